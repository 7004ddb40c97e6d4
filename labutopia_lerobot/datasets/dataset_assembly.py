"""The dataset of a recording, put together while its last episodes are still being played."""

import shutil
from collections.abc import Callable, Iterable
from functools import cached_property
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING

from labutopia_lerobot.datasets.candidate import Candidate
from labutopia_lerobot.datasets.recording_config import RecordingConfig

if TYPE_CHECKING:
    from labutopia_lerobot.datasets.assembler import DatasetAssembler


class Assembly:
    """Takes the stored candidates of a recording in the order of the dataset.

    Args:
        config: Options of the recording.
        work: Folder of the candidates; the dataset is made in it.
        assembled: Notified of every episode of the dataset.
    """

    def __init__(
        self, config: RecordingConfig, work: Path, assembled: Callable[[Candidate], None]
    ) -> None:
        self._config, self._work, self._assembled = config, work, assembled
        self._dataset = work / "dataset"
        self._taken = 0
        if self._dataset.exists():  # of a run that was killed
            shutil.rmtree(self._dataset)

    def take(self, settled: Iterable[Candidate]) -> None:
        """Append those that are new.

        Args:
            settled: All candidates so far whose place in the dataset is certain, in its order.
        """
        assembler = self._assembler  # before the first candidate is there: it takes seconds
        for candidate in islice(settled, self._taken, None):
            self._taken += 1
            if candidate.stored(self._config.keep):
                assembler.add(candidate)
                self._assembled(candidate)

    def finish(self, candidates: Iterable[Candidate]) -> Path:
        """Append what is missing of all candidates, and return the folder of the dataset."""
        candidates = list(candidates)
        self.take(candidates)
        self._assembler.finish(candidates)
        return self._dataset

    @cached_property
    def _assembler(self) -> "DatasetAssembler":
        # Imported late: LeRobot brings torch, which no worker needs.
        from labutopia_lerobot.datasets.assembler import DatasetAssembler

        return DatasetAssembler(self._config, self._work, self._dataset)
