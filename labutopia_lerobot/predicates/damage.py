"""What no task forgives: glass that is knocked, and a robot that runs into things."""

from collections.abc import Iterator

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

    def blows(world: World) -> Iterator[str]:
        for name in names:
            for other in sorted(world.touched_by(name) - {LEFT_PAD, RIGHT_PAD}):
                speed, load = world.approach_speed(name, other), world.contact_force(name, other)
                if speed > _KNOCK or load > _LOAD:
                    yield f"{name} met {other} at {speed:.2f} m/s, with {load:.1f} N"

    which = " or ".join(names) or "nothing"
    return Predicate(
        f"{which} knocked at {_KNOCK:g} m/s or pressed with {_LOAD:g} N",
        lambda world: any(blows(world)),
        because=lambda world: "; ".join(blows(world)),
    )


def collided(*sparing: Thing) -> Predicate:
    """Arm, or hand, pushes against anything; the hand may against some things."""
    spared = {thing.name for thing in sparing}
    robot = {ARM, HAND, LEFT_PAD, RIGHT_PAD}
    allowed = {ARM: robot, **dict.fromkeys((HAND, LEFT_PAD, RIGHT_PAD), robot | spared)}
    but = f" but {', '.join(sorted(spared))}" if spared else ""

    def pushes(world: World) -> Iterator[str]:
        for part, others in allowed.items():
            for other in sorted(world.touched_by(part) - others):
                force = world.contact_force(part, other)
                if force > _PUSH:
                    yield f"{part} pushed {other} with {force:.1f} N"

    return Predicate(
        f"robot pushes anything{but} with {_PUSH:g} N",
        lambda world: any(pushes(world)),
        because=lambda world: "; ".join(pushes(world)),
    )
