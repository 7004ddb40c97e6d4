"""Compiling a task into one MuJoCo model: room, robot, labware."""

from collections.abc import Iterable, Mapping, Set
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.chemistry.kept_answers import KeptAnswers
from labutopia_lerobot.labware.piece import Piece
from labutopia_lerobot.liquids.drawing.liquid_drawing import LiquidDrawing
from labutopia_lerobot.processes import Process, slots_of
from labutopia_lerobot.robots.odometry import Odometry
from labutopia_lerobot.robots.robot import Robot
from labutopia_lerobot.robots.set_points import SPAN
from labutopia_lerobot.scenes.laboratory_model import add_cameras
from labutopia_lerobot.scenes.room import PEDESTAL, Room
from labutopia_lerobot.scenes.views import View
from labutopia_lerobot.setting import CLASSIC, FILAMENT, PARTICLES
from labutopia_lerobot.sim import contact_shadows
from labutopia_lerobot.sim.bubbles import Bubbles, bubbles_in
from labutopia_lerobot.sim.filament_light import light_for_filament
from labutopia_lerobot.sim.steam import Steam, steam_over
from labutopia_lerobot.sim.warm_processes import warm_processes
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.world import ARM, BASE, HAND, LEFT_PAD, RIGHT_PAD, FloatArray
from labutopia_lerobot.world.model import PHYSICS_HZ

ROBOT_MOUNT = "robot_mount"
"""Body that the robot hangs on."""


@dataclass(frozen=True)
class Scene:
    """A compiled model and what its contacts are called.

    Attributes:
        model: The compiled model.
        robot: The robot in it.
        room: The room around it.
        pieces: The labware in it.
        processes: What they do by themselves, in the order in which it is done.
        groups: Names that contacts are reported under.
        group_of_geom: Index into `groups` of every geom, and after them of every flex, which is
            named after the thing that it belongs to; shape (ngeom + nflex,).
        contents: What vessels hold at the start.
        particles: In how many particles that is divided.
        liquid: How it is drawn, or None where there is none.
        odometry: Where the base believes to be, or None: it is observed where it is.
        answers: Of a language model, which decide what reacts; None for the rules.
    """

    model: mujoco.MjModel
    robot: Robot
    room: Room
    pieces: tuple[Piece, ...]
    processes: tuple[Process, ...]
    groups: tuple[str, ...]
    group_of_geom: NDArray[np.intp]
    contents: Mapping[Piece, Filling]
    particles: int
    liquid: LiquidDrawing | None
    odometry: Odometry | None = None
    answers: KeptAnswers | None = None

    @property
    def welds(self) -> int:
        """Number of bodies that are glued together; grasps are friction."""
        return int((self.model.eq_type == mujoco.mjtEq.mjEQ_WELD).sum())


def compile_scene(
    pieces: Iterable[Piece],
    robot: Robot,
    room: Room,
    view: View,
    contents: Mapping[Piece, Filling] | None = None,
    particles: int = PARTICLES,
    renderer: str = CLASSIC,
    *,
    drifts: bool = False,
    answers: KeptAnswers | None = None,
) -> Scene:
    """Put the robot and the pieces into the room and compile.

    Pieces stand at the world's origin; a reset puts them where the layout says. If the odometry of
    the robot's base `drifts`, the scene has one. What reacts is as the rules say, or `answers`.
    """
    pieces = tuple(pieces)
    spec = scene_spec(pieces, robot, room, view)
    contact_shadows.add_material(spec)
    standing = (*pieces, *room.pieces)
    processes = tuple(process for piece in standing for process in piece.processes)
    contents = contents or {}
    reacts = any(filling.reacts for filling in contents.values())
    processes += warm_processes(pieces, processes, robot.gripper.body, reacts=reacts)
    seen: list[Steam | Bubbles] = [*steam_over(processes), *bubbles_in(pieces, contents)]
    for each in seen:
        each.add_to(spec)
    processes += tuple(seen)
    odometry = Odometry("odometry", robot.base.joints) if drifts and robot.base else None
    processes += () if odometry is None else (odometry,)
    # MuJoCo keeps what it is given here with its state: the commands that act, then the processes.
    spec.nuserdata = SPAN * len(robot.elements) + slots_of(processes)
    liquid = _drawing(spec, contents, particles, renderer == CLASSIC) if contents else None
    if renderer == FILAMENT:
        light_for_filament(spec)
    model = spec.compile()
    _let_sleep(model, {piece.name for piece in room.pieces})
    groups, group_of_geom = _contact_groups(model, robot)
    return Scene(
        model,
        robot,
        room,
        pieces,
        processes,
        groups,
        group_of_geom,
        contents,
        particles,
        liquid,
        odometry,
        answers,
    )


def scene_spec(pieces: Iterable[Piece], robot: Robot, room: Room, view: View) -> mujoco.MjSpec:
    """Return the room with the robot and the pieces in it; what stands free has a free joint."""
    spec = room.build(view)
    room.decorate(spec, view)
    set_options(spec)
    add_robot(spec, robot, room)
    if view.on_base and robot.base is not None:
        add_cameras(spec.body(robot.base.body), view)
    for piece in pieces:
        body = piece.add_to(spec, spec.worldbody)
        if piece.movable:
            body.add_freejoint(name=f"{piece.name}_free")
    if spec.flexes:
        # The only integrator that is implicit in position: explicit ones need steps far below a
        # millisecond for elastic bodies, implicitfast refuses them, of which this is a sibling
        # (MuJoCo documentation, "Integrators", "Deformables").
        spec.option.integrator = mujoco.mjtIntegrator.mjINT_DISCRETE
    return spec


def _let_sleep(model: mujoco.MjModel, furnishings: Set[str]) -> None:
    """Let what stands around in a furnished room cost nothing until something touches it.

    What the task is about never sleeps, and the bare room has nothing that could (MuJoCo
    documentation, "Sleeping islands").
    """
    if not furnishings:
        return
    model.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_SLEEP
    for tree, body in enumerate(model.tree_bodyadr):
        if model.body(int(model.body_rootid[body])).name not in furnishings:
            model.tree_sleep_policy[tree] = mujoco.mjtSleepPolicy.mjSLEEP_NEVER


def set_options(spec: mujoco.MjSpec) -> None:
    """Set how a spec is stepped and drawn."""
    spec.option.timestep = 1.0 / PHYSICS_HZ
    # Elliptic cones with a high friction impedance keep a friction grasp from creeping
    # (MuJoCo documentation, "Preventing slip"): a held rod by 0.10 mm in 20 s; by 1.2 mm with 10
    # and softer pads.
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.impratio = 30.0
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    # No shadow map, no multisampling: on a CPU they cost more than the rest of the image.
    spec.visual.quality.shadowsize = 0
    spec.visual.quality.offsamples = 0
    # The image buffer of the largest picture that can be asked for.
    spec.visual.global_.offwidth = 1920
    spec.visual.global_.offheight = 1080
    spec.stat.extent = 1.0  # so that the clipping planes are in metres
    spec.visual.map.znear = 0.01
    spec.visual.map.zfar = 20.0


def add_robot(spec: mujoco.MjSpec, robot: Robot, room: Room) -> None:
    """Mount the robot on its stand; one that drives needs none, and starts at the origin."""
    stand = room.robot_stand
    if robot.base is not None:
        stand = (0.0, 0.0, 0.0)
        if (pedestal := spec.body(PEDESTAL)) is not None:
            spec.delete(pedestal)
        room.make_solid(spec)
    robot.add_to(spec, spec.worldbody.add_body(name=ROBOT_MOUNT, pos=stand))


def at_stand(robot: Robot, room: Room) -> FloatArray:
    """Return where a base is that stands at the bench of a room (see `Room.arm_place`).

    That is x, y [m] and heading [rad]; empty for an arm on a stand.
    """
    if robot.base is None:
        return np.empty(0)
    (x, y), (ahead, left, _) = room.arm_place(robot.base), robot.base.arm
    return np.array([x - ahead, y - left, 0.0])


def _drawing(
    spec: mujoco.MjSpec, contents: Mapping[Piece, Filling], particles: int, skin: bool
) -> LiquidDrawing:
    volume = sum(filling.volume for filling in contents.values()) / particles
    colors = {filling.of: filling.substance.rgba for filling in contents.values()}
    name, spacing = " and ".join(colors), volume ** (1 / 3)
    painted = any(filling.reacts for filling in contents.values())
    return LiquidDrawing.add_to(
        spec, name, list(colors.values()), spacing, particles, skin, painted
    )


def _contact_groups(
    model: mujoco.MjModel, robot: Robot
) -> tuple[tuple[str, ...], NDArray[np.intp]]:
    """Name each geom after its body or its part of the robot, each flex after its root body."""
    hand = model.body(robot.gripper.body).id
    arm = model.body(robot.base_body).id
    base = -1 if robot.base is None else model.body(robot.base.body).id
    names = []
    for geom in range(model.ngeom):
        body = model.geom_bodyid[geom]
        line = ancestors(model, body)
        if model.geom(geom).name == robot.gripper.pads[0]:
            names.append(LEFT_PAD)
        elif model.geom(geom).name == robot.gripper.pads[1]:
            names.append(RIGHT_PAD)
        elif hand in line:
            names.append(HAND)
        elif arm in line:
            names.append(ARM)
        elif base in line:
            names.append(BASE)
        else:
            names.append(model.body(body).name)
    for first in model.flex_vertadr:
        names.append(model.body(model.body_rootid[model.flex_vertbodyid[first]]).name)
    groups = tuple(dict.fromkeys([LEFT_PAD, RIGHT_PAD, HAND, ARM, BASE, *names]))
    return groups, np.array([groups.index(name) for name in names], dtype=np.intp)


def ancestors(model: mujoco.MjModel, body: int) -> set[int]:
    """Return the body and all bodies above it but the world."""
    line = set()
    while body:
        line.add(int(body))
        body = model.body_parentid[body]
    return line
