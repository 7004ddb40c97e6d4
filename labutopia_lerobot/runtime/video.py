"""MP4: encoding frame by frame, exact statistics of pixels, counting and reading frames.

Colours are H.264, lossy as everywhere. Depth is LeRobot's form of it, 12 bits of grey in lossless
HEVC. Segmentation is lossless too, in HEVC of three channels: LeRobot takes pictures of one channel
for depth, and has no other lossless codec of three.
"""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from types import TracebackType
from typing import Any, Literal, Self

import av
import cv2
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.pictures import COLOR
from labutopia_lerobot.runtime.level_count import LevelCount
from labutopia_lerobot.setting import DEPTH, SEGMENTATION
from labutopia_lerobot.world import CONTROL_HZ

KEYFRAME_INTERVAL = 2
"""Frames from one key frame to the next: training reads at random (LeRobot's default)."""

LOSSLESS = "lossless=1:bframes=0:ctu=16:min-cu-size=16:max-tu-size=16"
"""x265's parameters. Small blocks and no backward references take half the time at 4 % more."""

_ALONE = ":frame-threads=1:pools=none:log-level=error"


@dataclass(frozen=True)
class Encoding:
    """Storage format of pictures of one kind.

    Attributes:
        codec: FFmpeg's name of the codec.
        pixel_format: FFmpeg's name of what is stored.
        array: FFmpeg's name of what goes in and out.
        options: Of the codec.
        threading: Options that keep it in one thread, silently: LeRobot does not know of them.
        levels: How many values a channel can have.
        step: What one of these levels is worth: 1, or that many metres.
    """

    codec: Literal["h264", "hevc"]
    pixel_format: str
    array: str
    options: Mapping[str, str]
    threading: Mapping[str, str]
    levels: int = 256
    step: float = 1.0


_HALVED = "yuv420p"
"""Brightness of every pixel, colour of every fourth."""

_HEVC = {"preset": "ultrafast", "x265-params": LOSSLESS}
_QUIET = {"x265-params": LOSSLESS + _ALONE}

ENCODINGS = {
    # No CABAC and no deblocking filter, since training reads often, and x264's quickest search:
    # against `veryfast` it takes 60 % of the time and, as near to the pictures, 19 % more bytes.
    # Nor does it look ahead (its tree of macroblocks gives the same pictures other bytes now and
    # then, with key frames so near each other).
    COLOR: Encoding(
        "h264",
        _HALVED,
        "rgb24",
        {"preset": "ultrafast", "tune": "fastdecode", "crf": "28"},
        {"threads": "1"},
    ),
    DEPTH: Encoding("hevc", "gray12le", "gray12le", _HEVC, _QUIET, levels=4096, step=0.001),
    SEGMENTATION: Encoding("hevc", "gbrp", "rgb24", _HEVC, _QUIET),
}
"""Kind of picture -> how it is stored."""

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

    Args:
        path: File to write.
        width: Width of every picture [pixels], even.
        height: Height of every picture [pixels], even.
        kind: What the pictures show, a key of `ENCODINGS`.
    """

    def __init__(self, path: Path, width: int, height: int, kind: str = COLOR) -> None:
        self._encoding = encoding = ENCODINGS[kind]
        self._levels = LevelCount(1 if kind == DEPTH else 3, encoding.levels)
        self._container = av.open(str(path), "w", options={"movflags": "faststart"})
        options = {**encoding.options, "g": str(KEYFRAME_INTERVAL), **encoding.threading}
        self._stream = self._container.add_stream(encoding.codec, CONTROL_HZ, options=options)
        self._stream.width, self._stream.height = width, height
        self._stream.pix_fmt = encoding.pixel_format
        self._stream.time_base = Fraction(1, CONTROL_HZ)
        self._frames = 0

    def add(self, picture: NDArray[Any]) -> None:
        """Encode the next picture, shape (height, width, 3), or (height, width, 1) of depths."""
        if picture.shape[-1] == 1:
            steps = np.rint(picture[..., 0] / self._encoding.step)
            picture = steps.clip(0, self._encoding.levels - 1).astype(np.uint16)
        self._levels.add(picture)
        form = self._encoding.array
        if self._encoding.pixel_format == _HALVED:  # OpenCV does it in a seventh of FFmpeg's time
            form, picture = _HALVED, cv2.cvtColor(picture, cv2.COLOR_RGB2YUV_I420)
        frame = av.VideoFrame.from_ndarray(picture, format=form)
        frame.pts = self._frames
        frame.time_base = Fraction(1, CONTROL_HZ)
        self._container.mux(self._stream.encode(frame))
        self._frames += 1

    def statistics(self) -> dict[str, NDArray[np.float64]]:
        """Return the statistics that LeRobot stores, per channel: levels, or depths [m]."""
        return _statistics(self._levels, self._frames, self._encoding)

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


def statistics_of_video(path: Path, kind: str) -> dict[str, NDArray[np.float64]]:
    """Return the statistics that LeRobot stores, of the pictures as they are decoded.

    Args:
        path: The video.
        kind: What its pictures show, a key of `ENCODINGS`.
    """
    encoding, frames = ENCODINGS[kind], 0
    levels = LevelCount(1 if kind == DEPTH else 3, encoding.levels)
    with av.open(str(path)) as container:
        for frame in container.decode(container.streams.video[0]):
            picture: NDArray[Any] = frame.to_ndarray(format=encoding.array)
            levels.add(picture)
            frames += 1
    return _statistics(levels, frames, encoding)


def _statistics(
    levels: LevelCount, frames: int, encoding: Encoding
) -> dict[str, NDArray[np.float64]]:
    of_levels = level_statistics(levels.histogram, frames)
    return {n: v if n == "count" else v * encoding.step for n, v in of_levels.items()}


def level_statistics(histogram: NDArray[np.int64], frames: int) -> dict[str, NDArray[np.float64]]:
    """Return the statistics that LeRobot stores of a video, per channel, in levels from 0 on.

    A byte has 256 levels, so that their histogram gives every statistic exactly.

    Args:
        histogram: How often each channel had each level, shape (channels, levels).
        frames: Number of pictures.
    """
    levels = np.arange(histogram.shape[1])
    pixels = histogram.sum(axis=1)
    mean = histogram @ levels / pixels
    below = histogram.cumsum(axis=1)
    quantiles = {
        f"q{round(100 * q):02d}": (below < q * pixels[:, None]).sum(axis=1).astype(np.float64)
        for q in QUANTILES
    }
    return {
        "min": (histogram > 0).argmax(axis=1).astype(np.float64),
        "max": levels[-1] - (histogram[:, ::-1] > 0).argmax(axis=1).astype(np.float64),
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
    path: Path, first: int, wanted: Collection[int], kind: str = COLOR
) -> Iterator[tuple[int, NDArray[Any]]]:
    """Yield some frames of a video, in their order, in the form that `VideoWriter.add` takes.

    Args:
        path: The video, at the control rate and with a key frame every `KEYFRAME_INTERVAL`.
        first: The frame of the video that counts as number 0.
        wanted: Numbers of the frames.
        kind: What the pictures show.

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
                picture = frame.to_ndarray(format=ENCODINGS[kind].array)
                yield number, _metres(picture) if kind == DEPTH else picture


def _metres(levels: NDArray[Any]) -> NDArray[np.float32]:
    return (levels[..., None] * ENCODINGS[DEPTH].step).astype(np.float32)


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
