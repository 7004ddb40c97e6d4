"""The paper's own numbers, printed there without how many episodes they are of."""

import csv
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from labutopia_lerobot.evaluation.condition import ID, OOD

_PLACES = tuple(Path(__file__).parents[up] / "eval" / "paper_results.csv" for up in (2, 3))
"""Inside the package in a wheel, beside it in a checkout."""

NAMES = {"act": "ACT", "diffusion": "DP", "pi0": "π0"}
"""Policy of LeRobot -> what the paper calls it."""


@dataclass(frozen=True)
class PaperNumber:
    """A number of the paper.

    Attributes:
        percent: As printed [%].
        n: Episodes that the fractions of its table imply; inferred, the paper does not say.
    """

    percent: float
    n: int


LEFT_OUT = (
    "Left out: the paper's A4 to A7 of liquid_fusion, which repeat clean_beaker's, and its A7 of "
    "drying_beakers, a seventh column of six actions."
)
"""The paper's numbers that no row of ours stands beside; a note in the file marks them."""


@cache
def paper_results() -> dict[tuple[str, str, str, str, int], PaperNumber]:
    """Return every number of the result tables that is about one of our tasks.

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
            ): PaperNumber(float(line["percent"]), int(line["inferred_n"]))
            for line in csv.DictReader(lines)
            if not line["note"]
        }


def paper_number(
    task: str, policy: str, condition: str = ID, play: str = "single", step: int = 0
) -> PaperNumber | None:
    """Return a number of the paper, or None if it has none."""
    return paper_results().get((task, policy, condition, play, step))
