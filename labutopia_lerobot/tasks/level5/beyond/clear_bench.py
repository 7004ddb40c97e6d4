"""Clear bench: three beakers from a bench into the sink, one after the other.

Beyond the paper: its "transport container between areas", three times.
"""

from collections.abc import Iterator
from dataclasses import replace
from itertools import chain

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.labware.instruments.support.laboratory_sink import LaboratorySink
from labutopia_lerobot.layout import OfTheRoom, OnSomeBench, OnTheSameBench
from labutopia_lerobot.places import BesideSeat
from labutopia_lerobot.predicates import Predicate, halted, standing_on, withdrawn
from labutopia_lerobot.scenes.views import DRIVING_VIEW
from labutopia_lerobot.skills import BackOff, Place
from labutopia_lerobot.task import Step, Task
from labutopia_lerobot.tasks import actions, driving, failures

SINK = LaboratorySink("sink")
BASIN = BesideSeat("basin", SINK.places[0], inward=0.0, left=-0.13)  # its middle
WITHIN = 0.25  # ours: less than half of its diagonal; only its floor is so low

DEEP = 0.25  # of the basin: so far the hand is drawn back out of it

CLEARANCE = 0.68  # ours: in six drives beside chairs more than 0.6, its corners being at 0.62

BEAKERS = (
    glassware("beaker_low", "50 ml", "small_beaker"),
    glassware("beaker_low", "100 ml", "medium_beaker"),
    glassware("beaker_low", "150 ml", "large_beaker"),
)
# Ours: clear of the swan neck, and of walls by the half of a hand that comes from above.
PLACES = (
    BesideSeat("left of the basin", SINK.places[0], inward=0.03, left=-0.03),
    BesideSeat("right of the basin", SINK.places[0], inward=0.03, left=-0.23),
    BesideSeat("front of the basin", SINK.places[0], inward=-0.03, left=-0.13),
)


def clear_bench() -> Task:
    """Return the task."""
    first, *others = BEAKERS
    carried = (step for n in range(len(BEAKERS)) for step in _carry(n))
    return Task(
        instruction=(
            "Clear the bench: carry the small, then the medium, then the large beaker to the sink, "
            "and stand each on the floor of its basin. Face each beaker, and the sink."
        ),
        paraphrases=(
            "Bring the beakers to the sink, one by one, from the smallest to the largest; stand "
            "them in it. Turn to each before you take it, and to the sink before you set it down.",
            "Put all three beakers from the bench into the basin of the sink, upright: small, "
            "medium, large; face what you take, and the sink as you come to it.",
        ),
        start={
            first: OnSomeBench(things=3, from_above=True),
            **{beaker: OnTheSameBench(first, from_above=True) for beaker in others},
            SINK: OfTheRoom("laboratory_sink"),
        },
        drives=True,
        steps=tuple(step.named(f"{n}_{step.name}") for n, step in enumerate(carried, start=1)),
        goal=(
            *chain(*(actions.left_standing(each, BASIN, within=WITHIN) for each in BEAKERS)),
            halted(than=driving.HALTED),
        ),
        never={
            **failures.of_any(*(_never(each) for each in BEAKERS)),
        },
        time_limit_s=500.0,  # ours: three times what the expert needs in the largest rooms
        view=DRIVING_VIEW,
    )


def _never(beaker: Vessel) -> dict[str, Predicate]:
    return {**failures.handling(beaker, spill=None), **driving.collisions(beaker, SINK)}


def _carry(n: int) -> Iterator[Step]:
    """Yield the steps that bring one beaker into the sink; it is grasped from above."""
    beaker, place = BEAKERS[n], PLACES[n]
    out, away = (None if n == 0 else BackOff()), BackOff(beaker)
    yield driving.navigate(beaker, clearance=CLEARANCE, from_above=True, first=out)
    yield driving.face(beaker, from_above=True)
    yield driving.pick(beaker, approach="deep")
    yield driving.navigate(SINK, carrying=beaker, clearance=CLEARANCE, first=away)
    yield driving.face(SINK, carrying=beaker)
    # Over the edge of the basin, and back out of it.
    into = Place(beaker, place, hover=DEEP + 0.05, retreat=DEEP + 0.05, deep=True)
    end = (BackOff(),) if n == len(BEAKERS) - 1 else ()
    step = actions.place(beaker, BASIN, within=WITHIN)
    *others, last = step.substeps
    clear = replace(last, when=(standing_on(beaker, BASIN), withdrawn(beaker, by=DEEP)))
    step = replace(step, skills=(into, *end), substeps=(*others, clear))
    yield driving.docked(step, SINK, carrying=beaker)
