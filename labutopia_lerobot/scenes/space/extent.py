"""The room that a kind of instrument takes, shut and while anything of it moves.

Measured on the compiled model: every joint of a mechanism goes over its whole range, all others
being shut.
"""

from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING

import mujoco
import numpy as np

from labutopia_lerobot.labware.instrument_catalogue import instrument
from labutopia_lerobot.labware.parts.instrument import Equipment
from labutopia_lerobot.labware.parts.top import Top
from labutopia_lerobot.scenes.space.boxes import Boxes, boxes
from labutopia_lerobot.world.model import COLLISION_GROUP, HULL_GROUP

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from labutopia_lerobot.world import FloatArray

_STATIONS = 12
"""Positions of a joint; between two neighbours all is taken that is between their boxes."""
_STICKING_OUT = 0.005
"""Least travel out of the hull that needs room of its own [m]."""
_SOLE = 0.03
"""Height above the ground up to which a part counts as standing on it [m]."""
_CORNERS = np.array(np.meshgrid(*([-1.0, 1.0],) * 3)).reshape(3, -1).T


@dataclass(frozen=True, eq=False)
class Swing:
    """The space that a moving part takes.

    Attributes:
        name: Of its mechanism, without the name of the piece.
        room: Boxes that it passes, in the frame of the piece [m].
    """

    name: str
    room: Boxes


@dataclass(frozen=True, eq=False)
class Extent:
    """Space of an instrument kind, in its own frame: origin at the centre of its base, front to -x.

    Attributes:
        solids: What it takes while it is shut: one box, or of what carries others one a part.
        hull: The box around it, with all that is seen.
        sole: The box around what of it stands on the ground.
        swings: What moves out of its hull.
        tops: What instruments stand on.
        boards: What ware stands on in rows.
        movable: Whether it stands free.
    """

    solids: Boxes
    hull: Boxes
    sole: Boxes
    swings: tuple[Swing, ...]
    tops: tuple[Top, ...]
    boards: tuple[Top, ...]
    movable: bool


@cache
def extent(kind: str) -> Extent:
    """Return the room that a kind takes.

    Raises:
        UnknownInstrumentError: If there is none.
    """
    piece = instrument(kind)
    assert isinstance(piece, Equipment), f"{kind} does not say what it carries"
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    piece.add_to(spec, spec.worldbody)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    drawn = np.flatnonzero(model.geom_group != HULL_GROUP)
    clouds = {geom: _points(model, data, geom) for geom in drawn}
    parts = _around(list(clouds.values()))
    hull = parts.hull
    solids = hull
    if piece.tops:
        felt = model.geom_group[drawn] == COLLISION_GROUP
        solids = Boxes(parts.low[felt], parts.high[felt]).without_inner()
    stands = parts.low[:, 2] < _SOLE
    swings = (
        Swing(part.name.removeprefix(f"{kind}_"), _swept(model, data, part.joint, clouds, hull))
        for part in piece.mechanisms
    )
    return Extent(
        solids=solids,
        hull=hull,
        sole=Boxes(parts.low[stands], parts.high[stands]).hull,
        swings=tuple(swing for swing in swings if len(swing.room.low)),
        tops=piece.tops,
        boards=piece.boards,
        movable=piece.movable,
    )


def _swept(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    joint: str,
    clouds: "Mapping[int, FloatArray]",
    hull: Boxes,
) -> Boxes:
    """Return what is passed by all that hangs on a joint, as far as that is out of a hull."""
    number = model.joint(joint).id
    carrier, address = model.jnt_bodyid[number], model.jnt_qposadr[number]
    frames = data.xpos[carrier].copy(), data.xmat[carrier].reshape(3, 3).copy()
    moving = [cloud for geom, cloud in clouds.items() if _hangs(model, geom, carrier)]
    if not moving:
        return boxes()
    own = (np.vstack(moving) - frames[0]) @ frames[1]
    low, high = model.jnt_range[number] if model.jnt_limited[number] else (0.0, 2 * np.pi)
    shut, stations = data.qpos[address], []
    for position in np.linspace(low, high, _STATIONS):
        data.qpos[address] = position
        mujoco.mj_kinematics(model, data)
        stations.append(own @ data.xmat[carrier].reshape(3, 3).T + data.xpos[carrier])
    data.qpos[address] = shut
    mujoco.mj_kinematics(model, data)
    stops = _around(stations)
    lows = np.minimum(stops.low[1:], stops.low[:-1])
    highs = np.maximum(stops.high[1:], stops.high[:-1])
    out = ((lows < hull.low - _STICKING_OUT) | (highs > hull.high + _STICKING_OUT)).any(axis=1)
    return Boxes(lows[out], highs[out])


def _hangs(model: mujoco.MjModel, geom: int, carrier: int) -> bool:
    """Return whether a geom moves with a body."""
    body = model.geom_bodyid[geom]
    while body not in (0, carrier):
        body = model.body_parentid[body]
    return bool(body == carrier)


def _points(model: mujoco.MjModel, data: mujoco.MjData, geom: int) -> "FloatArray":
    """Return points around a geom, shape (n, 3) [m]."""
    if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_MESH:
        mesh = model.geom_dataid[geom]
        start = model.mesh_vertadr[mesh]
        local = model.mesh_vert[start : start + model.mesh_vertnum[mesh]].astype(float)
    else:
        local = model.geom_aabb[geom, :3] + _CORNERS * model.geom_aabb[geom, 3:]
    points: FloatArray = local @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom]
    return points


def _around(clouds: "Sequence[FloatArray]") -> Boxes:
    """Return the box around each of some clouds of points, written to the millimetre."""
    lows = np.array([cloud.min(axis=0) for cloud in clouds]).reshape(-1, 3)
    highs = np.array([cloud.max(axis=0) for cloud in clouds]).reshape(-1, 3)
    return Boxes(np.round(lows, 3) + 0.0, np.round(highs, 3) + 0.0)
