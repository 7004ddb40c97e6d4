"""What touched what, how hard and how fast, at every physics step of a control period."""

import mujoco
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.sim.scene import Scene
from labutopia_lerobot.world import LEFT_PAD, RIGHT_PAD, FloatArray


class ContactRecord:
    """Extremes since the record was last cleared, by the groups of a scene.

    MuJoCo's first half of a step finds contacts and how fast they close, its second half what
    forces they need: both are read where they are known, of all contacts at once.

    Args:
        scene: What was compiled.
        data: Its state.

    Attributes:
        touched: Which groups touched, shape (groups, groups).
        force: Greatest sum of normal forces between two groups [N], shape (groups, groups).
        approach: Greatest speed at which two groups met, along the normal of a contact [m/s],
            shape (groups, groups).
        fall: Greatest downward speed of each movable piece at an instant at which not both pads
            touched it [m/s], shape (movable pieces,).
    """

    def __init__(self, scene: Scene, data: mujoco.MjData) -> None:
        self._data = data
        self._soft = scene.model.ngeom
        self._group_of_geom = scene.group_of_geom
        count = len(scene.groups)
        movable = [piece.name for piece in scene.pieces if piece.movable]
        joints = [scene.model.joint(f"{name}_free") for name in movable]
        self._downward = np.array([joint.dofadr[0] + 2 for joint in joints], dtype=np.intp)
        groups = np.array([scene.groups.index(name) for name in movable], dtype=np.intp)
        self._pads = [scene.groups.index(pad) * count + groups for pad in (LEFT_PAD, RIGHT_PAD)]
        self._pairs = np.zeros(0, dtype=np.intp)
        self._now = np.zeros(count * count, dtype=bool)
        self.touched: NDArray[np.bool_] = np.zeros((count, count), dtype=bool)
        self.force: FloatArray = np.zeros((count, count))
        self.approach: FloatArray = np.zeros((count, count))
        self.fall: FloatArray = np.zeros(len(movable))

    def clear(self) -> None:
        """Forget everything: a control period begins."""
        for extremes in (self.touched, self.force, self.approach, self.fall):
            extremes[:] = 0

    def note_forces(self) -> None:
        """Take note of the forces that the second half of a step has found for its contacts."""
        rows = self._data.contact.efc_address
        active = rows >= 0
        forces = self._data.efc_force[rows[active]]
        total = np.bincount(self._pairs[active], forces, minlength=self.force.size)
        np.maximum(self.force, total.reshape(self.force.shape), out=self.force)

    def note_contacts(self) -> None:
        """Take note of the contacts that the first half of a step has found."""
        contact, velocity = self._data.contact, self._data.efc_vel
        geom = np.where(contact.geom < 0, self._soft + contact.flex, contact.geom)
        first, second = np.sort(self._group_of_geom[geom]).T
        self._pairs = first * len(self.touched) + second
        self._now[:] = False
        self._now[self._pairs] = True
        self.touched |= self._now.reshape(self.touched.shape)
        rows = contact.efc_address
        active = rows >= 0
        # The first row of a contact is its normal direction; bodies that part have a positive one.
        np.maximum.at(self.approach.reshape(-1), self._pairs[active], -velocity[rows[active]])
        left, right = (self._now[pad] for pad in self._pads)
        falling = np.where(left & right, 0.0, -self._data.qvel[self._downward])
        np.maximum(self.fall, falling, out=self.fall)

    def mirror(self) -> None:
        """Make every pair stand both ways round: a control period ends."""
        for extremes in (self.touched, self.force, self.approach):
            np.maximum(extremes, extremes.T, out=extremes)
