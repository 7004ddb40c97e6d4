"""Pour to mass: tare the balance, then pour 50 g of water by its reading (beyond the paper)."""

import math

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.labware.instruments.weighing.precision_balance import PrecisionBalance
from labutopia_lerobot.layout import Inside, OnBench
from labutopia_lerobot.places import WhereItStood
from labutopia_lerobot.predicates import given, reads, settled, standing_on, struck
from labutopia_lerobot.scenes.views import WIDE_VESSEL_VIEW
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import actions, failures

MASS, WITHIN = 50.0, 1.0
"""Mass to pour, and its tolerance [g]; ours."""
YAW = (-math.radians(10), math.radians(10))  # ours: as far as the button stays within easy reach


def pour_to_mass() -> Task:
    """Return the task."""
    return weigh_from(glassware("beaker", "150 ml", "small"))


def weigh_from(source: Vessel, *, mass: float = MASS) -> Task:
    """Return the task with a vessel and a mass [g], which level 3 varies."""
    balance, target = PrecisionBalance("balance"), glassware("beaker", "250 ml", "large")
    back = WhereItStood(source)
    return Task(
        instruction="Tare the balance, pour 50 g of water into its beaker and put the rest back.",
        paraphrases=(
            "Set the balance to zero and weigh out 50 g of water from the small beaker.",
            "Pour until the balance shows 50 g, no more than 51, then return the small beaker.",
        ),
        start={
            balance: OnBench((0.28, 0.36), (-0.12, -0.04), YAW),
            target: Inside(balance, at=balance.pan_top),
            source: OnBench(x=(0.17, 0.27), y=(0.13, 0.21)),
        },
        steps=(
            actions.press(balance.tare, hold=0.3).named("tare"),
            actions.pick(source, by=actions.OFF_THE_BENCH),
            actions.pour_by_reading(source, target, balance.weighing, mass=mass, within=WITHIN),
            actions.place(source, back, within=0.05),
        ),
        goal=(
            reads(balance.weighing, low=mass - WITHIN, high=mass + WITHIN),
            settled(balance.weighing),
            standing_on(target, balance.pan.place),
            *actions.left_standing(source, back, within=0.05),
        ),
        contents={source: Filling(ml=100)},  # ours: twice what is wanted
        never={
            **failures.handling(source, spill=0.02, into=target),
            "struck": struck(target, but_for=frozenset({balance.pan.name})),
            "overshot": given(source, target, more_than_ml=mass + 2 * WITHIN),
        },
        needs_liquid=True,
        time_limit_s=90.0,  # ours
        view=WIDE_VESSEL_VIEW,
    )
