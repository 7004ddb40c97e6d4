"""Transport to oven: fetch a filled beaker and put it into a drying oven on another bench.

Beyond the paper: its "transport container between areas", to where it is dried. The oven is that
of level 4, "Drying Beaker", and so is its place before the robot; its door stands open.
"""

import math
from dataclasses import replace

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.layout import OnDeepBench, OnSomeBench
from labutopia_lerobot.predicates import halted, touching
from labutopia_lerobot.scenes.views import DRIVING_VIEW
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import actions, driving, failures
from labutopia_lerobot.tasks.level4.drying_beakers import MOUTH, OVEN, RIGHT, WITHIN, YAW

AJAR = math.radians(110)  # ours: as far as a person leaves it open who has both hands full


def transport_to_oven() -> Task:
    """Return the task."""
    beaker, oven = glassware("beaker", "250 ml"), replace(OVEN, ajar=AJAR)
    return Task(
        instruction=(
            "Drive to the beaker, face it, pick it up, carry it to the drying oven without "
            "spilling, face the oven, and set the beaker down inside, on the right of the shelf."
        ),
        paraphrases=(
            "Fetch the beaker, facing it as you take it, then face the open drying oven and put "
            "the beaker into it, on the right of its shelf.",
            "Turn to the beaker, bring it across the laboratory, turn to the oven and stand it on "
            "the shelf, to the right; spill nothing and touch nothing with it.",
        ),
        start={
            beaker: OnSomeBench(),
            # As in level 4, from the base of the arm.
            oven: OnDeepBench(ahead=(0.97, 1.00), left=(-0.045, -0.005), yaw=(-YAW, YAW)),
        },
        drives=True,
        steps=(
            driving.navigate(beaker).named("1_navigate"),
            driving.face(beaker).named("2_face"),
            driving.pick(beaker).named("3_pick"),
            driving.navigate(oven, carrying=beaker).named("4_navigate"),
            driving.face(oven, carrying=beaker).named("5_face"),
            driving.place(beaker, RIGHT, at=oven, within=WITHIN, through=MOUTH).named("6_place"),
        ),
        goal=(
            *actions.left_standing(beaker, RIGHT, within=WITHIN),
            halted(than=driving.HALTED),
        ),
        contents={beaker: Filling(ml=100)},  # as in transport_between_areas
        never={
            **failures.handling(beaker, spill=0.01),
            **driving.collisions(beaker, oven.shelf),
            # Paper, level 4: no "contact ... with the cabinet structure".
            "struck": touching(beaker, oven, oven.door, oven.door.handle),
        },
        time_limit_s=200.0,  # ours: three times what the expert needs in the largest rooms
        view=DRIVING_VIEW,
    )
