"""Episodes that a viewer can show, by number: an expert's, whose number is the seed."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, Protocol

from numpy.typing import NDArray

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.registry import task_files
from labutopia_lerobot.scenes import ROOMS, rooms_to_draw
from labutopia_lerobot.setting import Setting, require_choices


class Performer(Protocol):
    """Plays an episode that has begun."""

    def act(self) -> NDArray[Any] | None:
        """Return the next action, shape (elements,); None if there is no more."""
        ...


class Episodes(Protocol):
    """What a viewer shows.

    Attributes:
        env: Where the present episode is played.
        counted: What the number of an episode is: "seed" or "episode".
        last: The greatest number.
        choices: What else those who look may choose, such as `room`, and from what.
    """

    env: LabEnv
    counted: str
    last: int
    choices: Mapping[str, Sequence[str]]

    def begin(self, number: int) -> Performer:
        """Begin an episode, and return who plays it."""
        ...

    def choose(self, option: str, value: str, number: int) -> None:
        """Show episodes of another setting from now on; they stay as they are if it raises.

        Args:
            option: One of the `choices`.
            value: One of its values.
            number: An episode that must be possible there.

        Raises:
            UserError: If it is no choice, or cannot be played.
        """
        ...


class ExpertEpisodes:
    """Episodes of a task's expert; task and room can be chosen.

    Args:
        setting: The first one.

    Raises:
        UserError: If the task cannot be played in this setting.
    """

    counted = "seed"
    last = 2**31 - 1

    def __init__(self, setting: Setting) -> None:
        self.env = LabEnv(setting)
        train, test = rooms_to_draw()
        rooms = [*ROOMS, *sorted((*train, *test))]
        self.choices: Mapping[str, Sequence[str]] = {
            "task": list(task_files(setting.tasks_dir)),
            "room": rooms if setting.room in rooms else [setting.room, *rooms],
        }

    def begin(self, number: int) -> Performer:
        """Begin the episode of a seed, and return its expert."""
        self.env.reset(seed=number)
        expert = self.env.expert()
        expert.start()
        return expert

    def choose(self, option: str, value: str, number: int) -> None:
        """Show another task, or another room."""
        require_choices("option", [option], list(self.choices))
        require_choices(option, [value], self.choices[option])
        chosen: dict[str, Any] = {option: value}
        env = LabEnv(replace(self.env.setting, **chosen))
        try:
            env.reset(seed=number)
        except Exception:
            env.close()
            raise
        self.env.close()
        self.env = env
