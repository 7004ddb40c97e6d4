"""The original's episodes as a LeRobotDataset with our keys, rate and videos.

It can be trained on, and not replayed: the original keeps no seeds, no commands and no states of
things. Its data are CC BY-NC 4.0.
"""

import json
import shutil
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from labutopia_lerobot.datasets.declaration import IMAGES, STATE
from labutopia_lerobot.datasets.original import RATE_HZ, OriginalEpisode, open_original
from labutopia_lerobot.datasets.writer import EncodedDatasetWriter, Video
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.features import ACTION
from labutopia_lerobot.robots import load_robot
from labutopia_lerobot.runtime.provenance import sha256
from labutopia_lerobot.runtime.video import VideoWriter, require_filmable
from labutopia_lerobot.setting import DEFAULT_ROBOT
from labutopia_lerobot.world import CONTROL_HZ

CONVERSION = "meta/labutopia_conversion.json"
"""File that says what a converted dataset was made of, and what it cannot do."""

_PATTERNS = ("*.h5", "*.hdf5")


class ConversionError(UserError):
    """Files that cannot become one dataset; the message says why."""


def convert(source: Path, out: Path, repo_id: str, instruction: str | None = None) -> int:
    """Convert a file of the original, or every one of a folder, and return the number of episodes.

    Args:
        source: The file or folder.
        out: Folder of the dataset; must not exist.
        repo_id: Its name on the Hub.
        instruction: For episodes that have none.

    Raises:
        OriginalFileError: If a file is no manipulation episode of the original.
        ConversionError: If there is no file, or the episodes do not fit together.
    """
    if out.exists():
        raise ConversionError(f"{out} is there already: choose another folder")
    files = _files(source)
    sizes = _require_alike(files, instruction)
    out.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=out.parent) as place:
        root = Path(place) / "dataset"
        writer = EncodedDatasetWriter(repo_id, _features(sizes), DEFAULT_ROBOT, root)
        episodes = 0
        for file in files:
            with open_original(file) as original:
                for episode in original:
                    _add(writer, episode, Path(place), episode.instruction or instruction or "")
                    episodes += 1
        writer.finish()
        (root / CONVERSION).write_text(
            json.dumps(_conversion_record(source, files), indent=2) + "\n"
        )
        root.rename(out)
    return episodes


def _files(source: Path) -> list[Path]:
    files = [source]
    if source.is_dir():
        files = sorted(file for pattern in _PATTERNS for file in source.rglob(pattern))
    if not files or not files[0].is_file():
        raise ConversionError(f"{source} is or holds no {' or '.join(_PATTERNS)}")
    return files


def _require_alike(files: Sequence[Path], instruction: str | None) -> dict[str, tuple[int, int]]:
    """Return camera -> height and width, the same in every episode."""
    first: dict[str, tuple[int, int]] = {}
    for file in files:
        with open_original(file) as original:
            for episode in original:
                first = first or episode.sizes
                if episode.sizes != first:
                    raise ConversionError(
                        f"{episode.name} has the cameras {episode.sizes}, those before it "
                        f"{first}: convert them apart"
                    )
                if not (episode.instruction or instruction):
                    raise ConversionError(
                        f"{episode.name} has no instruction, as the original's press has none: "
                        "say it with --instruction"
                    )
    for height, width in first.values():
        require_filmable(width, height)
    return first


def _features(sizes: dict[str, tuple[int, int]]) -> dict[str, dict[str, Any]]:
    names = list(load_robot(DEFAULT_ROBOT).names)
    vector = {"dtype": "float32", "shape": (len(names),), "names": names}
    axes = ["height", "width", "channels"]
    pictures = {
        f"{IMAGES}{camera}": {"dtype": "video", "shape": (*size, 3), "names": axes}
        for camera, size in sizes.items()
    }
    return {STATE: vector, ACTION: dict(vector), **pictures}


def _add(
    writer: EncodedDatasetWriter, episode: OriginalEpisode, place: Path, instruction: str
) -> None:
    folder = Path(tempfile.mkdtemp(dir=place))
    videos: dict[str, Video] = {}
    for camera, (height, width) in episode.sizes.items():
        file = folder / f"{camera}.mp4"
        with VideoWriter(file, width, height) as video:
            for picture in episode.pictures(camera):
                video.add(picture)
        videos[f"{IMAGES}{camera}"] = (file, video.statistics())
    writer.add(instruction, {STATE: episode.states, ACTION: episode.next_states}, videos, {})
    shutil.rmtree(folder)


def _conversion_record(source: Path, files: Sequence[Path]) -> dict[str, Any]:
    above = source if source.is_dir() else source.parent
    return {
        "source": "LabUtopia, original collectors",
        "files": {file.relative_to(above).as_posix(): sha256(file) for file in files},
        "licence": "CC-BY-NC-4.0",
        "replayable": False,
        "action": (
            f"the state measured 1/{CONTROL_HZ} s later, not a command: the gripper closes no "
            "further than the thing in it"
        ),
        "rate": f"every second frame of {RATE_HZ} per second",
        "gripper": "distance between the pads [m], twice the original's finger position",
    }
