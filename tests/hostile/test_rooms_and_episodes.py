"""Rooms and episodes of the original that somebody made to do harm, or that are damaged."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from hostile.programs import run
from hostile.test_results import NO_JSON
from labutopia_lerobot.scenes.plans.shipped_plans import FOLDER

type Damage = Callable[[dict[str, Any]], object]

SIZES = [float("nan"), float("inf"), 1e12, -5.0, 0.0, 10**400, "x", None]


def changed(**entries: Any) -> Damage:
    """Change entries of the room."""
    return lambda plan: plan.update(entries)


ROOMS: dict[str, Damage] = {
    **{f"a size of {size!r:.9}": changed(size=[size, 6.0, 3.0]) for size in SIZES},
    "three thousand pieces": lambda plan: plan.update(pieces=plan["pieces"][:1] * 3026),
    "a piece at no place": lambda plan: plan["pieces"][0].update(x=1e300),
    "pieces are a number": changed(pieces=5),
    "walls of words": changed(walls=["x"]),
    "a heading of true": lambda plan: plan["pieces"][0].update(heading=True),
    "an opening without end": lambda plan: plan["openings"][0].update(width=1e30),
    "no doors": changed(openings=[]),
}


@pytest.fixture
def room() -> dict[str, Any]:
    plan: dict[str, Any] = json.loads((FOLDER / "organic_7.json").read_text())
    return plan


@pytest.mark.parametrize("damage", ROOMS.values(), ids=ROOMS)
@pytest.mark.parametrize("command", [("check",), ("occupancy", "--out", "map")])
def test_a_room_that_cannot_be_is_refused(
    damage: Damage, command: tuple[str, ...], room: dict[str, Any], tmp_path: Path
) -> None:
    damage(room)
    (tmp_path / "room.json").write_text(json.dumps(room))
    assert run("scene", command[0], "room.json", *command[1:], folder=tmp_path).refused


@pytest.mark.parametrize("text", NO_JSON.values(), ids=NO_JSON)
def test_what_is_no_room_is_refused(text: str, tmp_path: Path) -> None:
    (tmp_path / "room.json").write_text(text)
    assert run("scene", "check", "room.json", folder=tmp_path).refused


FRAMES = 6


def write(file: Path) -> None:
    """Write an episode as the original's collectors do."""
    with h5py.File(file, "w") as root:
        root["agent_pose"] = np.zeros((FRAMES, 8), np.float32)
        root["actions"] = np.zeros((FRAMES, 8), np.float32)
        root["camera_1_rgb"] = np.zeros((FRAMES, 3, 64, 64), np.uint8)
        root["language_instruction"] = "Pick it up."


def replaced(name: str, array: Any) -> Callable[[h5py.File, Path], object]:
    """Write something else in the place of an array."""

    def change(root: h5py.File, folder: Path) -> None:
        del root[name]
        if array is not None:
            root[name] = array

    return change


def external_file(root: h5py.File, folder: Path) -> None:
    """Let an array lie in another file."""
    del root["camera_1_rgb"]
    shape, place = (FRAMES, 3, 64, 64), (str(folder / "secret.bin"), 0, FRAMES * 3 * 64 * 64)
    root.create_dataset("camera_1_rgb", shape, np.uint8, external=[place])


def external_link(root: h5py.File, folder: Path) -> None:
    """Let an array be one of another file."""
    del root["camera_1_rgb"]
    root["camera_1_rgb"] = h5py.ExternalLink(str(folder / "secret.h5"), "camera_1_rgb")


def virtual(root: h5py.File, folder: Path) -> None:
    """Let an array be put together of those of other files."""
    del root["camera_1_rgb"]
    layout = h5py.VirtualLayout((FRAMES, 3, 64, 64), np.uint8)
    layout[:] = h5py.VirtualSource(str(folder / "secret.h5"), "camera_1_rgb", (FRAMES, 3, 64, 64))
    root.create_virtual_dataset("camera_1_rgb", layout)


EPISODES: dict[str, Callable[[h5py.File, Path], object]] = {
    "an array in another file": external_file,
    "a link to another file": external_link,
    "an array of other files": virtual,
    "no poses": replaced("agent_pose", None),
    "poses of words": replaced("agent_pose", np.array([b"x"] * FRAMES)),
    "poses that are none": replaced("agent_pose", np.full((FRAMES, 8), np.nan, np.float32)),
    "poses of 7 elements": replaced("agent_pose", np.zeros((FRAMES, 7), np.float32)),
    "poses of one number": replaced("agent_pose", 5.0),
    "pictures of one dimension": replaced("camera_1_rgb", np.zeros(FRAMES, np.uint8)),
    "pictures of numbers": replaced("camera_1_rgb", np.zeros((FRAMES, 3, 64, 64), np.float32)),
    "no frames": replaced("camera_1_rgb", np.zeros((0, 3, 64, 64), np.uint8)),
    "an instruction of numbers": replaced("language_instruction", 5),
    "an instruction of none": replaced("language_instruction", np.zeros(0)),
}


@pytest.mark.parametrize("damage", EPISODES.values(), ids=EPISODES)
def test_an_episode_of_the_original_that_is_damaged_is_refused(
    damage: Callable[[h5py.File, Path], object], tmp_path: Path
) -> None:
    (tmp_path / "secret.bin").write_bytes(bytes(FRAMES * 3 * 64 * 64))
    write(tmp_path / "secret.h5")
    write(tmp_path / "episode.h5")
    with h5py.File(tmp_path / "episode.h5", "a") as root:
        damage(root, tmp_path)
    assert run("convert", "episode.h5", "converted", folder=tmp_path).refused
    assert not (tmp_path / "converted").exists()


def test_half_an_episode_is_refused(tmp_path: Path) -> None:
    write(tmp_path / "episode.h5")
    content = (tmp_path / "episode.h5").read_bytes()
    (tmp_path / "episode.h5").write_bytes(content[: len(content) // 2])
    assert run("convert", "episode.h5", "converted", folder=tmp_path).refused
