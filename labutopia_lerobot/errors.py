"""Mistakes that a user can mend: shown in one message, without a traceback."""

import builtins
import difflib
import inspect
import re
import sys
import traceback
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType


class UserError(Exception):
    """Names the thing that is wrong, lists the choices or the cure. Programs exit with status 2."""


class FileMistakeError(UserError, ValueError):
    """A mistake in a file of the user's own; the message names file, line and what Python says."""


_OURS = Path(__file__).parent
_MISTAKES = (SyntaxError, ImportError, NameError, AttributeError, TypeError, ValueError)
"""Exceptions that a mistake in a file raises, there or in what it calls."""


@contextmanager
def mistakes_located(folder: Path, *, playing: bool = False) -> Iterator[None]:
    """Report a mistake that is made here by the file and line of the user's that makes it.

    Args:
        folder: Where the user's files lie.
        playing: Whether an episode is played. What code of ours raises is a bug of ours then, also
            where the user's has called it: nobody else may report it.

    Raises:
        FileMistakeError: If one is made that has no message of ours; one that has is raised as it
            is, behind its place.
    """
    try:
        yield
    except UserError as error:
        frames = _frames_of(error, folder)
        if frames and error.args:
            place = f"{_place(*frames[-1])}: "
            message = str(error.args[0]).removeprefix(place)  # it may stand there already
            error.args = (f"{place}{message}", *error.args[1:])
        raise
    except Exception as error:
        frames = _frames_of(error, folder)
        if isinstance(error, SyntaxError) and Path(error.filename or "").is_relative_to(folder):
            where = _place(error.filename or "", error.lineno or 1, None)
            raise FileMistakeError(f"{where}: {error.msg}") from error
        known_by_kind = isinstance(error, _MISTAKES) and not playing
        if frames and (known_by_kind or not _raised_by_us(error, folder)):
            message = f"{type(error).__name__}: {error}{_hint(error, frames[-1][2])}"
            raise FileMistakeError(f"{_place(*frames[-1])}: {message}") from error
        raise


def did_you_mean(name: str, choices: Collection[str], cutoff: float = 0.5) -> str:
    """Return a question to the nearest of some names, with a blank before it, or nothing."""
    near = difflib.get_close_matches(name, choices, n=1, cutoff=cutoff)
    return f" Did you mean '{near[0]}'?" if near else ""


type _Line = tuple[str, int, FrameType | None]
"""File, number of the line, and what runs it."""


def _frames_of(error: Exception, folder: Path) -> list[_Line]:
    """Return the lines of the user's that an error went through, the innermost last."""
    walked = traceback.walk_tb(error.__traceback__)
    return [
        (frame.f_code.co_filename, line, frame)
        for frame, line in walked
        if Path(frame.f_code.co_filename).is_relative_to(folder)
    ]


def _raised_by_us(error: Exception, folder: Path) -> bool:
    """Return whether the user's code was in the middle of a call of ours."""
    files = [Path(frame.f_code.co_filename) for frame, _ in traceback.walk_tb(error.__traceback__)]
    last = max(index for index, file in enumerate(files) if file.is_relative_to(folder))
    return any(file.is_relative_to(_OURS) for file in files[last + 1 :])


def _place(file: str, line: int, frame: FrameType | None) -> str:
    path, here = Path(file), Path.cwd()
    shown = path.relative_to(here) if path.is_relative_to(here) else path
    return f"{shown}, line {line}"


def _hint(error: Exception, frame: FrameType | None) -> str:
    """Return a question to the nearest name."""
    if frame is None:
        return ""
    if isinstance(error, NameError):
        return did_you_mean(error.name or "", [*frame.f_locals, *frame.f_globals, *dir(builtins)])
    if isinstance(error, AttributeError):
        return did_you_mean(error.name or "", dir(error.obj))
    if isinstance(error, ImportError) and error.name_from and error.name in sys.modules:
        return did_you_mean(error.name_from, dir(sys.modules[error.name]))
    called = re.match(r"(\w+)\S*\(\) got an unexpected keyword argument '(\w+)'", str(error))
    function = frame.f_globals.get(called[1]) if called else None
    if called and callable(function):
        return did_you_mean(called[2], list(inspect.signature(function).parameters))
    return ""
