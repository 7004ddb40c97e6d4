"""Contacts, their forces and the speeds of things, at every step of a control period."""

import mujoco
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.kernel import kernel
from labutopia_lerobot.sim.scene import Scene
from labutopia_lerobot.world import LEFT_PAD, RIGHT_PAD, FloatArray


class ContactRecord:
    """Extremes since the record was last cleared, by the groups of a scene.

    MuJoCo's first half of a step finds contacts and how fast they close, its second half what
    forces they need: between the second half and the next first one all of that is known.

    Args:
        scene: The compiled scene.
        data: Its state.

    Attributes:
        now: Sum of the normal forces between two groups at the last physics step [N], negative
            where they did not touch, shape (groups, groups).
        touched: Which groups touched, shape (groups, groups).
        force: Greatest sum of normal forces between two groups [N], shape (groups, groups).
        approach: Greatest speed at which two groups met, along the normal of a contact [m/s],
            shape (groups, groups).
        fall: Greatest downward speed of each movable piece at an instant at which not both pads
            touched it [m/s], shape (movable pieces,).
        speed: Greatest speed of every degree of freedom [rad/s or m/s], shape (nv,).
    """

    def __init__(self, scene: Scene, data: mujoco.MjData) -> None:
        self._data = data
        self._soft = scene.model.ngeom
        self._group_of_geom = scene.group_of_geom
        movable = [piece.name for piece in scene.pieces if piece.movable]
        joints = [scene.model.joint(f"{name}_free") for name in movable]
        self._downward = np.array([joint.dofadr[0] + 2 for joint in joints], dtype=np.intp)
        self._movable = np.array([scene.groups.index(name) for name in movable], dtype=np.intp)
        self._pads = scene.groups.index(LEFT_PAD), scene.groups.index(RIGHT_PAD)
        groups = len(scene.groups), len(scene.groups)
        self.now: FloatArray = np.full(groups, -1.0)
        self.touched: NDArray[np.bool_] = np.zeros(groups, dtype=bool)
        self.force: FloatArray = np.zeros(groups)
        self.approach: FloatArray = np.zeros(groups)
        self.fall: FloatArray = np.zeros(len(movable))
        self.speed: FloatArray = np.zeros(scene.model.nv)

    def clear(self) -> None:
        """Forget everything: a control period begins."""
        for extremes in (self.touched, self.force, self.approach, self.fall, self.speed):
            extremes[:] = 0
        self.now[:] = -1.0

    def note(self) -> None:
        """Take note of a physics step, after its second half."""
        data, contact = self._data, self._data.contact
        self.now[:] = -1.0
        _note_contacts(
            contact.geom,
            contact.flex,
            contact.efc_address,
            data.efc_force,
            data.efc_vel,
            self._group_of_geom,
            self._soft,
            self.now,
            self.approach,
        )
        _note_extremes(self.now, self.touched, self.force)
        _note_speeds(
            self.now,
            self._pads,
            self._movable,
            self._downward,
            data.qvel,
            self.fall,
            self.speed,
        )


@kernel
def _note_contacts(
    geom: NDArray[np.int32],
    flex: NDArray[np.int32],
    address: NDArray[np.int32],
    force: FloatArray,
    velocity: FloatArray,
    group_of_geom: NDArray[np.intp],
    soft: int,
    now: FloatArray,
    approach: FloatArray,
) -> None:
    """Add up the forces of the contacts of a step, and take note of how fast they close.

    Args:
        geom: Geoms of each contact, -1 for a flex, shape (contacts, 2).
        flex: Flexes of each contact, shape (contacts, 2).
        address: First row of each contact among all constraints, its normal direction; -1 for a
            contact that needs no force; shape (contacts,).
        force: Of every constraint [N], shape (constraints,).
        velocity: Of every constraint [m/s], positive where bodies part, shape (constraints,).
        group_of_geom: Group of every geom, and after them of every flex.
        soft: How many geoms there are.
        now: Becomes the force between groups that touch [N]; others are negative.
        approach: Becomes the greatest speed at which they met [m/s].
    """
    for contact in range(len(address)):
        first, second = geom[contact]
        a = group_of_geom[first if first >= 0 else soft + flex[contact, 0]]
        b = group_of_geom[second if second >= 0 else soft + flex[contact, 1]]
        row = address[contact]
        pushing = force[row] if row >= 0 else 0.0
        closing = -velocity[row] if row >= 0 else 0.0
        total = max(now[a, b], 0.0) + pushing
        now[a, b] = now[b, a] = total
        approach[a, b] = approach[b, a] = max(approach[a, b], closing)


@kernel
def _note_extremes(now: FloatArray, touched: NDArray[np.bool_], force: FloatArray) -> None:
    """Take note of the forces between groups in a step, which are negative where none touch."""
    for a in range(len(now)):
        for b in range(len(now)):
            touched[a, b] |= now[a, b] >= 0.0
            force[a, b] = max(force[a, b], now[a, b])


@kernel
def _note_speeds(
    now: FloatArray,
    pads: tuple[int, int],
    movable: NDArray[np.intp],
    downward: NDArray[np.intp],
    qvel: FloatArray,
    fall: FloatArray,
    speed: FloatArray,
) -> None:
    """Take note of how fast everything moves, and how fast what is not between the pads goes down.

    Args:
        now: Forces between groups in a step [N], negative where none touch.
        pads: Groups of the pads.
        movable: Groups of the movable pieces.
        downward: Where their vertical velocities are.
        qvel: All velocities.
        fall: Becomes the greatest downward speed of each piece [m/s].
        speed: Becomes the greatest speed of every degree of freedom, whichever way.
    """
    for piece in range(len(movable)):
        group = movable[piece]
        if now[pads[0], group] < 0.0 or now[pads[1], group] < 0.0:
            fall[piece] = max(fall[piece], -qvel[downward[piece]])
    for dof in range(len(qvel)):
        speed[dof] = max(speed[dof], abs(qvel[dof]))
