"""`docs/vocabulary.md` is what the script would write, and leaves nothing out."""

import importlib
import inspect
import re
from collections.abc import Iterator

import make_vocabulary
import piece_pictures
from labutopia_lerobot import predicates, skills
from labutopia_lerobot.labware.piece import Piece
from labutopia_lerobot.tasks.level2.heat_beaker import heat_beaker

PAGE = make_vocabulary.PAGE.read_text()


def test_the_page_is_what_the_script_writes():
    assert make_vocabulary.page() == PAGE, "run: python scripts/make_vocabulary.py"


def test_every_predicate_and_every_skill_is_on_it():
    facts = [name for name in predicates.__all__ if not inspect.isclass(getattr(predicates, name))]
    assert [name for name in facts if f"| `{name}(" not in PAGE] == []
    assert [name for name in skills.__all__ if f"\n### {name}\n" not in PAGE] == []


def test_every_piece_of_a_task_is_on_it():
    made = {f"{type(piece).__name__}" for piece in heat_beaker().start}
    assert made == {"Vessel", "Heater"}
    for name in (*made, "TestTubeRack"):
        assert f"`{name}(name: str" in PAGE
    assert "`glassware(kind: str, size: str" in PAGE


def names_with_modules() -> Iterator[tuple[str, str]]:
    """Yield every name that the page says where to import from, with that module."""
    module, callable_rows = "", False
    for line in PAGE.splitlines():
        if here := re.match(r"(?:From `([\w.]+)`\.$|## )", line):
            module = here[1] or ""
        elif line.startswith("| ") and "---" not in line:
            own = re.search(r"`(\w+)(?:\(.*\))?`<br>from `([\w.]+)`", line)
            if line.startswith(("| call", "| ask", "| argument", "| |")):
                callable_rows = line.startswith("| call")
            elif own:
                package = "" if own[2].startswith("labutopia_lerobot") else "labutopia_lerobot."
                yield own[1], package + own[2]
            elif callable_rows:
                yield re.match(r"\| `(\w+)", line)[1], module
        elif line.startswith("### "):
            yield line.removeprefix("### "), module


def test_every_name_can_be_imported_from_the_module_that_the_page_names():
    named = list(names_with_modules())
    assert {"Profile", "hand_at", "Approach", "Phase", "Thing", "Pose"} <= {n for n, _ in named}
    assert len(named) > 100
    missing = [(n, m) for n, m in named if not hasattr(importlib.import_module(m), n)]
    assert missing == []


def test_every_line_has_a_meaning():
    rows = [line for line in PAGE.splitlines() if line.startswith("|")]
    meanings = [re.split(r"(?<!\\)\|", row)[-2] for row in rows if "labware." not in row]
    assert all(meaning.strip() for meaning in meanings)


def test_every_piece_that_needs_only_a_name_has_a_small_picture():
    drawn = {file.stem: file.stat().st_size for file in make_vocabulary.PICTURES.iterdir()}
    pieces = filter(piece_pictures.needs_only_a_name, piece_pictures.makers())
    assert set(drawn) == {make.__name__ for make in pieces}
    assert sum(drawn.values()) < 400_000


def test_a_picture_shows_its_piece():
    piece: Piece = next(p for p in heat_beaker().start if p.name == "beaker")
    drawn = piece_pictures.picture(piece)
    assert drawn.size == (160, 160)
    assert len(drawn.getcolors()) > 8
