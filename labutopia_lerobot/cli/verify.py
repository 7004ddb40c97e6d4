"""`labutopia-verify DATASET`: is every file of a dataset there, readable and consistent?"""

import argparse
from pathlib import Path

from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.doing import doing
from labutopia_lerobot.datasets.tables import INFO, read_json
from labutopia_lerobot.datasets.verify import require_intact


@clear_errors
def main() -> None:
    """Verify the dataset that the command line names."""
    parser = argparse.ArgumentParser(prog="labutopia-verify", description=__doc__)
    parser.add_argument("dataset", type=Path, help="folder of a LeRobotDataset v3")
    root: Path = parser.parse_args().dataset
    with doing(Console(stderr=True), f"Verifying {root}"):
        require_intact(root)
    info = read_json(root, INFO)
    videos = sum(feature["dtype"] == "video" for feature in info["features"].values())
    Console(highlight=False, soft_wrap=True).print(
        f"{root} is intact: {info['total_episodes']} episodes, {info['total_frames']} frames, "
        f"{videos} cameras",
        markup=False,
    )


if __name__ == "__main__":
    main()
