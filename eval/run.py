"""`python eval/run.py task=level1/pick policy=act`: play a policy and count its successes.

Interrupted or killed, the same command with the same `out=` goes on where it was.
"""

import difflib
import shlex
import sys
from collections.abc import Sequence
from pathlib import Path

import hydra
from hydra.core.config_store import ConfigStore
from omegaconf import DictConfig, OmegaConf
from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.option_list import option_list
from labutopia_lerobot.evaluation.config import (
    EvaluationConfig,
    EvaluationOptionError,
    PolicyConfig,
    require_known_options,
)
from labutopia_lerobot.evaluation.result import RESULT
from labutopia_lerobot.evaluation.run import run
from labutopia_lerobot.registry import task_files
from labutopia_lerobot.setting import as_lists

_CONFIGS = Path(__file__).parents[1] / "configs"

ConfigStore.instance().store(name="evaluation", node=EvaluationConfig)


@clear_errors
def main() -> None:
    """Evaluate what the command line asks for."""
    if {"-h", "--help"} & set(sys.argv[1:]):
        Console(highlight=False, soft_wrap=True).print(_help(), markup=False)
        return
    require_known_options(sys.argv[1:])
    _require_known_policy(sys.argv[1:])
    sys.argv[1:] = as_lists(sys.argv[1:])
    evaluate_composed()


@hydra.main(version_base=None, config_path="../configs", config_name="eval")
@clear_errors
def evaluate_composed(composed: DictConfig) -> None:
    """Evaluate what Hydra has composed."""
    config = OmegaConf.to_object(composed)
    assert isinstance(config, EvaluationConfig)
    try:
        run(config, Console())
    except KeyboardInterrupt:
        if (Path(config.out) / RESULT).exists():
            raise  # only films are missing
        raise KeyboardInterrupt(f"Go on: {_same_command(config.out)}") from None


def _same_command(out: str) -> str:
    """Return the command that goes on in a folder, which has a time stamp by default."""
    options = [option for option in sys.argv[1:] if not option.startswith("out=")]
    return shlex.join(["python", sys.argv[0], *options, f"out={out}"])


def _policies() -> list[str]:
    return sorted(file.stem for file in (_CONFIGS / "policy").glob("*.yaml"))


def _require_known_policy(arguments: Sequence[str]) -> None:
    """Make sure that the command line names one of the policies.

    Hydra's own flags (`--config-dir`, ...) may bring further ones: with them it is left to Hydra.

    Raises:
        EvaluationOptionError: If it does not; the message lists them.
    """
    if any(argument.startswith(("-", "hydra.")) for argument in arguments):
        return
    policies = _policies()
    named = [value for name, _, value in (a.partition("=") for a in arguments) if name == "policy"]
    if not named:
        raise EvaluationOptionError(f"Name a policy, policy=NAME. Policies: {', '.join(policies)}")
    for name in named:
        if name not in policies:
            near = difflib.get_close_matches(name, policies, n=1)
            hint = f" Did you mean '{near[0]}'?" if near else ""
            raise EvaluationOptionError(
                f"policy={name} is unknown.{hint} Policies: {', '.join(policies)}"
            )


def _help() -> str:
    return (
        "Usage: python eval/run.py policy=NAME task=level1/pick [name=value ...]\n\n"
        "Play a policy, count its successes per task and sub-step, film a few episodes.\n\n"
        f"Policies: {', '.join(_policies())}\n\n"
        "Options, with their defaults:\n"
        f"{option_list(EvaluationConfig, but=('policy',))}\n"
        f"{option_list(PolicyConfig, prefix='policy.')}\n\n"
        f"Tasks: {', '.join(task_files())}"
    )


if __name__ == "__main__":
    main()
