"""Pipette transfer: take a pipette, move 1 ml from one beaker to another (beyond the paper)."""

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.scenes.views import PIPETTE_VIEW
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import pipetting


def pipette_transfer() -> Task:
    """Return the task."""
    bench = pipetting.PipetteBench()
    target = glassware("beaker_low", "50 ml", "target")
    return Task(
        instruction="Take the pipette, move 1 ml of water into the empty beaker, and hold it.",
        paraphrases=(
            "With the pipette from the stand, transfer 1 ml from the full to the empty beaker.",
            "Pipette 1 ml of water out of the one beaker into the other; keep the pipette.",
        ),
        start={**bench.start, target: bench.empty_place()},
        steps=(
            bench.take(),
            bench.aspirate(),
            bench.dispense(target),
        ),
        goal=bench.delivered(target),
        contents={bench.source: Filling(ml=pipetting.FILLED_ML)},
        never=bench.never(target),
        needs_liquid=True,
        time_limit_s=60.0,  # ours
        view=PIPETTE_VIEW,
    )
