"""Videos: nothing is dropped, and the statistics are those of the pictures."""

from pathlib import Path

import av
import numpy as np
import pytest

from labutopia_lerobot.runtime.level_count import LevelCount
from labutopia_lerobot.runtime.video import VideoWriter, video_size_and_frames

RNG = np.random.default_rng(0)
PICTURES = [RNG.integers(20 * k, 200, (48, 64, 3), dtype=np.uint8) for k in range(9)]


@pytest.fixture
def written(tmp_path: Path) -> tuple[Path, VideoWriter]:
    """A video of nine pictures and its closed writer."""
    path = tmp_path / "video.mp4"
    with VideoWriter(path, width=64, height=48) as writer:
        for picture in PICTURES:
            writer.add(picture)
    return path, writer


def test_every_picture_becomes_a_frame(written: tuple[Path, VideoWriter]) -> None:
    path, _ = written
    assert video_size_and_frames(path) == (64, 48, len(PICTURES))
    with av.open(str(path)) as container:
        times = [frame.time for frame in container.decode(video=0)]
    assert times == pytest.approx([k / 30 for k in range(len(PICTURES))])


def test_statistics_are_those_of_every_pixel(written: tuple[Path, VideoWriter]) -> None:
    _, writer = written
    statistics = writer.statistics()
    pixels = np.stack(PICTURES).reshape(-1, 3)
    assert statistics["count"].tolist() == [len(PICTURES)]
    np.testing.assert_array_equal(statistics["min"], pixels.min(axis=0))
    np.testing.assert_array_equal(statistics["max"], pixels.max(axis=0))
    np.testing.assert_allclose(statistics["mean"], pixels.mean(axis=0))
    np.testing.assert_allclose(statistics["std"], pixels.std(axis=0))
    for name, q in {"q01": 0.01, "q10": 0.10, "q50": 0.50, "q90": 0.90, "q99": 0.99}.items():
        expected = np.quantile(pixels, q, axis=0, method="inverted_cdf")
        np.testing.assert_array_equal(statistics[name], expected)


def test_a_video_without_its_end_is_no_video(written: tuple[Path, VideoWriter]) -> None:
    path, _ = written
    path.write_bytes(path.read_bytes()[:200])
    with pytest.raises((OSError, ValueError)):
        video_size_and_frames(path)


@pytest.mark.parametrize("shape", [(7, 5, 3), (7, 5), (1, 1, 3), (1, 1), (16, 16, 3)])
def test_every_level_of_a_picture_is_counted_once_whatever_its_size(shape: tuple[int, ...]) -> None:
    channels = shape[2] if len(shape) == 3 else 1
    pictures = RNG.integers(0, 4096, (3, *shape), dtype=np.uint16)
    count = LevelCount(channels, 4096)
    for picture in pictures:
        count.add(picture)
    values = pictures.reshape(-1, channels)
    wanted = [np.bincount(values[:, channel], minlength=4096) for channel in range(channels)]
    np.testing.assert_array_equal(count.histogram, wanted)
