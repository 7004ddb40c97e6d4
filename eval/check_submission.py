"""`python eval/check_submission.py FILE`: play a drawn sample of a submission again.

Exits with 0 if every column of every drawn row comes out the same, to the bit. Otherwise with 1,
and says whether the submission was played by another build than this one: then nothing is shown.
What was not played as published (docs/leaderboard.md) is refused with 2. Nothing can show that the
actions are the policy's, and not the expert's or a copy.
"""

import sys
from pathlib import Path

import numpy as np
from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.grammar import OptionParser
from labutopia_lerobot.evaluation.submission import other_build, read, replayed


@clear_errors
def main() -> None:
    """Check the submission."""
    parser = OptionParser(prog="python eval/check_submission.py", description=__doc__)
    parser.add_argument("file", type=Path, metavar="FILE")
    parser.add_argument("--episodes", type=int, default=20, help="how many to play (default: 20)")
    parser.add_argument("--seed", type=int, help="of the draw; another one each time if not given")
    arguments = parser.parse_args()
    console = Console(soft_wrap=True, highlight=False)
    submission = read(arguments.file)
    different = other_build(submission)
    count = min(max(arguments.episodes, 1), len(submission.result.rows))
    rng = np.random.default_rng(arguments.seed)
    sample = sorted(rng.choice(len(submission.result.rows), count, replace=False).tolist())
    wrong = 0
    for row, columns in replayed(submission, sample):
        verdict = f"differs in {', '.join(columns)}" if columns else "the same"
        console.print(f"{row.task} {row.split}, seed {row.seed}: {verdict}", markup=False)
        wrong += bool(columns)
    if different:
        listed = "\n".join(different)
        console.print(f"Played by another build than this one:\n{listed}", markup=False)
    if wrong:
        blame = (
            "That may be the other build's doing: check it with the same one"
            if different
            else "It was played by this very build: the submission is not what it says"
        )
        console.print(f"{wrong} of {count} drawn episodes came out otherwise. {blame}.")
        sys.exit(1)
    console.print(
        f"All {count} drawn episodes came out the same, to the bit. That shows what these actions "
        "do, not whose they are: the expert's or another entry's would come out the same."
    )


if __name__ == "__main__":
    main()
