"""Navigation and Manipulation: drive to a beaker, face it, pick it up (paper, level 5).

The original has an expert for it and no metric, the paper no number: distance, heading and lift are
ours.
"""

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.layout import OnSomeBench
from labutopia_lerobot.predicates import gripped, halted, raised, steady, upright
from labutopia_lerobot.scenes.views import DRIVING_VIEW
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import driving, failures


def navigation_and_manipulation() -> Task:
    """Return the task."""
    beaker = glassware("beaker", "250 ml")
    return Task(
        instruction=(
            "Drive to the beaker, face it, pick it up and hold it still, 20 cm above its bench."
        ),
        paraphrases=(
            "Find the beaker in the laboratory, drive up to it, turn to it and lift it by 20 cm.",
            "Go to the bench with the beaker, halt facing it, and raise the beaker 20 cm.",
        ),
        # Paper: robot and beaker "randomly initialized at available positions".
        start={beaker: OnSomeBench()},
        drives=True,
        steps=(
            driving.navigate(beaker).named("1_navigate"),
            driving.face(beaker).named("2_face"),
            driving.pick(beaker).named("3_pick"),
        ),
        goal=(
            raised(beaker, by=driving.LIFT),
            gripped(beaker),  # paper: "securely grasp"
            upright(beaker, within_deg=20),  # ours, as in level 1
            steady(beaker, below=0.05),  # paper: no "instability"; the number is level 1's
            halted(than=driving.HALTED),
        ),
        never={**failures.handling(beaker, spill=None), **driving.collisions(beaker)},
        time_limit_s=120.0,  # ours: three times what the expert needs in the largest rooms
        view=DRIVING_VIEW,
    )
