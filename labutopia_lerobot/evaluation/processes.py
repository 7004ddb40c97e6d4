"""Worker processes that take jobs from a queue."""

import multiprocessing
import signal
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed

from labutopia_lerobot.worker_process import become_worker


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
        initializer=become_worker,
        initargs=(signal.SIG_DFL,),
    )
    try:
        for future in as_completed([pool.submit(function, *job) for job in jobs]):
            yield future.result()
    finally:
        pool.shutdown(cancel_futures=True)
