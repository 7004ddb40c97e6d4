"""Annotations of each episode, beyond those of every LeRobotDataset."""

import json
from dataclasses import asdict
from typing import Any

from labutopia_lerobot.datasets.candidate import Candidate, candidate_of
from labutopia_lerobot.datasets.tables import (
    CAUSE,
    DRAWN,
    MACHINE,
    OUTCOME,
    PARAPHRASES,
    PRIVILEGED,
    RENDERER,
    ROUTES,
    SEED,
    SEGMENTS,
    SETTING,
    VOLUMES,
    Row,
    setting_column,
)
from labutopia_lerobot.robots import load_robot
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import SEGMENTATION, Setting
from labutopia_lerobot.sim.segments import segment_names

_PLAIN = {
    SEED: "seed",
    OUTCOME: "outcome",
    CAUSE: "cause",
    MACHINE: "machine",
    RENDERER: "renderer",
}
_JSON = {
    DRAWN: "drawn",
    VOLUMES: "volumes",
    PARAPHRASES: "paraphrases",
    PRIVILEGED: "privileged",
}


def annotations(candidate: Candidate, setting: Setting) -> dict[str, int | str]:
    """Return the columns of our own in the episode table, for one episode."""
    values = asdict(candidate)
    segmented, base = SEGMENTATION in setting.extras, load_robot(setting.robot).base
    return {
        SETTING: setting_column(setting),
        **{column: values[name] for column, name in _PLAIN.items()},
        **{column: json.dumps(values[name]) for column, name in _JSON.items()},
        **({SEGMENTS: json.dumps(segment_names(canonical_task(setting)))} if segmented else {}),
        **({ROUTES: json.dumps(values["routes"])} if base is not None else {}),
    }


def annotated_candidate(row: Row, first_seed: int) -> Candidate:
    """Return the candidate that an episode was.

    Args:
        row: Its row of the episode table.
        first_seed: The seed of candidate 0.
    """
    fields: dict[str, Any] = {name: row[column] for column, name in _PLAIN.items()}
    fields |= {name: json.loads(row[column]) for column, name in _JSON.items()}
    fields["routes"] = json.loads(row.get(ROUTES) or "null")
    return candidate_of(
        fields
        | {
            "task": json.loads(row[SETTING])["task"],
            "index": row[SEED] - first_seed,
            "frames": row["length"],
            "instruction": row["tasks"][0],
        }
    )
