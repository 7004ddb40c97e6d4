"""A part of an experiment: a program, what it needs, what it makes, how much of it is there."""

import hashlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Protocol

from labutopia_lerobot.runtime import provenance

NEVER_HALF = ("commit", "uncommitted_changes")
"""Left out of the code's description: the hash of the sources says more."""


class ExperimentPart(Protocol):
    """A frozen value; two that are equal are the same work."""

    @property
    def out(self) -> Path:
        """Folder of the experiment."""
        ...

    @property
    def name(self) -> str:
        """What it is called, which no other part of the experiment is."""
        ...

    @property
    def rate_key(self) -> str:
        """What it shares its rate with: parts that take as long for as much work."""
        ...

    @property
    def size(self) -> float:
        """How much work it is, in a unit that all parts of one rate share."""
        ...

    @property
    def volume(self) -> float:
        """How much it stores, in a unit that all parts of one rate share."""
        ...

    @property
    def place(self) -> Path:
        """What it makes: a folder, or a file."""
        ...

    @property
    def cores(self) -> int:
        """How many cores its program keeps busy."""
        ...

    @property
    def gpus(self) -> int:
        """How many GPUs its program needs."""
        ...

    @property
    def needs(self) -> "tuple[ExperimentPart, ...]":
        """Parts that must be done before it."""
        ...

    def check(self) -> None:
        """Check, before anything is done, that it can be.

        Raises:
            UserError: If it cannot; the message says why.
        """
        ...

    def inputs(self) -> dict[str, Any]:
        """Return everything that decides what it makes, by hashes; what it needs must be done."""
        ...

    @property
    def peak_bytes(self) -> int | None:
        """About how much room it takes on the disk; None if only earlier parts can show it."""
        ...

    def prepare(self) -> None:
        """Make ready for the program; it may have been killed before."""
        ...

    def command(self) -> list[str]:
        """Return the program that makes it, or goes on with what a killed one has left."""
        ...

    def progress(self) -> float:
        """Return how much of it is done, from 0 to 1, as far as files show it."""
        ...

    def finished(self) -> bool:
        """Return whether what it makes is there, whole."""
        ...

    def digest(self) -> str:
        """Return a hash of what it has made."""
        ...


def sources(*tasks: str, tasks_dir: str | None = None) -> dict[str, Any]:
    """Return the hashes of the code that plays tasks, and the versions of what it computes with."""
    code = provenance.code(tasks, tasks_dir)
    return {
        "code": {name: value for name, value in code.items() if name not in NEVER_HALF},
        "versions": provenance.versions(),
    }


def digest_of(files: Mapping[str, Path]) -> str:
    """Return one hash of files by name, in hexadecimal digits."""
    digest = hashlib.sha256()
    for name in sorted(files):
        digest.update(f"{name} {provenance.sha256(files[name])}\n".encode())
    return digest.hexdigest()


def log_of(part: ExperimentPart) -> Path:
    """Return where the program of a part writes what it says."""
    return part.out / "logs" / f"{file_name(part)}.log"


def file_name(part: ExperimentPart) -> str:
    """Return the name of a part as a file's."""
    return part.name.replace("/", "-").replace(" ", "_")
