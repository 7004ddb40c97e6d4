"""The page: self-contained, and shown by a real browser where one is installed."""

import html
import json
import re
import subprocess
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import numpy as np
import pytest

from browser import BROWSER, needs_browser, opened
from labutopia_lerobot.evaluation.load_results import LoadedResult, load_results
from labutopia_lerobot.evaluation.reporting import page as page_module
from labutopia_lerobot.evaluation.reporting.page import addresses, films_of, page, write_page
from labutopia_lerobot.evaluation.result_folder import film_of
from labutopia_lerobot.runtime.video import write_video
from labutopia_lerobot.web.results_site import ResultsSite
from labutopia_lerobot.web.server import served

from .written_rows import every_level, in_drawn_order, keep, written

WIDTHS = (480, 1400)
"""A telephone's and a laptop's [pixels]."""

PROBE = """<!doctype html>
<style>body {{ margin: 0 }} iframe {{ border: 0; width: {width}px; height: 900px }}</style>
<iframe srcdoc="{page}"></iframe>
<script>
addEventListener("load", () => setTimeout(() => {{
  const frame = document.querySelector("iframe").contentDocument;
  const whole = element => {{
    const range = frame.createRange();
    range.selectNodeContents(element);
    return range.getClientRects().length;
  }};
  const cells = [...frame.querySelectorAll("th, td")].filter(cell => cell.offsetParent);
  const named = cell => `${{cell.dataset.label}}: ${{cell.textContent.trim().slice(0, 40)}}`;
  const found = {{
    width: frame.documentElement.scrollWidth,
    paper: frame.defaultView.getComputedStyle(frame.body).backgroundColor,
    outside: cells.filter(cell => {{
      const box = cell.getBoundingClientRect();
      return box.left < 0 || box.right > {width} || !box.width;
    }}).map(named),
    clipped: [...frame.querySelectorAll("th, td, li, li span, h1, h2, h3, p, a, figcaption, dd")]
      .filter(element => element.scrollWidth > element.clientWidth + 1 && element.clientWidth)
      .map(named),
    broken: [...frame.querySelectorAll("tbody th, td.words")]
      .filter(cell => !/[ /]/.test(cell.textContent) && cell.offsetParent && whole(cell) > 1)
      .map(named),
    labels: [...new Set(cells.map(cell => cell.dataset.label || ""))],
    films: [...frame.querySelectorAll("video")].map(film => [film.readyState, film.duration]),
  }};
  document.title = JSON.stringify(found);
}}, 500));
</script>"""
"""Measures, beside the page and not in it, how it came out: the page itself runs no scripts."""


def measured(page: Path, folder: Path, width: int) -> dict[str, Any]:
    """Return how a browser shows a page in a frame of this width [pixels]."""
    probe = page.with_name("probe.html")  # where the page lies, for its links
    probe.write_text(PROBE.format(width=width, page=html.escape(page.read_text())))
    assert BROWSER is not None
    command = [
        *(BROWSER, "--headless=new", "--no-sandbox", "--disable-gpu", "--window-size=1500,1000"),
        *("--virtual-time-budget=10000", f"--user-data-dir={folder / 'profile'}", "--dump-dom"),
        probe.as_uri(),
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=120)
    title = re.search("<title>(.*?)</title>", done.stdout, re.DOTALL)
    assert title is not None
    reported: dict[str, Any] = json.loads(html.unescape(title[1]))
    return reported


@pytest.fixture(scope="module")
def written_page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("page")
    drawn = keep(folder / "drawn", in_drawn_order([1, 3, 3, 0, 6, 4]))
    results = [r for place in [*every_level(folder), drawn] for r in load_results(place)]
    film_first(results[1])
    write_page(folder / "report.html", results)
    return folder / "report.html"


def film_first(result: LoadedResult) -> None:
    """Film the first failure and the first success of a result, a second each."""
    for success in (False, True):
        row = next(row for row in result.rows if row.success == success)
        film = film_of(result.place, row)
        film.parent.mkdir(exist_ok=True)
        write_video(film, [np.full((64, 64, 3), 8 * i, np.uint8) for i in range(30)])


class Tags(HTMLParser):
    """Collects tags, and checks that each is closed."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.addresses: list[str] = []
        self.ids: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag not in ("meta", "br", "wbr"):
            self.open.append(tag)
        reported = dict(attrs)
        self.addresses += [value for name in ("src", "href") if (value := reported.get(name))]
        self.ids += [value for name in ("id",) if (value := reported.get(name))]

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


def test_the_page_shows_all_that_rows_hold(written_page: Path) -> None:
    text = written_page.read_text()
    for heading in ("Level 1 and level 2", "Level 3", "Size test", "Under shift"):
        assert f"<h2>{heading}</h2>" in text
    for heading in ("Substeps", "Failures", "Films", "Precision", "Level 4: liquid_fusion"):
        assert f"<h2>{heading}</h2>" in text
    assert text.count('<video controls muted loop playsinline preload="metadata" src="data:') == 2
    assert "success, after" in text
    assert "expert: not filmed" in text
    assert "0123456789abcdef" in text
    assert "python eval/run.py task=level1/pick policy=act" in text
    assert "prefers-color-scheme: dark" in text
    assert "@media print" in text


def page_in(folder: Path, results: list[LoadedResult]) -> str:
    return page(results, addresses(films_of(results), folder))


def test_films_that_are_too_large_to_stand_in_the_page_are_linked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (result,) = load_results(keep(tmp_path / "an out", written("level1/pick", "act", 0.5, n=8)))
    film_first(result)
    monkeypatch.setattr(page_module, "MOST_EMBEDDED", 100)
    text = page_in(tmp_path, [result])
    tags = Tags()
    tags.feed(text)
    linked = [address for address in tags.addresses if address[0] != "#"]
    assert len(linked) == 2
    assert all((tmp_path / unquote(address)).is_file() for address in linked)
    assert "data:video" not in text
    assert "take the folders <code>videos</code> along" in text
    assert "media-src 'self' file:" in text


def test_no_file_outside_the_films_of_a_result_is_shown(tmp_path: Path) -> None:
    rows = written("level1/pick", "act", 0.0, n=2)
    (tmp_path / "private.mp4").write_bytes(b"secret")
    folder = tmp_path / "out"
    keep(folder, [replace(rows[0], outcome="/../../../private"), rows[1]])
    (folder / "videos" / "level1-pick_id_seed100000_").mkdir(parents=True)
    film_of(folder, rows[1]).symlink_to(tmp_path / "private.mp4")
    text = page_in(tmp_path, load_results(folder))
    assert "<video" not in text
    assert "c2VjcmV0" not in text


def test_what_users_name_is_escaped(tmp_path: Path) -> None:
    rows = written("level1/pick", "<script>alert(1)</script>", 0.5, n=8)
    text = page_in(tmp_path, load_results(keep(tmp_path / "out", rows)))
    assert "<script" not in text


def test_the_same_results_give_the_same_page(tmp_path: Path) -> None:
    results = load_results(keep(tmp_path / "out", written("level1/pick", "act", 0.5, n=8)))
    assert page_in(tmp_path, results) == page_in(tmp_path, load_results(tmp_path / "out"))


@needs_browser
@pytest.mark.parametrize("width", WIDTHS)
def test_a_browser_shows_every_column_whole_without_scrolling_aside(
    written_page: Path, tmp_path: Path, width: int
) -> None:
    reported = measured(written_page, tmp_path, width)
    assert reported["width"] <= width
    assert (reported["outside"], reported["clipped"], reported["broken"]) == ([], [], [])
    assert reported["paper"].startswith("rgb(")
    columns = {"SP", "1 pick", "7 place", "10 press", "6 close", "OOD", "paper ACT", "Condition"}
    assert columns <= set(reported["labels"])


@needs_browser
@pytest.mark.parametrize("most", [100, page_module.MOST_EMBEDDED])
def test_a_browser_plays_the_films_in_the_page_and_beside_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, most: int
) -> None:
    monkeypatch.setattr(page_module, "MOST_EMBEDDED", most)
    results = load_results(keep(tmp_path / "out", written("level1/pick", "act", 0.5, n=8)))
    film_first(results[0])
    write_page(tmp_path / "report.html", results)
    films = measured(tmp_path / "report.html", tmp_path, 480)["films"]
    assert len(films) == 2
    assert all(ready >= 1 and duration == pytest.approx(1.0, abs=0.1) for ready, duration in films)


@needs_browser
def test_a_report_is_served_with_its_films_and_as_the_results_are_now(tmp_path: Path) -> None:
    rows = written("level1/pick", "act", 0.5, n=8)
    place = keep(tmp_path / "out", rows)
    film_first(load_results(place)[0])
    report = ResultsSite(lambda: load_results(place))
    with served(0, report) as address, opened(tmp_path) as browser:
        browser.go(address)
        films = "[...document.querySelectorAll('video')]"
        browser.wait_for(f"{films}.length == 2 && {films}.every(film => film.readyState >= 1)")
        assert browser.value(f"{films}.every(film => Math.abs(film.duration - 1) < 0.1)")
        episodes = "parseInt(document.querySelector('.figures')?.innerText)"
        browser.wait_for(f"{episodes} == 8")
        assert all(each.startswith(f"{address}/") for each in browser.addresses)
        assert "take the folders" not in browser.value("document.body.innerText")
        place = keep(tmp_path / "later", rows[:5])
        browser.go(address)
        browser.wait_for(f"{episodes} == 5")
    assert report.get("/films/../../etc/passwd", "") is None
    assert not report.take({"do": "anything"})


def test_a_served_report_of_damaged_results_says_so(tmp_path: Path) -> None:
    folder = keep(tmp_path / "out", written("level1/pick", "act", 0.5, n=8))
    (folder / "rows.jsonl").unlink(missing_ok=True)
    (folder / "result.json").write_text("{")
    said = ResultsSite(lambda: load_results(folder)).get("/", "")
    assert said is not None
    assert said.kind.startswith("text/plain")
    assert b"result.json" in said.content
