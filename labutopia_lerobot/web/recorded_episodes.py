"""The episodes of a dataset, for a viewer: played again from their seeds and commands."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from labutopia_lerobot.datasets.looking import drawn_with, find_episode
from labutopia_lerobot.datasets.playback import begin, commands_of
from labutopia_lerobot.datasets.tables import episode_setting, read_episodes
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.web.episodes import Performer


class RecordedEpisodes:
    """Episodes of a dataset; there is nothing else to choose.

    Args:
        root: Folder of the dataset.
        first: Number of an episode that it must have.
        width: Width of the pictures [pixels].
        height: Their height [pixels].
        tasks_dir: A further folder of tasks, which the user trusts.

    Raises:
        UserError: If the first episode is not there, or cannot be played again.
    """

    counted = "episode"
    choices: Mapping[str, Sequence[str]] = {}

    def __init__(
        self, root: Path, first: int, width: int, height: int, tasks_dir: str | None = None
    ) -> None:
        self._root, self._tasks_dir = root, tasks_dir
        self._size = {"width": width, "height": height}
        self.last = max(row["episode_index"] for row in read_episodes(root))
        self.begin(first)

    def begin(self, number: int) -> Performer:
        """Begin an episode, and return who repeats its commands.

        Raises:
            UserError: If it cannot be played again.
        """
        row, frames = find_episode(self._root, number, self._tasks_dir)
        setting = episode_setting(drawn_with(row, self._tasks_dir, **self._size), self._tasks_dir)
        assert setting is not None  # `find_episode` refuses those that have none
        setting = setting.without_pictures()
        env: LabEnv | None = getattr(self, "env", None)
        if env is None or env.setting != setting:
            if env is not None:
                env.close()
            self.env = LabEnv(setting)
        begin(self.env, row)
        return _Recorded(commands_of(row, frames, setting.robot))

    def choose(self, option: str, value: str, number: int) -> None:
        """Do nothing: a dataset is what it is."""


class _Recorded:
    """Repeats commands, shape (frames, elements)."""

    def __init__(self, commands: NDArray[Any]) -> None:
        self._commands = iter(commands)

    def act(self) -> NDArray[Any] | None:
        return next(self._commands, None)
