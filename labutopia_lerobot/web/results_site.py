"""The site of results: their page as they are now, and the films that it shows."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.load_results import LoadedResult
from labutopia_lerobot.evaluation.reporting.page import films_of, page
from labutopia_lerobot.web.server import Answer


class ResultsSite:
    """Shows results; a browser that loads the page again sees what was played meanwhile.

    Args:
        results: Loads what it shows; at least one of them has a row.
    """

    may_load = "media-src 'self'; img-src data:; style-src 'unsafe-inline'"

    def __init__(self, results: Callable[[], Sequence[LoadedResult]]) -> None:
        self._results = results
        self._films: dict[str, Path] = {}

    def get(self, path: str, query: str) -> Answer | None:
        """Return the page, or one of its films."""
        if path == "/":
            return self._page()
        film = self._films.get(path)
        return Answer("video/mp4", film.read_bytes()) if film and film.is_file() else None

    def take(self, command: Mapping[str, Any]) -> bool:
        """Refuse: the page has no buttons."""
        return False

    def _page(self) -> Answer:
        try:
            results = self._results()
        except UserError as error:
            return Answer("text/plain; charset=utf-8", str(error).encode())
        films = films_of(results)
        address_of = {film: f"/films/{number}.mp4" for number, film in enumerate(films)}
        self._films = {address: film for film, address in address_of.items()}
        return Answer("text/html; charset=utf-8", page(results, address_of).encode())
