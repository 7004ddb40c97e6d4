"""Playing a recorded episode again from its seed and commands; comparing what comes of it."""

import json
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from labutopia_lerobot.datasets.declaration import COMMAND, PHASE
from labutopia_lerobot.datasets.demonstration import EXPERT_FAILED
from labutopia_lerobot.datasets.description import DamagedDatasetError
from labutopia_lerobot.datasets.frames import Columns, Frames
from labutopia_lerobot.datasets.recording_config import SLOWEST
from labutopia_lerobot.datasets.replanning import Replanning
from labutopia_lerobot.datasets.routes import Routes
from labutopia_lerobot.datasets.tables import (
    CUT,
    OUTCOME,
    ROUTES,
    SEED,
    Row,
    column,
    cut_of,
    episode_setting,
)
from labutopia_lerobot.env import Info, LabEnv, Observation
from labutopia_lerobot.features import ACTION
from labutopia_lerobot.robots import load_robot
from labutopia_lerobot.scenario.task_function import located_in_play
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.task import RUNNING, SUCCESS


@dataclass(frozen=True)
class Difference:
    """First difference between a replayed episode and the recorded one.

    Attributes:
        frame: The first frame that differs.
        key: A feature that differs there.
        largest: Greatest absolute difference of a number in any frame; nan where only words, or
            the numbers of frames, differ.
    """

    frame: int
    key: str
    largest: float


@dataclass(frozen=True)
class Playback:
    """A recorded episode, played again.

    Attributes:
        instruction: What the environment says is to be done.
        drawn: What it draws, as JSON gives it back.
        volumes: Where the liquid is at the end [ml], likewise.
        outcome: Outcome, "running" if the commands ended before the episode.
        routes: Map, and the paths that are planned when those of the dataset were.
        difference: Where the frames differ, or None: they are the same, bit for bit.
    """

    instruction: str
    drawn: Any
    volumes: Any
    outcome: str
    routes: Routes | None
    difference: Difference | None


class Player:
    """Plays recorded episodes; the environment is kept while their setting is the same.

    Args:
        tasks_dir: A further folder of tasks, which the user trusts.
    """

    def __init__(self, tasks_dir: str | None = None) -> None:
        self._tasks_dir = tasks_dir
        self._env: LabEnv | None = None

    def play(
        self, row: Row, frames: pa.Table, look: Callable[[int, LabEnv], None] = lambda *_: None
    ) -> Playback | None:
        """Play an episode again; None if its seed or setting is not known.

        Args:
            row: Its row of the episode table.
            frames: The table of its frames.
            look: Is shown every frame before its command: number, environment.

        Raises:
            UnknownTaskError: If its task is not there.
            DamagedDatasetError: If it has no commands for the robot.
        """
        setting = episode_setting(row, self._tasks_dir)
        if setting is None or row.get(SEED) is None:
            return None
        env = self._environment(setting)
        commands = commands_of(row, frames, setting.robot)
        replayed = Frames(env, setting.obs)
        replanning = Replanning(json.loads(row.get(ROUTES) or "null"))
        with located_in_play(setting.task, setting.tasks_dir):
            observation, info = begin(env, row)
            drawn = info["drawn"]
            for number, command in enumerate(commands):
                look(number, env)
                replanning.look(env)
                replayed.begin(observation)
                observation, reward, terminated, truncated, info = env.step(command)
                replayed.end(command, reward, terminated or truncated, info)
                if terminated or truncated:
                    break
        volumes = {name: value for name, value in info.items() if name.startswith("ml_")}
        return Playback(
            instruction=env.task,
            drawn=json.loads(json.dumps(drawn)),
            volumes=json.loads(json.dumps(volumes)),
            outcome=info["outcome"],
            routes=replanning.routes(env),
            difference=_difference(frames, replayed.columns()),
        )

    def close(self) -> None:
        """Give the OpenGL context back."""
        if self._env is not None:
            self._env.close()

    def _environment(self, setting: Setting) -> LabEnv:
        setting = setting.without_pictures()  # pictures are drawn where somebody looks
        if self._env is None or self._env.setting != setting:
            self.close()
            self._env = LabEnv(setting)
        return self._env


def begin(env: LabEnv, row: Row) -> tuple[Observation, Info]:
    """Begin a recorded episode, whose seed is known, at its first frame.

    What comes before that in an episode that was cut, the expert plays as it did.

    Args:
        env: Where to play.
        row: Its row of the episode table.

    Raises:
        DamagedDatasetError: If no expert comes there.
    """
    observation, info = env.reset(seed=row[SEED])
    cut = cut_of(row)
    if cut is None:
        return observation, info
    where = f"{CUT} of episode {row['episode_index']}"
    if not SLOWEST <= cut["pace"] <= 1.0:
        raise DamagedDatasetError(f"{where} has the pace {cut['pace']}, not {SLOWEST:g} to 1")
    expert = env.expert(cut["pace"])
    expert.start()
    for frame in range(cut["first"]):
        command = expert.act()
        if expert.failure is not None or info["outcome"] != RUNNING:
            raise DamagedDatasetError(
                f"{where} begins at frame {cut['first']}, but the expert ends at {frame}"
            )
        observation, *_, info = env.step(command)
    return observation, info


def outcome_behind(row: Row) -> str:
    """Return what the environment says behind the last frame of a recorded episode.

    It goes on where the expert gave up, or another step follows on the one that was cut out. Where
    none is written, such as in a dataset that was edited, it is to be a success.
    """
    cut, outcome = cut_of(row), row.get(OUTCOME) or SUCCESS
    goes_on = outcome == EXPERT_FAILED or (cut is not None and not cut["last"])
    return RUNNING if goes_on else str(outcome)


def commands_of(row: Row, frames: pa.Table, robot: str) -> NDArray[Any]:
    """Return what was commanded in an episode, shape (frames, elements).

    Args:
        row: Its row of the episode table.
        frames: The table of its frames.
        robot: Name of the robot that it commands.

    Raises:
        DamagedDatasetError: If there are no commands for it.
    """
    elements = len(load_robot(robot).elements)
    name = COMMAND if COMMAND in frames.column_names else ACTION
    where = f"{name} of episode {row['episode_index']}"
    if name not in frames.column_names:
        raise DamagedDatasetError(f"{where} is missing")
    commands = column(frames, name)
    if commands.dtype.kind != "f" or commands.shape[1:] != (elements,):
        raise DamagedDatasetError(
            f"{where} has the shape {commands.shape} of {commands.dtype}; the robot takes "
            f"{elements} numbers"
        )
    return commands


def _difference(frames: pa.Table, replayed: Columns) -> Difference | None:
    """Compare what is recorded with what was replayed; the expert's phases are not replayed."""
    differences = []
    for key in replayed.keys() & set(frames.column_names) - {PHASE}:
        there, here = column(frames, key), replayed[key]
        there, here = there.reshape(len(there), -1), here.reshape(len(here), -1)
        both = min(len(there), len(here))
        different = np.flatnonzero((there[:both] != here[:both]).any(axis=1))
        if different.size:
            differences.append(
                Difference(int(different[0]), key, _largest(there[:both], here[:both]))
            )
        elif len(there) != len(here):
            differences.append(Difference(both, key, np.nan))
    if not differences:
        return None
    first = min(differences, key=lambda difference: (difference.frame, difference.key))
    largest = [d.largest for d in differences if not np.isnan(d.largest)]
    return replace(first, largest=max(largest, default=np.nan))


def _largest(there: NDArray[Any], here: NDArray[Any]) -> float:
    if there.dtype.kind != "f" or here.dtype.kind != "f":
        return float("nan")
    return float(np.abs(there - here).max())
