"""The record of a part: its inputs, what it took, how it ended."""

from collections.abc import Iterator
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, Literal

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.experiments.parts.experiment_part import ExperimentPart, file_name
from labutopia_lerobot.foreign_files import read_json
from labutopia_lerobot.runtime.claim import write_whole

type State = Literal["begun", "done", "failed"]

BEGUN: State = "begun"
DONE: State = "done"
FAILED: State = "failed"


class DamagedRecordError(UserError):
    """A record that cannot be read; the message names the file."""


@dataclass(frozen=True)
class PartRecord:
    """Record of a part.

    Attributes:
        name: What the part is called.
        rate_key: What it shares its rate with.
        state: How far it came.
        inputs: Everything that decides what it makes (see `ExperimentPart.inputs`).
        machine: What it was done on.
        digest: Hash of what it made, once it is done.
        size: How much work it was, without what a killed one had done before.
        volume: How much it stores, in the unit of its rate.
        seconds: How long the program ran [s].
        startup_s: Of these, before anything was to be seen [s].
        stored_bytes: Size of what it made [bytes].
        memory_bytes: Most memory of the program and its processes together [bytes].
        reason: Why it failed.
    """

    name: str
    rate_key: str
    state: State
    inputs: dict[str, Any]
    machine: str
    digest: str = ""
    size: float = 0.0
    volume: float = 0.0
    seconds: float = 0.0
    startup_s: float = 0.0
    stored_bytes: int = 0
    memory_bytes: int = 0
    reason: str = field(default="")


@dataclass(frozen=True)
class PartRecords:
    """Records in the folder of an experiment.

    Attributes:
        out: That folder.
    """

    out: Path

    def of(self, part: ExperimentPart) -> PartRecord | None:
        """Return the record of a part, or None if there is none.

        Raises:
            DamagedRecordError: If it cannot be read.
        """
        file = self._file(part)
        return read_json(file, PartRecord, DamagedRecordError) if file.is_file() else None

    def keep(self, part: ExperimentPart, record: PartRecord) -> None:
        """Write the record of a part, whole or not at all."""
        file = self._file(part)
        file.parent.mkdir(parents=True, exist_ok=True)
        write_whole(file, asdict(record))

    def drop(self, part: ExperimentPart) -> None:
        """Delete the record of a part, if there is one."""
        self._file(part).unlink(missing_ok=True)

    def all(self) -> Iterator[PartRecord]:
        """Yield every record, of parts of earlier experiments in the same folder too."""
        for file in sorted((self.out / "parts").glob("*.json")):
            yield read_json(file, PartRecord, DamagedRecordError)

    def _file(self, part: ExperimentPart) -> Path:
        return self.out / "parts" / f"{file_name(part)}.json"
