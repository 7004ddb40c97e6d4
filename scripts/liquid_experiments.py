"""Experiments with liquids that have a right result: of the tests, and of plot_liquids.py."""

from collections.abc import Sequence
from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray
from scipy.special import j1, jn_zeros

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.liquids.liquid import Liquid
from labutopia_lerobot.liquids.solver.flow import GRAVITY, LIQUID_HZ
from labutopia_lerobot.setting import PARTICLES
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.substances.substance import SUBSTANCES
from labutopia_lerobot.world.model import PHYSICS_HZ

COLUMN = 2.25 * 0.0254
"""Width a of the column of water in the experiment of Martin and Moyce [m]; it is 2 a high."""

FRONTS = np.array(
    [
        (0.41, 1.11), (0.84, 1.22), (1.19, 1.44), (1.43, 1.67), (1.63, 1.89), (1.83, 2.11),
        (1.98, 2.33), (2.20, 2.56), (2.32, 2.78), (2.51, 3.00), (2.65, 3.22), (2.83, 3.44),
        (2.98, 3.67), (3.11, 3.89),
    ]
)  # fmt: skip
"""Time in sqrt(a / 2 g) and front in a: Martin and Moyce (1952), "An Experimental Study of the
Collapse of Liquid Columns on a Rigid Horizontal Plane", Phil. Trans. R. Soc. A 244, 312-324,
table 2 (n^2 = 2, a = 2.25 inches)."""

type Numbers = NDArray[np.float64]


def world(
    *vessels: Vessel, boxes: Sequence[tuple[object, object]] = (), bench: bool = True
) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Compile vessels, boxes (position and half lengths [m]), and a bench at the height 0."""
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    spec.option.timestep = 1.0 / PHYSICS_HZ
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    if bench:
        spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=(5, 5, 0.1))
    for position, size in boxes:
        spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, pos=position, size=size)
    for vessel in vessels:
        vessel.add_to(spec, spec.worldbody).add_freejoint()
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def filled(
    vessel: Vessel,
    filling: Filling,
    count: int = PARTICLES,
    height: float = 0.0,
    bench: bool = True,
    seed: int = 0,
) -> tuple[mujoco.MjModel, mujoco.MjData, Liquid]:
    """Return a vessel that stands at a height [m], with liquid at rest in it."""
    model, data = world(vessel, bench=bench)
    move_to(model, data, (0, 0, height), 0.0)
    liquid = Liquid(model, data, [vessel], [filling], count)
    liquid.fill({vessel: filling}, np.random.default_rng(seed))
    return model, data, liquid


def move_to(
    model: mujoco.MjModel, data: mujoco.MjData, position: Sequence[float], tilt: float
) -> None:
    """Put the only vessel there [m], turned about the y axis [rad]."""
    data.qpos[:] = (*position, np.cos(tilt / 2), 0.0, np.sin(tilt / 2), 0.0)
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)


def surface(liquid: Liquid) -> tuple[float, float]:
    """Fit a plane to the highest particle of every cell; return its height [m] and slope [rad]."""
    spacing = liquid.volume ** (1 / 3)
    positions = liquid.positions[np.argsort(liquid.positions[:, 2])]
    cells = np.floor(positions[:, :2] / (1.5 * spacing)).astype(int)
    highest = positions[list({tuple(cell): index for index, cell in enumerate(cells)}.values())]
    # Cells that hang over the wall or the bottom catch no surface.
    highest = highest[highest[:, 2] > np.median(highest[:, 2]) - 1.5 * spacing]
    plane, *_ = np.linalg.lstsq(np.insert(highest[:, :2], 2, 1.0, axis=1), highest[:, 2])
    return float(highest[:, 2].mean() + spacing / 2), float(np.arctan(np.hypot(*plane[:2])))


class Collapse(NamedTuple):
    """Course of a collapsing column of water.

    Attributes:
        times: In sqrt(a / 2 g).
        fronts: How far the water had come, in a, at those times.
        count: Number of particles.
    """

    times: Numbers
    fronts: Numbers
    count: int


def collapse(across: int) -> Collapse:
    """Let a column of water collapse that is so many particles wide."""
    deep = across // 2
    spacing = COLUMN / across
    side = deep * spacing / 2
    boxes = [
        ((-0.05, 0, 0.1), (0.05, 0.3, 0.2)),
        ((0, side + 0.05, 0.1), (0.6, 0.05, 0.2)),
        ((0, -side - 0.05, 0.1), (0.6, 0.05, 0.2)),
    ]
    model, data = world(boxes=boxes)
    places = np.moveaxis(np.indices((across, deep, 2 * across)), 0, -1).reshape(-1, 3) + 0.5
    places = places * spacing - (0, side, 0)
    places += np.random.default_rng(0).uniform(-0.05, 0.05, places.shape) * spacing
    liquid = Liquid(model, data, [], [Filling(len(places) * spacing**3 * 1e6)], len(places))
    liquid.release(places, np.zeros_like(places))
    fronts = [1.0]
    seconds = np.arange(0.0, 0.2, 1.0 / liquid.hertz)
    for _ in seconds[1:]:
        liquid.step()
        foremost = np.sort(liquid.positions[:, 0])[-deep:].mean()
        fronts.append((foremost + spacing / 2) / COLUMN)
    return Collapse(seconds * np.sqrt(2 * GRAVITY / COLUMN), np.array(fronts), len(places))


class Swirl(NamedTuple):
    """Course of a swirl that dies away.

    Attributes:
        seconds: Times [s].
        spins: Angular momentum per mass at those times [m^2/s].
        rate: At what rate it decayed in the first 0.2 s [1/s].
        stokes: At what rate it should [1/s].
    """

    seconds: Numbers
    spins: Numbers
    rate: float
    stokes: float


def swirl(substance: str) -> Swirl:
    """Let a swirl die away in an upright cylinder of glass.

    It sticks to wall and bottom and has a free surface: separating the unsteady Stokes equation
    gives v = J1(j r / R) sin(pi z / 2 H) exp(-nu ((j / R)^2 + (pi / 2 H)^2) t), where J1(j) = 0.
    """
    vessel, ml = glassware("beaker", "150 ml", "glass"), 60.0
    _, _, liquid = filled(vessel, Filling(ml, substance))
    radius, zero = vessel.profile.inner_radius(0.02), jn_zeros(1, 1)[0]
    depth = ml * 1e-6 / (np.pi * radius**2)
    x, y, z = liquid.positions.T
    distance, height = np.hypot(x, y), z - vessel.profile.bottom
    shape = j1(zero * distance / radius) * np.sin(np.pi * height / (2 * depth)) / distance
    liquid.velocities[:] = 0.2 * shape[:, None] * np.column_stack([-y, x, np.zeros_like(x)])
    seconds, spins = np.arange(1, round(0.4 * LIQUID_HZ)) / LIQUID_HZ, []
    for _ in seconds:
        liquid.step()
        spins.append(abs(np.cross(liquid.positions, liquid.velocities)[:, 2].mean()))
    early = seconds < 0.2
    rate = -float(np.polyfit(seconds[early], np.log(spins)[early], 1)[0])
    squares = (zero / radius) ** 2 + (np.pi / (2 * depth)) ** 2
    stokes = float(SUBSTANCES[substance].kinematic_viscosity * squares)
    return Swirl(seconds, np.array(spins), rate, stokes)
