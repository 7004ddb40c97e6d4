"""Navigate: drive to a beaker and face it, within the arm's reach (beyond the paper).

The first two steps of the paper's "Navigation and Manipulation".
"""

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.layout import OnSomeBench
from labutopia_lerobot.predicates import at_hand, facing, halted
from labutopia_lerobot.scenes.views import DRIVING_VIEW
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import driving, failures


def navigate() -> Task:
    """Return the task."""
    beaker = glassware("beaker", "250 ml")
    return Task(
        instruction="Drive to the beaker, face it, and halt where the arm could take it.",
        paraphrases=(
            "Go to the bench on which the beaker stands and stop in front of it, turned to it.",
            "Find the beaker in the laboratory and drive up to it, facing it; do not touch it.",
        ),
        start={beaker: OnSomeBench()},
        drives=True,
        steps=(
            driving.navigate(beaker).named("1_navigate"),
            driving.face(beaker).named("2_face"),
        ),
        goal=(
            at_hand(beaker, share=driving.AT_HAND),
            facing(beaker, within_deg=driving.FACING),
            halted(than=driving.HALTED),
        ),
        never=failures.handling(beaker, spill=None),
        time_limit_s=100.0,  # ours: four times what the expert needs on average
        view=DRIVING_VIEW,
    )
