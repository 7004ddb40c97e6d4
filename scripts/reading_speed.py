"""`python scripts/reading_speed.py DATASET`: what reading a frame costs, by its columns.

Reads the same random frames, each with a chunk of actions, from a dataset on states and from a copy
of it without the columns that no policy reads, in turn. Prints one JSON object: processor time of a
frame [ms] of both, a number per round, and their medians.
"""

import argparse
import json
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

import numpy as np
from lerobot.datasets.dataset_tools import remove_feature
from lerobot.datasets.lerobot_dataset import LeRobotDataset

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.datasets.dataset_folder import dataset_folder
from labutopia_lerobot.world import CONTROL_HZ

UNREAD = ("commanded_action", "next.", "annotation.")
"""What the columns begin with that no policy reads."""

CHUNK = 40
"""Actions of a frame, as in policies/act/train_state.json."""

_ROUNDS, _FRAMES = 6, 40


@clear_errors
def main() -> None:
    """Measure the dataset that the command line names."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("dataset", type=dataset_folder, help="folder of a dataset with obs=state")
    sys.stdout.write(json.dumps(reading_speed(parser.parse_args().dataset)) + "\n")


def reading_speed(root: Path) -> dict[str, dict[str, object]]:
    """Return name of the set -> its number of columns and its times [ms]."""
    chunk = {"action": [step / CONTROL_HZ for step in range(CHUNK)]}
    whole = LeRobotDataset("local/whole", root=root, delta_timestamps=chunk)
    unread = [name for name in whole.meta.features if name.startswith(UNREAD)]
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / "lean"
        remove_feature(LeRobotDataset("local/whole", root=root), unread, place, "local/lean")
        lean = LeRobotDataset("local/lean", root=place, delta_timestamps=chunk)
        sets = {"whole": whole, "lean": lean}
        times: dict[str, list[float]] = {name: [] for name in sets}
        rng = np.random.default_rng(0)
        for name in sets:  # the first look opens its files
            sets[name][0]
        for index in range(_ROUNDS):
            frames = rng.integers(0, len(whole), _FRAMES)
            for name in list(sets) if index % 2 else list(sets)[::-1]:
                start = time.process_time()
                for frame in frames:
                    sets[name][int(frame)]
                times[name].append(1000 * (time.process_time() - start) / _FRAMES)
    return {
        name: {
            "columns": len(sets[name].meta.features),
            "ms": [round(each, 2) for each in of_set],
            "median_ms": round(median(of_set), 2),
        }
        for name, of_set in times.items()
    }


if __name__ == "__main__":
    main()
