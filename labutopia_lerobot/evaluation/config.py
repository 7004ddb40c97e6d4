"""What to evaluate: the schema and the defaults of `eval/run.py`."""

import os
from dataclasses import dataclass, field
from typing import Any

from omegaconf import MISSING

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.condition import SINGLE, STAGED
from labutopia_lerobot.evaluation.uncertainty.intervals import require_precision
from labutopia_lerobot.registry import choose_tasks, listed
from labutopia_lerobot.setting import SPLITS, require_choices, with_setting

BOTH = "both"


class EvaluationOptionError(UserError, ValueError):
    """An option with an impossible value; the message says which values are possible."""


@dataclass
class PolicyConfig:
    """Which policy plays.

    Attributes:
        name: `expert`, `random`, `still`, `remote`, LeRobot's name of a learned policy, or null for
            whatever type the checkpoint is.
        path: Checkpoint of a learned policy: a folder, one with a checkpoint per task
            (`level4/clean_beaker`) or per step of it (`level4/clean_beaker/3_place`), or a Hub id
            such as `org/name` or `org/name@revision`. With `remote`, where LeRobot's server finds
            it.
        device: Device of torch for a learned policy; CUDA where there is one when null.
        rename: Our key -> what the policy calls it, such as
            {observation.images.front: observation.images.camera1}; a checkpoint knows its own.
        address: `remote`: host and port of the server, such as localhost:8080.
        protocol: `remote`: `lerobot` (its policy server) or `openpi` (websocket).
        type: `remote` over `lerobot`: LeRobot's name of the policy; read from the checkpoint when
            null.
        actions: `remote`: how many actions of an answer are played before the next is asked for;
            all of them when null.
        patience: `remote`: for how long the simulation stands still for an answer [s]; after that
            time passes, and the robot holds its position.
        timeout: `remote`: after how long without an answer an episode ends as
            `policy_unreachable` [s].
    """

    name: str | None = None
    path: str | None = None
    device: str | None = None
    rename: Any = None  # a map; Hydra refuses new keys in one that is declared as such
    address: str | None = None
    protocol: str | None = None
    type: str | None = None
    actions: int | None = None
    patience: float = 1.0
    timeout: float = 30.0


@with_setting
class EvaluationConfig:
    """Options of an evaluation; the fields of `Setting` are options too.

    Attributes:
        policy: Which policy plays.
        task: Task id, the bare name of a task of the level, or a list of these.
        level: 1 to 4, a list of these, or `all`.
        split: `id`, `train`, `ood`, or a list.
        play: `single`: one policy plays all steps of a task. `staged`: one policy per step, each
            from the moment in which the step before it is done. Or `both`, one after the other.
        episodes: Episodes per task, split and way of playing.
        seed: Episode i resets with `seed + i`; training seeds begin at 0.
        obs: `pixels` or `state`; what the checkpoint was trained on, or else `state`, when null.
        workers: Processes that play; the result does not depend on it.
        until: Stop a task when its rate is known to plus or minus this, such as 0.05, or when it is
            told apart from `versus`; `episodes` are then the most that are played.
        versus: Result folder of another policy, to be told apart from with `until`.
        episodes_for: Play nothing; tell how many episodes this precision costs, such as 0.05.
        videos: How many successes and how many failures to film, of each of these.
        out: Folder of the result.
    """

    policy: PolicyConfig = field(default_factory=PolicyConfig)
    task: Any = None
    level: Any = None
    split: Any = "id"
    play: str = SINGLE
    episodes: int = 100
    seed: int = 100_000
    obs: str | None = None
    workers: int = field(default_factory=lambda: len(os.sched_getaffinity(0)))
    until: float | None = None
    versus: str | None = None
    episodes_for: float | None = None
    videos: int = 2
    out: str = MISSING

    @property
    def tasks(self) -> list[str]:
        """Ids of the tasks to play.

        Raises:
            UnknownTaskError: If none is named, or one that does not exist.
        """
        return choose_tasks(self.task, self.level, getattr(self, "tasks_dir", None))

    @property
    def splits(self) -> list[str]:
        return list(dict.fromkeys(listed(self.split)))

    @property
    def plays(self) -> list[str]:
        """Ways of playing: `single`, `staged`, or the one and then the other."""
        return [SINGLE, STAGED] if self.play == BOTH else [self.play]

    def check(self) -> None:
        """Check every value that stands for itself.

        Raises:
            EvaluationOptionError: If a number is out of its range.
            PrecisionError: If no interval of a rate can be as narrow as `until`.
            UnknownOptionError: If a word is not one of its choices.
        """
        for name, least in {"episodes": 1, "workers": 1, "seed": 0, "videos": 0}.items():
            if getattr(self, name) < least:
                raise EvaluationOptionError(
                    f"{name}={getattr(self, name)} is too small: {name} is at least {least}"
                )
        require_choices("split", self.splits, SPLITS)
        require_choices("play", [self.play], (SINGLE, STAGED, BOTH))
        if self.versus is not None and self.until is None:
            raise EvaluationOptionError("versus= needs until=, such as until=0.05")
        if self.until is not None:
            require_precision(self.until)
        rename = self.policy.rename or {}
        if not isinstance(rename, dict) or not all(isinstance(n, str) for n in rename.values()):
            raise EvaluationOptionError(
                f"policy.rename={rename} is no map of keys, such as "
                "'policy.rename={observation.images.front: observation.images.camera1}'"
            )
