"""Identify unknown: find by a reagent which of three clear solutions holds what is asked for.

Beyond the paper, whose laboratory has no chemistry in its vessels.
"""

from dataclasses import replace
from functools import reduce
from operator import and_, or_

from labutopia_lerobot.chemistry.inventory import Solute
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.target_plate import TargetPlate
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.places import OnTop, WhereItStood
from labutopia_lerobot.predicates import (
    Transfer,
    clouded,
    gripped,
    received,
    standing_on,
    struck,
    upright,
)
from labutopia_lerobot.scenario import Draw
from labutopia_lerobot.scenes.views import WIDEST_VESSEL_VIEW
from labutopia_lerobot.skills import TryEach
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Step, Substep, Task
from labutopia_lerobot.tasks import actions, failures
from labutopia_lerobot.tasks.variety import start_temperature

# What is asked for -> what holds it, the reagent that it clouds with, and what that leaves clear
# (the classical tests for anions, as in any textbook of qualitative analysis).
_TESTS = {
    "chloride": ("sodium chloride", "silver nitrate", ("sodium nitrate", "sodium sulfate")),
    "sulfate": ("sodium sulfate", "barium chloride", ("sodium chloride", "sodium nitrate")),
    "iodide": ("potassium iodide", "lead(II) nitrate", ("sodium nitrate", "sodium chloride")),
    "carbonate": ("sodium carbonate", "calcium chloride", ("sodium nitrate", "sodium chloride")),
}
_UNKNOWN, _REAGENT = 0.02, 0.05
"""Concentrations [mol/l]; ours: what is not asked for stays clear, however much reagent it gets."""
_UNKNOWN_ML, _REAGENT_ML, _TRIED_ML = 30.0, 50.0, 0.5
"""What the vessels hold, and how much reagent is a test, some drops [ml]; ours."""
_PLATE, _BACK = 0.04, 0.05
"""How near to the plate's middle [m], as `level2/transport_beaker`; to where it stood, ours."""


def identify_unknown(draw: Draw) -> Task:
    """Return the task that an episode has drawn."""
    names, places = list(_TESTS), ("middle", "left", "right")
    content = draw.choice("content", train=names[:2], test=names[2:], shifted=True)
    place = draw.choice("place", train=places)
    molar, celsius = _UNKNOWN, start_temperature(draw)
    if draw.varies("concentration"):
        molar = draw.choice("concentration", train=(_UNKNOWN, 0.015), test=(0.0175, 0.0125))
    asked_for, reagent, others = _TESTS[content]
    order = [place, *(p for p in places if p != place)]
    holds = dict(zip(order, (asked_for, *others), strict=True))
    unknown = {p: glassware("beaker", "150 ml", f"{p}_beaker") for p in places}
    right, row = unknown[place], tuple(unknown.values())
    wrong = [vessel for vessel in row if vessel is not right]
    bottle = glassware("beaker_tall", "150 ml", "reagent_beaker")
    plate = TargetPlate("target_plate")
    tried = [received(bottle, v, low_ml=_TRIED_ML, high_ml=_REAGENT_ML) for v in wrong]
    identified = clouded(right) | reduce(and_, tried)  # who has seen both others stay clear knows
    test = Step(
        "test",
        (TryEach(bottle, tuple((v, clouded(v)) for v in row), ml=3.0, within_ml=1.5),),
        (
            Substep("identified", (identified,)),
            Substep("righted", (identified, gripped(bottle), upright(bottle, within_deg=10))),
        ),
        (bottle,),
        transfers=tuple(Transfer(bottle, v) for v in row),
    )
    # The hand may take the wrong one too: else that would look like a knock.
    choose = replace(actions.pick(right, by=actions.OFF_THE_BENCH).named("choose"), touches=row)
    present = actions.place(right, OnTop(plate), within=_PLATE).named("present")
    return Task(
        instruction=f"One of the three beakers in a row holds {content}, which clouds with the "
        f"{reagent} of the tall beaker. Find which, put that back, and set it on the plate.",
        paraphrases=(
            f"Test the three clear solutions with a little {reagent} from the tall beaker, put "
            f"that back, and place the one that turns cloudy, with {content}, on the plate.",
            f"Which of the three holds {content}? Pour some of the {reagent} into them, put "
            "it back, and bring the one that becomes cloudy to the white plate.",
        ),
        start={
            # The hand comes from the left, 0.2 m wide: in a slanting row nothing is in its way.
            bottle: OnBench(x=(-0.025, -0.010), y=(-0.265, -0.250)),
            unknown["right"]: OnBench(x=(0.130, 0.145), y=(-0.215, -0.200)),
            unknown["middle"]: OnBench(x=(0.270, 0.285), y=(-0.130, -0.115)),
            unknown["left"]: OnBench(x=(0.390, 0.405), y=(-0.010, 0.005)),
            plate: OnBench(x=(0.22, 0.28), y=(0.22, 0.28)),
        },
        steps=(
            actions.pick(bottle, by=actions.OFF_THE_BENCH),
            test,
            actions.place(bottle, WhereItStood(bottle), within=_BACK),
            choose,
            replace(present, touches=row),
        ),
        goal=(identified, *actions.left_standing(right, OnTop(plate), within=_PLATE)),
        contents={
            bottle: Filling(_REAGENT_ML, celsius=celsius, dissolved=(Solute(reagent, _REAGENT),)),
            **{
                unknown[p]: Filling(_UNKNOWN_ML, celsius=celsius, dissolved=(Solute(of, molar),))
                for p, of in holds.items()
            },
        },
        never={
            **failures.of_any(*(failures.handling(v, spill=0.05) for v in (bottle, *row))),
            "misjudged": reduce(or_, [standing_on(v, OnTop(plate)) for v in wrong]),
            "struck": struck(plate, but_for=frozenset(v.name for v in row)),
        },
        needs_liquid=True,
        time_limit_s=120.0,  # ours
        view=WIDEST_VESSEL_VIEW,
    )
