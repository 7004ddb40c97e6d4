"""Aspirate: draw up 1 ml with the pipette in the hand (beyond the paper)."""

from labutopia_lerobot.scenes.views import PIPETTE_VIEW
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import pipetting


def aspirate() -> Task:
    """Return the task."""
    bench = pipetting.PipetteBench()
    return Task(
        instruction="Draw up 1 ml of water with the pipette, and lift its tip out.",
        paraphrases=(
            "Aspirate 1 ml from the beaker: press the pipette, dip it, release, lift it out.",
            "Fill the pipette in the hand with 1 ml of water and lift its tip out of the beaker.",
        ),
        start=bench.start,
        setup=(bench.taking,),
        steps=(bench.aspirate(),),
        goal=bench.full(),
        contents={bench.source: Filling(ml=pipetting.FILLED_ML)},
        never=bench.never(),
        needs_liquid=True,
        time_limit_s=25.0,  # ours
        view=PIPETTE_VIEW,
    )
