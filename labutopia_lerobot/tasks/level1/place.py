"""Place: set a beaker that is in the hand down on a plate (paper, level 1, "Place").

Ported from: config/level1_place.yaml, tasks/place_task.py, controllers/place_controller.py.
"""

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.target_plate import TargetPlate
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.places import OnTop
from labutopia_lerobot.predicates import struck
from labutopia_lerobot.scenes.views import WIDE_VESSEL_VIEW
from labutopia_lerobot.skills import Pick
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import actions, failures


def place() -> Task:
    """Return the task."""
    vessel, plate = glassware("beaker", "250 ml"), TargetPlate("target_plate")
    within = 0.04  # original: 0.05, where the base overhangs
    return Task(
        instruction="Set the beaker in the gripper down on the target plate.",
        paraphrases=(
            "Place the beaker you are holding onto the white plate.",
            "Put the beaker down in the middle of the plate and let go.",
        ),
        # Original: the same ranges, which are the paper's 15 cm x 15 cm.
        start={
            vessel: OnBench(x=(0.19, 0.34), y=(0.10, 0.25)),
            plate: OnBench(x=(0.18, 0.33), y=(-0.32, -0.17)),
        },
        setup=(Pick(vessel, lift=0.25),),
        steps=(actions.place(vessel, OnTop(plate), within=within),),
        goal=actions.left_standing(vessel, OnTop(plate), within=within),
        never={
            **failures.handling(vessel, spill=None),
            "struck": struck(plate, but_for=frozenset({vessel.name})),
        },
        time_limit_s=2000 / 60,  # original: 2000 steps at 60 Hz
        view=WIDE_VESSEL_VIEW,
    )
