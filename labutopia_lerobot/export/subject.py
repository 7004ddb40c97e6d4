"""Exportable things by name: an instrument, a piece of ware, a room, the start of a task."""

import difflib
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.labware.glass.catalogue import catalogue as ware
from labutopia_lerobot.labware.instrument_catalogue import catalogue as instruments
from labutopia_lerobot.labware.piece import Piece
from labutopia_lerobot.registry import task_files
from labutopia_lerobot.scenes import ROOMS, load_room
from labutopia_lerobot.scenes.plan_model import build
from labutopia_lerobot.scenes.plans import load_plan, plan_names
from labutopia_lerobot.scenes.views import VESSEL_VIEW
from labutopia_lerobot.setting import LIQUID, Setting
from labutopia_lerobot.sim.scene import scene_spec, set_options
from labutopia_lerobot.sim.workcells import Workcells
from labutopia_lerobot.world.model import SOLIMP, SOLREF

START = "start"
"""Keyframe of a task: robot at home, everything where the episode begins."""

_SHOWN = 12
"""Names that a message lists of each sort; the catalogues have pages of their own."""


class UnknownSubjectError(UserError, ValueError):
    """A thing to be exported does not exist; the message lists those of a similar name."""


@dataclass(frozen=True)
class ExportSubject:
    """The thing that is exported.

    Attributes:
        name: As files and models are called after it, such as `level1_pick`.
        spec: The model; of a task with the keyframe `START`.
        model: The same, compiled.
    """

    name: str
    spec: mujoco.MjSpec
    model: mujoco.MjModel


def find_subject(what: str, size: str | None = None, seed: int = 0) -> ExportSubject:
    """Return what has a name.

    Args:
        what: Kind of an instrument or of ware, name of a room, id of a task.
        size: Of the ware, such as "250 ml"; may be left out where there is only one.
        seed: Of the episode whose start is exported, for a task.

    Raises:
        UnknownGlasswareError: If the ware has no such size.
        UnknownSubjectError: If there is nothing of this name, or ware that comes in several sizes
            is asked for without one.
    """
    if size is not None and what not in ware():
        _require_known(what)
        raise UnknownSubjectError(f"'{what}' has no sizes: leave the size {size!r} out")
    if what in instruments():
        return _piece(what, instruments()[what](what))
    if what in ware():
        sizes = ware()[what].sizes
        if size is None and len(sizes) > 1:
            raise UnknownSubjectError(f"Choose a size of {what}: {', '.join(sizes)}")
        size = size or next(iter(sizes))
        return _piece(f"{what}_{size.replace(' ', '_')}", ware()[what].make(size, what))
    if what in ROOMS:
        return _compiled(what, _with_options(load_room(what).build(VESSEL_VIEW)))
    if what in plan_names():
        return _compiled(what, _with_options(build(load_plan(what))))
    _require_known(what)
    return _task(what, seed)


def _require_known(what: str) -> None:
    sorts = {
        "instruments": list(instruments()),
        "ware": list(ware()),
        "rooms": [*ROOMS, *plan_names()],
        "tasks": list(task_files()),
    }
    names = [name for sort in sorts.values() for name in sort]
    if what not in names:
        near = difflib.get_close_matches(what, names, n=3, cutoff=0.5)
        hint = f" Did you mean {' or '.join(repr(name) for name in near)}?" if near else ""
        listed = "; ".join(f"{sort} {_few(names)}" for sort, names in sorts.items())
        raise UnknownSubjectError(f"Nothing is called '{what}'.{hint} There are {listed}")


def _few(names: list[str]) -> str:
    more = f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else ""
    return ", ".join(names[:_SHOWN]) + more


def _piece(name: str, piece: Piece) -> ExportSubject:
    """Return a piece at the origin; what stands free falls unless it is put onto something."""
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    spec.default.geom.solref[:] = SOLREF
    spec.default.geom.solimp[:] = SOLIMP
    body = piece.add_to(_with_options(spec), spec.worldbody)
    if piece.movable:
        body.add_freejoint(name=f"{piece.name}_free")
    return _compiled(name, spec)


def _task(task: str, seed: int) -> ExportSubject:
    """Return the scene of an episode as it begins; vessels are empty, liquids are no part of it."""
    cells = Workcells(Setting(task, obs="state", liquid=LIQUID[1]))
    try:
        cell, _, _ = cells.begin(seed)
        scene, data = cell.simulation.scene, cell.simulation.data
        spec = scene_spec(scene.pieces, scene.robot, scene.room, cell.task.view)
        for body in spec.bodies[1:]:
            compiled = scene.model.body(body.name)
            body.pos, body.quat = compiled.pos, compiled.quat
        for piece in scene.pieces:
            if piece.movable:  # where it stands, not at the origin, before any keyframe is loaded
                body, there = spec.body(piece.name), data.body(piece.name)
                body.pos, body.quat = there.xpos, there.xquat
        spec.add_key(name=START, qpos=data.qpos, ctrl=data.ctrl)
        return _compiled(task.replace("/", "_"), spec)
    finally:
        cells.close()


def _with_options(spec: mujoco.MjSpec) -> mujoco.MjSpec:
    set_options(spec)
    return spec


def _compiled(name: str, spec: mujoco.MjSpec) -> ExportSubject:
    spec.modelname = name
    return ExportSubject(name, spec, spec.compile())
