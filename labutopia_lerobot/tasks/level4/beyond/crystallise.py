"""Crystallise: dissolve a salt on a hot plate, let it crystallise in ice, decant what is left.

Beyond the paper, whose laboratory has no chemistry in its vessels. It takes four minutes as there
is little of it, in ice: on the bench it would be most of an hour. What is more than dissolves falls
out as it mixes: the engine has no solutions that wait for a seed.
"""

import math
from dataclasses import replace

from labutopia_lerobot.chemistry.crystals import Crystals
from labutopia_lerobot.chemistry.inventory import Solute
from labutopia_lerobot.chemistry.poured_together import solid_at
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.heater import Heater
from labutopia_lerobot.labware.instruments.storage.ice_bath import IceBath
from labutopia_lerobot.layout import Inside, OnBench
from labutopia_lerobot.predicates import (
    Transfer,
    dissolved,
    gripped,
    hotter,
    precipitated,
    received,
    struck,
    tilted,
    upright,
)
from labutopia_lerobot.scenario import Draw
from labutopia_lerobot.scenes.views import WIDE_VESSEL_VIEW
from labutopia_lerobot.skills import PourMeasured, WaitUntil
from labutopia_lerobot.skills.gauge import Received
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Step, Substep, Task
from labutopia_lerobot.tasks import actions, failures

_SALT = "potassium nitrate"
"""Of all common salts its solubility rises most with the temperature."""
_ML, _MOLAR = 10.0, 3.0
"""Volume [ml], and what is dissolved at the start [mol/l]: a little less than can be; ours."""
_GRAIN_MM = 0.3
"""Diameter of the grains [mm]; ours: table salt, fine. Crystals that come back count as these."""
_COLD_C, _SHARE = 22.0, 0.9
"""How cold it must have become [degrees C], and which part of what cannot be dissolved then must be
in the beaker, as crystals; ours."""
_LOW_ML, _POURED_ML = 5.0, 6.0
"""Least mother liquor that must be decanted, and what the expert decants [ml]; ours."""
_WITHIN = 0.02
"""How near the middle of the bath [m]; ours: its pan has 15 mm around the beaker."""


def crystallise(draw: Draw) -> Task:
    """Return the task that an episode has drawn."""
    grams = draw.choice("mass", train=(1.2, 1.1, 1.3), test=(1.15, 1.25), shifted=True)
    vessel, other = glassware("beaker", "150 ml"), glassware("beaker", "250 ml", "large_beaker")
    heater, bath = Heater("heater", probe_in=vessel.name), IceBath("bath")
    solutes, crystals = (Solute(_SALT, _MOLAR),), Crystals(_SALT, grams, _GRAIN_MM)
    least = _SHARE * 1e3 * solid_at(solutes, crystals, _ML, _COLD_C)
    formed = precipitated(vessel, solid=crystals.species, mmol=round(least, 1))
    clear = dissolved(vessel)
    decanted = received(vessel, other, low_ml=_LOW_ML, high_ml=_ML)
    take_off = actions.pick(vessel, by=0.10, lift=0.12, support=heater.name).named("take_off")
    return Task(
        instruction=(
            f"Dissolve the {_SALT} on the hot plate, take it off before the glass is at 60 C, "
            f"crystallise it in ice, decant {_LOW_ML:g} ml into the large beaker and put it back."
        ),
        paraphrases=(
            f"Recrystallise the {_SALT}: heat until it has dissolved, the glass to 60 C at most, "
            "cool it in ice until crystals are back, pour most of the liquid off, and put it back.",
            f"Heat until the {_SALT} has gone, and take it off at once: glass of 60 C burns. Cool "
            "it in the bath, pour the mother liquor off, not the crystals; then back into ice.",
        ),
        start={
            heater: OnBench((0.22, 0.28), (-0.06, 0.00), (-math.radians(5), math.radians(5))),
            vessel: Inside(heater, at=(0.0, 0.0, heater.top_height)),
            bath: OnBench((0.28, 0.34), (0.20, 0.26)),
            other: OnBench((0.20, 0.28), (-0.38, -0.32)),
        },
        steps=(
            actions.press(heater.button, hold=0.3).named("heat"),
            Step(
                "dissolve",
                (WaitUntil(clear, at_most_s=200.0),),
                (Substep("dissolved", (clear,)),),
                (vessel, heater.button),
            ),
            replace(take_off, touches=(vessel, heater.button)),
            actions.place(vessel, bath.pan, within=_WITHIN).named("cool"),
            Step(
                "crystallise",
                (WaitUntil(formed, at_most_s=250.0),),
                (Substep("crystallised", (formed,)),),
                (vessel, heater.button),  # a hand that is free may switch it off now
            ),
            actions.pick(vessel, by=0.10, lift=0.12, support=bath.name).named("take_out"),
            Step(
                "decant",
                (PourMeasured(vessel, other, Received(vessel, other), _POURED_ML, 0.6),),
                (
                    Substep("decanted", (decanted, formed), (tilted(vessel, beyond_deg=30),)),
                    Substep("righted", (gripped(vessel), upright(vessel, within_deg=10))),
                ),
                (vessel,),
                transfers=(Transfer(vessel, other),),
            ),
            actions.place(vessel, bath.pan, within=_WITHIN).named("return"),
        ),
        goal=(formed, decanted, *actions.left_standing(vessel, bath.pan, within=_WITHIN)),
        contents={vessel: Filling(_ML, dissolved=solutes, crystals=(crystals,))},
        never={
            **failures.handling(vessel, spill=0.03, into=other),
            **failures.burning(),
            "struck": struck(other),
            "overheated": hotter(vessel, than_c=80.0),
        },
        needs_liquid=True,
        time_limit_s=420.0,  # ours
        view=WIDE_VESSEL_VIEW,
    )
