"""Facts about push buttons, and about the finger on them."""

import math
from collections.abc import Mapping
from typing import Protocol

import numpy as np

from labutopia_lerobot.predicates.predicate import predicate
from labutopia_lerobot.predicates.vessels import REACH
from labutopia_lerobot.world import ARM, BASE, HAND, LEFT_PAD, RIGHT_PAD, Button, Thing, World


class Switchable(Protocol):
    """Something that is on or off."""

    @property
    def name(self) -> str:
        """Its name in the world."""
        ...


@predicate("{button} pressed")
def pressed(world: World, button: Button) -> bool:
    """Button has clicked in, and not out again."""
    return world.reading(button.name).value > 0.0


@pressed.approach
def _near_button(world: World, button: Button) -> float:
    return math.exp(-world.gripper.distance_to(world.frame(button.name)) / REACH)


@predicate("{button} pushed with {with_force:g} N")
def pushed(world: World, button: Button, *, with_force: float) -> bool:
    """Button is pushed with a force [N] or more."""
    return world.sensor(button.force_sensor) >= with_force


@predicate("finger on {button}")
def fingered(world: World, button: Button) -> bool:
    """A finger touches the button."""
    return bool(world.touched_by(button.name) & {LEFT_PAD, RIGHT_PAD, HAND})


@predicate("hand aligned with {button} within {within:g} m and {within_deg:g} deg")
def aligned(world: World, button: Button, *, within: float, within_deg: float) -> bool:
    """A finger tip, or the middle between both, is on the button's axis and points along it.

    Args:
        world: The world.
        button: The button pointed at.
        within: How far from the axis [m].
        within_deg: How far the hand may lean from it [deg].
    """
    aside, lean = _misses(world, button)
    return aside < within and lean < math.radians(within_deg)


@aligned.measure
def _axis_errors(
    world: World, button: Button, *, within: float, within_deg: float
) -> Mapping[str, float]:
    aside, lean = _misses(world, button)
    return {"mm": 1e3 * aside, "deg": math.degrees(lean)}


def _misses(world: World, button: Button) -> tuple[float, float]:
    """Return how far the nearest finger tip is from the button's axis [m], and the angle [rad]."""
    axis, hand = world.frame(button.name), world.gripper
    between = hand.advanced(world.robot.finger_reach).position_w - axis.position_w
    outward = (world.gripper_opening + world.robot.finger_thickness) / 2 * hand.y_axis
    tips = np.array([between, between + outward, between - outward])
    aside = tips - np.outer(tips @ axis.z_axis, axis.z_axis)
    cosine = np.clip(hand.z_axis @ axis.z_axis, -1.0, 1.0)
    return float(np.linalg.norm(aside, axis=1).min()), float(np.arccos(cosine))


@predicate("robot touches {things}")
def touched(world: World, *things: Thing) -> bool:
    """Arm, hand or base touches any of the things."""
    robot = {ARM, BASE, HAND, LEFT_PAD, RIGHT_PAD}
    return any(world.touched_by(thing.name) & robot for thing in things)


@predicate("hand {by:g} m clear of {button}")
def fingers_clear_of(world: World, button: Thing, *, by: float) -> bool:
    """Point between the pads is further than `by` metres from the face of a button or knob."""
    return world.gripper.distance_to(world.frame(button.name)) > by


@predicate("{switch} on")
def switched_on(world: World, switch: Switchable) -> bool:
    """Switch is on."""
    return world.reading(switch.name).value > 0.0
