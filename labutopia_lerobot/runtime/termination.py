"""Ending a program by a signal: SIGTERM, as a cluster sends it, does what Ctrl-C does."""

import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType, TracebackType

INTERRUPTED = "Interrupted. What was finished before is intact."
"""What a program says when it is asked to end."""


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
def ended_at_once() -> Iterator[None]:
    """End this process in one line if it is asked to end here, where nothing has begun: in imports.

    Nothing is raised. A `KeyboardInterrupt` may come to a library that clears it, or is written in
    C++ and makes an `ImportError` of it, as mujoco and scipy do.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    numbers = (signal.SIGINT, signal.SIGTERM)
    heard = [number for number in numbers if signal.getsignal(number) is not signal.SIG_IGN]
    before = {number: signal.signal(number, _end) for number in heard}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def report_interrupt_in_one_line() -> None:
    """Report the next exception in one line if it is an interrupt that nobody handles."""
    before = sys.excepthook

    def report(
        kind: type[BaseException], error: BaseException, trace: TracebackType | None
    ) -> None:
        sys.excepthook = before
        if issubclass(kind, KeyboardInterrupt):
            sys.stderr.write(f"{INTERRUPTED}\n")
        else:
            before(kind, error, trace)

    sys.excepthook = report


@contextmanager
def interrupts_held() -> Iterator[None]:
    """Hold Ctrl-C and SIGTERM back for as long as this lasts; then they do what they do.

    A process that is started here holds Ctrl-C back too, until `let_interrupts_through`: in its
    imports it would be printed with a traceback. SIGTERM ends it at once.
    """
    before = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
    try:
        with _termination_held():
            yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def _termination_held() -> Iterator[None]:
    """Hold SIGTERM back in this process alone: a blocked signal would be inherited."""
    if threading.current_thread() is not threading.main_thread():
        yield  # handlers run, and are set, in the main thread only
        return
    came: list[int] = []
    before = signal.signal(signal.SIGTERM, lambda number, frame: came.append(number))
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)
        if came:
            signal.raise_signal(signal.SIGTERM)


def let_interrupts_through() -> None:
    """End what `interrupts_held` began in the process that started this one."""
    signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])


def _end(number: int, frame: FrameType | None) -> None:
    os.write(2, f"{INTERRUPTED}\n".encode())
    os._exit(128 + number)


def _terminate(number: int, frame: FrameType | None) -> None:
    for child in multiprocessing.active_children():
        child.terminate()
    raise Terminated
