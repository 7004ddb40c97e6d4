"""A push button alone in a small box on a post, as those of the original's press tasks."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.instruments.button_panel import INTO_FRONT, LEANING
from labutopia_lerobot.labware.parts.colors import COLORS
from labutopia_lerobot.labware.parts.instrument import Equipment
from labutopia_lerobot.labware.parts.materials import add_materials
from labutopia_lerobot.labware.parts.push_button import PushButton
from labutopia_lerobot.labware.parts.solid import CYLINDER, add_look, add_part

_SIDE, _DEPTH = 0.080, 0.050
"""Front and depth of the box [m] (original: cubes of 0.08)."""
_HALF_GAP = 0.085
"""Half of the least distance of two of them, without `layout.CLEARANCE` [m]; ours."""
_POST_RADIUS, _POST_LENGTH = 0.014, 0.50
"""Radius and length of the post, which goes through the bench top at any height of the box [m]."""


@dataclass(frozen=True)
class ButtonPost(Equipment):
    """A box that faces -x of its own frame and leans back; its origin is the middle of its front.

    It leans as a `ButtonPanel` does, for the same reason.

    Attributes:
        name: Name of its root body; prefix of all its elements.
        color: Colour of the button, one of `COLORS`.
    """

    name: str
    color: str = "red"
    size = (0.09, 0.08, 0.53)
    mass = 0.8
    source = "original (cubes of 0.08 m), on a post of ours"

    @property
    def button(self) -> PushButton:
        return PushButton(f"{self.name}_button", COLORS[self.color])

    @property
    def buttons(self) -> tuple[PushButton, ...]:
        return (self.button,)

    @property
    def head(self) -> str:
        """Name of the body that carries the button."""
        return f"{self.name}_head"

    @property
    def bodies(self) -> frozenset[str]:
        return frozenset({self.name, self.head, self.button.name})

    @property
    def footprint_radius(self) -> float:
        """Radius of the circle around its origin that it needs [m].

        Beside what presses it: two are 0.18 m apart, half a hand, half a box and 4 cm.
        """
        return _HALF_GAP

    def add_to(self, spec: mujoco.MjSpec, parent: mujoco.MjsBody) -> mujoco.MjsBody:
        """Build its body into a spec (angles in radians), at the origin of the parent.

        Sites: the frame of the button (see `PushButton`).

        Returns:
            The body.
        """
        add_materials(
            spec,
            self.name,
            ("shell", (0.86, 0.88, 0.89, 1.0), 0.2),
            ("metal", (0.66, 0.68, 0.70, 1.0), 0.6),
        )
        body = parent.add_body(name=self.name)
        add_part(
            body,
            f"{self.name}_post",
            (_POST_RADIUS, _POST_LENGTH / 2, 0.0),
            (0.7 * _DEPTH, 0.0, -_POST_LENGTH / 2),
            f"{self.name}_metal",
            shape=CYLINDER,
        )
        head, button = body.add_body(name=self.head, quat=LEANING), self.button
        size = (_DEPTH / 2, _SIDE / 2, _SIDE / 2)
        add_part(head, f"{self.name}_box", size, (_DEPTH / 2, 0, 0), f"{self.name}_shell")
        bezel = (1.3 * button.radius, 0.003, 0.0)
        add_look(
            head,
            f"{self.name}_bezel",
            bezel,
            (0.0, 0.0, 0.0),
            f"{self.name}_metal",
            shape=CYLINDER,
            quat=INTO_FRONT,
        )
        button.add_to(spec, head, (0.0, 0.0, 0.0), INTO_FRONT)
        return body
