"""`labutopia-recipe act DATASET --epochs 200`: the training command, with steps computed."""

import shlex
from pathlib import Path

from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.grammar import OptionParser
from labutopia_lerobot.experiments.recipe import trainable_policies, training_command


@clear_errors
def main() -> None:
    """Print the command."""
    parser = OptionParser(prog="labutopia-recipe", description=__doc__)
    parser.add_argument("policy", help=f"what to train: {', '.join(trainable_policies())}")
    parser.add_argument("dataset", type=Path, metavar="DATASET", help="folder of a LeRobotDataset")
    parser.add_argument(
        "--epochs",
        type=int,
        help="how often every frame is seen; the recipe's own number of steps if not given",
    )
    parser.add_argument(
        "--batch-size", type=int, help="frames per step (default: the recipe's)", metavar="FRAMES"
    )
    parser.add_argument(
        "--out",
        type=Path,
        help="default, where policy=POLICY looks: outputs/train/POLICY/LEVEL/TASK[/STEP]",
    )
    arguments = parser.parse_args()
    command = training_command(
        arguments.policy, arguments.dataset, arguments.epochs, arguments.batch_size, arguments.out
    )
    Console(soft_wrap=True, highlight=False).print(shlex.join(command), markup=False)
    out = next(word.partition("=")[2] for word in command if word.startswith("--output_dir="))
    if Path(out).exists():
        kept = f"{out}/checkpoints/last/pretrained_model/train_config.json"
        note = (
            f"{out} is there already, and lerobot-train begins nothing there. Choose another "
            f"--out, or go on: lerobot-train --config_path={shlex.quote(kept)} --resume=true"
        )
        Console(stderr=True, soft_wrap=True, highlight=False).print(note, markup=False)


if __name__ == "__main__":
    main()
