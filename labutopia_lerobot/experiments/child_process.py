"""One program in a process of its own: its log, its memory, its progress, its end."""

import ctypes
import os
import signal
import subprocess
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

_LOOK_S = 1.0
"""Time between two looks at a program [s]."""

_TERMINATION_S = 30.0
"""How long a program that is asked to end may take [s]."""

_LINES = 6
"""Lines of a message that are repeated; the log has all."""

_DEATH_OF_PARENT = 1
"""Linux: PR_SET_PDEATHSIG of prctl(2)."""

_QUIET_THREADS = {"OMP_NUM_THREADS": "1", "OMP_WAIT_POLICY": "PASSIVE"}
"""Threads that spin while they wait for each other take most of the time of a few cores."""


@dataclass(frozen=True)
class EndedChild:
    """How a program ended.

    Attributes:
        status: Its exit status.
        seconds: How long it ran [s].
        startup_s: How long nothing was to be seen of its work [s], extrapolated to its beginning.
        done_before: Share of the work that was there when it began.
        memory_bytes: Most memory of its processes together, what they share once [bytes].
    """

    status: int
    seconds: float
    startup_s: float
    done_before: float
    memory_bytes: int


def run_child(
    command: Sequence[str],
    log: Path,
    progress: Callable[[], float],
    watch: Callable[[float], None],
) -> EndedChild:
    """Run a program to its end; it ends with this process, however that ends.

    Args:
        command: The program and its arguments.
        log: File to which what it says is appended.
        progress: Returns how much of its work is done, from 0 to 1.
        watch: Is given that share again and again.

    Raises:
        KeyboardInterrupt: If this process is asked to end; then the program has ended too.
    """
    log.parent.mkdir(parents=True, exist_ok=True)
    before = progress()
    began = time.monotonic()
    seen: list[tuple[float, float]] = []
    memory = 0
    with log.open("ab") as said:
        child = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=said,
            stderr=subprocess.STDOUT,
            start_new_session=True,
            env=_QUIET_THREADS | os.environ,
            preexec_fn=_end_with_parent,
        )
        try:
            while True:
                try:
                    status = child.wait(_LOOK_S)
                    break
                except subprocess.TimeoutExpired:
                    share = progress()
                    memory = max(memory, _memory_of_session(child.pid))
                    if before < share < 1 and (not seen or share > seen[-1][1]):
                        seen.append((time.monotonic() - began, share))
                    watch(share)
        except BaseException:
            _end(child)
            raise
    seconds = time.monotonic() - began
    return EndedChild(status, seconds, _startup(seen, before, seconds), before, memory)


def last_words(log: Path, begin: int = 0) -> str:
    """Return the last message of a log: from `Error:` on, or else the last line.

    Args:
        log: The log.
        begin: Where in it the program began to write [bytes].
    """
    lines = log.read_bytes()[begin:].decode(errors="replace").replace("\r", "\n").split("\n")
    said = [line.strip() for line in lines if line.strip()]
    errors = [number for number, line in enumerate(said) if line.startswith("Error:")]
    shown = said[errors[-1] :][:_LINES] if errors else said[-1:]
    return " ".join(shown) or "it said nothing"


def _startup(seen: Sequence[tuple[float, float]], before: float, seconds: float) -> float:
    """Return when the work began, if it went on as fast before it was first seen as after [s]."""
    if not seen or seen[0][1] >= 1.0:
        return 0.0
    time_s, share = seen[0]
    rate = (seconds - time_s) / (1.0 - share)
    return max(0.0, time_s - rate * (share - before))


def _end_with_parent() -> None:
    ctypes.CDLL(None).prctl(_DEATH_OF_PARENT, signal.SIGTERM)


def _end(child: "subprocess.Popen[bytes]") -> None:
    try:
        os.killpg(child.pid, signal.SIGTERM)
        child.wait(_TERMINATION_S)
    except ProcessLookupError:
        pass
    except subprocess.TimeoutExpired:
        os.killpg(child.pid, signal.SIGKILL)
        child.wait()


def _memory_of_session(session: int) -> int:
    """Return the memory of all processes of a session [bytes]; shared pages count once (PSS)."""
    total = 0
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            # Behind the name in brackets: state, parent, group, session.
            if int((folder / "stat").read_text().rpartition(")")[2].split()[3]) != session:
                continue
            lines = (folder / "smaps_rollup").read_text().splitlines()
            total += sum(int(line.split()[1]) for line in lines if line.startswith("Pss:"))
        except (OSError, ValueError, IndexError):
            continue  # it has just ended
    return 1024 * total
