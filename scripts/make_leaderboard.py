"""`python scripts/make_leaderboard.py`: `docs/leaderboard.md`, from the rows in `eval/results`.

The expert's rows lie there, a file per task (`scripts/expert_rows.py`); submissions, which
`eval/submit.py` packs, below in `submissions/`.
"""

from pathlib import Path

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.evaluation.reporting.leaderboard import leaderboard_page

ROOT = Path(__file__).parents[1]
RESULTS = ROOT / "eval" / "results"
PAGE = ROOT / "docs" / "leaderboard.md"


@clear_errors
def main() -> None:
    """Write the page."""
    PAGE.write_text(leaderboard_page(RESULTS))


if __name__ == "__main__":
    main()
