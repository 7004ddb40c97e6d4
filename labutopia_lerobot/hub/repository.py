"""Intended content of a repository of the Hub: a value, made before anything is sent."""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

CARD = "README.md"
"""Name of the file that the Hub shows as the page of a repository."""


@dataclass(frozen=True)
class Repository:
    """The content of a repository.

    Attributes:
        kind: What the Hub calls it.
        files: Path in the repository -> file on this machine, or content.
        tag: Tag by which readers look for it, or None; it moves to what is sent.
    """

    kind: Literal["dataset", "model"]
    files: dict[str, Path | bytes]
    tag: str | None = None

    @property
    def card(self) -> bytes:
        """Content of its card."""
        content = self.files[CARD]
        return content if isinstance(content, bytes) else content.read_bytes()

    @property
    def sizes(self) -> dict[str, int]:
        """Path in the repository -> size [bytes]."""
        return {
            path: len(content) if isinstance(content, bytes) else content.stat().st_size
            for path, content in sorted(self.files.items())
        }
