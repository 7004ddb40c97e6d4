"""`python scripts/leak_rate.py --episodes 1000`: does liquid ever go through glass?

Vessels are swung about at random, as fast as a Panda can, and dropped. After every step of the
solver each particle's position is tested against the vessel's profile, in an implementation of its
own, and each change of side against the mouth. Goes on where it was interrupted.
"""

import argparse
import json
import multiprocessing
from collections.abc import Callable
from functools import partial
from pathlib import Path

import mujoco
import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.liquids.liquid import Liquid
from labutopia_lerobot.setting import PARTICLES
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.world.model import PHYSICS_HZ

SECONDS = 10.0
SPEED, ACCELERATION = 1.7, 13.0
"""Limits of the Panda's hand [m/s], [m/s^2] (Franka Emika, "Robot limits")."""
TURN_SPEED, TURN_ACCELERATION = 2.5, 25.0
"""Limits of the same for rotation [rad/s], [rad/s^2]."""
DROP = 0.10
"""Height of a fall [m]."""
FLOOR = -2.5
"""Height of the floor [m]; the vessel begins at 0 and comes no lower than -1 (measured)."""
VESSELS: tuple[Callable[[str], Vessel], ...] = (
    partial(glassware, "beaker", "250 ml"),
    partial(glassware, "conical_flask", "300 ml"),
    partial(glassware, "measuring_cylinder", "250 ml"),
)


def main() -> None:
    """Play the episodes that are not yet in the file of rows, and print what has leaked in all."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--episodes", type=int, default=20)
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--rows", type=Path, default=Path("outputs/leak_rate.jsonl"))
    arguments = parser.parse_args()
    arguments.rows.parent.mkdir(parents=True, exist_ok=True)
    arguments.rows.touch()
    done = {row["seed"] for row in _read(arguments.rows)}
    seeds = [seed for seed in range(arguments.episodes) if seed not in done]
    with (
        multiprocessing.get_context("spawn").Pool(arguments.processes) as pool,
        arguments.rows.open("a") as file,
    ):
        for row in pool.imap_unordered(handle, seeds):
            file.write(json.dumps(row) + "\n")
            file.flush()
    rows = _read(arguments.rows)
    total = {name: sum(row[name] for row in rows) for name in rows[0] if name != "seed"}
    print(json.dumps({"episodes": len(rows), **total}))  # noqa: T201


def _read(path: Path) -> list[dict[str, int]]:
    return [json.loads(line) for line in path.read_text().splitlines()]


def handle(seed: int) -> dict[str, int]:
    """Swing a filled vessel about; count crossings of glass, lost particles, and those poured."""
    rng = np.random.default_rng([seed, 41])
    vessel = VESSELS[seed % len(VESSELS)]("vessel")
    filling = Filling(rng.uniform(0.2, 0.8) * vessel.capacity)
    model, data = _room_with(vessel)
    liquid = Liquid(model, data, [vessel], [filling])
    liquid.fill({vessel: filling}, rng)
    swing = _Swing(rng, data.qpos.copy())
    watch = Watch(vessel)
    watch.look(liquid.positions, data)
    for step in range(round(SECONDS * PHYSICS_HZ)):
        data.qpos[:] = swing.move(1.0 / PHYSICS_HZ)
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        if (step + 1) % (PHYSICS_HZ // liquid.hertz) == 0:
            liquid.step()
            if liquid.diverged:
                break
            watch.look(liquid.positions, data)
    lost = PARTICLES - len(liquid.positions) + int(np.sum(~np.isfinite(liquid.positions).all(1)))
    return {
        "seed": seed,
        "particle_steps": watch.looks * PARTICLES,
        "diverged": int(liquid.diverged),
        "crossings": watch.crossings,
        "lost_particles": lost,
        "left_through_the_mouth": watch.left,
    }


def _room_with(vessel: Vessel) -> tuple[mujoco.MjModel, mujoco.MjData]:
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    # Out of reach: nobody swings glass through a floor, and liquid between the two has no way out.
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=(5, 5, 0.1), pos=(0, 0, FLOOR))
    vessel.add_to(spec, spec.worldbody).add_freejoint()
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


class _Swing:
    """A random motion within the limits, with a fall now and then."""

    def __init__(self, rng: np.random.Generator, qpos: NDArray[np.float64]) -> None:
        self._rng = rng
        self._qpos = qpos
        self._home = qpos[:3].copy()
        self._velocity, self._turning = np.zeros(3), np.zeros(3)
        self._left, self._falls = 0.0, False

    def _decide(self) -> None:
        rng = self._rng
        self._left = rng.uniform(0.05, 0.6)
        self._falls = rng.random() < 0.1
        if self._falls:
            self._left = np.sqrt(2 * DROP / 9.81)
            self._velocity[:] = 0.0
            return
        away = self._home + rng.uniform(-0.2, 0.2, 3) - self._qpos[:3]
        self._wanted = away / np.linalg.norm(away) * rng.uniform(0.0, SPEED)
        axis = rng.normal(size=3)
        self._wanted_turning = axis / np.linalg.norm(axis) * rng.uniform(0.0, TURN_SPEED)

    def move(self, dt: float) -> NDArray[np.float64]:
        """Return the pose after a physics step."""
        if self._left <= 0.0:
            if self._falls:
                self._velocity[:] = 0.0  # it hits something hard
            self._decide()
        self._left -= dt
        if self._falls:
            self._velocity[2] -= 9.81 * dt
        else:
            self._velocity += _limited(self._wanted - self._velocity, ACCELERATION * dt)
            change = self._wanted_turning - self._turning
            self._turning += _limited(change, TURN_ACCELERATION * dt)
        turn = Rotation.from_rotvec(self._turning * dt)
        was = Rotation.from_quat(self._qpos[3:], scalar_first=True)
        self._qpos[:3] += self._velocity * dt
        self._qpos[3:] = (turn * was).as_quat(scalar_first=True)
        return self._qpos


class Watch:
    """Tests every position against the profile."""

    def __init__(self, vessel: Vessel) -> None:
        self._name, self._profile = vessel.name, vessel.profile
        walls = (vessel.profile.inner, vessel.profile.outer)
        self._walls = [np.array(wall).T[::-1] for wall in walls]
        self.crossings = self.left = self.looks = 0
        self._inside: NDArray[np.bool_] | None = None

    def look(self, positions: NDArray[np.float64], data: mujoco.MjData) -> None:
        """Look once after a step."""
        self.looks += 1
        profile, body = self._profile, data.body(self._name)
        local = (positions - body.xpos) @ body.xmat.reshape(3, 3)
        radius, z = np.hypot(local[:, 0], local[:, 1]), local[:, 2]
        between = (z > 0.0) & (z < profile.height)
        inner, outer = (np.interp(z, heights, radii) for heights, radii in self._walls)
        inside = between & (z > profile.bottom) & (radius < inner)
        in_glass = between & ~inside & (radius < outer)
        self.crossings += int(in_glass.sum())
        if self._inside is not None:
            changed = inside != self._inside
            start, end = self._local[changed], local[changed]
            part = (profile.height - start[:, 2]) / (end[:, 2] - start[:, 2])
            at = start + part[:, None] * (end - start)
            mouth = profile.inner_radius(profile.height)
            through = (part >= 0) & (part <= 1) & (np.hypot(at[:, 0], at[:, 1]) < mouth)
            self.crossings += int((~through).sum())
            self.left += int((self._inside & ~inside).sum())
        self._inside, self._local = inside, local


def _limited(vector: NDArray[np.float64], longest: float) -> NDArray[np.float64]:
    length = float(np.linalg.norm(vector))
    return vector * min(1.0, longest / length) if length > 0 else vector


if __name__ == "__main__":
    main()
