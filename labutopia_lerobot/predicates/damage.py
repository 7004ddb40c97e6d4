"""Faults that no task forgives: knocked glass, a robot that runs into things, an untidy bench."""

import math
from collections.abc import Iterator

from labutopia_lerobot.predicates.predicate import predicate
from labutopia_lerobot.world import ARM, BASE, HAND, LEFT_PAD, RIGHT_PAD, Thing, World

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

_MOVED = 0.02
"""Greatest shift of a thing that a task leaves alone [m]; ours: a nudge no person would see."""

_FELLED = 30.0
"""Greatest lean of it [deg]; ours: further than glass leans and falls back."""


@predicate(f"anything knocked at {_KNOCK:g} m/s or pressed with {_LOAD:g} N")
def broken(world: World) -> bool:
    """A free-standing thing is knocked or pressed too hard against anything but the rubber pads."""
    return any(_blows(world))


@broken.explain
def _all_blows(world: World) -> str:
    return "; ".join(_blows(world))


def _blows(world: World) -> Iterator[str]:
    for thing in world.movable:
        name = thing.name
        for other in sorted(world.touched_by(name) - {LEFT_PAD, RIGHT_PAD}):
            speed, load = world.approach_speed(name, other), world.contact_force(name, other)
            if speed > _KNOCK or load > _LOAD:
                yield f"{name} met {other} at {speed:.2f} m/s, with {load:.1f} N"


@predicate(f"robot pushes itself or anything but {{spared}} with {_PUSH:g} N")
def collided(world: World, *spared: Thing) -> bool:
    """Arm, base or hand pushes anything, another link included; the hand may push some things."""
    return any(_pushes(world, spared))


@collided.explain
def _all_pushes(world: World, *spared: Thing) -> str:
    return "; ".join(_pushes(world, spared))


def _pushes(world: World, spared: tuple[Thing, ...]) -> Iterator[str]:
    hand = {HAND, LEFT_PAD, RIGHT_PAD}
    may_touch = hand | {thing.name for thing in spared}
    allowed: dict[str, set[str]] = {ARM: set(), BASE: set()}
    allowed |= dict.fromkeys(sorted(hand), may_touch)
    for part, others in allowed.items():
        for other in sorted(world.touched_by(part) - others):
            force = world.contact_force(part, other)
            if force > _PUSH:
                yield f"{part} pushed {other} with {force:.1f} N"


@predicate(f"anything but {{moved}} displaced by {_MOVED:g} m or leaning by {_FELLED:g} deg")
def displaced(world: World, *moved: Thing) -> bool:
    """A thing that the task leaves alone, target or distractor, has left its place or fallen."""
    return any(_displacements(world, moved))


@displaced.explain
def _all_displacements(world: World, *moved: Thing) -> str:
    return "; ".join(_displacements(world, moved))


def _displacements(world: World, moved: tuple[Thing, ...]) -> Iterator[str]:
    names = {thing.name for thing in moved}
    for thing in world.movable:
        if thing.name not in names:
            now = world.pose(thing)
            way, lean = now.distance_to(world.stood(thing)), math.degrees(now.tilt)
            if way > _MOVED or lean > _FELLED:
                yield f"{thing.name} is {1e3 * way:.0f} mm off, leaning by {lean:.0f} deg"


@predicate("any button but {named} pressed")
def pressed_out_of_turn(world: World, *named: Thing) -> bool:
    """A button clicks that is not to be pressed now, whatever presses it."""
    return bool(world.pressed - {thing.name for thing in named})
