"""Place: set a beaker that is in the hand down on a plate (paper, level 1, "Place").

Ported from: config/level1_place.yaml, tasks/place_task.py, controllers/place_controller.py.
"""

from labutopia_lerobot.labware.glassware import beaker
from labutopia_lerobot.labware.target_plate import TargetPlate
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.places import OnTop
from labutopia_lerobot.predicates import (
    falling,
    gripped,
    knocked_over,
    near,
    released,
    standing_on,
    steady,
    struck,
    withdrawn,
)
from labutopia_lerobot.scenes.views import WIDE_VESSEL_VIEW
from labutopia_lerobot.skills.pick import Pick
from labutopia_lerobot.skills.place import Place
from labutopia_lerobot.task import Substep, Task


def place() -> Task:
    """Return the task."""
    vessel, plate = beaker("beaker"), TargetPlate("target_plate")
    target = OnTop(plate)
    at_target = near(vessel, target, within=0.04)  # original: 0.05, where the base overhangs
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
        prelude=(Pick(vessel, lift=0.25),),
        expert=(Place(vessel, on=target),),
        substeps=(
            Substep("carried", (at_target, gripped(vessel))),
            Substep("placed", (at_target, standing_on(vessel, target))),
            Substep("released", (released(vessel),)),
        ),
        goal=(
            at_target,
            standing_on(vessel, target),  # paper: "upright ... with its base in full contact"
            released(vessel),
            withdrawn(vessel, by=0.05),  # original, TransportBeaker: gripper 0.05 m away
            steady(vessel, below=0.02),  # paper: "maintaining stability"; ours: at rest
        ),
        never={
            "knocked_over": knocked_over(vessel, beyond_deg=30),
            "dropped": falling(vessel, faster_than=0.5),  # free fall over 13 mm
            "collided": struck(plate, but_for=frozenset({vessel.name})),
        },
        time_limit_s=2000 / 60,  # original: 2000 steps at 60 Hz
        view=WIDE_VESSEL_VIEW,
    )
