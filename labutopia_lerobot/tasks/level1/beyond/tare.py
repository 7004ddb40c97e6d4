"""Tare: set a balance to zero with a beaker on its pan (beyond the paper).

The paper names balances among its instruments; none of its tasks reads one.
"""

import math

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.weighing.precision_balance import PrecisionBalance
from labutopia_lerobot.layout import Inside, OnBench
from labutopia_lerobot.predicates import fingers_clear_of, reads, settled, standing_on
from labutopia_lerobot.scenes.views import WIDE_VESSEL_VIEW
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import actions, failures

YAW = (-math.radians(10), math.radians(10))  # ours: as far as the button stays within easy reach


def tare() -> Task:
    """Return the task."""
    balance, vessel = PrecisionBalance("balance"), glassware("beaker", "150 ml")
    return Task(
        instruction="Set the balance to zero with the beaker on it: press its blue button.",
        paraphrases=(
            "Tare the balance; the beaker stays on the pan.",
            "Press the blue key of the balance until its display shows zero.",
        ),
        start={
            balance: OnBench((0.22, 0.32), (-0.15, 0.10), YAW),
            vessel: Inside(balance, at=balance.pan_top),
        },
        steps=(actions.press(balance.tare, hold=0.3),),
        goal=(
            # Three times the repeatability that balances of this class have (`Weighing`).
            reads(balance.weighing, low=-0.03, high=0.03),
            settled(balance.weighing),
            standing_on(vessel, balance.pan.place),
            fingers_clear_of(balance.tare, by=0.05),  # as when a hot plate is switched on
        ),
        never=failures.handling(vessel, spill=None),
        time_limit_s=20.0,  # ours
        view=WIDE_VESSEL_VIEW,
    )
