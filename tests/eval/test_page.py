"""The page: self-contained, and shown by a real browser where one is installed."""

import re
import shutil
import subprocess
from html.parser import HTMLParser
from pathlib import Path

import pytest

from labutopia_lerobot.evaluation.found import find_results
from labutopia_lerobot.evaluation.reporting.page import page, write_page
from labutopia_lerobot.evaluation.result import film_of

from .written_rows import every_level, keep, written

BROWSER = next(
    filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None
)

needs_browser = pytest.mark.skipif(
    BROWSER is None, reason="no Chromium here: scripts/install_chromium.sh installs Debian's"
)

PROBE = """<script>
addEventListener("load", () => {
  const root = document.documentElement;
  root.dataset.width = root.scrollWidth;
  root.dataset.seen = innerWidth;
  root.dataset.paper = getComputedStyle(document.body).backgroundColor;
});
</script>"""
"""Tells, in what the browser dumps, how the page came out; it is not part of the page."""


@pytest.fixture(scope="module")
def written_page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("page")
    results = [result for place in every_level(folder) for result in find_results(place)]
    failed = next(row for row in results[1].rows if not row.success)
    film = film_of(results[1].place, failed)
    film.parent.mkdir()
    film.write_bytes(b"no film, but bytes")
    write_page(folder / "report.html", results)
    return folder / "report.html"


class Tags(HTMLParser):
    """Collects tags, and checks that each is closed."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.addresses: list[str] = []
        self.ids: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag not in ("meta", "br"):
            self.open.append(tag)
        told = dict(attrs)
        self.addresses += [value for name in ("src", "href") if (value := told.get(name))]
        self.ids += [value for name in ("id",) if (value := told.get(name))]

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        pass

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def test_the_page_needs_nothing_from_elsewhere(written_page: Path) -> None:
    tags = Tags()
    text = written_page.read_text()
    tags.feed(text)
    assert not tags.open
    assert all(address.startswith(("#", "data:")) for address in tags.addresses)
    assert {address[1:] for address in tags.addresses if address[0] == "#"} <= set(tags.ids)
    assert not re.search(r"https?://|<script|@import|url\(", text)


def test_the_page_shows_all_that_rows_tell(written_page: Path) -> None:
    text = written_page.read_text()
    for heading in ("Level 1 and level 2", "Level 3", "Size test", "Level 4", "Under shift"):
        assert f"<h2>{heading}</h2>" in text
    for heading in ("Sub-steps", "Failures", "Failures on film", "Precision"):
        assert f"<h2>{heading}</h2>" in text
    assert "data:video/mp4;base64,bm8gZmlsbSwgYnV0IGJ5dGVz" in text
    assert "expert: not filmed" in text
    assert "0123456789abcdef" in text
    assert "python eval/run.py task=level1/pick policy=act" in text
    assert "prefers-color-scheme: dark" in text
    assert "@media print" in text


def test_what_users_name_is_escaped(tmp_path: Path) -> None:
    rows = written("level1/pick", "<script>alert(1)</script>", 0.5, n=8)
    text = page(find_results(keep(tmp_path / "out", rows)))
    assert "<script" not in text


def test_the_same_results_give_the_same_page(tmp_path: Path) -> None:
    results = find_results(keep(tmp_path / "out", written("level1/pick", "act", 0.5, n=8)))
    assert page(results) == page(find_results(tmp_path / "out"))


@needs_browser
@pytest.mark.parametrize("width", [500, 1200])
def test_a_browser_shows_it_without_scrolling_aside(
    written_page: Path, tmp_path: Path, width: int
) -> None:
    policy = re.compile(r'<meta http-equiv="Content-Security-Policy"[^>]*>')
    probed = tmp_path / "probed.html"
    probed.write_text(
        policy.sub("", written_page.read_text()).replace("</body>", PROBE + "</body>")
    )
    assert BROWSER is not None
    command = [
        *(BROWSER, "--headless=new", "--no-sandbox", "--disable-gpu", f"--window-size={width},900"),
        *(f"--user-data-dir={tmp_path / 'profile'}", "--dump-dom", probed.as_uri()),
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=120)
    told = dict(re.findall(r'data-(\w+)="([^"]*)"', done.stdout[:400]))
    assert int(told["width"]) <= int(told["seen"]), told
    assert told["paper"].startswith("rgb(")
    assert "<h2>Level 4</h2>" in done.stdout
