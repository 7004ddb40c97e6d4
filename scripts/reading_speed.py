"""`python scripts/reading_speed.py DATASET`: what a frame costs, read from tables and from memory.

Reads the same random frames of a dataset on states, each with a chunk of actions, as LeRobot does
by itself and as it does with this package, in turn. Prints one JSON object: processor time of a
frame [ms] of both, a number per round, and their medians.
"""

import argparse
import json
import sys
import time
from pathlib import Path
from statistics import median

import numpy as np
from lerobot.datasets.dataset_reader import DatasetReader
from lerobot.datasets.lerobot_dataset import LeRobotDataset

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.datasets.dataset_folder import dataset_folder
from labutopia_lerobot.datasets.frames_in_memory import keep_frames_in_memory
from labutopia_lerobot.world import CONTROL_HZ

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
    """Return where frames are read from -> the times [ms]."""
    chunk = {"action": [step / CONTROL_HZ for step in range(CHUNK)]}
    dataset = LeRobotDataset("local/frames", root=root, delta_timestamps=chunk)
    readers = {"tables": DatasetReader.get_item}
    keep_frames_in_memory()
    readers["memory"] = DatasetReader.get_item
    times: dict[str, list[float]] = {place: [] for place in readers}
    rng = np.random.default_rng(0)
    for read in readers.values():  # the first look opens its files, or reads all of them
        read(dataset.reader, 0)
    for index in range(_ROUNDS):
        frames = rng.integers(0, len(dataset), _FRAMES)
        for place in list(readers) if index % 2 else list(readers)[::-1]:
            start = time.process_time()
            for frame in frames:
                readers[place](dataset.reader, int(frame))
            times[place].append(1000 * (time.process_time() - start) / _FRAMES)
    return {
        place: {
            "ms": [round(each, 3) for each in of_place],
            "median_ms": round(median(of_place), 3),
        }
        for place, of_place in times.items()
    }


if __name__ == "__main__":
    main()
