"""Dispense: give 1 ml out of the pipette in the hand (beyond the paper)."""

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.scenes.views import PIPETTE_VIEW
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import pipetting


def dispense() -> Task:
    """Return the task."""
    bench = pipetting.PipetteBench()
    target = glassware("beaker_low", "50 ml", "target")
    return Task(
        instruction="Dispense the 1 ml in the pipette into the empty beaker, and lift it clear.",
        paraphrases=(
            "Empty the pipette into the empty beaker, and raise its tip above the rim.",
            "Press the pipette until its 1 ml is in the empty beaker; then lift it out.",
        ),
        start={**bench.start, target: bench.empty_place()},
        setup=(bench.taking, bench.aspirating),
        steps=(bench.dispense(target),),
        goal=bench.delivered(target),
        contents={bench.source: Filling(ml=pipetting.FILLED_ML)},
        never=bench.never(target),
        needs_liquid=True,
        time_limit_s=25.0,  # ours
        view=PIPETTE_VIEW,
    )
