"""Prepare solution: weigh out a stock solution, and fill it up with water to a concentration.

Beyond the paper, whose laboratory has no chemistry in its vessels. It is made up by mass, in a
beaker on the balance. A solid on a spatula and a volumetric flask are missing: nothing here pours a
powder.
"""

import math

from labutopia_lerobot.chemistry.inventory import Solute
from labutopia_lerobot.chemistry.poured_together import density
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.weighing.precision_balance import PrecisionBalance
from labutopia_lerobot.layout import Inside, OnBench
from labutopia_lerobot.places import WhereItStood
from labutopia_lerobot.predicates import (
    concentration,
    given,
    reads,
    settled,
    standing_on,
    struck,
)
from labutopia_lerobot.scenario import Draw
from labutopia_lerobot.scenes.views import WIDE_VESSEL_VIEW
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import actions, failures
from labutopia_lerobot.tasks.variety import start_temperature

# What is made up -> the ion that it is judged by; one for each formula unit.
_SALTS = {
    "copper(II) sulfate": "Cu^2+(aq)",
    "potassium hexacyanidoferrate(III)": "[Fe(CN)6]^3-(aq)",
    "nickel(II) chloride": "Ni^2+(aq)",
    "potassium chromate": "CrO4^2-(aq)",
}
_STOCK = 0.5
"""Of the stock solution [mol/l]; ours."""
_TOTAL_ML = 120.0
"""Volume of the solution [ml]; ours."""
_WITHIN_G = 4.0
"""How near to its mass, and the stock to its share [g]; ours: what counts is their ratio."""
_WITHIN = 0.02
"""How near the concentration must be, as a part of it; as is asked of a student."""
_STOCK_ML, _WATER_ML = 85.0, 110.0
"""What the beakers hold [ml]; ours: of either a quarter is left."""
_BACK = 0.05
"""How near to where they stood they are to be put back [m]; ours, as `pour_to_mass`."""


def prepare_solution(draw: Draw) -> Task:
    """Return the task that an episode has drawn."""
    names = list(_SALTS)
    salt = draw.choice("substance", train=names[:2], test=names[2:], shifted=True)
    molar = draw.choice("concentration", train=(0.20, 0.15, 0.25), test=(0.18, 0.22), shifted=True)
    celsius, solutes = start_temperature(draw), (Solute(salt, _STOCK),)
    ml = _TOTAL_ML * molar / _STOCK
    share = round(1e-3 * density(solutes) * ml, 1)
    total = round(share + 1e-3 * density(()) * (_TOTAL_ML - ml), 1)
    balance, target = PrecisionBalance("balance"), glassware("beaker", "250 ml", "large")
    stock = glassware("beaker", "150 ml", "stock_beaker")
    water = glassware("beaker", "150 ml", "water_beaker")
    weighing = balance.weighing
    low, high = (molar * (1.0 + off) for off in (-_WITHIN, _WITHIN))
    made = concentration(target, species=_SALTS[salt], low=low, high=high)
    full = reads(weighing, low=total - _WITHIN_G, high=total + _WITHIN_G)
    there = (made, full, settled(weighing))
    weigh = actions.pour_by_reading(
        stock, target, weighing, mass=share, within=_WITHIN_G, aim=_WITHIN_G / 4, coarse=0.3
    )
    fill_up = actions.dilute(water, target, weighing, times=total / share, there=there)
    homes = {vessel: WhereItStood(vessel) for vessel in (stock, water)}
    return Task(
        instruction=f"Prepare {total:g} g of {molar:g} mol/l {salt}: tare the balance, weigh "
        f"{share:g} g of the {_STOCK:g} mol/l stock into its beaker, fill it up with water, and "
        "put both beakers back.",
        paraphrases=(
            f"Dilute the {_STOCK:g} mol/l {salt} to {molar:g} mol/l on the tared balance: "
            f"{share:g} g of it, and water up to {total:g} g. Return both beakers.",
            f"Make up {total:g} g of {salt}, {molar:g} mol/l, of the coloured stock of "
            f"{_STOCK:g} mol/l and water, by the balance, then put the two beakers back.",
        ),
        start={
            balance: OnBench((0.28, 0.36), (-0.12, -0.04), (-math.radians(10), math.radians(10))),
            target: Inside(balance, at=balance.pan_top),
            stock: OnBench(x=(0.14, 0.19), y=(0.13, 0.17)),
            water: OnBench(x=(0.31, 0.36), y=(0.26, 0.30)),
        },
        steps=(
            actions.press(balance.tare, hold=0.3).named("tare"),
            actions.pick(stock, by=actions.OFF_THE_BENCH).named("take_stock"),
            weigh.named("weigh"),
            actions.place(stock, homes[stock], within=_BACK).named("return_stock"),
            actions.pick(water, by=actions.OFF_THE_BENCH).named("take_water"),
            fill_up,
            actions.place(water, homes[water], within=_BACK).named("return_water"),
        ),
        goal=(
            *there,
            standing_on(target, balance.pan.place),
            standing_on(stock, homes[stock]),
            *actions.left_standing(water, homes[water], within=_BACK),
        ),
        contents={
            stock: Filling(_STOCK_ML, celsius=celsius, dissolved=solutes),
            water: Filling(_WATER_ML, celsius=celsius),
        },
        never={
            **failures.of_any(
                *(failures.handling(v, spill=0.02, into=target) for v in (stock, water))
            ),
            "struck": struck(target, but_for=frozenset({balance.pan.name})),
            "overshot": given(stock, target, more_than_ml=ml * (1.0 + _WITHIN_G / share)),
        },
        needs_liquid=True,
        time_limit_s=260.0,  # ours
        view=WIDE_VESSEL_VIEW,
    )
