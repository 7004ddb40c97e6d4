"""`python scripts/make_leaderboard.py`: `docs/leaderboard.md`, from the rows in `eval/results`.

The expert's rows lie there, a file per task (`scripts/expert_rows.py`); submissions, which
`eval/submit.py` packs, below in `submissions/`. Baselines are those of `make results-cpu`.
"""

from pathlib import Path

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.evaluation.load_results import LoadedResult
from labutopia_lerobot.evaluation.reporting.leaderboard import leaderboard_page
from make_results import measured

ROOT = Path(__file__).parents[1]
RESULTS = ROOT / "eval" / "results"
PAGE = ROOT / "docs" / "leaderboard.md"


@clear_errors
def main() -> None:
    """Write the page."""
    PAGE.write_text(content())


def content() -> str:
    """Return the page."""
    return leaderboard_page(RESULTS, baselines())


def baselines() -> list[LoadedResult]:
    """Return what is measured of our own policies on the splits; single axes are in results.md."""
    kept = measured("results_cpu")
    return [kept.results[e] for e in kept.final if e in kept.results and not e.shift.axes]


if __name__ == "__main__":
    main()
