"""Weigh beaker: tare the empty balance, set a beaker on it, wait until it settles.

Beyond the paper.
"""

import math

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.weighing.precision_balance import PrecisionBalance
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.predicates import reads, settled
from labutopia_lerobot.scenes.views import WIDE_VESSEL_VIEW
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import actions, failures

YAW = (-math.radians(10), math.radians(10))  # ours: as far as the button stays within easy reach


def weigh_beaker() -> Task:
    """Return the task."""
    # Somebody has tared it with more on it than a pan: it reads minus that.
    balance = PrecisionBalance("balance", tared=(20.0, 200.0))
    vessel, pan = glassware("beaker", "150 ml"), balance.pan.place
    grams = 1e3 * vessel.mass
    return Task(
        instruction="Tare the empty balance and weigh the beaker: set it on the pan and let go.",
        paraphrases=(
            "Set the balance to zero, then put the beaker on it until the reading settles.",
            "Find out what the beaker weighs: tare first, then place it on the pan.",
        ),
        start={
            balance: OnBench((0.28, 0.36), (-0.14, -0.06), YAW),
            vessel: OnBench(x=(0.17, 0.27), y=(0.12, 0.20)),
        },
        steps=(
            actions.press(balance.tare, hold=0.3).named("tare"),
            actions.pick(vessel, by=actions.OFF_THE_BENCH),
            actions.place(vessel, pan, within=0.05),
        ),
        goal=(
            # Ours: five times what such a balance trembles by.
            reads(balance.weighing, low=grams - 0.05, high=grams + 0.05),
            settled(balance.weighing),
            *actions.left_standing(vessel, pan, within=0.05),
        ),
        never=failures.handling(vessel, spill=None),
        time_limit_s=45.0,  # ours
        view=WIDE_VESSEL_VIEW,
    )
