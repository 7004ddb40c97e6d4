"""What a robot does that drives, as steps of level 5 (paper, appendix, "Level 5").

The paper gives no number for it: heading, distance and lift are ours.
"""

from dataclasses import replace
from typing import Literal

from labutopia_lerobot.navigation.path_planner import RADIUS
from labutopia_lerobot.places import Destination
from labutopia_lerobot.predicates import (
    Predicate,
    at_hand,
    below_hand,
    beside,
    carried_into,
    facing,
    gripped,
    halted,
    raised,
)
from labutopia_lerobot.skills import DriveTo, Face, Pick
from labutopia_lerobot.skills.skill import Skill
from labutopia_lerobot.task import Step, Substep
from labutopia_lerobot.tasks import actions
from labutopia_lerobot.world import Graspable, Standing, Thing

NEAR = 1.5
"""Greatest distance of the base from a thing that it has driven to [m]; ours: from there it goes
straight in (paper: "a position near the target beaker")."""
AT_HAND = 0.80 / 0.855
"""Share of its arm's reach within which a thing is where the base has halted at the bench; ours:
1.1 m before the middle of the Ridgeback, whose arm reaches 0.855 m, and 0.97 m of the Fetch."""
FACING = 10.0
"""Greatest angle of its heading from the direction to the thing [deg]; ours (paper: "face the
object")."""
HALTED = 0.02
"""Speed below which it has halted [m/s and rad/s]; ours (paper: "halts navigation")."""
LIFT = 0.20
"""Least lift from where a thing stood [m]; ours here: the paper's of levels 1 to 3."""


def navigate(
    to: Thing,
    *,
    carrying: Graspable | None = None,
    clearance: float = RADIUS,
    from_above: bool = False,
    first: Skill | None = None,
) -> Step:
    """Navigate: drive to near a thing and halt (paper: "steadily at a position near").

    Args:
        to: What to drive to.
        carrying: Thing in the hand, if any.
        clearance: Distance that the expert keeps from everything where it can [m].
        from_above: Whether it is to be taken from above.
        first: What the expert plays before, as to get out of a cupboard.
    """
    drive = DriveTo(to, carrying, clearance, from_above, NEAR)
    there = (beside(to, within=NEAR), halted(than=HALTED))
    return Step(
        "navigate",
        (drive,) if first is None else (first, drive),
        (Substep("arrived", (*there, *_held(carrying))),),
        _touched(carrying),
    )


def face(thing: Thing, *, carrying: Graspable | None = None, from_above: bool = False) -> Step:
    """Face: turn to a thing and go in to where the arm reaches it (paper: "controlled turn").

    Args:
        thing: What to face.
        carrying: Thing in the hand, if any.
        from_above: Whether it is to be taken from above.
    """
    faced = (facing(thing, within_deg=FACING), halted(than=HALTED), *_held(carrying))
    near = below_hand(thing) if from_above else at_hand(thing, share=AT_HAND)
    return Step(
        "face",
        (Face(thing, carrying, from_above),),
        (Substep("faced", faced), Substep("at_hand", (*faced, near))),
        _touched(carrying),
    )


def pick(thing: Graspable, *, approach: Literal["side", "deep"] = "side") -> Step:
    """Pick: grasp a thing from whatever it stands on and lift it (paper: "securely grasp").

    Args:
        thing: What to pick up.
        approach: From where the expert does so, see `skills.Pick`.
    """
    held = gripped(thing)
    step = Step(
        "pick",
        (Pick(thing, lift=LIFT + 0.05, support=None, approach=approach),),
        (Substep("gripped", (held,)), Substep("lifted", (held, raised(thing, by=LIFT)))),
        (thing,),
    )
    return docked(step, thing, from_above=approach == "deep")


def place(
    thing: Standing,
    on: Destination,
    *,
    at: Thing,
    within: float,
    through: Destination | None = None,
) -> Step:
    """Place, as on any bench, what was brought to another thing.

    Args:
        thing: The thing in the hand.
        on: Where to.
        at: The thing that the base stands before.
        within: Greatest distance from the place [m].
        through: What the expert carries it through, see `actions.place`.
    """
    step = actions.place(thing, on, within=within, through=through)
    return docked(step, at, carrying=thing)


def docked(
    step: Step, thing: Thing, *, carrying: Thing | None = None, from_above: bool = False
) -> Step:
    """Return a step before which the expert docks, where that has not been done yet.

    To face a thing takes less than to dock, so that what follows may begin farther off.

    Args:
        step: One that is done at the bench.
        thing: The one that the base stands before.
        carrying: Thing in the hand, if any.
        from_above: Whether the thing is to be taken from above.
    """
    return replace(step, skills=(Face(thing, carrying, from_above), *step.skills))


def collisions(load: Graspable, *others: Thing) -> dict[str, Predicate]:
    """Return what must not happen to what is carried (paper: "no collisions").

    Those of the robot itself no task forgives.

    Args:
        load: Thing that is carried.
        *others: What it may touch beside benches at which the base has halted.
    """
    return {"load_collided": carried_into(load, *others, than=HALTED)}


def _held(thing: Graspable | None) -> tuple[Predicate, ...]:
    return () if thing is None else (gripped(thing),)


def _touched(thing: Graspable | None) -> tuple[Graspable, ...]:
    return () if thing is None else (thing,)
