"""`labutopia-eval task=level1/pick policy=act`: play a policy and count its successes.

Interrupted or killed, the same command with the same `out=` goes on where it was.
"""

import difflib
import shlex
import sys
from collections.abc import Sequence
from pathlib import Path

from hydra import compose, initialize_config_dir
from hydra.core.config_store import ConfigStore
from hydra.errors import HydraException
from omegaconf import OmegaConf
from omegaconf.errors import OmegaConfBaseException
from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.grammar import ABOUT, overrides, types_of, why_refused
from labutopia_lerobot.cli.option_list import option_list, task_list
from labutopia_lerobot.evaluation.config import (
    EvaluationConfig,
    EvaluationOptionError,
    PolicyConfig,
)
from labutopia_lerobot.evaluation.result_folder import ROWS, OccupiedFolderError
from labutopia_lerobot.evaluation.run import run
from labutopia_lerobot.runtime.shipped import shipped


@clear_errors
def main() -> None:
    """Evaluate what the command line asks for."""
    arguments = sys.argv[1:]
    if {"-h", "--help"} & set(arguments):
        Console(highlight=False, soft_wrap=True).print(_help(), markup=False)
        return
    config = parse(arguments)
    try:
        run(config, Console())
    except KeyboardInterrupt as interrupt:
        raise type(interrupt)(f"Go on: {_same_command(config.out)}") from None
    except Exception as error:
        if (Path(config.out) / ROWS).exists() and not isinstance(error, OccupiedFolderError):
            note = f"What was finished before is intact. Go on: {_same_command(config.out)}"
            error.add_note(note)
        raise


def parse(words: Sequence[str]) -> EvaluationConfig:
    """Return the configuration that a command line describes; nothing is written.

    Raises:
        EvaluationOptionError: If a name is unknown, a value has the wrong type, or no policy is
            named.
    """
    chosen = _overrides(words)
    ConfigStore.instance().store(name="evaluation", node=EvaluationConfig)
    try:
        # The compose API makes neither an output folder nor a log file, as hydra.main would.
        with initialize_config_dir(version_base=None, config_dir=str(shipped("configs"))):
            composed = compose("eval", [*_policy(chosen), *chosen])
        config = OmegaConf.to_object(composed)
    except (HydraException, OmegaConfBaseException) as error:
        raise EvaluationOptionError(f"{why_refused(error)} (in: {' '.join(words)})") from None
    assert isinstance(config, EvaluationConfig)
    return config


def _same_command(out: str) -> str:
    """Return the command that goes on in a folder, which has a time stamp by default."""
    program = Path(sys.argv[0])
    called = ["python", sys.argv[0]] if program.suffix == ".py" else [program.name]
    options = [option for option in _overrides(sys.argv[1:]) if not option.startswith("out=")]
    return shlex.join([*called, *options, f"out={out}"])


def _overrides(words: Sequence[str]) -> list[str]:
    options = types_of(EvaluationConfig)
    options |= {f"policy.{name}": kind for name, kind in types_of(PolicyConfig).items()}
    return overrides(words, options, EvaluationOptionError)


def _policies() -> list[str]:
    return sorted(file.stem for file in (shipped("configs") / "policy").glob("*.yaml"))


def _policy(chosen: Sequence[str]) -> list[str]:
    """Return the override that names the policy where only its checkpoint is named.

    Raises:
        EvaluationOptionError: If neither is, or there is no such policy; the message lists them.
    """
    policies = _policies()
    values = dict(override.split("=", 1) for override in chosen)
    if "policy" not in values:
        if "policy.path" in values:
            return ["policy=lerobot"]
        raise EvaluationOptionError(
            f"Name a policy, policy=NAME, or a checkpoint, policy.path=. Policies: "
            f"{', '.join(policies)}"
        )
    if values["policy"] not in policies:
        near = difflib.get_close_matches(values["policy"], policies, n=1)
        hint = f" Did you mean '{near[0]}'?" if near else ""
        raise EvaluationOptionError(
            f"policy={values['policy']} is unknown.{hint} Policies: {', '.join(policies)}. Any "
            "other type that LeRobot loads: policy=lerobot policy.path=..."
        )
    return []


def _help() -> str:
    return (
        "Usage: labutopia-eval level1/pick policy=NAME [name=value ...]\n"
        "       labutopia-eval level1/pick policy.path=CHECKPOINT [name=value ...]\n\n"
        "Play a policy, count its successes per task and substep, film a few episodes. In a\n"
        "checkout, `python eval/run.py` is the same. Interrupted, the same command goes on.\n\n"
        f"Policies: {', '.join(_policies())}\n\n"
        f"{ABOUT}\nWith their defaults:\n"
        f"{option_list(EvaluationConfig, but=('policy',))}\n"
        f"{option_list(PolicyConfig, prefix='policy.')}\n\n{task_list()}"
    )


if __name__ == "__main__":
    main()
