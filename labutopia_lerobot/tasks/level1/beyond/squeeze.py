"""Squeeze: dispense from a soft wash bottle into a beaker (beyond the paper).

The paper simulates soft bodies, but none of its tasks needs one; the original's code has neither.
"""

import math

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.soft.wash_bottle import WashBottle
from labutopia_lerobot.layout import Inside, OnBench
from labutopia_lerobot.predicates import (
    Transfer,
    dispensed,
    gripped,
    released,
    spilled,
    struck,
    withdrawn,
)
from labutopia_lerobot.scenes.views import WIDE_VESSEL_VIEW
from labutopia_lerobot.skills import Squeeze
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Step, Substep, Task

_AMOUNT_ML = 20.0
"""A rinse of a 250 ml beaker; one firm stroke gives a little more."""


def squeeze() -> Task:
    """Return the task."""
    bottle, target = WashBottle("bottle"), glassware("beaker", "250 ml")
    enough = dispensed(bottle, target, at_least_ml=_AMOUNT_ML)
    return Task(
        instruction="Squeeze the wash bottle until at least 20 ml are in the beaker.",
        paraphrases=(
            "Dispense 20 ml or more into the beaker by squeezing the wash bottle, then let go.",
            "Press the soft bottle until 20 ml have run out of its spout, and leave it standing.",
        ),
        start={
            bottle: OnBench(
                x=(0.22, 0.37),
                y=(-0.05, 0.10),
                # The spout points away from the hand, which comes from the robot's left.
                yaw=(-math.radians(90), -math.radians(30)),
            ),
            target: Inside(bottle, at=(bottle.spout_reach, 0.0, 0.0)),
        },
        steps=(
            Step(
                "squeeze",
                (Squeeze(bottle, amount_ml=_AMOUNT_ML + 2.0),),
                (
                    Substep("gripped", (gripped(bottle),)),
                    Substep("dispensed", (enough,)),
                    Substep("released", (released(bottle),)),
                ),
                (bottle,),  # not its cap and spout, which are another body
                transfers=(Transfer(bottle, target),),
            ),
        ),
        goal=(
            enough,
            released(bottle),
            withdrawn(bottle, by=0.05),
        ),
        contents={bottle: Filling(ml=200)},
        never={
            "spilled": spilled(bottle, share=0.01),
            "struck": struck(target),
        },
        time_limit_s=20.0,  # ours: twice the expert's median of 9.5 s, rounded up
        view=WIDE_VESSEL_VIEW,
    )
