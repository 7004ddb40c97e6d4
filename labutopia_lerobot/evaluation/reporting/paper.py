"""The paper's own numbers, printed there without how many episodes they are of."""

import csv
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from labutopia_lerobot.evaluation.reporting.entry import ID, OOD

_PLACES = tuple(Path(__file__).parents[up] / "eval" / "paper_results.csv" for up in (2, 3))
"""Inside the package in a wheel, beside it in a checkout."""

NAMES = {"act": "ACT", "diffusion": "DP", "pi0": "π0"}
"""Policy of LeRobot -> what the paper calls it."""


@dataclass(frozen=True)
class Printed:
    """A number of the paper.

    Attributes:
        percent: As printed [%].
        n: Episodes that the fractions of its table imply; inferred, the paper does not tell.
    """

    percent: float
    n: int


@cache
def paper_results() -> dict[tuple[str, str, str, str, int], Printed]:
    """Return every number of the result tables.

    Returns:
        (task, policy, condition, play, step) -> number; step 0 is the whole task.
    """
    file = next(place for place in _PLACES if place.exists())
    with file.open(newline="") as lines:
        return {
            (
                line["task"],
                line["policy"],
                {"id": ID, "ood": OOD}[line["split"]],
                line["play"],
                int(line["step"] or 0),
            ): Printed(float(line["percent"]), int(line["inferred_n"]))
            for line in csv.DictReader(lines)
        }


def printed(
    task: str, policy: str, condition: str = ID, play: str = "single", step: int = 0
) -> Printed | None:
    """Return a number of the paper, or None if it has none."""
    return paper_results().get((task, policy, condition, play, step))
