"""Speed on this machine: frames per second and demonstrations per hour.

One frame is one 30 Hz `env.step` with observation, predicates and info, replaying what the expert
commanded; resets are not timed.
"""

import multiprocessing
import os
import signal
import tempfile
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import AbstractContextManager
from dataclasses import asdict, replace
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.datasets.candidate import Candidate
from labutopia_lerobot.datasets.recorder import record
from labutopia_lerobot.datasets.recording_config import RecordingConfig
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.registry import task_files
from labutopia_lerobot.runtime.termination import interrupts_held
from labutopia_lerobot.runtime.workers import become_worker
from labutopia_lerobot.setting import CAMERAS, Setting
from labutopia_lerobot.sim.renderers import renderer_name

POLICY_CAMERAS = ("front", "top")
"""Cameras of the paper's ACT and Diffusion Policy ("Model Input And Output")."""

RIGID = "level1/pick"
LIQUID = "level1/pour"
"""100 ml of water in 1,000 particles, in the hand, in the air and in the other beaker."""

_PACKAGES = ("lerobot_env_labutopia", "mujoco", "mink", "numba", "numpy", "lerobot")


class _Silent:
    """A recording that nobody watches."""

    def resumed(self, candidates: Sequence[Candidate]) -> None:
        """Ignore it."""

    def played(self, candidate: Candidate) -> None:
        """Ignore it."""

    def assembled(self, candidate: Candidate) -> None:
        """Ignore it."""


type Watcher = Callable[[str], AbstractContextManager[None]]
"""Says what is being measured, while it is."""


def measure(
    base: Setting, tasks: Sequence[str], seconds: float, episodes: int, watcher: Watcher
) -> dict[str, Any]:
    """Measure everything.

    Args:
        base: Options of the environment, but for task, observation and cameras.
        tasks: Tasks whose demonstrations per hour are asked for.
        seconds: How long each rate is measured [s].
        episodes: Demonstrations recorded per rate of recording.
        watcher: Notified of every measurement.
    """
    cores = len(os.sched_getaffinity(0))
    blind = replace(base, task=RIGID, obs="state")
    rigid = replace(blind, obs="pixels", cameras=POLICY_CAMERAS)
    liquid = replace(rigid, task=LIQUID)
    rates: dict[str, Callable[[], float]] = {
        "no_camera_fps": lambda: _fps(blind, 1, seconds),
        "no_camera_fps_all_cores": lambda: _fps(blind, cores, seconds),
        "rigid_2cam_fps": lambda: _fps(rigid, 1, seconds),
        "rigid_2cam_fps_all_cores": lambda: _fps(rigid, cores, seconds),
        "liquid_2cam_fps": lambda: _fps(liquid, 1, seconds),
        "liquid_2cam_fps_all_cores": lambda: _fps(liquid, cores, seconds),
        "liquid_solver_real_time": lambda: round(_solver_speed(liquid, seconds), 2),
        "record_3cam_fps": lambda: _recording_fps(replace(rigid, cameras=CAMERAS), episodes),
    }
    hourly = {f"demonstrations per hour of {task}": task for task in tasks}
    count = len(rates) + len(hourly)
    figures: dict[str, Any] = {}
    demonstrations = {}
    for number, (name, rate) in enumerate(rates.items(), start=1):
        with watcher(f"Measuring {number}/{count}: {name}"):
            figures[name] = rate()
    for number, (name, task) in enumerate(hourly.items(), start=len(rates) + 1):
        with watcher(f"Measuring {number}/{count}: {name}"):
            demonstrations[task] = _demonstrations_per_hour(replace(blind, task=task), episodes)
    return {
        **figures,
        "demos_per_hour": demonstrations,
        "renderer": renderer_name(base.renderer),
        "cores": cores,
        "versions": {package: version(package) for package in _PACKAGES},
    }


def all_tasks() -> list[str]:
    """Return the ids of every task."""
    return list(task_files())


def _fps(setting: Setting, processes: int, seconds: float) -> float:
    """Return the frames per second of so many environments, one process each, together."""
    context = multiprocessing.get_context("spawn")
    with context.Manager() as manager:
        gate = manager.Barrier(processes)
        with ProcessPoolExecutor(processes, mp_context=context) as pool:
            with interrupts_held():  # it starts processes
                rates = [pool.submit(_replay, setting, seconds, gate) for _ in range(processes)]
            return round(sum(rate.result() for rate in rates), 1)


def _replay(setting: Setting, seconds: float, gate: Any) -> float:
    """Replay an expert episode again and again; return the frames per second of the steps."""
    become_worker(signal.SIG_DFL)
    actions = _expert_actions(setting)
    env = LabEnv(setting)
    env.reset(seed=0)
    env.step(actions[0])
    gate.wait()
    frames, elapsed = 0, 0.0
    while elapsed < seconds:
        env.reset(seed=0)
        start = time.perf_counter()
        for action in actions:
            env.step(action)
        elapsed += time.perf_counter() - start
        frames += len(actions)
    env.close()
    return frames / elapsed


def _solver_speed(setting: Setting, seconds: float) -> float:
    """Return how many seconds of liquid the solver alone computes in one, on one core."""
    env = LabEnv(replace(setting, obs="state"))
    env.reset(seed=0)
    liquid = env.workcell.simulation.liquid
    assert liquid is not None  # the task has contents
    start, steps = time.perf_counter(), 0
    while time.perf_counter() - start < seconds:
        liquid.step()
        steps += 1
    return steps / liquid.hertz / (time.perf_counter() - start)


def _expert_actions(setting: Setting) -> list[NDArray[np.float32]]:
    env = LabEnv(replace(setting, obs="state"))
    env.reset(seed=0)
    expert = env.expert()
    expert.start()
    actions = []
    over = False
    while not over:
        _, _, terminated, truncated, info = env.step(expert.act())
        actions.append(info["applied_action"])
        over = terminated or truncated
    return actions


def _recording_fps(setting: Setting, episodes: int) -> float:
    """Return the frames per second of a recording with pictures, start-up included."""
    start = time.perf_counter()
    frames = _record(setting, episodes)
    return round(frames / (time.perf_counter() - start), 1)


def _demonstrations_per_hour(setting: Setting, episodes: int) -> int:
    """Return how many demonstrations without pictures are recorded, start-up included."""
    start = time.perf_counter()
    _record(setting, episodes)
    return round(3600 * episodes / (time.perf_counter() - start))


def _record(setting: Setting, episodes: int) -> int:
    """Record demonstrations on all cores; return their number of frames."""
    with tempfile.TemporaryDirectory() as folder:
        root = str(Path(folder) / "dataset")
        options = asdict(setting) | {"split": "train", "cameras": list(setting.cameras)}
        config = RecordingConfig(**options, episodes=episodes, root=root)
        candidates = [c for one in config.datasets() for c in record(one, _Silent())]
    return sum(candidate.frames for candidate in candidates if candidate.success)
