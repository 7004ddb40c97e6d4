"""A control panel on a post, with three coloured push buttons in a row."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.colors import COLORS
from labutopia_lerobot.labware.parts.instrument import Equipment
from labutopia_lerobot.labware.parts.materials import add_materials
from labutopia_lerobot.labware.parts.push_button import PushButton
from labutopia_lerobot.labware.parts.solid import CYLINDER, Quaternion, add_look, add_part

_SLANT = math.radians(35.0)
_ROLL = math.radians(45.0)
"""Angle by which the front leans back, and a pressing hand to the right about its own axis [rad].

The default robot cannot point a level hand straight ahead. Like this, on a panel turned by 20 to 35
degrees to face the robot's left, its joints keep away from their ends (`level1/press`).
"""

_WIDTH, _HEIGHT, _DEPTH = 0.36, 0.13, 0.05
"""Size of the box behind the front [m]."""
_SPACING = 0.12
"""Between two buttons [m] (original: 0.05 to 0.29, drawn one by one)."""
_POST_RADIUS, _POST_LENGTH = 0.018, 0.50
"""Radius and length of the post [m], which goes through the bench top at any panel height."""

_COLORS = ("red", "green", "blue")
_SLOTS = (-_SPACING, 0.0, _SPACING)
LEANING: Quaternion = (math.cos(_SLANT / 2), 0.0, math.sin(_SLANT / 2), 0.0)
_SINE, _COSINE = (half(_ROLL / 2) * math.sqrt(0.5) for half in (math.sin, math.cos))
INTO_FRONT: Quaternion = (-_SINE, _COSINE, -_SINE, _COSINE)
"""z along the head's x, into the front; x up along the front, then turned by the roll."""


@dataclass(frozen=True)
class ButtonPanel(Equipment):
    """A panel that faces -x of its own frame and leans back; its origin is the middle of its front.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.120, 0.360, 0.553)
    mass = 1.5
    source = "width and height of the panel as the original's, the rest ours"

    @property
    def buttons(self) -> tuple[PushButton, ...]:
        """The red, the green and the blue button, built from right to left."""
        return tuple(PushButton(f"{self.name}_{name}", COLORS[name]) for name in _COLORS)

    @property
    def head(self) -> str:
        """Name of the body that carries the buttons."""
        return f"{self.name}_head"

    @property
    def bodies(self) -> frozenset[str]:
        return frozenset({self.name, self.head, *(button.name for button in self.buttons)})

    @property
    def footprint_radius(self) -> float:
        """Radius of the circle around its origin that it needs [m]."""
        return math.hypot(_WIDTH / 2, _DEPTH + _HEIGHT / 2)

    def add_to(self, spec: mujoco.MjSpec, parent: mujoco.MjsBody) -> mujoco.MjsBody:
        """Build its body into a spec (angles in radians), at the origin of the parent.

        Sites: frames of the buttons (see `PushButton`).

        Returns:
            The body.
        """
        add_materials(
            spec,
            self.name,
            ("shell", (0.86, 0.88, 0.89, 1.0), 0.2),
            ("front", (0.24, 0.28, 0.33, 1.0), 0.2),
            ("metal", (0.66, 0.68, 0.70, 1.0), 0.6),
        )
        body = parent.add_body(name=self.name)
        add_part(
            body,
            f"{self.name}_post",
            (_POST_RADIUS, _POST_LENGTH / 2, 0.0),
            (1.3 * _DEPTH, 0.0, -_POST_LENGTH / 2),
            f"{self.name}_metal",
            shape=CYLINDER,
        )
        head = body.add_body(name=self.head, quat=LEANING)
        size = (_DEPTH / 2, _WIDTH / 2, _HEIGHT / 2)
        add_part(head, f"{self.name}_box", size, (_DEPTH / 2, 0, 0), f"{self.name}_shell")
        plate = (0.001, _WIDTH / 2 - 0.008, _HEIGHT / 2 - 0.008)
        add_look(head, f"{self.name}_plate", plate, (0, 0, 0), f"{self.name}_front")
        for number, (button, y) in enumerate(zip(self.buttons, _SLOTS, strict=True)):
            add_look(
                head,
                f"{self.name}_bezel_{number}",
                (1.3 * button.radius, 0.003, 0.0),
                (0.0, y, 0.0),
                f"{self.name}_metal",
                shape=CYLINDER,
                quat=INTO_FRONT,
            )
            button.add_to(spec, head, (0.0, y, 0.0), INTO_FRONT)
        return body
