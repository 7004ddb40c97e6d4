"""Pour: tilt a beaker that is in the hand over another and back (paper, level 1, "Pour").

Ported from: config/level1_pour.yaml, tasks/pickpour_task.py, controllers/pour_controller.py.
"""

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.predicates import gripped, lifted, steady, struck, upright
from labutopia_lerobot.scenes.views import WIDE_VESSEL_VIEW
from labutopia_lerobot.skills import Pick
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import actions, failures


def pour() -> Task:
    """Return the task."""
    return pour_from(glassware("beaker", "250 ml"))


def pour_from(vessel: Vessel) -> Task:
    """Return the task with a vessel, which level 3 varies."""
    target = glassware("beaker", "800 ml", "target_beaker")
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
        setup=(Pick(vessel, lift=0.25),),
        steps=(actions.pour(vessel, target),),
        goal=(
            gripped(vessel),
            lifted(vessel, by=0.05),  # original: z > z0 + 0.05
            upright(vessel, within_deg=10),
            steady(vessel, below=0.05),  # paper: "remaining stable"; ours: as in Pick
        ),
        contents={vessel: Filling(ml=100)},  # ours: a good third of what it holds
        never={
            **failures.handling(vessel, spill=0.05, into=target),
            "struck": struck(target),
        },
        time_limit_s=1500 / 60,  # original: 1500 steps at 60 Hz
        view=WIDE_VESSEL_VIEW,
    )
