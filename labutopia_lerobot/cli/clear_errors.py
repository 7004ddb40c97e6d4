"""Turns a user's mistake into one message and a non-zero exit status."""

import errno
import sys
from collections.abc import Callable
from functools import wraps
from types import TracebackType

from rich.console import Console

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.runtime.termination import (
    INTERRUPTED,
    Terminated,
    terminated_like_interrupted,
)


def clear_errors[**P](main: Callable[P, None]) -> Callable[P, None]:
    """Wrap a program: user errors exit with 2, failures of disk with 1, Ctrl-C 130, SIGTERM 143.

    The text of a `KeyboardInterrupt`, such as how to go on, is printed. Anything else is a bug of
    ours and keeps its traceback.
    """

    @wraps(main)
    def wrapped(*args: P.args, **kwargs: P.kwargs) -> None:
        try:
            with terminated_like_interrupted():
                main(*args, **kwargs)
        except UserError as error:
            _exit(_message(error), status=2)
        except OSError as error:
            _exit(f"Error: {_failure(error)}. What was finished before is intact.", status=1)
        except KeyboardInterrupt as interrupt:
            message = f"{INTERRUPTED} {interrupt}"
            _exit(message.rstrip(), status=143 if isinstance(interrupt, Terminated) else 130)

    return wrapped


def show_clearly(
    kind: type[BaseException], error: BaseException, trace: TracebackType | None
) -> None:
    """Print what ended a program: a user's mistake in one message, all else as Python does.

    It is a `sys.excepthook`, for programs of others that play our episodes.
    """
    if isinstance(error, UserError):
        _show(_message(error))
    else:
        sys.__excepthook__(kind, error, trace)


def _message(error: UserError) -> str:
    return "\n".join((f"Error: {error}", *getattr(error, "__notes__", ())))


def _failure(error: OSError) -> str:
    """Return what the system refuses, and of which file."""
    if error.errno == errno.ENOSPC:
        return "the disk is full"
    reason = error.strerror or str(error).partition("\n")[0] or type(error).__name__
    return reason if error.filename is None else f"{error.filename}: {reason}"


def _exit(message: str, status: int) -> None:
    _show(message)
    sys.exit(status)


def _show(message: str) -> None:
    Console(stderr=True, soft_wrap=True).print(message, style="red", markup=False, highlight=False)
