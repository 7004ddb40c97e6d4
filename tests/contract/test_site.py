"""The site and the README: built offline and strictly, and nothing of them comes from elsewhere."""

import os
import re
import subprocess
import sys
import tomllib
from html.parser import HTMLParser
from pathlib import Path

import pytest
import yaml

from labutopia_lerobot.registry import task_files
from labutopia_lerobot.runtime.video import video_size_and_frames

ROOT = Path(__file__).parents[2]


class Loaded(HTMLParser):
    """Collects what a page loads, as a browser would: not where it only leads to."""

    def __init__(self) -> None:
        super().__init__()
        self.addresses: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        if tag in ("script", "img", "source", "iframe", "video"):
            self.addresses.append(given.get("src") or "")
        if tag == "link" and given.get("rel") not in ("canonical", "next", "prev"):
            self.addresses.append(given.get("href") or "")


@pytest.fixture(scope="module")
def site(tmp_path_factory) -> Path:
    pytest.importorskip("mkdocs", reason="the extra `docs` is not installed")
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", str(folder)]
    environment = {**os.environ, "NO_MKDOCS_2_WARNING": "1"}
    done = subprocess.run(
        command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return folder


def test_no_page_of_the_site_loads_anything_from_elsewhere(site):
    pages = list(site.rglob("*.html"))
    assert len(pages) > 80
    for page in pages:
        loaded = Loaded()
        loaded.feed(page.read_text())
        assert not [each for each in loaded.addresses if "//" in each], page
    styles = "".join(each.read_text() for each in site.rglob("*.css"))
    assert not re.search(r"@import|url\((?!data:)['\"]?(https?:)?//", styles)


@pytest.mark.slow
def test_every_task_has_a_page_with_its_instruction_and_the_reference_is_filled(site):
    for task_id in task_files():
        page = (site / "tasks" / f"{task_id.replace('/', '-')}.html").read_text()
        assert "Goal, held for two seconds" in page
        assert "labutopia-view" in page
    assert "Judges one episode of a task" in (site / "reference" / "tasks.html").read_text()
    assert (site / "search" / "search_index.json").stat().st_size > 100_000


def test_every_task_has_a_film_of_its_own_that_is_small():
    films = ROOT / "docs" / "gallery" / "films"
    expected = {f"{task_id.replace('/', '-')}.mp4" for task_id in task_files()}
    assert {each.name for each in films.iterdir()} == expected, "run: scripts/make_films.py tasks"
    for film in films.iterdir():
        assert video_size_and_frames(film)[:2] == (480, 270)
        assert 10_000 < film.stat().st_size < 600_000


def test_the_readme_is_a_page_that_opens_with_a_film_of_less_than_3_mb():
    lines = (ROOT / "README.md").read_text().splitlines()
    assert len(lines) <= 150
    pictures = re.findall(r"!\[[^\]]+\]\(([^)]+)\)", "\n".join(lines[:20]))
    assert pictures[0].endswith(".webp")
    for picture in pictures:
        assert (ROOT / picture).stat().st_size < 3_000_000
    for target in re.findall(r"\]\(([^)#:]+)\)", "\n".join(lines)):
        assert (ROOT / target).exists(), target


def test_community_files_can_be_read_and_say_the_version():
    version = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"]
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    assert cited["version"] == version
    assert f"## {version}\n" in (ROOT / "CHANGELOG.md").read_text()
    assert cited["preferred-citation"]["title"].startswith("LabUtopia")
    for file in (ROOT / ".github").rglob("*.yml"):
        assert yaml.safe_load(file.read_text())["name"]
    for file in ("CONTRIBUTING.md", "SECURITY.md"):
        for target in re.findall(r"\]\(([^)#:]+)\)", (ROOT / file).read_text()):
            assert (ROOT / target).exists(), target
