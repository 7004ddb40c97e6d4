"""Record demonstrations on state, train ACT on them with lerobot-train, and count its successes.

The numbers by default are those of `make demo`; `--demonstrations 50 --steps 500` is quicker.
"""

import argparse
import subprocess
import sys
from pathlib import Path

from labutopia_lerobot.runtime.shipped import shipped


def run(*words: str) -> None:
    """Run a program of this environment, as one would type it."""
    program = Path(sys.executable).parent / words[0]
    print("$", " ".join(words), flush=True)
    subprocess.run([str(program), *words[1:]], check=True)


def main() -> None:
    """Do all three."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--demonstrations", type=int, default=200)
    parser.add_argument("--steps", type=int, default=2000, help="of the training")
    parser.add_argument("--episodes", type=int, default=50, help="of the evaluation")
    parser.add_argument("--out", type=Path, default=Path("outputs/example"))
    given = parser.parse_args()
    dataset, training = given.out / "dataset", given.out / "train"

    run(
        *("labutopia-record", "task=level1/pick", "obs=state"),
        *(f"episodes={given.demonstrations}", f"root={dataset}"),
    )
    run(
        *("lerobot-train", f"--config_path={shipped('policies') / 'act' / 'train_state.json'}"),
        *("--dataset.repo_id=local/pick", f"--dataset.root={dataset}"),
        *(f"--steps={given.steps}", f"--save_freq={given.steps}", f"--output_dir={training}"),
    )
    run(
        *("labutopia-eval", "level1/pick", "policy=act", f"policy.path={training}"),
        *(f"episodes={given.episodes}", f"out={given.out / 'eval'}"),
    )


if __name__ == "__main__":
    main()
