"""Titrate: base from a burette into an acid, up to the end point that a pH meter shows.

Beyond the paper, whose laboratory has no chemistry in its vessels.
"""

import math

from labutopia_lerobot.chemistry.inventory import Solute
from labutopia_lerobot.chemistry.poured_together import ph_together
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.handling.burette_stand import BuretteStand
from labutopia_lerobot.labware.instruments.measuring.ph_meter import PhMeter
from labutopia_lerobot.layout import Inside, OnBench
from labutopia_lerobot.predicates import (
    Transfer,
    closed,
    fingers_clear_of,
    given,
    more_basic,
    opened,
    ph_between,
    received,
    spilled,
    struck,
)
from labutopia_lerobot.scenario import Draw
from labutopia_lerobot.scenes.views import TITRATION_VIEW
from labutopia_lerobot.skills import Titrate
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Step, Substep, Task
from labutopia_lerobot.tasks.variety import start_temperature

_SAMPLE_ML, _BURETTE_ML = 45.0, 20.0
"""What the beaker and the burette hold [ml]; ours: the electrode's bulb is covered, and a particle
of the liquid is 0.065 ml, as a drop from a burette is."""
_BASE = 0.10
"""Sodium hydroxide [mol/l]; ours, as usual."""
_WITHIN_ML = 0.10
"""How near to the equivalence volume [ml]; ours: two drops."""
_LAST_ML, _DROP_ML = 0.22, 0.05
"""How much before that the expert, who has titrated it before, begins with drops, and when it
pinches a drop off, which goes on to run meanwhile [ml]."""


def titrate(draw: Draw) -> Task:
    """Return the task that an episode has drawn."""
    acid = draw.choice(
        "substance",
        train=("acetic acid", "hydrochloric acid"),
        test=("formic acid", "nitric acid"),
        shifted=True,
    )
    molar = draw.choice(
        "concentration", train=(0.015, 0.012, 0.018), test=(0.0135, 0.0165), shifted=True
    )
    needed, celsius = _SAMPLE_ML * molar / _BASE, start_temperature(draw)
    sample, base = (Solute(acid, molar),), (Solute("sodium hydroxide", _BASE),)

    def ph_at(ml: float) -> list[float]:  # at first, and as warm as the room in the end
        return [ph_together(((sample, _SAMPLE_ML), (base, ml)), t) for t in (celsius, None)]

    low, high = min(ph_at(needed - _WITHIN_ML)), max(ph_at(needed + _WITHIN_ML))
    stand, beaker = BuretteStand("stand"), glassware("beaker", "150 ml", "beaker")
    meter = PhMeter("meter", turned=math.radians(45), lowered=0.112)  # electrode beside the jet
    burette, wing = stand.burette, stand.stopcock
    reached = ph_between(beaker, low=low, high=high)
    enough = received(burette, beaker, low_ml=needed - _WITHIN_ML, high_ml=needed + _WITHIN_ML)
    clear = fingers_clear_of(wing, by=0.05)  # as of a knob
    return Task(
        instruction=f"Titrate the {acid} in the beaker with the base of the burette: shut the "
        "stopcock at the end point, where the pH leaps.",
        paraphrases=(
            f"Let base run into the {acid} until the pH meter shows the end point, then close the "
            "burette; 0.1 ml too much is too much.",
            f"Find the end point of the {acid} in the beaker: run the burette, drop by drop at "
            "last, watch the pH meter, and shut it as soon as the pH has leapt.",
        ),
        start={  # the wing faces the hand
            stand: OnBench((0.28, 0.36), (-0.12, 0.06), (-math.radians(145), -math.radians(125))),
            beaker: Inside(stand, at=stand.under.at),
            meter: Inside(stand, at=(-0.169, 0.232, 0.0), yaw=math.radians(45)),
        },
        steps=(
            Step(
                "titrate",
                (
                    Titrate(
                        wing,
                        burette.processes[0],
                        meter.reads,
                        ph=ph_at(needed - _WITHIN_ML / 2)[0],
                        first_ml=needed - _LAST_ML,
                        drop_ml=_DROP_ML,
                    ),
                ),
                (
                    Substep("opened", (opened(wing, to=math.radians(30)),)),
                    Substep("reached", (reached, enough)),
                    Substep("shut", (closed(wing), reached, enough)),
                    Substep("released", (closed(wing), clear)),
                ),
                (wing,),
                transfers=(Transfer(burette, beaker),),
            ),
        ),
        goal=(reached, enough, closed(wing), clear),
        contents={
            burette: Filling(_BURETTE_ML, celsius=celsius, dissolved=base),
            beaker: Filling(_SAMPLE_ML, celsius=celsius, dissolved=sample),
        },
        never={
            "overshot": more_basic(beaker, than=high),
            "overrun": given(burette, beaker, more_than_ml=needed + _WITHIN_ML),
            "missed": spilled(burette, share=0.0),
            "struck": struck(beaker, but_for=frozenset({stand.name, meter.electrode.name})),
        },
        needs_liquid=True,
        time_limit_s=150.0,  # ours
        view=TITRATION_VIEW,
    )
