"""Prepare solution: weigh out a stock solution, and fill it up with water to a concentration.

Beyond the paper, whose laboratory has no chemistry in its vessels. It is made up by mass, in a
beaker on the balance. A solid on a spatula and a volumetric flask are missing: nothing here pours a
powder.
"""

import math

from labutopia_lerobot.chemistry.inventory import Solute
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
_TOTAL_G = 120.0
"""Mass of the solution [g]: a balance here takes it for water, so that it is ml too; ours."""
_WITHIN_G = 4.0
"""How near to that, and how near the stock to its share [g]; ours: what counts is their ratio."""
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
    celsius, share = start_temperature(draw), _TOTAL_G * molar / _STOCK
    balance, target = PrecisionBalance("balance"), glassware("beaker", "250 ml", "large")
    stock = glassware("beaker", "150 ml", "stock_beaker")
    water = glassware("beaker", "150 ml", "water_beaker")
    weighing = balance.weighing
    low, high = (molar * (1.0 + off) for off in (-_WITHIN, _WITHIN))
    made = concentration(target, species=_SALTS[salt], low=low, high=high)
    full = reads(weighing, low=_TOTAL_G - _WITHIN_G, high=_TOTAL_G + _WITHIN_G)
    there = (made, full, settled(weighing))
    near = _WITHIN_G / 4
    weigh = actions.pour_by_reading(stock, target, weighing, mass=share, within=near, coarse=0.3)
    fill_up = actions.dilute(water, target, weighing, times=_STOCK / molar, there=there)
    homes = {vessel: WhereItStood(vessel) for vessel in (stock, water)}
    return Task(
        instruction=f"Prepare {_TOTAL_G:g} g of {molar:g} mol/l {salt}: tare the balance, weigh "
        f"{share:.0f} g of the {_STOCK:g} mol/l stock into its beaker, fill it up with water, and "
        "put both beakers back.",
        paraphrases=(
            f"Dilute the {_STOCK:g} mol/l {salt} to {molar:g} mol/l on the tared balance: "
            f"{share:.0f} g of it, and water up to {_TOTAL_G:g} g. Return both beakers.",
            f"Make up {_TOTAL_G:g} g of {salt}, {molar:g} mol/l, of the coloured stock of "
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
            stock: Filling(_STOCK_ML, celsius=celsius, dissolved=(Solute(salt, _STOCK),)),
            water: Filling(_WATER_ML, celsius=celsius),
        },
        never={
            **failures.of_any(
                *(failures.handling(v, spill=0.02, into=target) for v in (stock, water))
            ),
            "struck": struck(target, but_for=frozenset({balance.pan.name})),
            "overshot": given(stock, target, more_than_ml=share + _WITHIN_G),
        },
        needs_liquid=True,
        time_limit_s=260.0,  # ours
        view=WIDE_VESSEL_VIEW,
    )
