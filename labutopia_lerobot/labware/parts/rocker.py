"""A rocker switch: it stays on either side, and snaps over its middle."""

import math
from dataclasses import dataclass

import mujoco
import numpy as np
from scipy.spatial.transform import Rotation

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.form import Block, Prism
from labutopia_lerobot.labware.parts.mechanism import add_moving, in_degrees
from labutopia_lerobot.labware.parts.solid import Quaternion, Vector
from labutopia_lerobot.world.model import COLLISION_GROUP

_TILT = math.radians(12.0)
"""Tilt of the rocker to either side [rad]; a usual one."""
_PROUD = 0.003
"""Distance from the panel to the pivot [m]; ours."""
_ARM, _ANCHOR = 0.006, 0.013
"""Distances from the pivot to the ends of the spring behind the panel [m]; ours."""
_STIFFNESS, _PRESSED = 500.0, 0.012
"""Stiffness of the spring [N/m], and its shortening from rest [m]: 3 to 6 N at the rocker's end,
as makers give for appliance switches."""


@dataclass(frozen=True)
class Rocker:
    """A rocker that is pressed at its lower end to switch on; a sprung toggle keeps it there.

    The frame of its name lies in the middle of its face: z into the panel, x up, y to the right of
    who stands before it.

    Attributes:
        name: Name of its body and of its frame.
        height: Of the rocker, along x [m].
        width: Of the rocker, along y [m].
        look: Its finish.
    """

    name: str
    height: float = 0.022
    width: float = 0.014
    look: str = "black"

    @property
    def joint(self) -> str:
        """Name of its hinge [rad]; 0 is off."""
        return f"{self.name}_hinge"

    @property
    def widest(self) -> float:
        """Angle at which it is on [rad]."""
        return 2 * _TILT

    @property
    def effort(self) -> float:
        """Torque with which a finger at its end presses it over [N m]."""
        return 0.06

    def format_position(self, position: float) -> str:
        """Write an angle [rad] with a unit."""
        return in_degrees(position)

    def add_to(
        self,
        spec: mujoco.MjSpec,
        piece: str,
        parent: mujoco.MjsBody,
        pos: Vector,
        quat: Quaternion,
    ) -> None:
        """Build its body, its frame and its spring onto a panel.

        Args:
            spec: What the panel is in (angles in radians).
            piece: Name of the piece.
            parent: The panel.
            pos: Where on the surface of the panel its middle is [m].
            quat: Orientation of its frame in the panel's, scalar-first; z points into the panel.
        """
        panel = Rotation.from_quat(quat, scalar_first=True)
        off_rotation = panel * Rotation.from_euler("y", -_TILT)
        w, x, y, z = (float(part) for part in off_rotation.as_quat(scalar_first=True))
        x_p, y_p, z_p = np.asarray(pos) + panel.apply((0.0, 0.0, -_PROUD))
        pivot = (float(x_p), float(y_p), float(z_p))
        body = add_moving(
            spec, parent, self, pivot, (0, 1, 0), quat=(w, x, y, z), friction=0.001, damping=0.004
        )
        half, wide = self.height / 2, self.width / 2
        deep, out = half * math.tan(_TILT), 0.004
        left = [(0.0, 0.0), (half, 0.0), (half, -out - deep), (0.0, -out)]
        right = [(-half, 0.0), (0.0, 0.0), (0.0, -out), (-half, -out - deep)]
        mark = Block(
            (0.45 * half, 0.8 * half), (-0.0007, 0.0007), (-out - deep, -out), "white", touch=False
        )
        forms = [_upright(part, wide, self.look) for part in (left, right)]
        assemble(spec, body, piece, (*forms, mark), mass=0.006)
        body.add_site(name=self.name, pos=(0, 0, -out), group=COLLISION_GROUP)
        inner, outer = f"{self.name}_arm", f"{self.name}_anchor"
        body.add_site(name=inner, pos=(0, 0, _ARM), group=COLLISION_GROUP)
        behind = np.asarray(pivot) + panel.apply((0, 0, _ANCHOR + _ARM))
        parent.add_site(name=outer, pos=behind, group=COLLISION_GROUP)
        rest = _ANCHOR + _PRESSED
        spring = spec.add_tendon(
            name=f"{self.name}_spring", stiffness=_STIFFNESS, springlength=[rest, rest]
        )
        spring.wrap_site(inner)
        spring.wrap_site(outer)


def _upright(corners: list[tuple[float, float]], wide: float, look: str) -> Prism:
    """Return half of the rocker, its corners in the order that `Prism` wants."""
    x, z = np.array(corners).T
    area = x @ np.roll(z, -1) - z @ np.roll(x, -1)
    return Prism(tuple(corners if area > 0 else corners[::-1]), (-wide, wide), look, edge=0.0006)
