"""What to evaluate: the schema and the defaults of `eval/run.py`."""

import os
from dataclasses import dataclass, field
from typing import Any

from omegaconf import MISSING

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.condition import SINGLE, STAGED
from labutopia_lerobot.evaluation.uncertainty.intervals import require_precision
from labutopia_lerobot.registry import choose_tasks, listed
from labutopia_lerobot.setting import SPLITS, SettingOptions, option, require_choices

BOTH = "both"


class EvaluationOptionError(UserError, ValueError):
    """An option with an impossible value; the message says which values are possible."""


@dataclass
class PolicyConfig:
    """Which policy plays."""

    name: str | None = option(
        None,
        "`expert`, `random`, `still`, `remote`, LeRobot's name of a learned policy, or null for "
        "whatever type the checkpoint is.",
    )
    path: str | None = option(
        None,
        "Checkpoint of a learned policy: a folder, one with a checkpoint per task "
        "(`level4/clean_beaker`) or per step of it (`level4/clean_beaker/3_place`), or a Hub id "
        "such as `org/name` or `org/name@revision`. With `remote`, where LeRobot's server finds "
        "it.",
    )
    device: str | None = option(
        None, "Device of torch for a learned policy; CUDA where there is one when null."
    )
    # A map; Hydra refuses new keys in one that is declared as such
    rename: Any = option(
        None,
        "Our key -> what the policy calls it, such as {observation.images.front: "
        "observation.images.camera1}; a checkpoint knows its own.",
    )
    address: str | None = option(
        None, "`remote`: host and port of the server, such as localhost:8080."
    )
    protocol: str | None = option(
        None, "`remote`: `lerobot` (its policy server) or `openpi` (websocket)."
    )
    type: str | None = option(
        None,
        "`remote` over `lerobot`: LeRobot's name of the policy; read from the checkpoint when "
        "null.",
    )
    actions: int | None = option(
        None,
        "`remote`: how many actions of an answer are played before the next is asked for; all of "
        "them when null.",
    )
    patience: float = option(
        1.0,
        "`remote`: for how long the simulation stands still for an answer [s]; after that time "
        "passes, and the robot holds its position.",
    )
    timeout: float = option(
        30.0,
        "`remote`: after how long without an answer an episode ends as `policy_unreachable` [s].",
    )


@dataclass
class EvaluationConfig(SettingOptions):
    """Options of an evaluation, beside those of every program that plays."""

    policy: PolicyConfig = field(
        default_factory=PolicyConfig, metadata={"help": "Which policy plays."}
    )
    task: Any = option(None, "Task id, the bare name of a task of the level, or a list of these.")
    level: Any = option(None, "1 to 5, a list of these, or `all`: the paper's tasks.")
    split: Any = option("id", "`id`, `train`, `ood`, or a list.")
    play: str = option(
        SINGLE,
        "`single`: one policy plays all steps of a task. `staged`: one policy per step, each from "
        "the moment in which the step before it is done. Or `both`, one after the other.",
    )
    episodes: int = option(100, "Episodes per task, split and way of playing.")
    seed: int = option(100_000, "Episode i resets with `seed + i`; training seeds begin at 0.")
    # Null is for the checkpoint to say: `setting_of` gets what it said.
    obs: str | None = option(  # type: ignore[assignment]
        None, "`pixels` or `state`; what the checkpoint was trained on, or else `state`, when null."
    )
    workers: int = field(
        default_factory=lambda: len(os.sched_getaffinity(0)),
        metadata={"help": "Processes that play; the result does not depend on it."},
    )
    until: float | None = option(
        None,
        "Stop a task when its rate is known to plus or minus this, such as 0.05, or when it is "
        "distinguished from `versus`; `episodes` are then the most that are played.",
    )
    versus: str | None = option(
        None, "Result folder of another policy, to be distinguished from with `until`."
    )
    episodes_for: float | None = option(
        None, "Play nothing; print how many episodes this precision costs, such as 0.05."
    )
    videos: int = option(2, "How many successes and how many failures to film, of each of these.")
    out: str = option(MISSING, "Folder of the result.")

    @property
    def tasks(self) -> list[str]:
        """Ids of the tasks to play.

        Raises:
            UnknownTaskError: If none is named, or one that does not exist.
        """
        return choose_tasks(self.task, self.level, self.tasks_dir)

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
