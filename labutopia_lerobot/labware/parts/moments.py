"""Weight of forms: mass, centre and inertia of what their surfaces enclose."""

from collections.abc import Iterable
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.labware.parts.form import Form


@dataclass(frozen=True, eq=False)
class Moments:
    """Moments of a solid, additive; in the frame of its body.

    Attributes:
        mass: Its mass [kg].
        first: Mass times centre, shape (3,) [kg m].
        second: Integral of x x^T over the mass, shape (3, 3) [kg m^2].
    """

    mass: float
    first: NDArray[np.float64]
    second: NDArray[np.float64]

    def __add__(self, other: "Moments") -> "Moments":
        return Moments(self.mass + other.mass, self.first + other.first, self.second + other.second)

    @classmethod
    def of_revolution(
        cls, mass: float, height: float, transverse: float, axial: float
    ) -> "Moments":
        """Return those of a body of revolution about z.

        Args:
            mass: Its mass [kg].
            height: Of its centre [m].
            transverse: Moment of inertia about a horizontal axis through its centre [kg m^2].
            axial: Moment of inertia about its axis [kg m^2].
        """
        second = np.diag([axial / 2, axial / 2, transverse - axial / 2 + mass * height**2])
        return cls(mass, np.array([0.0, 0.0, mass * height]), second)

    def give_to(self, body: mujoco.MjsBody) -> None:
        """Make a body weigh this; its geoms then weigh nothing."""
        centre = self.first / self.mass
        about = self.second - self.mass * np.outer(centre, centre)
        inertia = np.trace(about) * np.eye(3) - about
        body.explicitinertial = True
        body.mass, body.ipos = self.mass, centre
        body.fullinertia = [*np.diag(inertia), inertia[0, 1], inertia[0, 2], inertia[1, 2]]


def moments(forms: Iterable[Form], density: float) -> Moments:
    """Return the moments of forms of one density [kg/m^3], those for the eye alone left out.

    Exact for closed surfaces: the sum over the tetrahedra between every triangle and the origin
    (Tonon, "Explicit exact formulas for the 3-D tetrahedron inertia tensor", 2005).
    """
    total = Moments(0.0, np.zeros(3), np.zeros((3, 3)))
    for form in forms:
        if form.touch:
            vertices, _, faces = form.shell()
            corners = vertices[faces]
            weight = density * np.linalg.det(corners) / 6
            sums = corners.sum(axis=1)
            second = np.einsum("t,tki,tkj->ij", weight, corners, corners)
            second = (second + np.einsum("t,ti,tj->ij", weight, sums, sums)) / 20
            total += Moments(float(weight.sum()), weight @ sums / 4, second)
    return total
