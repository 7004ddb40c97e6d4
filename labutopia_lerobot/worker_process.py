"""What every worker process does first."""

import multiprocessing
import os
import signal
import threading


def become_worker(on_interrupt: signal.Handlers) -> None:
    """Make this process a worker: it ends with its parent, however that ends, and draws alone.

    Args:
        on_interrupt: What Ctrl-C does to it: `SIG_DFL` ends it, `SIG_IGN` lets it finish its job.
    """
    signal.signal(signal.SIGINT, on_interrupt)
    threading.Thread(target=_end_with_parent, daemon=True).start()
    os.environ.setdefault("LP_NUM_THREADS", "1")  # Mesa's software renderer: a process per core


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
