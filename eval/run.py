"""`python eval/run.py task=level1/pick policy=act`: play a policy and count its successes.

Interrupted or killed, the same command with the same `out=` goes on where it was.
"""

import shlex
import sys
from pathlib import Path

import hydra
from hydra.core.config_store import ConfigStore
from omegaconf import DictConfig, OmegaConf
from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.evaluation.config import EvaluationConfig, require_known_options
from labutopia_lerobot.evaluation.result import RESULT
from labutopia_lerobot.evaluation.run import run
from labutopia_lerobot.setting import as_lists

ConfigStore.instance().store(name="evaluation", node=EvaluationConfig)


@clear_errors
def main() -> None:
    """Evaluate what the command line asks for."""
    require_known_options(sys.argv[1:])
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


if __name__ == "__main__":
    main()
