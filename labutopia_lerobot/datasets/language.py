"""LeRobot's language columns: what is said and done of every frame, in its own form.

Its styles have their meanings: `task_aug` for paraphrases, `subtask` for steps, `memory` for
substeps (what has been achieved), `motion` for the expert's phases.
"""

import json
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pyarrow as pa
from lerobot.annotations.steerable_pipeline.reader import iter_episodes
from lerobot.annotations.steerable_pipeline.staging import EpisodeStaging
from lerobot.annotations.steerable_pipeline.writer import LanguageColumnsWriter
from lerobot.datasets.language import language_feature_info

from labutopia_lerobot.datasets.declaration import PHASE, STEP, SUBSTEP
from labutopia_lerobot.datasets.description import INFO, read_info
from labutopia_lerobot.datasets.tables import (
    PARAPHRASES,
    Row,
    column,
    frames_of_episodes,
    read_episodes,
)

_STYLES = {STEP: "subtask", SUBSTEP: "memory", PHASE: "motion"}


def add_language_columns(root: Path) -> None:
    """Write the language columns of a dataset from its annotations."""
    info = read_info(root)
    with tempfile.TemporaryDirectory() as staged:
        for row, frames in frames_of_episodes(root, read_episodes(root)):
            rows = list(_said(row, frames))
            EpisodeStaging(Path(staged), row["episode_index"]).write("plan", rows)
        LanguageColumnsWriter().write_all(list(iter_episodes(root)), Path(staged), root)
    info["features"] |= language_feature_info()
    (root / INFO).write_text(json.dumps(info, indent=4))


def _said(row: Row, frames: pa.Table) -> Iterator[dict[str, Any]]:
    """Yield what is said of an episode, each from when it holds [s]."""
    times = column(frames, "timestamp")[:, 0].tolist()
    for paraphrase in json.loads(row[PARAPHRASES]):
        yield {"role": "user", "content": paraphrase, "style": "task_aug", "timestamp": times[0]}
    for key, style in _STYLES.items():
        before = ""
        for content, time in zip(column(frames, key).tolist(), times, strict=True):
            if content not in ("", before):
                yield {"role": "assistant", "content": content, "style": style, "timestamp": time}
            before = content
