"""`python eval/run.py task=level1/pick policy=act`: play a policy and count its successes."""

import sys

import hydra
from hydra.core.config_store import ConfigStore
from omegaconf import DictConfig, OmegaConf
from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.evaluation.config import EvaluationConfig, require_known_options
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
    run(config, Console())


if __name__ == "__main__":
    main()
