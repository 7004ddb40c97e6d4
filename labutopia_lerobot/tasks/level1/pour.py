"""Pour: tilt a beaker that is in the hand over another and back (paper, level 1, "Pour").

Ported from: config/level1_pour.yaml, tasks/pickpour_task.py, controllers/pour_controller.py.
"""

from labutopia_lerobot.labware.glassware import beaker
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.predicates import (
    falling,
    gripped,
    lifted,
    lip_over,
    poured,
    spilled,
    steady,
    struck,
    upright,
)
from labutopia_lerobot.skills.pick import Pick
from labutopia_lerobot.skills.pour import Pour
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Substep, Task
from labutopia_lerobot.views import WIDE_VESSEL_VIEW


def pour() -> Task:
    """Return the task."""
    vessel, target = beaker("beaker"), beaker("target_beaker", "800 ml")
    return Task(
        instruction="Pour the beaker in the gripper into the large beaker.",
        paraphrases=(
            "Empty the beaker you are holding into the big beaker and hold it upright again.",
            "Tip the contents of the small beaker into the 800 ml beaker.",
        ),
        # Original: the same ranges, which are the paper's 15 cm x 15 cm.
        start={
            vessel: OnBench(x=(0.22, 0.37), y=(0.0, 0.15)),
            target: OnBench(x=(0.18, 0.33), y=(-0.32, -0.17)),
        },
        prelude=(Pick(vessel, lift=0.25),),
        expert=(Pour(vessel, into=target),),
        substeps=(
            # Ours: the volume. Original: a tilt of 50 deg.
            Substep("poured", (poured(vessel, target, share=0.80),)),
            Substep("righted", (upright(vessel, within_deg=10),)),  # original: 30 deg
        ),
        goal=(
            gripped(vessel),
            lifted(vessel, by=0.05),  # original: z > z0 + 0.05
            upright(vessel, within_deg=10),
            steady(vessel, below=0.02),  # paper: "remaining stable"; ours: at rest
        ),
        contents={vessel: Filling(ml=100)},  # ours: a good third of what it holds
        never={
            "spilled": spilled(vessel, share=0.05, unless=lip_over(vessel, target)),  # ours
            "dropped": falling(vessel, faster_than=0.5),  # free fall over 13 mm
            "collided": struck(target),
        },
        time_limit_s=1500 / 60,  # original: 1500 steps at 60 Hz
        view=WIDE_VESSEL_VIEW,
    )
