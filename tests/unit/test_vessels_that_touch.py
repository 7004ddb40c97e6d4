"""Liquid between two vessels: what one moves, the other one does not let through its glass."""

from collections.abc import Callable

import mujoco
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.liquids.liquid import Liquid
from labutopia_lerobot.liquids.solver.bodies import Glass, clearances, stop_at_vessels
from labutopia_lerobot.liquids.solver.flow import LIQUID_HZ
from labutopia_lerobot.liquids.solver.walls import Edges, edges_of, first_crossing, in_glass
from labutopia_lerobot.liquids.surroundings import Surroundings
from labutopia_lerobot.substances.filling import Filling
from leak_rate import Watch
from liquid_experiments import world

type Path = Callable[[float], tuple[tuple[float, float, float], float]]
"""Position [m] and tilt about the y axis [rad] at a time [s]."""


def put(data: mujoco.MjData, index: int, position: tuple[float, float, float], tilt: float) -> None:
    quat = Rotation.from_euler("y", tilt).as_quat(scalar_first=True)
    data.qpos[7 * index : 7 * index + 7] = (*position, *quat)


def crossings(vessels: list[Vessel], paths: list[Path], ml: list[float], seconds: float) -> int:
    """Move vessels along their paths and count what goes through the glass of any."""
    model, data = world(*vessels, bench=False)
    contents = {v: Filling(m) for v, m in zip(vessels, ml, strict=True) if m}
    liquid = Liquid(model, data, vessels, list(contents.values()), 800)
    watches = [Watch(vessel) for vessel in vessels]
    for step in range(round(seconds * LIQUID_HZ)):
        for index, path in enumerate(paths):
            put(data, index, *path(step / LIQUID_HZ))
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        if step == 0:
            liquid.fill(contents, np.random.default_rng(0))
        liquid.step()
        assert not liquid.diverged
        for watch in watches:
            watch.look(liquid.positions, data)
    assert sum(watch.left for watch in watches) > 100  # it was wild enough
    return sum(watch.crossings for watch in watches)


def test_a_spout_inside_a_mouth_lets_nothing_through_either_glass() -> None:
    vessels = [
        glassware("beaker", "150 ml", "small"),
        glassware("beaker", "800 ml", "large"),
    ]

    def spout(seconds: float) -> tuple[tuple[float, float, float], float]:
        tilt = np.radians(105) * min(1.0, seconds / 0.25)
        # Only once it lies does it come down into the mouth, where its wall is clear of the rim.
        down = 0.05 * min(1.0, max(0.0, seconds - 0.25) / 0.15)
        # Its lip is 33 mm aside and 90 mm up.
        aside = 0.033 * np.cos(tilt) + 0.09 * np.sin(tilt)
        up = -0.033 * np.sin(tilt) + 0.09 * np.cos(tilt)
        wag = 0.004 * np.sin(25 * seconds)
        return (float(0.03 - aside + wag), 0.0, float(0.17 - down - up)), tilt

    def mouth(seconds: float) -> tuple[tuple[float, float, float], float]:
        return (0.003 * np.sin(17 * seconds), 0.0, 0.0), 0.03 * np.sin(11 * seconds)

    assert crossings(vessels, [spout, mouth], [100.0, 300.0], 2.0) == 0


@pytest.mark.parametrize(("kind", "size"), [("beaker", "250 ml"), ("conical_flask", "300 ml")])
def test_nothing_crosses_the_glass_of_two_vessels_that_touch_while_they_swing(kind, size) -> None:
    vessels = [glassware(kind, size, "left"), glassware(kind, size, "right")]
    half = max(radius for radius, _ in vessels[0].profile.outer)

    def swing(side: int) -> Path:
        def path(seconds: float) -> tuple[tuple[float, float, float], float]:
            shake = 0.05 * np.sin(15 * seconds)
            apart = 0.0005 + 0.004 * (1 + np.sin(9 * seconds))
            return (shake + side * (half + apart), 0.0, 0.02 * np.sin(21 * seconds)), 0.0

        return path

    assert crossings(vessels, [swing(-1), swing(1)], [230.0, 230.0], 2.0) == 0


def test_what_the_second_vessel_moves_is_offered_to_the_first_again() -> None:
    left, right = (
        glassware("beaker", "250 ml", "left"),
        glassware("beaker", "250 ml", "right"),
    )
    model, data = world(left, right, bench=False)
    around = Surroundings(model, data, [left, right])
    rng, half = np.random.default_rng(0), max(radius for radius, _ in left.profile.outer)
    edges, glass = edges_of(left.profile), around.glass
    met = 0
    for _ in range(400):
        # They come together until their lips almost touch, turning; drops between them fly about.
        for apart, turn in ((0.008, 0.0), (0.001, rng.uniform(-0.02, 0.02))):
            put(data, 0, (-half - apart / 2, 0.0, 0.0), turn)
            put(data, 1, (half + apart / 2, 0.0, rng.uniform(-0.004, 0.004)), -turn)
            mujoco.mj_kinematics(model, data)
            around.move()
        start = rng.uniform((-0.003, -0.02, 0.086), (0.003, 0.02, 0.092), (50, 3))
        outside = np.array([not _in_either(glass, edges, point) for point in start])
        start = start[outside]
        end = start + rng.normal(0.0, 0.01, start.shape)
        clear, impulse = clearances(start, end, glass), np.zeros((around.owners, 6))
        stop_at_vessels(start, end, glass, clear, np.ones(len(start)), impulse)
        met += int(impulse[0].any() and impulse[1].any())
        assert not any(_crosses(glass, edges, *path) for path in zip(start, end, strict=True))
    assert met > 100


def _in_either(glass: Glass, edges: Edges, point: np.ndarray) -> bool:
    local = [glass.before.rotation[v].T @ (point - glass.before.origin[v]) for v in (0, 1)]
    return any(in_glass(edges, *place) for place in local)


def _crosses(glass: Glass, edges: Edges, start: np.ndarray, end: np.ndarray) -> bool:
    for v in (0, 1):
        p = glass.before.rotation[v].T @ (start - glass.before.origin[v])
        q = glass.now.rotation[v].T @ (end - glass.now.origin[v])
        if first_crossing(edges, p, q)[1] >= 0:
            return True
    return False
