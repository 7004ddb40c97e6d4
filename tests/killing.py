"""A program that is killed again and again, and goes on each time."""

import os
import signal
import subprocess
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np


def killed_at_any_moment(
    command: Sequence[str], *, times: int, within: float, folder: Path
) -> Iterator[None]:
    """Start a program until it has been killed often enough, and once more.

    Yields whenever it has come to its end, the last time after the last kill: what it has written
    can be looked at then, and has to be taken away.

    Args:
        command: The program and its arguments.
        times: How often it is killed.
        within: Kills come this long after a start at most [s], all moments equally likely.
        folder: Where it is started.
    """
    rng = np.random.default_rng(0)
    kills = 0
    while True:
        process = subprocess.Popen(
            command, cwd=folder, start_new_session=True, stderr=subprocess.PIPE, text=True
        )
        try:
            reported = process.communicate(
                timeout=rng.uniform(0, within) if kills < times else None
            )[1]
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            kills += 1
            continue
        # A kill may come between the last byte and the end of the process.
        assert process.returncode == 0 or "already holds" in reported, reported
        yield
        if kills == times:
            return
