"""Worker processes: how they begin, how they end, how they take jobs from a queue."""

import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from itertools import islice

from labutopia_lerobot.runtime.termination import interrupts_held, let_interrupts_through

_AHEAD = 2
"""Jobs per process that are handed out: one in play and one that waits, so that none is idle."""


def in_processes[*Job, Result](
    function: Callable[[*Job], Result], jobs: Iterable[tuple[*Job]], workers: int
) -> Iterator[Result]:
    """Yield the result of every job, in the order in which they are finished.

    Args:
        function: What to do with a job; can be pickled, like everything in a job.
        jobs: Its arguments, one tuple per job; they are begun in this order, and asked for one by
            one while others are done, so that results may decide what comes next.
        workers: Number of processes.

    Raises:
        Exception: Whatever the function raised first; jobs that have not begun are dropped.
    """
    remaining = iter(jobs)
    pool = ProcessPoolExecutor(
        workers,
        mp_context=multiprocessing.get_context("spawn"),
        initializer=become_worker,
        initargs=(signal.SIG_DFL,),
    )
    try:
        pending: set[Future[Result]] = set()
        while True:
            ahead = _AHEAD * workers - len(pending)
            for job in islice(remaining, ahead):
                with interrupts_held():  # it starts processes
                    pending.add(pool.submit(function, *job))
            if not pending:
                return
            done, pending = wait(pending, return_when=FIRST_COMPLETED)
            for future in done:
                yield future.result()
    finally:
        pool.shutdown(cancel_futures=True)


def become_worker(on_interrupt: signal.Handlers) -> None:
    """Make this process a worker: it ends with its parent, however that ends, and draws alone.

    Args:
        on_interrupt: What Ctrl-C does to it: `SIG_DFL` ends it, `SIG_IGN` lets it finish its job.
            Where it began with Ctrl-C ignored, as behind a shell's `&`, it goes on ignoring that.
    """
    if signal.getsignal(signal.SIGINT) is not signal.SIG_IGN:
        signal.signal(signal.SIGINT, on_interrupt)
    let_interrupts_through()
    threading.Thread(target=_end_with_parent, daemon=True).start()
    os.environ.setdefault("LP_NUM_THREADS", "1")  # Mesa's software renderer: a process per core


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
