"""The Clearpath Ridgeback as a MuJoCo spec: what it looks like, weighs, and touches.

[URDF] `ridgeback_description` 0.3.0 (ridgeback/ridgeback, BSD), in `rtb-data`: meshes, frames,
masses and inertias. The paper makes of it "a planar holonomic robot": so do we. It slides and turns
in the plane, by servos of its velocity; the wheels are drawn and weighed, and roll on nothing.
"""

import math

import mujoco

from labutopia_lerobot.robots.meshes import PlacedMesh
from labutopia_lerobot.robots.mobile_base import MobileBase
from labutopia_lerobot.robots.parts import (
    add_assembly,
    add_collision_box,
    add_tones,
    set_inertia,
)
from labutopia_lerobot.robots.planar_base import add_planar_base
from labutopia_lerobot.world.model import VISUAL_GROUP

_FOLDER = "xacro/clearpath_ridgeback_description/meshes"
_FINISH = "ridgeback"
_BLACK, _RED, _YELLOW, _WHITE = 0.1, 0.4, 0.7, 1.0
"""Tones of its parts, that stand for colours."""
_TONES = (
    (_BLACK, (0.13, 0.13, 0.14)),
    (_RED, (0.62, 0.06, 0.05)),
    (_YELLOW, (0.90, 0.72, 0.10)),
    (_WHITE, (0.92, 0.92, 0.90)),
)
_AXLE = 0.050
"""Height of the axles above the frame of the files [m] [URDF]."""
_WHEEL_RADIUS = 0.0759
_LIFT = _WHEEL_RADIUS - _AXLE
"""Height of the frame of the files above the floor [m]."""
_AXLE_X = 0.319
_WHEEL_Y = (0.472 + 0.0790) / 2
"""Places of the axles and of the wheels on them, to either side [m] [URDF]."""

_MASS = 165.304 + 2 * 10.267 + 4 * 2.3
"""Chassis, two rockers and four wheels [kg] [URDF]; 135 kg in the data sheet."""
_CENTRE = (0.0102, 0.0017, 0.0644)
"""Centre of mass of all of them, frame of the files [m] [URDF]."""
_INERTIA = (6.2, 7.6, 11.8, 0.0, 0.0, 0.0)
"""About it [kg m^2]: chassis 4.6, 4.5 and 7.2 about x, y and z, rockers 0.8, 2.1 and 3.0, wheels
0.7, 1.0 and 1.6, each where it is [URDF]; heights differ too little to count."""

_RISER = 0.09
"""Half the width of the riser that carries the arm [m]; ours."""
_RISER_MASS = 12.0
"""[kg]; ours: an aluminium profile of 180 mm, 0.4 m, with its plates."""

_DAMPING, _TURNING_DAMPING = 2.0e4, 2.0e3
"""Gains of the velocity servos [N s/m and N m s/rad]; ours: 230 kg follow within 12 ms."""
_FORCE, _TORQUE = 1200.0, 500.0
"""What the wheels can push with [N] and turn with [N m]; ours: a friction of 0.6 under 200 kg."""


def add_ridgeback(spec: mujoco.MjSpec, parent: mujoco.MjsBody, base: MobileBase) -> mujoco.MjsBody:
    """Build the base onto a body in the room's frame; return where the arm is mounted."""
    body = add_planar_base(spec, parent, base, (_DAMPING, _FORCE), (_TURNING_DAMPING, _TORQUE))
    x, y, z = _CENTRE
    set_inertia(body, _MASS, (x, y, z + _LIFT), _INERTIA)
    length, width = base.size
    middle = (0.0, 0.0, (_LIFT + base.height) / 2)
    add_collision_box(
        body, "base_collision", middle, (length / 2, width / 2, (base.height - _LIFT) / 2)
    )
    add_tones(spec, _FINISH, *_TONES, specular=0.3, shininess=0.4)
    add_assembly(spec, body, "ridgeback", _parts(), _FINISH)
    return _add_riser(spec, body, base)


def _parts() -> list[PlacedMesh]:
    """Return the files that it is drawn with, where they are [URDF]; rockers are inside."""
    half, up = math.pi / 2, (0.0, 0.0, _LIFT)
    parts = [
        PlacedMesh(f"{_FOLDER}/{file}.stl", up, (0.0, 0.0, turn), tone)
        for file, turn, tone in (
            ("body", 0.0, _BLACK),
            ("top", 0.0, _BLACK),
            ("side-cover", 0.0, _YELLOW),
            ("side-cover", math.pi, _YELLOW),
            ("end-cover", 0.0, _BLACK),
            ("end-cover", math.pi, _BLACK),
            ("lights", 0.0, _WHITE),
            ("lights", math.pi, _RED),
        )
    ]
    for x in (-_AXLE_X, _AXLE_X):
        parts += [
            PlacedMesh(f"{_FOLDER}/wheel.stl", (x, y, _WHEEL_RADIUS), (half, 0.0, 0.0), _BLACK)
            for y in (-_WHEEL_Y, _WHEEL_Y)
        ]
    return parts


def _add_riser(spec: mujoco.MjSpec, body: mujoco.MjsBody, base: MobileBase) -> mujoco.MjsBody:
    """Add the post on the deck that the arm stands on; return its top, a body."""
    mount = body.add_body(name="arm_mount", pos=base.arm, gravcomp=1)
    half = (base.arm[2] - base.height) / 2
    spec.add_material(name="riser", rgba=(0.72, 0.73, 0.74, 1.0), specular=0.4, shininess=0.5)
    middle, size = (0.0, 0.0, -half), (_RISER, _RISER, half)
    mount.add_geom(
        name="riser",
        type=mujoco.mjtGeom.mjGEOM_BOX,
        material="riser",
        group=VISUAL_GROUP,
        contype=0,
        conaffinity=0,
        mass=_RISER_MASS,
        pos=middle,
        size=size,
    )
    add_collision_box(mount, "riser_collision", middle, size).mass = 0.0
    return mount
