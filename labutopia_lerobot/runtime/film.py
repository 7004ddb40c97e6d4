"""Films for people: MP4, animated WebP or GIF, as the name of the file ends.

What datasets hold is written by `runtime.video`, for training; these are for looking at. Every one
is encoded in the calling thread, so that the same pictures give the same bytes.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import av
import numpy as np
from numpy.typing import NDArray
from PIL import Image

from labutopia_lerobot.errors import UserError


class FilmError(UserError, ValueError):
    """A film that cannot be written; the message says which can."""


@dataclass(frozen=True)
class _Form:
    """How a kind of film is stored.

    Attributes:
        codec: FFmpeg's name of the codec.
        pixels: FFmpeg's name of what is stored.
        options: Of the codec.
        container: Options of the file.
        even: Whether width and height must be even.
    """

    codec: str
    pixels: str
    options: Mapping[str, str]
    container: Mapping[str, str] = field(default_factory=dict)
    even: bool = True


_PALETTED = "pal8"
"""Pictures of 256 colours: GIF has no others."""

_FORMS = {
    ".mp4": _Form(
        "h264",
        "yuv420p",
        {"preset": "medium", "crf": "17", "threads": "1"},  # 17: no difference is seen
        {"movflags": "faststart"},
    ),
    ".webp": _Form(
        "libwebp_anim",
        "yuv420p",
        {"quality": "88", "compression_level": "6", "threads": "1"},
        {"loop": "0"},
    ),
    ".gif": _Form("gif", _PALETTED, {"threads": "1"}, {"loop": "0"}, even=False),
}


def require_film(file: Path, width: int, height: int) -> None:
    """Make sure, before anything is played, that a film can be written.

    Args:
        file: Its name says of which kind it is.
        width: Of every picture [pixels].
        height: Likewise.

    Raises:
        FilmError: If it cannot.
    """
    form = _FORMS.get(file.suffix)
    if form is None:
        raise FilmError(f"'{file}' is no film: choose a name that ends with {', '.join(_FORMS)}")
    for name, value in {"width": width, "height": height}.items():
        if value < 16 or (form.even and value % 2):
            raise FilmError(
                f"{name}={value} cannot be filmed: {file.suffix} takes "
                f"{'even numbers' if form.even else 'numbers'} from 16 pixels"
            )


class FilmWriter:
    """Writes a film; a context manager. What is cut short by an error leaves no file.

    Args:
        file: What to write; a film that is there is replaced when this one is complete.
        width: Width of every picture [pixels].
        height: Height of every picture [pixels].
        rate: Pictures per second.

    Raises:
        FilmError: If such a film cannot be written.
    """

    def __init__(self, file: Path, width: int, height: int, rate: int) -> None:
        require_film(file, width, height)
        self._file, self._form = file, _FORMS[file.suffix]
        self._unfinished = file.with_name(f".unfinished-{file.name}")
        self._palette: Image.Image | None = None
        form = self._form
        self._container = av.open(str(self._unfinished), "w", options=dict(form.container))
        stream = self._container.add_stream(form.codec, rate, options=dict(form.options))
        assert isinstance(stream, av.VideoStream)  # no codec of `_FORMS` is for sound
        self._stream = stream
        self._stream.width, self._stream.height = width, height
        self._stream.pix_fmt = form.pixels
        self._stream.codec_context.time_base = self._tick = Fraction(1, rate)
        self._frames = 0

    def add(self, picture: NDArray[np.uint8]) -> None:
        """Encode the next picture, shape (height, width, 3)."""
        if self._form.pixels == _PALETTED:
            frame = self._paletted(picture)
        else:
            frame = av.VideoFrame.from_ndarray(picture, format="rgb24")
        frame.pts, frame.time_base, frame.duration = self._frames, self._tick, 1
        self._container.mux(self._stream.encode(frame))
        self._frames += 1

    def _paletted(self, picture: NDArray[np.uint8]) -> av.VideoFrame:
        """Return a picture in the 256 colours of the first one: others would flicker."""
        image = Image.fromarray(picture)
        if self._palette is None:
            self._palette = image.quantize(256, Image.Quantize.MEDIANCUT)
        numbers = image.quantize(palette=self._palette, dither=Image.Dither.NONE)
        colors = np.zeros((256, 4), np.uint8)
        known = np.array(self._palette.getpalette(), np.uint8).reshape(-1, 3)
        colors[: len(known), 1:], colors[:, 0] = known, 255  # opaque; FFmpeg's order is ARGB
        pair: Any = np.asarray(numbers), colors  # PyAV declares arrays, and takes these for pal8
        return av.VideoFrame.from_ndarray(pair, format=_PALETTED)

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
        if kind is None:
            self._unfinished.replace(self._file)
        else:
            self._unfinished.unlink(missing_ok=True)
