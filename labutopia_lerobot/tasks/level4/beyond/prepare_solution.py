"""Prepare solution: dissolve crystals, weigh out what they make, and fill it up to a concentration.

Beyond the paper, whose laboratory has no chemistry in its vessels. It is made up by mass, in a
beaker on the balance; there is no solid on a spatula, and no volumetric flask.
"""

import math

from labutopia_lerobot.chemistry.crystals import Crystals
from labutopia_lerobot.chemistry.inventory import Solute
from labutopia_lerobot.chemistry.poured_together import density
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.weighing.precision_balance import PrecisionBalance
from labutopia_lerobot.layout import Inside, OnBench
from labutopia_lerobot.places import OverBench, WhereItStood
from labutopia_lerobot.predicates import (
    concentration,
    dissolved,
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

# What is made up -> the ion that it is judged by, one for each formula unit; grams of crystals.
_SALTS = {
    "copper(II) chloride": ("Cu^2+(aq)", 5.71),
    "potassium hexacyanidoferrate(III)": ("[Fe(CN)6]^3-(aq)", 13.99),
    "nickel(II) chloride": ("Ni^2+(aq)", 5.51),
    "potassium chromate": ("CrO4^2-(aq)", 8.25),
}
_STOCK = 0.5
"""Of the stock, when its crystals have dissolved [mol/l]; ours."""
_GRAIN_MM = 0.7
"""Diameter of a grain [mm]; ours, as `level2/dissolve`."""
_ACID = Solute("sulfuric acid", 1e-3)
"""In the water that they dissolve in [mol/l]; ours, as `level2/dissolve`."""
_TOTAL_ML, _STOCK_ML, _WATER_ML = 120.0, 85.0, 110.0
"""Volumes of the solution, and of what the two beakers hold [ml]; ours: a quarter of it is left."""
_WITHIN_G = 4.0
"""How near to its mass, and the stock to its share [g]; ours: what counts is their ratio."""
_WITHIN = 0.02
"""How near the concentration must be, as a part of it; as is asked of a student."""
_BACK = 0.05
"""How near to where they stood they are to be put back [m]; ours, as `pour_to_mass`."""


def prepare_solution(draw: Draw) -> Task:
    """Return the task that an episode has drawn."""
    salts = list(_SALTS)
    salt = draw.choice("substance", train=salts[:2], test=salts[2:], shifted=True)
    (ion, grams), solutes = _SALTS[salt], (Solute(salt, _STOCK),)
    molar = draw.choice("concentration", train=(0.20, 0.15, 0.25), test=(0.18, 0.22), shifted=True)
    celsius, crystals = start_temperature(draw), (Crystals(salt, grams, _GRAIN_MM),)
    ml = _TOTAL_ML * molar / _STOCK
    share = round(1e-3 * density(solutes) * ml, 1)
    total = round(share + 1e-3 * density(()) * (_TOTAL_ML - ml), 1)
    balance, target = PrecisionBalance("balance"), glassware("beaker", "250 ml", "large")
    stock, water = (glassware("beaker", "150 ml", f"{of}_beaker") for of in ("stock", "water"))
    weighing, homes = balance.weighing, {vessel: WhereItStood(vessel) for vessel in (stock, water)}
    made = concentration(target, species=ion, low=molar * (1 - _WITHIN), high=molar * (1 + _WITHIN))
    full = reads(weighing, low=total - _WITHIN_G, high=total + _WITHIN_G)
    there = (made, full, settled(weighing))
    weigh = actions.pour_by_reading(
        stock, target, weighing, mass=share, within=_WITHIN_G, aim=_WITHIN_G / 4, coarse=0.3
    )
    fill_up = actions.dilute(water, target, weighing, times=total / share, there=there)
    over = OverBench("before the robot", ahead=0.5, left=0.1, height=0.2)
    return Task(
        instruction=f"Prepare {total:g} g of {molar:g} mol/l {salt}: tare the balance, swirl the "
        f"stock beaker until its crystals have dissolved, weigh {share:g} g of this {_STOCK:g} "
        "mol/l stock into the other beaker, put the stock back, add the water, and put that back.",
        paraphrases=(
            f"Tare, swirl the {_STOCK:g} mol/l {salt} until it is clear, dilute {share:g} g to "
            f"{molar:g} mol/l, {total:g} g. Put each beaker back before you take the next.",
            f"Make up {total:g} g of {molar:g} mol/l {salt}: tare, swirl the stock clear, weigh "
            f"{share:g} g, put it back, then add the water, and put that back.",
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
            actions.swirl(stock, over, until=dissolved(stock)),
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
            stock: Filling(_STOCK_ML, celsius=celsius, dissolved=(_ACID,), crystals=crystals),
            water: Filling(_WATER_ML, celsius=celsius),
        },
        never={
            **failures.of_any(*(failures.handling(v, spill=0.02, into=target) for v in homes)),
            "struck": struck(target, but_for=frozenset({balance.pan.name})),
            "overshot": given(stock, target, more_than_ml=ml * (1.0 + _WITHIN_G / share)),
        },
        needs_liquid=True,
        time_limit_s=300.0,  # ours
        view=WIDE_VESSEL_VIEW,
    )
