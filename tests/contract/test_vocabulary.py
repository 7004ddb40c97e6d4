"""`docs/vocabulary.md` is what the script would write, and leaves nothing out."""

import inspect
import re

import make_vocabulary
import piece_pictures
from labutopia_lerobot import predicates, skills
from labutopia_lerobot.layout import Piece
from labutopia_lerobot.tasks.level2.heat_beaker import heat_beaker

PAGE = make_vocabulary.PAGE.read_text()


def test_the_page_is_what_the_script_writes():
    assert make_vocabulary.page() == PAGE, "run: python scripts/make_vocabulary.py"


def test_every_predicate_and_every_skill_is_on_it():
    facts = [name for name in predicates.__all__ if inspect.isfunction(getattr(predicates, name))]
    assert [name for name in facts if f"| `{name}(" not in PAGE] == []
    assert [name for name in skills.__all__ if f"\n### {name}\n" not in PAGE] == []


def test_every_piece_of_a_task_is_on_it():
    made = {f"{type(piece).__name__}" for piece in heat_beaker().start}
    assert made == {"Vessel", "Heater"}
    for name in (*made, "beaker", "erlenmeyer_flask", "TestTubeRack"):
        assert f"`{name}(name: str" in PAGE


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
