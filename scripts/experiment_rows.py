"""`python scripts/experiment_rows.py OUT`: keep an experiment's results in `eval/experiments`.

After a measuring run, such as

    labutopia-experiment experiment=results_cpu only=level1/pick out=OUT
    python scripts/experiment_rows.py OUT
    python scripts/make_results.py

Every finished evaluation below `OUT/eval` is kept at the same place below `eval/experiments`: where
its rows come from, and the rows, one per line and without `facts` and `history`, which are most of
their length. Paths are written as if OUT were the default.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import expert_rows
from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.result_folder import RESULT
from labutopia_lerobot.foreign_files import read_json_object

KEPT = Path(__file__).parents[1] / "eval" / "experiments"
_DEFAULT = "outputs/experiments/results_cpu"
"""Where the experiment is made if OUT is not said."""


class NothingMeasuredError(UserError):
    """A folder that holds no finished evaluation; the message says what to run."""


@clear_errors
def main() -> None:
    """Keep the results of experiments."""
    expert_rows.keep_each(__doc__, keep, KEPT)


def keep(experiment: Path, folder: Path) -> list[Path]:
    """Write the rows of an experiment's finished evaluations, and return the files.

    Raises:
        NothingMeasuredError: If it has none.
    """
    evaluations = experiment / "eval"
    results = sorted(evaluations.rglob(RESULT))
    if not results:
        raise NothingMeasuredError(
            f"{evaluations} holds no {RESULT}. Make one: labutopia-experiment "
            f"experiment=results_cpu out={experiment}"
        )
    return [_keep(each, experiment, folder / each.relative_to(evaluations)) for each in results]


def _keep(result: Path, experiment: Path, file: Path) -> Path:
    content = read_json_object(result, NothingMeasuredError)
    origin = _moved(content["provenance"], [str(experiment.resolve()), str(experiment)])
    file.parent.mkdir(parents=True, exist_ok=True)
    return expert_rows.write(file, content["rows"], origin)


def _moved(said: Any, places: Sequence[str]) -> Any:
    """Return what a file says, paths below the experiment as if that were at the default place."""
    if isinstance(said, dict):
        return {key: _moved(value, places) for key, value in said.items()}
    if isinstance(said, list):
        return [_moved(value, places) for value in said]
    for place in places:
        if isinstance(said, str) and said.startswith(f"{place}/"):
            return _DEFAULT + said.removeprefix(place)
    return said


if __name__ == "__main__":
    main()
