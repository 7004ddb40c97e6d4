"""A Rerun recording of an episode: pictures, states, actions, facts and liquid on one time line."""

from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from labutopia_lerobot.datasets.declaration import STATE
from labutopia_lerobot.datasets.tables import column
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.features import ACTION
from labutopia_lerobot.robots import load_robot
from labutopia_lerobot.world import CONTROL_HZ

_JPEG_QUALITY = 85


class NoRerunError(UserError):
    """Rerun is not installed."""


class RerunRecording:
    """A `Look` that writes everything that is known of each frame; a context manager.

    Args:
        file: `.rrd` to write; `rerun FILE` opens it.
        frames: Table of the frames: states and actions are the recorded ones.
        cameras: Which pictures to draw.

    Raises:
        NoRerunError: If Rerun is not installed.
    """

    def __init__(self, file: Path, frames: pa.Table, cameras: Sequence[str]) -> None:
        try:
            import rerun
        except ImportError:
            raise NoRerunError(
                "Rerun is not installed: pip install 'lerobot_env_labutopia[rerun]'"
            ) from None
        self._rerun = rerun
        self._stream = rerun.RecordingStream("labutopia")
        file.parent.mkdir(parents=True, exist_ok=True)
        self._stream.save(file)
        self._cameras = cameras
        self._recorded: dict[str, NDArray[Any]] = {
            "state": column(frames, STATE),
            "action": column(frames, ACTION),
        }
        self._step: str | None = None

    def __call__(self, number: int, env: LabEnv) -> None:
        """Write a frame."""
        self._stream.set_time("frame", sequence=number)
        self._stream.set_time("time", duration=number / CONTROL_HZ)
        for camera, picture in env.workcell.pictures(self._cameras).items():
            image = self._rerun.Image(picture).compress(jpeg_quality=_JPEG_QUALITY)
            self._stream.log(["camera", camera], image)
        robot = load_robot(env.setting.robot)
        for kind, names in (("state", robot.state_names), ("action", robot.names)):
            for name, value in zip(names, self._recorded[kind][number], strict=True):
                self._scalar(kind, name, value)
        progress, liquid = env.workcell.progress, env.workcell.world.liquid
        for name, holds in progress.facts.items():
            self._scalar("fact", name, holds)
        for name, volume in ({} if liquid is None else liquid.millilitres).items():
            self._scalar("liquid", name, volume)
        step = "" if progress.step is None else progress.step.name
        if step != self._step:
            self._stream.log("step", self._rerun.TextLog(step or "all steps are done"))
            self._step = step

    def _scalar(self, kind: str, name: str, value: float | np.floating[Any]) -> None:
        self._stream.log([kind, name], self._rerun.Scalars(float(value)))

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._stream.disconnect()
