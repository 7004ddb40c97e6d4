"""Doors and windows, in the frame of their opening.

As of a piece of furniture: the front faces -x, the way that a door opens; the origin is the middle
of the lower edge of the opening, in the plane of the wall's front.
"""

import math

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.form import Block, Form, Rod, Span
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.scenes.plan import Opening

DOUBLE = 1.25
"""Doors that are wider have two leaves [m] (DIN 18100: single ones up to 1.25 m)."""
_LEAF = 0.040
"""Thickness of a leaf [m]."""
_JAMB, _GAP = 0.050, 0.004
"""Width of the frame, and the gap between it and a leaf [m]."""
_WIDEST = math.radians(90.0)
_DENSITY = 500.0
"""Density of a door leaf of tube board [kg/m^3]; one of 0.9 x 2 m weighs 36 kg."""
MATERIALS = "building"
"""Prefix of the materials of all doors and windows."""


def add_door(spec: mujoco.MjSpec, body: mujoco.MjsBody, opening: Opening, thickness: float) -> None:
    """Add frame and leaves; their hinges are closed at 0.

    Args:
        spec: What the body is in (angles in radians).
        body: At the opening.
        opening: The door.
        thickness: Of the wall [m].
    """
    half, high = opening.width / 2, opening.height
    x = (-0.008, thickness + 0.008)
    frame: list[Form] = [
        Block(x, (half - _JAMB, half), (0.0, high), "grey"),
        Block(x, (-half, -half + _JAMB), (0.0, high), "grey"),
        Block(x, (-half + _JAMB, half - _JAMB), (high - _JAMB, high), "grey"),
    ]
    assemble(spec, body, MATERIALS, frame)
    sides = (1, -1) if opening.width >= DOUBLE else (1,)
    wide = 2 * (half - _JAMB) / len(sides) - 1.5 * _GAP
    tall = high - _JAMB - 0.008 - _GAP
    for side, label in zip(sides, ("left", "right"), strict=False):
        rotor = Rotor(f"{body.name}_{label}_leaf", friction=1.0, effort=12.0, widest=_WIDEST)
        hinge = (0.0, side * (half - _JAMB - _GAP), 0.008)
        leaf = rotor.add_to(spec, body, hinge, (0.0, 0.0, -float(side)))
        assemble(spec, leaf, MATERIALS, _leaf(side, wide, tall), _DENSITY * _LEAF * wide * tall)


def _leaf(side: int, wide: float, tall: float) -> list[Form]:
    """Return a leaf with a pane at eye level; its hinge is its outer front edge."""
    x, pane = (0.0, _LEAF), (1.20, min(1.75, tall - 0.15))
    near, far = wide / 2 - 0.13, wide / 2 + 0.13
    y = -side * (wide - 0.07)
    lever: list[Form] = []
    for front, out in ((0.0, -0.045), (_LEAF, _LEAF + 0.045)):
        inward = side * 0.115
        lever += [
            Rod((front, y, 1.05), (out, y, 1.05), 0.018, "steel", segments=10),
            Rod((out, y, 1.05), (out, y + inward, 1.05), 0.018, "steel", segments=10),
        ]
    return [
        Block(x, _across(side, 0.0, wide), (0.0, pane[0]), "door", edge=0.0),
        Block(x, _across(side, 0.0, wide), (pane[1], tall), "door", edge=0.0),
        Block(x, _across(side, 0.0, near), pane, "door", edge=0.0),
        Block(x, _across(side, far, wide), pane, "door", edge=0.0),
        Block((0.4 * _LEAF, 0.6 * _LEAF), _across(side, near, far), pane, "glass", edge=0.0),
        *lever,
    ]


def add_window(
    spec: mujoco.MjSpec, body: mujoco.MjsBody, opening: Opening, thickness: float
) -> None:
    """Add frame, mullions, panes and the board within the wall; see `add_door`."""
    half, high = opening.width / 2, opening.height
    x, rim = (0.55 * thickness, 0.55 * thickness + 0.06), 0.055
    forms: list[Form] = [
        Block(x, (half - rim, half), (0.0, high), "white", edge=0.0),
        Block(x, (-half, -half + rim), (0.0, high), "white", edge=0.0),
        Block(x, (-half, half), (0.0, rim), "white", edge=0.0),
        Block(x, (-half, half), (high - rim, high), "white", edge=0.0),
        Block((0.0, x[0]), (-half, half), (0.0, 0.020), "white", edge=0.0),
    ]
    lights = max(1, round(opening.width / 0.9))
    step = opening.width / lights
    for n in range(1, lights):
        y = -half + n * step
        forms.append(Block(x, (y - rim / 2, y + rim / 2), (rim, high - rim), "white", edge=0.0))
    glass = (sum(x) / 2 - 0.006, sum(x) / 2 + 0.006)
    forms.append(Block(glass, (-half + rim, half - rim), (rim, high - rim), "glass", edge=0.0))
    assemble(spec, body, MATERIALS, forms)


def _across(side: int, near: float, far: float) -> Span:
    """Return a span of a leaf by the distances from its hinge."""
    one, other = -side * near, -side * far
    return min(one, other), max(one, other)
