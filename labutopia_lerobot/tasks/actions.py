"""The paper's actions as steps: what the expert plays, and what tells that it is done.

Tasks of all levels share them (paper, appendix "Task Details"); what a number comes from is said on
its line. A task that does an action twice gives the step another name (`Step.named`).
"""

from collections.abc import Mapping
from dataclasses import replace

from labutopia_lerobot.places import Destination
from labutopia_lerobot.predicates import (
    Predicate,
    closed,
    dipped,
    falling,
    fingered,
    grasped,
    gripped,
    knocked_over,
    less_open,
    lifted,
    moving,
    near,
    off_axis,
    on_side,
    opened,
    over_mouth,
    poured,
    pressed,
    pushed,
    released,
    spilled,
    standing_on,
    steady,
    struck,
    tilted_left,
    tilted_right,
    upright,
    withdrawn,
)
from labutopia_lerobot.skills import Close, Open, Pick, Place, Pour, Press, Shake, Stir
from labutopia_lerobot.skills.handle import Operable
from labutopia_lerobot.skills.pour import Pourable
from labutopia_lerobot.task import Milestone, Step
from labutopia_lerobot.world import BENCH, Button, Graspable, OpenVessel, Standing, Thing


def pick(
    thing: Graspable, *, lift: float = 0.25, support: str = BENCH, also: tuple[Predicate, ...] = ()
) -> Step:
    """Pick: grasp and lift by 20 cm (paper: "exceeding 20 cm").

    Args:
        thing: What to pick up.
        lift: How far the expert lifts it [m].
        support: Contact name of what it stands on or in.
        also: What must hold too when it has been lifted.
    """
    held = gripped(thing)
    return Step(
        "pick",
        (Pick(thing, lift, support),),
        (Milestone("gripped", (held,)), Milestone("lifted", (held, lifted(thing, by=0.20), *also))),
    )


def pour(
    vessel: Pourable, into: OpenVessel, *, share: float = 0.80, of: Thing | None = None
) -> Step:
    """Pour: 80 % of what was in the vessel, which is then held upright again.

    The share is ours; the original judges a tilt of 50 degrees, and 30 for upright.

    Args:
        vessel: What is in the hand.
        into: What to pour into.
        share: How much of what was filled in must have arrived.
        of: What it was filled into, if not into the vessel in the hand.
    """
    return Step(
        "pour",
        (Pour(vessel, into),),
        (
            Milestone("poured", (poured(vessel, into, share=share, of=of),)),
            Milestone("righted", (gripped(vessel), upright(vessel, within_deg=10))),
        ),
    )


def place(thing: Standing, on: Destination, *, within: float | None) -> Step:
    """Place: set down upright with the base in full contact, and let go.

    Args:
        thing: What is in the hand.
        on: Where to.
        within: How far off it may stand [m]; None for anywhere on the same support.
    """
    there = () if within is None else (near(thing, on, within=within),)
    carried = () if within is None else (Milestone("carried", (*there, gripped(thing))),)
    return Step(
        "place",
        (Place(thing, on),),
        (
            *carried,
            Milestone("placed", (*there, standing_on(thing, on))),
            Milestone("released", (standing_on(thing, on), released(thing))),
        ),
    )


def left_standing(
    thing: Standing, on: Destination, *, within: float | None
) -> tuple[Predicate, ...]:
    """Return the goal of what ends with `place`: the thing stands, at rest, the hand is away."""
    return (
        *(() if within is None else (near(thing, on, within=within),)),
        standing_on(thing, on),  # paper: "upright ... with its base in full contact"
        released(thing),
        withdrawn(thing, by=0.05),  # original, TransportBeaker: gripper 0.05 m away
        steady(thing, below=0.02),  # paper: "maintaining stability"; ours: at rest
    )


def shake(vessel: Graspable, at: Destination) -> Step:
    """Shake: from the start position, tilt left and right three times (paper), and return."""
    in_hand = (gripped(vessel), lifted(vessel, by=0.05))  # original: z > z0 + 0.05
    swing = (
        tilted_left(vessel, beyond_deg=15),  # ours: the paper has no number
        tilted_right(vessel, beyond_deg=15),
    )
    return Step(
        "shake",
        (Shake(vessel, at),),
        (
            Milestone("at_start", held_at(vessel, at)),
            Milestone("shaken", in_hand, via=swing * 3, keeping=in_hand),
            Milestone("returned", held_at(vessel, at)),
        ),
    )


def held_at(vessel: Graspable, at: Destination) -> tuple[Predicate, ...]:
    """Return what holds where a shake starts and ends."""
    return (
        near(vessel, at, within=0.05),
        lifted(vessel, by=0.20),
        upright(vessel, within_deg=5),  # ours: a third of a tilt
    )


def stir(rod: Graspable, vessel: OpenVessel) -> Step:
    """Stir: five circles counterclockwise, and take the rod out."""
    # Ours: the lower half of the beaker, where the liquid of a half-full one is.
    inside = (gripped(rod), dipped(rod, vessel, by=0.045))
    turn = (
        on_side(rod, vessel, "ahead", beyond=0.005),  # ours: half of the original's 9 mm
        on_side(rod, vessel, "left", beyond=0.005),
        on_side(rod, vessel, "behind", beyond=0.005),
        on_side(rod, vessel, "right", beyond=0.005),
    )
    circling = (
        *inside,
        off_axis(rod, vessel, beyond=0.003),  # so that the sides are passed by going round
        moving(rod, above=0.003),  # paper: "without interruption or hesitation"; ours: a tenth
    )
    return Step(
        "stir",
        (Stir(rod, vessel),),
        (
            Milestone("inserted", inside),
            Milestone("stirred", inside, via=turn * 5, begins=circling, keeping=circling),
            Milestone("withdrawn", held_over(rod, vessel)),
        ),
    )


def held_over(rod: Graspable, vessel: OpenVessel) -> tuple[Predicate, ...]:
    """Return what holds when a rod has been taken out (original: within 0.04 m; ours: clear)."""
    return (gripped(rod), over_mouth(rod, vessel, within=0.04, by=0.05))


def open_by_handle(part: Operable, *, to: float, begun: float, pull: float) -> Step:
    """Open: grip the handle and pull, "without slipping" (paper).

    Args:
        part: The door or drawer.
        to: Position of its joint that counts as open [rad or m].
        begun: Position beyond which it has moved [rad or m].
        pull: How far the expert pulls [rad or m].
    """
    held = grasped(part.handle)
    return Step(
        "open",
        (Open(part, pull),),
        (
            Milestone("gripped", (held, less_open(part, than=begun))),
            Milestone("opened", (opened(part, to=to),), (opened(part, to=begun),), keeping=(held,)),
        ),
    )


def close_by_handle(part: Operable, *, begun: float, grip: str = "gripped") -> Step:
    """Close: grip the handle and push shut, "without slipping" (paper).

    Args:
        part: The door or drawer.
        begun: Position below which it has moved [rad or m].
        grip: Name of the first milestone.
    """
    held = grasped(part.handle)
    return Step(
        "close",
        (Close(part),),
        (
            Milestone(grip, (held, opened(part, to=begun))),
            Milestone("closed", (closed(part),), (less_open(part, than=begun),), keeping=(held,)),
        ),
    )


def press(button: Button, *, hold: float) -> Step:
    """Press: with 2 N until it clicks (paper: "with sufficient force over a specified distance").

    Args:
        button: What to press; its frame bears its name, its sensor `<name>_force`.
        hold: How long the expert keeps it in [s].
    """
    in_by_finger = (fingered(button), pressed(button), pushed(button, with_force=2.0))
    return Step("press", (Press(button, hold),), (Milestone("pressed", in_by_finger),))


def mishaps(
    vessel: Standing, *, spill: float | None, pouring: Predicate | None = None
) -> dict[str, Predicate]:
    """Return what must not happen to a vessel that is handled.

    Args:
        vessel: What is handled.
        spill: Share of its content that may be spilled (paper: "without spilling"; the number is
            ours); None for an empty one.
        pouring: What excuses a tilt where no liquid is simulated.
    """
    spilling = {} if spill is None else {"spilled": spilled(vessel, share=spill, unless=pouring)}
    return {
        "knocked_over": knocked_over(vessel, beyond_deg=30),
        **spilling,
        "dropped": falling(vessel, faster_than=0.5),  # free fall over 13 mm
    }


def either(first: Mapping[str, Predicate], second: Mapping[str, Predicate]) -> dict[str, Predicate]:
    """Return what must happen to neither of two vessels, from the `mishaps` of each."""
    return {name: first[name] | second[name] for name in first}


def sparing(thing: Thing, *steps: Step) -> tuple[Step, ...]:
    """Return steps during which a thing that stands on the bench must not be touched."""
    return tuple(replace(step, never={**step.never, "collided": struck(thing)}) for step in steps)


def stirring_mishaps(rod: Graspable, vessel: OpenVessel, rack: Thing) -> dict[str, Predicate]:
    """Return what must not happen while a rod from a rack stirs in a vessel."""
    return {
        "knocked_over": knocked_over(rod, beyond_deg=30),
        "dropped": falling(rod, faster_than=0.5),  # free fall over 13 mm
        "spilled": spilled(vessel, share=0.01),  # paper: "without causing spillage"
        "collided": struck(vessel),
        "rack_struck": struck(rack, but_for=frozenset({rod.name})),
    }
