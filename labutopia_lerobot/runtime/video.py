"""H.264 in MP4: encoding frame by frame, exact colour statistics, counting and reading frames."""

from collections.abc import Collection, Iterator, Sequence
from fractions import Fraction
from pathlib import Path
from types import TracebackType
from typing import Final, Self

import av
import cv2
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.world import CONTROL_HZ

CODEC: Final = "h264"
PIXEL_FORMAT = "yuv420p"
PRESET = "veryfast"
KEYFRAME_INTERVAL = 2
"""Frames from one key frame to the next: training reads at random (LeRobot's default)."""

QUALITY = 23
"""Constant rate factor: x264's default."""

TUNE = "fastdecode"
"""x264's settings for fast decoding (no CABAC, no deblocking filter): training reads often."""

QUANTILES = (0.01, 0.10, 0.50, 0.90, 0.99)
"""Those that LeRobot stores, as q01 ... q99."""


class UnfilmableError(UserError, ValueError):
    """Pictures of a size that H.264 cannot hold; the message says which it can."""


def require_filmable(width: int, height: int) -> None:
    """Make sure, before anything is played, that pictures of a size [pixels] can be filmed.

    Raises:
        UnfilmableError: If they cannot.
    """
    for name, value in {"width": width, "height": height}.items():
        if value < 16 or value % 2:
            raise UnfilmableError(
                f"{name}={value} cannot be filmed: H.264 takes even numbers from 16 pixels"
            )


class VideoWriter:
    """Encodes pictures in the calling thread: nothing is queued, so nothing can be dropped.

    A worker process per core fills the machine, and one thread makes the bytes reproducible.

    Attributes:
        histogram: How often each channel had each level so far, shape (3, 256).

    Args:
        path: File to write.
        width: Width of every picture [pixels], even.
        height: Height of every picture [pixels], even.
    """

    def __init__(self, path: Path, width: int, height: int) -> None:
        self.histogram: NDArray[np.int64] = np.zeros((3, 256), dtype=np.int64)
        self._container = av.open(str(path), "w", options={"movflags": "faststart"})
        self._stream = self._container.add_stream(
            CODEC,
            CONTROL_HZ,
            options={
                "preset": PRESET,
                "tune": TUNE,
                "crf": str(QUALITY),
                "g": str(KEYFRAME_INTERVAL),
                "threads": "1",
            },
        )
        self._stream.width, self._stream.height = width, height
        self._stream.pix_fmt = PIXEL_FORMAT
        self._stream.time_base = Fraction(1, CONTROL_HZ)
        self._frames = 0

    def add(self, picture: NDArray[np.uint8]) -> None:
        """Encode the next picture, shape (height, width, 3)."""
        for channel in range(3):
            levels = cv2.calcHist([picture], [channel], None, [256], [0.0, 256.0])
            self.histogram[channel] += levels[:, 0].astype(np.int64)
        frame = av.VideoFrame.from_ndarray(picture, format="rgb24")
        frame.pts = self._frames
        frame.time_base = Fraction(1, CONTROL_HZ)
        self._container.mux(self._stream.encode(frame))
        self._frames += 1

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if kind is None:
            self._container.mux(self._stream.encode())
        self._container.close()


def write_video(file: Path, frames: Sequence[NDArray[np.uint8]]) -> None:
    """Write pictures, shape (height, width, 3) each, as H.264 in MP4 at the control rate."""
    height, width, _ = frames[0].shape
    file.parent.mkdir(parents=True, exist_ok=True)
    with VideoWriter(file, width, height) as video:
        for frame in frames:
            video.add(frame)


def color_statistics(histogram: NDArray[np.int64], frames: int) -> dict[str, NDArray[np.float64]]:
    """Return the statistics that LeRobot stores of a video, per channel, in levels of 0 to 255.

    A byte has 256 levels, so that their histogram gives every statistic exactly.

    Args:
        histogram: How often each channel had each level, shape (3, 256).
        frames: Number of pictures.
    """
    levels = np.arange(256)
    pixels = histogram.sum(axis=1)
    mean = histogram @ levels / pixels
    below = histogram.cumsum(axis=1)
    quantiles = {
        f"q{round(100 * q):02d}": (below < q * pixels[:, None]).sum(axis=1).astype(np.float64)
        for q in QUANTILES
    }
    return {
        "min": (histogram > 0).argmax(axis=1).astype(np.float64),
        "max": 255.0 - (histogram[:, ::-1] > 0).argmax(axis=1),
        "mean": mean,
        "std": np.sqrt(histogram @ levels**2 / pixels - mean**2),
        "count": np.array([frames]),
        **quantiles,
    }


def video_size_and_frames(path: Path) -> tuple[int, int, int]:
    """Return width and height [pixels] and the number of intact frames of a video.

    Raises:
        OSError: If the file is missing.
        ValueError: If the file is no video that can be read.
    """
    with av.open(str(path)) as container:
        if not container.streams.video:
            raise ValueError("it holds no pictures")
        stream = container.streams.video[0]
        intact = sum(
            packet.size > 0 and not packet.is_corrupt for packet in container.demux(stream)
        )
    return stream.width, stream.height, intact


def read_frames(
    path: Path, first: int, wanted: Collection[int]
) -> Iterator[tuple[int, NDArray[np.uint8]]]:
    """Yield some frames of a video, in their order, each of shape (height, width, 3).

    Args:
        path: The video, at the control rate and with a key frame every `KEYFRAME_INTERVAL`.
        first: The frame of the video that counts as number 0.
        wanted: Numbers of the frames.

    Raises:
        OSError: If the file is missing.
        ValueError: If the file is no video that can be read.
    """
    with av.open(str(path)) as container:
        stream = container.streams.video[0]
        ticks = _ticks(stream)
        reached = -1
        for number in sorted(wanted):
            if reached < 0 or number > reached + KEYFRAME_INTERVAL:
                container.seek((first + number) * ticks, stream=stream)
            for frame in container.decode(stream):
                reached = round(frame.time * CONTROL_HZ) - first
                if reached >= number:
                    break
            if reached == number:
                picture: NDArray[np.uint8] = frame.to_ndarray(format="rgb24").astype(np.uint8)
                yield number, picture


def copy_frames(path: Path, copy: Path, first: int, frames: int) -> None:
    """Copy frames of a video into one of their own, without encoding them anew.

    Args:
        path: The video, which has a key frame at the first of them.
        copy: File to write.
        first: Number of the first frame.
        frames: How many.
    """
    with (
        av.open(str(path)) as source,
        av.open(str(copy), "w", options={"movflags": "faststart"}) as container,
    ):
        stream = source.streams.video[0]
        target = container.add_stream_from_template(stream, opaque=True)
        target.time_base = stream.time_base
        ticks = _ticks(stream)
        for packet in source.demux(stream):
            if packet.pts is None or packet.dts is None:
                continue
            if 0 <= packet.pts // ticks - first < frames:
                packet.pts, packet.dts = packet.pts - first * ticks, packet.dts - first * ticks
                packet.stream = target
                container.mux(packet)


def _ticks(stream: av.VideoStream) -> int:
    """Return how many units of its own clock a video spends on a frame."""
    assert stream.time_base is not None  # of a file that has pictures
    return round(1 / (CONTROL_HZ * stream.time_base))
