"""The site of a viewer: its page, what can be chosen, moments, and what its buttons say."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs

from labutopia_lerobot.web.server import Answer
from labutopia_lerobot.web.showing import Stage

_WAIT_S = 10.0
"""Longest time that a browser waits for the next moment before it asks again [s]."""


class EpisodesSite:
    """Shows a stage.

    Args:
        stage: Who has the moments and takes the commands.
    """

    may_load = (
        "connect-src 'self'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'"
    )

    def __init__(self, stage: Stage) -> None:
        self._stage = stage
        self._page = (Path(__file__).parent / "page.html").read_bytes()

    def get(self, path: str, query: str) -> Answer | None:
        """Return the page, what can be chosen, or the next moment."""
        if path == "/":
            return Answer("text/html; charset=utf-8", self._page)
        if path == "/choices":
            return Answer("application/json", json.dumps(self._stage.choices).encode())
        if path == "/moment":
            number = parse_qs(query).get("after", [""])[0]
            known = int(number) if number.isdecimal() and len(number) < 18 else -1
            return Answer("application/json", self._stage.after(known, _WAIT_S) or b"")
        return None

    def take(self, command: Mapping[str, Any]) -> bool:
        """Leave a command on the stage."""
        self._stage.commands.put(command)
        return True
