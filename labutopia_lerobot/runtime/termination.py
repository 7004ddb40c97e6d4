"""Ending a program by a signal: SIGTERM, as a cluster sends it, does what Ctrl-C does."""

import multiprocessing
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType


class Terminated(KeyboardInterrupt):
    """SIGTERM has come: whatever takes care of Ctrl-C takes care of this."""


@contextmanager
def terminated_like_interrupted() -> Iterator[None]:
    """Turn SIGTERM into `Terminated` here; worker processes end at once, as it came to one only."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGTERM, _terminate)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


@contextmanager
def interrupts_held() -> Iterator[None]:
    """Hold Ctrl-C back for as long as this lasts.

    A process that is started here holds it back too, until `let_interrupts_through`: in its imports
    it would be printed with a traceback.
    """
    before = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def let_interrupts_through() -> None:
    """End what `interrupts_held` began in the process that started this one."""
    signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])


def _terminate(number: int, frame: FrameType | None) -> None:
    for child in multiprocessing.active_children():
        child.terminate()
    raise Terminated
