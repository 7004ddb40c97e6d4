"""The paper's actions as steps: what the expert plays, and the facts by which it is done.

Tasks of all levels share them (paper, appendix "Task Details"); what a number comes from is said on
its line. A task that does an action twice gives the step another name (`Step.named`).
"""

from labutopia_lerobot.places import Destination
from labutopia_lerobot.predicates import (
    Predicate,
    Transfer,
    closed,
    colour_turned,
    fingered,
    grasped,
    gripped,
    immersed,
    less_open,
    lifted,
    lip_over,
    liquid_moving,
    near,
    opened,
    over_mouth,
    poured,
    pressed,
    pulled,
    pushed,
    reads,
    released,
    settled,
    standing_on,
    steady,
    swings,
    tilted,
    touched,
    turns,
    upright,
    withdrawn,
)
from labutopia_lerobot.predicates.liquids import POURS_BELOW
from labutopia_lerobot.predicates.readings import Readable
from labutopia_lerobot.predicates.stirring import Filled
from labutopia_lerobot.skills import (
    Close,
    Dilute,
    Open,
    Pick,
    Place,
    Pour,
    PourMeasured,
    Press,
    Shake,
    Stir,
    WaitUntil,
)
from labutopia_lerobot.skills.gauge import Received, Weighed
from labutopia_lerobot.skills.handle import Operable
from labutopia_lerobot.skills.pour import Pourable
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Step, Substep
from labutopia_lerobot.world import BENCH, Button, Graspable, OpenVessel, Standing, Thing

OFF_THE_BENCH = 0.10
"""Least lift at level 4 [m]; ours: the paper's 20 cm are those of levels 1 to 3."""


def pick(
    thing: Graspable,
    *,
    by: float = 0.20,
    lift: float = 0.25,
    support: str = BENCH,
    also: tuple[Predicate, ...] = (),
) -> Step:
    """Pick: grasp and lift, by 20 cm in levels 1 to 3 (paper: "exceeding 20 cm").

    Args:
        thing: What to pick up.
        by: How far it must be lifted [m].
        lift: How far the expert lifts it [m].
        support: Contact name of what it stands on or in.
        also: What must hold too when it has been lifted.
    """
    held = gripped(thing)
    return Step(
        "pick",
        (Pick(thing, lift, support),),
        (Substep("gripped", (held,)), Substep("lifted", (held, lifted(thing, by=by), *also))),
        (thing,),
    )


def pour(
    vessel: Pourable, into: OpenVessel, *, share: float = 0.80, of: Thing | None = None
) -> Step:
    """Pour: 80 % of what was in the vessel, which is then held upright again.

    From where liquid may flow until that much has, the lip is over the target (paper: "within a
    specified region above the target"). The share is ours; the original judges a tilt of 50
    degrees, and 30 for upright.

    Args:
        vessel: The vessel in the hand.
        into: What to pour into.
        share: How much of what was filled in must have arrived.
        of: What it was filled into, if not into the vessel in the hand.
    """
    origin = vessel if of is None else of
    enough = poured(vessel, into, share=share, origin=origin)
    flowing = tilted(vessel, beyond_deg=60)
    over_it = (
        lip_over(vessel, into, below=POURS_BELOW) | ~flowing
    )  # upright it may go anywhere, and pour on later
    return Step(
        "pour",
        (Pour(vessel, into),),
        (
            Substep("poured", (enough,), (flowing,), keeping=(over_it,)),
            Substep("righted", (gripped(vessel), upright(vessel, within_deg=10))),
        ),
        (vessel,),
        transfers=(Transfer(origin, into),),
    )


def pour_by_reading(
    vessel: Pourable,
    into: OpenVessel,
    balance: Readable,
    *,
    mass: float,
    within: float,
    aim: float | None = None,
    coarse: float = 0.1,
) -> Step:
    """Pour until the balance below the other vessel reads a mass, and right the vessel.

    Args:
        vessel: The vessel in the hand.
        into: What to pour into.
        balance: What the balance reads.
        mass: Reading to reach [g].
        within: How near [g].
        aim: How near the expert tries to come [g]; as near as it must if not said.
        coarse: Share of it that the balance shows when the expert eases back.
    """
    there = (reads(balance, low=mass - within, high=mass + within), settled(balance))
    near = 0.8 * (within if aim is None else aim)
    return Step(
        "pour",
        (PourMeasured(vessel, into, Weighed(balance), mass, near, coarse=coarse),),
        (
            Substep("poured", there, (tilted(vessel, beyond_deg=30),)),
            Substep("righted", (*there, gripped(vessel), upright(vessel, within_deg=10))),
        ),
        (vessel,),
        transfers=(Transfer(vessel, into),),
    )


def dilute(
    vessel: Pourable,
    into: OpenVessel,
    balance: Readable,
    *,
    times: float,
    there: tuple[Predicate, ...],
) -> Step:
    """Fill up what is on a balance to a multiple of its mass, and right the vessel.

    Args:
        vessel: The vessel in the hand, with what is added.
        into: The vessel on the balance.
        balance: What the balance reads.
        times: How many times the mass that is there it is to be.
        there: What must hold in the end, first what the expert waits for.
    """
    fill_up = Dilute(vessel, into, Weighed(balance), times, within=0.6)
    return Step(
        "fill_up",
        (fill_up, WaitUntil(there[0], holding=vessel)),
        (
            Substep("made_up", there, (tilted(vessel, beyond_deg=30),)),
            Substep("held_upright", (*there, gripped(vessel), upright(vessel, within_deg=10))),
        ),
        (vessel,),
        transfers=(Transfer(vessel, into),),
    )


def pour_until_it_turns(
    vessel: Pourable, into: OpenVessel, *, to: str, about_ml: float, within_ml: float
) -> Step:
    """Pour until what is in the other vessel turns, and right the vessel.

    Args:
        vessel: The vessel in the hand.
        into: What to pour into.
        to: The colour that it is to turn to, as `colour_turned` has it.
        about_ml: What the expert pours, who knows how much that takes [ml].
        within_ml: How near to that it stops [ml].
    """
    turned = colour_turned(into, to=to)
    gauge = Received(vessel, into)
    # No balance that lags: most of it goes without a break, and what is at the lip then follows.
    pour = PourMeasured(vessel, into, gauge, about_ml, within_ml, coarse=0.8, drop=0.10)
    return Step(
        "pour",
        (pour, WaitUntil(turned, holding=vessel)),
        (
            Substep("turned", (turned,), (tilted(vessel, beyond_deg=30),)),
            Substep("righted", (turned, gripped(vessel), upright(vessel, within_deg=10))),
        ),
        (vessel,),
        transfers=(Transfer(vessel, into),),
    )


def place(
    thing: Standing,
    on: Destination,
    *,
    within: float,
    hover: float = 0.10,
    through: Destination | None = None,
) -> Step:
    """Place: set down upright with the base in full contact, let go, and draw the hand back.

    Only then can the next action begin: around what stands there, the hand can go nowhere else.

    Args:
        thing: The thing in the hand.
        on: Where to.
        within: Greatest distance from the place [m].
        hover: Height above that from which the expert lowers it [m].
        through: What the expert carries it through, to a place inside something; None elsewhere.
    """
    there = near(thing, on, within=within)
    # Original, TransportBeaker; ours: drawn back a little where walls are near, and then out.
    retreat, away = (0.15, 0.05) if through is None else (0.06, 0.15)
    return Step(
        "place",
        (Place(thing, on, hover, retreat=retreat, through=through),),
        (
            Substep("carried", (there, gripped(thing))),
            Substep("placed", (there, standing_on(thing, on))),
            Substep("released", (standing_on(thing, on), released(thing))),
            # Paper: "the end effector retracts".
            Substep("retracted", (standing_on(thing, on), withdrawn(thing, by=away))),
        ),
        (thing,),
    )


def put_back(thing: Standing, home: Destination, *, within: float) -> Step:
    """Put back: place, after a pour, at the height to which the thing was lifted.

    From 0.10 m the foot of a beaker would leave the 800 ml one 4 mm above its rim, and learned
    policies strike it; from 0.25 m it leaves 10 mm above and rises (ours, both measured).
    """
    return place(thing, home, within=within, hover=0.25)


def left_standing(thing: Standing, on: Destination, *, within: float) -> tuple[Predicate, ...]:
    """Return the goal of what ends with `place`: the thing stands, at rest, the hand is away."""
    return (
        near(thing, on, within=within),
        standing_on(thing, on),  # paper: "upright ... with its base in full contact"
        released(thing),
        withdrawn(thing, by=0.05),  # original, TransportBeaker: gripper 0.05 m away
        steady(thing, below=0.02),  # paper: "maintaining stability"; ours: at rest
    )


def shake(vessel: Graspable, at: Destination) -> Step:
    """Shake: from the start position, tilt left and right three times (paper), and return."""
    in_hand = (gripped(vessel), lifted(vessel, by=0.20))  # as where it starts; original: 0.05
    three = swings(vessel, needed=3, beyond_deg=15)  # ours: the paper has no angle
    return Step(
        "shake",
        (Shake(vessel, at),),
        (
            Substep("at_start", held_at(vessel, at)),
            Substep("shaken", in_hand, keeping=in_hand, count=three),
            Substep("returned", held_at(vessel, at)),
        ),
        (vessel,),
    )


def swirl(vessel: Graspable, at: Destination, *, until: Predicate) -> Step:
    """Swirl: tilt left and right until something has come about, and hold it upright again.

    Args:
        vessel: The vessel in the hand.
        at: Where the expert does it.
        until: The fact that is to come about.
    """
    upright_again = (until, gripped(vessel), upright(vessel, within_deg=10))
    swirling = Shake(vessel, at, cycles=90, until=until)  # ours: one takes a second or so
    return Step(
        "swirl",
        (swirling,),
        (Substep("swirled", (until,)), Substep("steadied", upright_again)),
        (vessel,),
    )


def held_at(vessel: Graspable, at: Destination) -> tuple[Predicate, ...]:
    """Return what holds where a shake starts and ends."""
    return (
        near(vessel, at, within=0.20),  # ours: over the workspace, of which it is the middle
        lifted(vessel, by=0.20),
        upright(vessel, within_deg=5),  # ours: a third of a tilt
    )


def stir(rod: Graspable, vessel: Filled, filling: Filling) -> Step:
    """Stir: five circles in the liquid, either way round (paper), and take the rod out.

    Args:
        rod: What to stir with.
        vessel: Where to stir.
        filling: What it holds, or would.
    """
    inside = (gripped(rod), immersed(rod, vessel, filling_ml=filling.ml))
    # Ours: a third of the original's 9 mm; the way from the axis to the circle and back for free;
    # the paper's "without interruption", where a person still sees one motion.
    five = turns(rod, vessel, needed=4.75, beyond=0.003, pause=2.0)
    return Step(
        "stir",
        (Stir(rod, vessel),),
        (
            Substep("inserted", inside),
            Substep("stirred", inside, keeping=inside, count=five),
            Substep("withdrawn", held_over(rod, vessel)),
        ),
        (rod,),
        notes=(liquid_moving(vessel, above=0.005),),
    )


def held_over(rod: Graspable, vessel: OpenVessel) -> tuple[Predicate, ...]:
    """Return what holds when a rod has been taken out (original: within 0.04 m; ours: clear)."""
    return (gripped(rod), over_mouth(rod, vessel, within=0.04, by=0.05))


def open_by_handle(part: Operable, *, to: float, begun: float, pull: float) -> Step:
    """Open: grip the handle and pull, in one pull or several (paper: "without slipping").

    Args:
        part: The door or drawer.
        to: Position of its joint that counts as open [rad or m].
        begun: Position beyond which it has moved [rad or m].
        pull: How far the expert pulls [rad or m].
    """
    by_handle = pulled(part, part.handle, to=to, slack=begun)
    return Step(
        "open",
        (Open(part, pull),),
        (
            Substep("gripped", (grasped(part.handle), less_open(part, than=begun))),
            Substep("opened", (opened(part, to=to),), count=by_handle),
        ),
        (part.handle,),
    )


def close_by_handle(part: Operable, *, begun: float) -> Step:
    """Close: push shut by the handle, in the grip or not (paper: grasped; the original either way).

    Args:
        part: The door or drawer.
        begun: Position below which it has moved [rad or m].
    """
    return Step(
        "close",
        (Close(part),),
        (
            Substep("touched", (touched(part.handle), opened(part, to=begun))),
            Substep("closed", (closed(part),)),
        ),
        (part.handle,),
        notes=(grasped(part.handle),),
    )


def press(button: Button, *, hold: float) -> Step:
    """Press: with 2 N until it clicks (paper: "with sufficient force over a specified distance").

    Args:
        button: What to press; its frame bears its name, its sensor `<name>_force`.
        hold: How long the expert keeps it in [s].
    """
    in_by_finger = (fingered(button), pressed(button), pushed(button, with_force=2.0))
    pressing = Substep("pressed", in_by_finger)
    return Step("press", (Press(button, hold),), (pressing,), (button,))
