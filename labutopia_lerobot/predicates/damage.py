"""What no task forgives: glass that is knocked, and a robot that runs into things."""

from labutopia_lerobot.predicates.predicate import Predicate
from labutopia_lerobot.world import ARM, HAND, LEFT_PAD, RIGHT_PAD, Thing, World

_KNOCK = 0.25
"""Speed at which a thing may meet something hard [m/s]. The paper says "undamaged", "intact";
ours is the fastest that ISO 10218-1 calls reduced speed, and what a fall of 3 mm gives."""

_LOAD = 70.0
"""Force with which a thing may be pressed against something hard [N]; ours: the full
grip of the default robot's hand, which glassware has to stand. Experts press with 17 N at most."""

_PUSH = 2.0
"""Force with which the robot may brush against something [N]; ours: what moves an
arm that is guided by hand (data sheet of the default robot: guiding force about 2 N), so that one
feels it."""


def broken(*things: Thing) -> Predicate:
    """One of the things is knocked or pressed too hard, against anything but the rubber pads."""
    names = [thing.name for thing in things]

    def holds(world: World) -> bool:
        return any(
            world.approach_speed(name, other) > _KNOCK or world.contact_force(name, other) > _LOAD
            for name in names
            for other in world.touched_by(name) - {LEFT_PAD, RIGHT_PAD}
        )

    which = " or ".join(names) or "nothing"
    return Predicate(f"{which} knocked at {_KNOCK:g} m/s or pressed with {_LOAD:g} N", holds)


def collided(*sparing: Thing) -> Predicate:
    """Arm, or hand, pushes against anything; the hand may against some things."""
    spared = {thing.name for thing in sparing}
    robot = {ARM, HAND, LEFT_PAD, RIGHT_PAD}
    allowed = {ARM: robot, **dict.fromkeys((HAND, LEFT_PAD, RIGHT_PAD), robot | spared)}
    but = f" but {', '.join(sorted(spared))}" if spared else ""

    def holds(world: World) -> bool:
        return any(
            world.contact_force(part, other) > _PUSH
            for part, others in allowed.items()
            for other in world.touched_by(part) - others
        )

    return Predicate(f"robot pushes anything{but} with {_PUSH:g} N", holds)
