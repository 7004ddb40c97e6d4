"""Running a program as a user does, in a process of its own that is watched."""

import contextlib
import importlib
import os
import resource
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from multiprocessing import forkserver, get_context
from pathlib import Path
from typing import Any

from labutopia_lerobot.cli import launch

MODULES = {"check-submission": "check_submission"} | {
    program: f"labutopia_lerobot.cli.{program}"
    for program in launch.PROGRAMS
    if program not in ("bench", "check")  # they open no files, and play for minutes
}
"""Program -> the module whose `main` it is."""

LIMIT_S = 10.0
"""How long a program may look at a file that it refuses [s]."""

_ADDRESSES = {"socket.connect", "socket.getaddrinfo", "socket.gethostbyname"}
_WRITING = os.O_WRONLY | os.O_RDWR
_CACHES = ("__pycache__", "/dev/", "/proc/", "labutopia_lerobot/kernels/")
_context: Any = None


@dataclass(frozen=True)
class Ended:
    """How a program ended.

    Attributes:
        status: Its exit status; None if it did not end in time.
        output: What it printed, on both channels.
        connections: Which machines it wanted to reach.
        written: Files outside its folder that it opened to write.
        seconds: How long it ran [s].
    """

    status: int | None
    output: str
    connections: list[str]
    written: list[str]
    seconds: float

    @property
    def refused(self) -> bool:
        """Whether it refused what it was given as it must: clearly, quickly and without harm."""
        clear = "Traceback" not in self.output and ("Error:" in self.output or self.found_faults)
        return clear and self.status in (1, 2) and self.harmless

    @property
    def found_faults(self) -> bool:
        """Whether it is a verification that found faults."""
        return self.status == 1 and "Fault: " in self.output

    @property
    def harmless(self) -> bool:
        """Whether nothing was written elsewhere, and nobody asked."""
        return not self.connections and not self.written


def run(program: str, *arguments: object, folder: Path, limit_s: float = LIMIT_S) -> Ended:
    """Run a program in a folder.

    Args:
        program: A key of `MODULES`.
        *arguments: Of the command line.
        folder: Its working folder, outside of which nothing may be written.
        limit_s: After how long it is killed [s].
    """
    global _context
    if _context is None:
        sys.path.append(str(Path(__file__).parents[2] / "eval"))  # where the processes find it too
        _context = get_context("forkserver")
        # Another test may have started this process's only fork server, which imports less.
        forkserver._forkserver._stop()  # type: ignore[attr-defined]
        _context.set_forkserver_preload([*MODULES.values(), "torch", "lerobot.policies"])
    notes = folder / ".notes"
    notes.mkdir(exist_ok=True)
    for file in notes.iterdir():
        file.unlink()
    process = _context.Process(
        target=_call,
        args=(MODULES[program], [str(a) for a in arguments], str(folder), str(notes)),
    )
    before = time.monotonic()
    process.start()
    process.join(limit_s)
    if process.exitcode is None:
        process.kill()
        process.join()
        status = None
    else:
        status = process.exitcode
    output = "".join((notes / name).read_text(errors="replace") for name in ("out", "err"))
    return Ended(
        status,
        output,
        _lines(notes / "connections"),
        _lines(notes / "written"),
        time.monotonic() - before,
    )


def _lines(file: Path) -> list[str]:
    return file.read_text().splitlines() if file.exists() else []


def _call(module: str, arguments: Sequence[str], folder: str, notes: str) -> None:
    os.chdir(folder)
    for number, name in ((1, "out"), (2, "err")):
        os.dup2(os.open(f"{notes}/{name}", os.O_WRONLY | os.O_CREAT), number)
    with contextlib.suppress(ValueError):
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    tempfile.gettempdir()  # it finds out by writing
    sys.addaudithook(_Watch(folder, notes))
    sys.argv = [module, *arguments]
    importlib.import_module(module).main()


class _Watch:
    """Notes where a process connects to, which it may not, and what it writes elsewhere."""

    def __init__(self, folder: str, notes: str) -> None:
        self._folder, self._notes = os.path.realpath(folder), notes
        self._busy = False

    def __call__(self, event: str, arguments: tuple[Any, ...]) -> None:
        if self._busy:
            return
        self._busy = True
        try:
            if event in _ADDRESSES and not self._is_local(event, arguments):
                self._note("connections", repr(arguments[1:]))
                raise ConnectionRefusedError("no connection is allowed")
            if event == "open" and isinstance(arguments[2], int) and arguments[2] & _WRITING:
                self._opened(arguments[0])
        finally:
            self._busy = False

    def _is_local(self, event: str, arguments: tuple[Any, ...]) -> bool:
        if event == "socket.connect":
            return not isinstance(arguments[1], tuple)  # a socket of this machine
        return arguments[0] in (None, "", "localhost", "127.0.0.1")

    def _opened(self, path: object) -> None:
        if not isinstance(path, str | bytes | os.PathLike):
            return
        place = os.path.realpath(os.fsdecode(path))
        known = place.startswith(self._folder) or any(part in place for part in _CACHES)
        if not known and not place.startswith(("/tmp/pymp-", "/tmp/torch")):
            self._note("written", place)

    def _note(self, name: str, text: str) -> None:
        with open(f"{self._notes}/{name}", "a") as file:
            file.write(text + "\n")
