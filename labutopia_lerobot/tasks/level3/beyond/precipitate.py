"""Precipitate: pour the one of two clear solutions that makes what the instruction names.

Beyond the paper, whose example of a reaction is the first family: copper(II) sulfate and barium
chloride. Its laboratory has no chemistry in its vessels.
"""

from dataclasses import replace

from labutopia_lerobot.chemistry.inventory import Solute
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.places import WhereItStood
from labutopia_lerobot.predicates import (
    Transfer,
    gripped,
    precipitated,
    struck,
    tilted,
    upright,
)
from labutopia_lerobot.scenario import Draw
from labutopia_lerobot.scenes.views import WIDE_VESSEL_VIEW
from labutopia_lerobot.skills import Pour, WaitUntil
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Step, Substep, Task
from labutopia_lerobot.tasks import actions, failures
from labutopia_lerobot.tasks.variety import start_temperature

# What is to be made -> its solid, what the large beaker holds, what makes it of that, how much of
# it one formula unit takes, and what makes another solid or none (solubility rules, as in any
# textbook of general chemistry).
_MADE_OF = {
    "barium sulfate": ("BaSO4(s)", "copper(II) sulfate", "barium chloride", 1, "sodium hydroxide"),
    "copper(II) hydroxide": (
        *("Cu(OH)2(s)", "copper(II) sulfate", "sodium hydroxide", 2),
        "barium chloride",
    ),
    "silver chloride": ("AgCl(s)", "sodium chloride", "silver nitrate", 1, "sodium nitrate"),
    "lead(II) iodide": ("PbI2(s)", "lead(II) nitrate", "potassium iodide", 2, "sodium sulfate"),
    "calcium carbonate": (
        *("CaCO3(s)", "calcium chloride", "sodium carbonate", 1),
        "sodium chloride",
    ),
}
_THERE_ML, _POURED_ML = 100.0, 80.0
"""What the large beaker and each small one hold [ml]; ours."""
_REAGENT = 0.11
"""What the small ones hold, for each that a formula unit takes [mol/l]; ours: 80 % of it makes all
of the strongest solution fall out, with a sixth to spare."""
_ALL = 0.95
"""Share of it that must fall out; ours: nothing more is seen to."""
_WITHIN = 0.05
"""How near to where it stood the beaker is to be put back [m]; ours, as `neutralise`."""


def precipitate(draw: Draw) -> Task:
    """Return the task that an episode has drawn."""
    names = list(_MADE_OF)
    product = draw.choice("product", train=names[:3], test=names[3:], shifted=True)
    molar = draw.choice(
        "concentration", train=(0.05, 0.04, 0.06), test=(0.045, 0.055), shifted=True
    )
    solid, there, reagent, each, other = _MADE_OF[product]
    tall = glassware("beaker_tall", "150 ml", "tall_beaker")
    low = glassware("beaker", "150 ml", "low_beaker")
    target = glassware("beaker", "800 ml", "large_beaker")
    in_the_tall_one = draw.choice("object", train=("tall beaker", "low beaker")) == "tall beaker"
    source, wrong = (tall, low) if in_the_tall_one else (low, tall)
    in_tall, in_low = (reagent, other) if in_the_tall_one else (other, reagent)
    celsius = start_temperature(draw)
    formed = precipitated(target, solid=solid, mmol=_ALL * _THERE_ML * molar)
    both, back = (tall, low), WhereItStood(source)
    return Task(
        instruction=f"The tall beaker holds {in_tall}, the low one {in_low}. Make {product} of the "
        f"{there} in the large beaker: pour the right one in, until all has fallen out, and put it "
        "back.",
        paraphrases=(
            f"Precipitate {product}: of {in_tall} in the tall beaker and {in_low} in the low one, "
            f"pour what makes it into the {there}, and return that beaker.",
            f"Which makes {product} of the {there} in the large beaker, {in_tall} (tall beaker) or "
            f"{in_low} (low beaker)? Pour in enough of it, then put it back where it stood.",
        ),
        start={  # in a slanting row, as `identify_unknown`: the hand is 0.2 m wide
            tall: OnBench(x=(0.29, 0.35), y=(0.12, 0.20)),
            low: OnBench(x=(0.15, 0.21), y=(-0.06, 0.00)),
            target: OnBench(x=(0.20, 0.30), y=(-0.35, -0.28)),
        },
        steps=(
            # The hand may take the wrong one too, and put it back.
            replace(actions.pick(source, by=actions.OFF_THE_BENCH), touches=both),
            Step(
                "pour",
                (Pour(source, target), WaitUntil(formed, holding=source)),
                (
                    Substep("formed", (formed,), (tilted(source, beyond_deg=60),)),
                    Substep("righted", (formed, gripped(source), upright(source, within_deg=10))),
                ),
                both,
                transfers=(Transfer(source, target),),
            ),
            replace(actions.place(source, back, within=_WITHIN), touches=both),
        ),
        goal=(formed, *actions.left_standing(source, back, within=_WITHIN)),
        contents={
            vessel: Filling(ml, celsius=celsius, dissolved=(solute,))
            for vessel, ml, solute in (
                (source, _POURED_ML, Solute(reagent, each * _REAGENT)),
                (wrong, _POURED_ML, Solute(other, _REAGENT)),
                (target, _THERE_ML, Solute(there, molar)),
            )
        },
        never={
            **failures.of_any(*(failures.handling(v, spill=0.05, into=target) for v in both)),
            "struck": struck(target),
        },
        needs_liquid=True,
        time_limit_s=60.0,  # ours
        view=WIDE_VESSEL_VIEW,
    )
