"""Facts about push buttons, and about the finger on them."""

from typing import Protocol

import numpy as np

from labutopia_lerobot.predicates.predicate import Predicate
from labutopia_lerobot.world import ARM, HAND, LEFT_PAD, RIGHT_PAD, Button, Thing, World


class Switchable(Protocol):
    """Something that is on or off."""

    @property
    def name(self) -> str:
        """What the world calls it."""
        ...


def pressed(button: Button) -> Predicate:
    """Button has clicked in, and not out again."""
    return Predicate(f"{button.name} pressed", lambda world: world.pressed(button.name))


def pushed(button: Button, *, with_force: float) -> Predicate:
    """Button is pushed with a force [N] or more."""
    return Predicate(
        f"{button.name} pushed with {with_force:g} N",
        lambda world: world.sensor(button.force_sensor) >= with_force,
    )


def fingered(button: Button) -> Predicate:
    """A finger touches the button."""
    fingers = frozenset({LEFT_PAD, RIGHT_PAD, HAND})
    return Predicate(
        f"finger on {button.name}", lambda world: bool(world.touched_by(button.name) & fingers)
    )


def aligned(button: Button, *, within: float, within_deg: float) -> Predicate:
    """Fingers point at a button: axes no further apart than a distance [m] and an angle [deg]."""
    least = np.cos(np.radians(within_deg))

    def misses(world: World) -> tuple[float, float]:
        axis, hand = world.frame(button.name), world.gripper
        offset = hand.position_w - axis.position_w
        aside = np.linalg.norm(offset - (offset @ axis.z_axis) * axis.z_axis)
        return float(aside), float(hand.z_axis @ axis.z_axis)

    def holds(world: World) -> bool:
        aside, cosine = misses(world)
        return bool(aside < within and cosine > least)

    def off(world: World) -> dict[str, float]:
        aside, cosine = misses(world)
        return {"mm": 1e3 * aside, "deg": float(np.degrees(np.arccos(np.clip(cosine, -1, 1))))}

    return Predicate(f"hand aligned with {button.name} within {within:g} m", holds, off)


def touched(*things: Thing) -> Predicate:
    """Arm or hand touches any of the things."""
    robot = frozenset({ARM, HAND, LEFT_PAD, RIGHT_PAD})
    names = [thing.name for thing in things]
    return Predicate(
        f"robot touches {' or '.join(names)}",
        lambda world: any(world.touched_by(name) & robot for name in names),
    )


def fingers_clear_of(button: Button, *, by: float) -> Predicate:
    """Point between the pads is further than `by` metres from the face of a button."""
    return Predicate(
        f"hand {by:g} m clear of {button.name}",
        lambda world: world.gripper.distance_to(world.frame(button.name)) > by,
    )


def switched_on(switch: Switchable) -> Predicate:
    """Switch is on."""
    return Predicate(f"{switch.name} on", lambda world: world.switched_on(switch.name))
