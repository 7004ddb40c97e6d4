"""`python scripts/expert_rows.py OUT`: keep the expert's rows of a result in `eval/results`.

After a measuring run, such as

    python eval/run.py level=[1,2] policy=expert obs=state videos=0 out=OUT
    python eval/run.py level=3 split=ood policy=expert obs=state videos=0 out=OUT2
    python scripts/expert_rows.py OUT OUT2
    python scripts/make_docs.py

`eval/results` holds one file per task, and another for split `ood` where a task has axes of its
own: where the rows come from, and the rows, one per line and without `facts` and `history`, which
are most of their length. The documentation is made of these.
"""

import argparse
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.result_folder import RESULT, SCHEMA
from labutopia_lerobot.evaluation.rows import Row, from_columns
from labutopia_lerobot.evaluation.submission import PUBLISHED
from labutopia_lerobot.foreign_files import read_json_object
from labutopia_lerobot.registry import task_files
from labutopia_lerobot.setting import OF_THE_LEVEL, robot_of_level

RESULTS = Path(__file__).parents[1] / "eval" / "results"

ID, OOD = "id", "ood"
_HERE = ("out", "workers")
"""Options that say something of the machine only."""

_LEFT_OUT: dict[str, Any] = {"facts": {}, "history": {}}
_WANTED = {"policy": "expert", "axes": []}


class OtherRowsError(UserError):
    """Rows that the documentation must not show as the expert's; the message says why."""


@clear_errors
def main() -> None:
    """Keep the rows of results."""
    keep_each(__doc__, keep, RESULTS)


def keep_each(
    description: str | None, keep: Callable[[Path, Path], list[Path]], folder: Path
) -> None:
    """Keep what lies in every OUT of the command line in a folder, and say what was written."""
    parser = argparse.ArgumentParser(
        description=description, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("out", type=Path, nargs="+", metavar="OUT")
    for out in parser.parse_args().out:
        for file in keep(out, folder):
            Console().print(f"Wrote {file}", soft_wrap=True, markup=False, highlight=False)


def keep(result: Path, folder: Path) -> list[Path]:
    """Write the rows of a finished result, a file per task, and return the files.

    Raises:
        OtherRowsError: If it is unfinished, or holds rows that are not the expert's as published.
    """
    content = read_json_object(result / RESULT, OtherRowsError)
    of_each: dict[tuple[str, str], list[dict[str, Any]]] = {}
    for row in content["rows"]:
        split = OOD if row["split"] == OOD else ID
        of_each.setdefault((row["task"], split), []).append(row)
    for (task, split), rows in of_each.items():
        _require_expert(result / RESULT, task, split, rows, content["provenance"])
    folder.mkdir(parents=True, exist_ok=True)
    return [
        write(folder / _name(task, split), rows, content["provenance"])
        for (task, split), rows in of_each.items()
    ]


def read(folder: Path, split: str = ID) -> dict[str, list[Row]]:
    """Return the expert's rows of tasks, in the order in which these are listed.

    Args:
        folder: Where they are kept.
        split: With `id` there must be rows of every task, with `ood` there may be.

    Raises:
        OtherRowsError: If the rows of a task are missing, or some are not as published: the
            expert's, of that split, no further axes, the default setting.
        UnreadableResultError: If a row lacks a column.
    """
    files = {task: folder / _name(task, split) for task in task_files()}
    missing = [task for task, file in files.items() if not file.exists()]
    if split == OOD:
        files = {task: file for task, file in files.items() if task not in missing}
    elif missing:
        raise OtherRowsError(
            f"{folder} lacks the expert's rows of {', '.join(missing)}. Measure them, and keep "
            f"them: python scripts/expert_rows.py OUT (its help says how)"
        )
    rows_of = {}
    for task, file in files.items():
        content = read_json_object(file, OtherRowsError)
        _require_expert(file, task, split, content["rows"], content["provenance"])
        rows_of[task] = [from_columns(Row, row | _LEFT_OUT, file) for row in content["rows"]]
    return rows_of


def commits(folder: Path) -> dict[str, str]:
    """Return the commit by which the rows of each task were played, abbreviated.

    Raises:
        OtherRowsError: If a file cannot be read.
    """
    files = {task: folder / _name(task, ID) for task in task_files()}
    return {
        task: read_json_object(file, OtherRowsError)["provenance"]["commit"][:7]
        for task, file in files.items()
    }


def _require_expert(
    file: Path, task: str, split: str, rows: list[dict[str, Any]], provenance: dict[str, Any]
) -> None:
    config = provenance["config"]
    for row in rows:
        wanted = {"task": task, "split": split} | _WANTED
        other = {name: row[name] for name, value in wanted.items() if row[name] != value}
        if row["liquid"] == "off":
            other["liquid"] = "off"
        if other:
            differing = ", ".join(f"{name}={value}" for name, value in other.items())
            raise OtherRowsError(
                f"{file} holds a row of {differing} (seed {row['seed']}); {task} is published with "
                f"policy=expert split={split} liquid=on and no axes"
            )
    robot = robot_of_level(task)
    if config.get("robot", robot) not in (robot, OF_THE_LEVEL):
        raise OtherRowsError(f"{file} was played with robot={config['robot']}, not {robot}")
    for name, value in PUBLISHED.items():
        if config.get(name, value) != value:
            raise OtherRowsError(f"{file} was played with {name}={config[name]}, not {value}")
    played = range(config["seed"], config["seed"] + config["episodes"])
    if [row["seed"] for row in rows] != list(played):
        raise OtherRowsError(
            f"{file} does not hold every row of {task} once, seeds {played.start} to "
            f"{played.stop - 1} in order: {len(rows)} rows"
        )


def write(file: Path, rows: list[dict[str, Any]], provenance: dict[str, Any]) -> Path:
    """Write rows, one per line, with where they come from; return the file."""
    slim = ({name: row[name] for name in row if name not in _LEFT_OUT} for row in rows)
    lines = ",\n".join(json.dumps(row) for row in slim)
    options = {name: v for name, v in provenance["config"].items() if name not in _HERE}
    origin = json.dumps(provenance | {"config": options}, indent=1)
    file.write_text(f'{{"schema": {SCHEMA},\n"provenance": {origin},\n"rows": [\n{lines}\n]}}\n')
    return file


def _name(task: str, split: str) -> str:
    return f"{task.replace('/', '-')}{'' if split == ID else f'-{split}'}.json"


if __name__ == "__main__":
    main()
