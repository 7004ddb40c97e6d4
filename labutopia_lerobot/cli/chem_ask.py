"""`labutopia-chem ask`: what a language model says of the solutions of tasks, kept in a file."""

import argparse
from dataclasses import replace
from pathlib import Path

from rich.console import Console

from labutopia_lerobot.foreign_files import printable

_DRAWS = 100
"""Seeds of each split whose vessels are asked about; ours: axes have less than twenty values."""


def add_ask(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the command `ask`; `run` of what it parses does it."""
    parser = commands.add_parser(
        "ask", help="keep a language model's answers about the solutions of tasks in a file"
    )
    parser.add_argument("tasks", nargs="+", metavar="TASK", help="task id, as level3/precipitate")
    parser.add_argument(
        "--out",
        required=True,
        type=Path,
        metavar="FILE.json",
        help="what it holds is not asked again",
    )
    parser.add_argument("--model", help="what its server calls it (default: LABUTOPIA_MODEL)")
    parser.add_argument("--base-url", metavar="URL", help="default: LABUTOPIA_MODEL_URL")
    parser.add_argument(
        "--timeout", type=float, default=60.0, metavar="S", help="of a question [s] (default: 60)"
    )
    parser.add_argument("--cached-only", action="store_true", help="use kept answers, ask nobody")
    parser.add_argument("--tasks-dir", metavar="DIR", help="a further folder of tasks")
    parser.set_defaults(run=_ask)


def _ask(arguments: argparse.Namespace) -> None:
    # Here: geometry and what asks take seconds to import, and the other commands need none.
    from labutopia_lerobot.chemistry.answer import AnswerError
    from labutopia_lerobot.chemistry.kept_answers import (
        KeptAnswer,
        KeptAnswers,
        asked_of,
        read,
        write,
    )
    from labutopia_lerobot.chemistry.language_model import LanguageModel
    from labutopia_lerobot.scenario import draw_scenario
    from labutopia_lerobot.setting import SPLITS, Setting

    settings = [
        Setting(task, split=split, tasks_dir=arguments.tasks_dir)
        for task in arguments.tasks
        for split in SPLITS
    ]
    model = LanguageModel.of_environment(
        arguments.model, arguments.base_url, arguments.timeout, arguments.cached_only
    )
    kept = read(arguments.out) if arguments.out.exists() else KeptAnswers(model.model)
    kept.require_of(model.model, arguments.out)
    console = Console(highlight=False, soft_wrap=True)
    for setting in settings:
        for seed in range(_DRAWS):
            contents = draw_scenario(setting, seed).task.contents
            for compounds in kept.unanswered([filling.compounds for filling in contents.values()]):
                try:
                    answer = KeptAnswer(compounds, model.reactions(*asked_of(compounds)))
                except AnswerError as failed:
                    answer = KeptAnswer(compounds, failed=printable(str(failed)))
                kept = replace(kept, answers=(*kept.answers, answer))
                write(kept, arguments.out)  # what has been answered is kept, whatever comes
                said = [one.stoichiometry for one in answer.reactions] or ["nothing reacts"]
                line = f"By the rules: {answer.failed}" if answer.failed else "; ".join(said)
                console.print(printable(f"{' and '.join(compounds)}: {line}"), markup=False)
    write(kept, arguments.out)  # one compound alone is no question, and its file is wanted
    console.print(f"{len(kept.answers)} answers of {model.model} in {arguments.out}", markup=False)
