"""`labutopia-experiment`: record, verify, train, evaluate, compare, as one pipeline."""

import shlex
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from hydra.core.override_parser.overrides_parser import OverridesParser
from hydra.errors import HydraException
from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.grammar import ABOUT, overrides, types_of
from labutopia_lerobot.cli.option_list import option_list
from labutopia_lerobot.cli.printing_tables import print_tables
from labutopia_lerobot.evaluation.reporting.page import write_page
from labutopia_lerobot.experiments.experiment import (
    Experiment,
    ExperimentConfig,
    experiment_files,
    make_experiment,
)
from labutopia_lerobot.experiments.measured import Measured, missing_table
from labutopia_lerobot.experiments.parts.experiment_part import ExperimentPart
from labutopia_lerobot.experiments.planning import evaluations
from labutopia_lerobot.experiments.recipe import trainable_policies
from labutopia_lerobot.experiments.runner import run_experiment
from labutopia_lerobot.experiments.study import ExperimentOptionError


@clear_errors
def main() -> None:
    """Do what the command line asks for; exit with 1 if a part is not done."""
    arguments = sys.argv[1:]
    console = Console(stderr=True, highlight=False, soft_wrap=True)
    if {"-h", "--help"} & set(arguments):
        Console(highlight=False, soft_wrap=True).print(_help(), markup=False)
        return
    experiment = parse(arguments)
    planned: list[ExperimentPart] = []

    def report(parts: Sequence[ExperimentPart]) -> None:
        planned[:] = parts
        _write_page(experiment, parts)

    try:
        missing = run_experiment(experiment, console, report)
    except KeyboardInterrupt as interrupt:
        command = shlex.join(["labutopia-experiment", *arguments])
        raise type(interrupt)(f"Go on: {command}") from None
    if experiment.plan:
        return
    if experiment.kit and not missing:
        console.print(f"Filled {experiment.kit}; there: bash train.sh", markup=False)
        return
    tables = Measured.of(evaluations(planned)).tables()
    print_tables([*tables, *([missing_table(missing)] if missing else [])], "text")
    if page(experiment).exists():
        console.print(f"Wrote {page(experiment)}", markup=False)
    if missing:
        sys.exit(1)


def parse(words: Sequence[str]) -> Experiment:
    """Return the experiment that a command line describes; nothing is written.

    Raises:
        ExperimentOptionError: If a name is unknown, or a value is impossible.
        UserError: If a task, a level or another word does not exist.
    """
    chosen = overrides(words, types_of(ExperimentConfig), ExperimentOptionError)
    try:
        parsed = OverridesParser.create().parse_overrides(chosen)
    except HydraException as error:
        reason = str(error).strip().splitlines()[0]
        raise ExperimentOptionError(f"{reason} (in: {' '.join(words)})") from None
    values: dict[str, Any] = {each.key_or_group: each.value() for each in parsed}
    return make_experiment(values)


def page(experiment: Experiment) -> Path:
    """Return where the page of an experiment lies."""
    return experiment.out / "report.html"


def _write_page(experiment: Experiment, parts: Sequence[ExperimentPart]) -> None:
    measured = Measured.of(evaluations(parts))
    results = measured.final_results()
    if results:
        write_page(page(experiment), results, measured.tables(), measured.curves())


def _help() -> str:
    return (
        "Usage: labutopia-experiment experiment=NAME [name=value ...]\n"
        "       labutopia-experiment level1/pick policy=act [name=value ...]\n\n"
        "Record demonstrations, verify them, train policies with lerobot-train, evaluate and\n"
        "compare them. Says what it will cost before it begins. Killed, the same command goes on:\n"
        "what was made from the same inputs stands. Tables, curves and films: OUT/report.html.\n\n"
        f"Experiments: {', '.join(experiment_files())}. Policies: "
        f"{', '.join(trainable_policies())}, expert, random, still\n\n"
        f"{ABOUT}\nWith their defaults:\n{option_list(ExperimentConfig)}"
    )


if __name__ == "__main__":
    main()
