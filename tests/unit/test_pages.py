"""Pages of the documentation lead to each other, and name every program."""

import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text()
PROGRAMS = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["scripts"]


@pytest.mark.parametrize("page", sorted((ROOT / "docs").glob("*.md")), ids=lambda page: page.stem)
def test_the_readme_leads_to_every_page_and_every_page_back(page: Path) -> None:
    assert f"](docs/{page.name})" in README
    assert "[To the README](../README.md)" in page.read_text()


@pytest.mark.parametrize("program", PROGRAMS)
def test_the_page_of_use_has_every_program(program: str) -> None:
    assert f"{program} " in (ROOT / "docs" / "using.md").read_text()
