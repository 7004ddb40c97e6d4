"""Worker processes that take jobs from a queue."""

import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed


def in_processes[*Job, Result](
    function: Callable[[*Job], Result], jobs: Sequence[tuple[*Job]], workers: int
) -> Iterator[Result]:
    """Yield the result of every job, in the order in which they are finished.

    Args:
        function: What to do with a job; can be pickled, like everything in a job.
        jobs: Its arguments, one tuple per job; they are begun in this order.
        workers: Number of processes.

    Raises:
        Exception: Whatever the function raised first; jobs that have not begun are dropped.
    """
    if not jobs:
        return
    pool = ProcessPoolExecutor(
        min(workers, len(jobs)),
        mp_context=multiprocessing.get_context("spawn"),
        initializer=_start_worker,
    )
    try:
        for future in as_completed([pool.submit(function, *job) for job in jobs]):
            yield future.result()
    finally:
        pool.shutdown(cancel_futures=True)


def _start_worker() -> None:
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C ends a worker at once and silently
    threading.Thread(target=_end_with_parent, daemon=True).start()
    os.environ["LP_NUM_THREADS"] = "1"  # Mesa's software renderer: a process per core, no threads


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
