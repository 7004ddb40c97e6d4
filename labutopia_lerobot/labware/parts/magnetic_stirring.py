"""Stirring: what turns in a vessel turns the liquid in it, magnets turn the bar."""

import math
from dataclasses import dataclass
from typing import override

import mujoco
import numpy as np
from scipy.spatial.transform import Rotation

from labutopia_lerobot.labware.parts.drive import FASTEST, RPM, Drive
from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.world.model import VISUAL_GROUP

MAGNET = "_magnet"
"""How the name of the site in a magnet ends."""
_NEAR, _ABOVE = 0.050, 0.040
"""How far from the axis and above the plate a magnet is taken along [m]; ours: the field of a
stirrer's magnet falls within a few centimetres."""
_CENTRING = 0.15
"""Time within which the field draws a bar to the axis [s]; ours."""


@dataclass(frozen=True)
class Stirring(Process):
    """A propeller, or a cup that shakes a tube: the liquid in the vessel there goes round with it.

    Attributes:
        name: Of this process.
        drive: What turns it.
        site: Frame of what turns; liquid feels it that is in the same vessel as its origin.
        radius: Of what turns [m].
    """

    name: str
    drive: Drive
    site: str
    radius: float

    @override
    def step(self, apparatus: Apparatus) -> None:
        speed = apparatus.memory(self.drive)[0]
        if speed and apparatus.liquid is not None:
            at = apparatus.site(self.site).position_w
            apparatus.liquid.stir(at, RPM * speed, self.radius, apparatus.period)


@dataclass(frozen=True)
class MagneticStirring(Process):
    """A magnet below a plate: it draws bars that lie above it to its axis, and they stir.

    The liquid around a bar feels its speed. The bar itself is not turned: among particles half its
    thickness apart it would be thrown off at a tenth of the speeds that stirrers have. What is seen
    of it turns, up to `FASTEST`.

    Attributes:
        name: Of this process.
        drive: What turns the magnet.
        site: Middle of the plate's surface.
    """

    name: str
    drive: Drive
    site: str

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        """How far what is seen of the bars is turned [rad]."""
        return ("angle",)

    @override
    def step(self, apparatus: Apparatus) -> None:
        memory, speed = apparatus.memory(self), float(apparatus.memory(self.drive)[0])
        memory[0] = (memory[0] + RPM * min(speed, FASTEST) * apparatus.period) % (2 * math.pi)
        for bar in _bars(apparatus.model):
            self._draw(apparatus, bar, speed)

    @override
    def show(self, apparatus: Apparatus) -> None:
        model, data = apparatus.model, apparatus.data
        turn = Rotation.from_rotvec([0.0, 0.0, float(apparatus.memory(self)[0])]).as_matrix()
        for bar in _bars(model):
            if not self._near(apparatus, bar):
                continue
            body = int(model.site_bodyid[bar])
            own = turn @ data.xmat[body].reshape(3, 3)
            for geom in np.flatnonzero(model.geom_bodyid == body):
                if model.geom_group[geom] == VISUAL_GROUP:
                    quat = Rotation.from_quat(model.geom_quat[geom], scalar_first=True)
                    data.geom_xpos[geom] = data.xpos[body] + own @ model.geom_pos[geom]
                    data.geom_xmat[geom] = (own @ quat.as_matrix()).ravel()

    def _near(self, apparatus: Apparatus, bar: int) -> bool:
        """Return whether the magnet takes a bar, a site, along."""
        off = apparatus.data.site_xpos[bar] - apparatus.site(self.site).position_w
        return bool(np.hypot(off[0], off[1]) < _NEAR and 0.0 < off[2] < _ABOVE)

    def _draw(self, apparatus: Apparatus, bar: int, speed: float) -> None:
        """Draw a bar, a site, to the axis until the next period, and stir with it."""
        model, data = apparatus.model, apparatus.data
        body = int(model.site_bodyid[bar])
        first = int(model.body_dofadr[body])
        off = data.site_xpos[bar] - apparatus.site(self.site).position_w
        push = np.zeros(2)
        if speed and self._near(apparatus, bar):
            velocity = data.qvel[first : first + 2]
            push = model.body_mass[body] * (-off[:2] / _CENTRING**2 - 2.0 * velocity / _CENTRING)
            if apparatus.liquid is not None:
                half = float(model.body_inertia[body].max() * 3.0 / model.body_mass[body]) ** 0.5
                at = data.site_xpos[bar]
                apparatus.liquid.stir(at, RPM * speed, half, apparatus.period)
        data.qfrc_applied[first : first + 2] = push


def _bars(model: mujoco.MjModel) -> list[int]:
    """Return the sites of all magnets."""
    return [site for site in range(model.nsite) if model.site(site).name.endswith(MAGNET)]
