"""`python eval/submit.py DIR`: pack a finished result into one file for the leaderboard."""

from pathlib import Path

from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.grammar import OptionParser
from labutopia_lerobot.evaluation.submission import pack


@clear_errors
def main() -> None:
    """Write the submission."""
    parser = OptionParser(prog="python eval/submit.py", description=__doc__)
    parser.add_argument("folder", type=Path, metavar="DIR", help="a folder of `eval/run.py`")
    parser.add_argument("--out", type=Path, metavar="FILE", help="default: DIR/submission.json")
    arguments = parser.parse_args()
    file = arguments.out or arguments.folder / "submission.json"
    pack(arguments.folder, file)
    message = f"Wrote {file}. Check it: python eval/check_submission.py {file}"
    Console().print(message, soft_wrap=True, markup=False, highlight=False)


if __name__ == "__main__":
    main()
