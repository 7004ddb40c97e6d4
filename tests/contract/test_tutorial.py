"""Every block of `docs/tutorial.md` does what the page says."""

import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "tutorial.md").read_text()

FILES = dict(re.findall(r"`(my_tasks/\S+\.py)`:\n\n```python\n(.*?)```", PAGE, re.DOTALL))
CONSOLES = re.findall(r"```console\n(.*?)```", PAGE, re.DOTALL)

SLOW = "labutopia-(check|record|eval)"
"""Blocks with these take ten seconds or more; of the others `make test` runs the first ones."""

SMALL = ["--headless", "--width", "32", "--height", "32"]
"""What a display would show at real time is drawn small here; no outcome depends on it."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An empty folder in which every file of the page has been written."""
    empty = tmp_path_factory.mktemp("tutorial")
    for name, text in FILES.items():
        (empty / name).parent.mkdir(parents=True, exist_ok=True)
        (empty / name).write_text(text)
    return empty


def run(command: str, folder: Path) -> str:
    """Run a command of the page; return what it prints."""
    program, *arguments = shlex.split(command)
    call = [program, *arguments]
    if program.startswith("labutopia-"):
        name = program.removeprefix("labutopia-").replace("eval", "evaluate")
        main = f"from labutopia_lerobot.cli.{name} import main; main()"
        call = [sys.executable, "-c", main, *arguments, *(SMALL if name == "view" else [])]
    done = subprocess.run(call, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_no_block_is_forgotten():
    assert len(FILES) + len(CONSOLES) == PAGE.count("```") // 2


def test_the_first_file_is_the_example_of_the_readme():
    assert FILES["my_tasks/level1/raise_flask.py"] in (ROOT / "README.md").read_text()


@pytest.mark.parametrize(
    "console",
    [
        pytest.param(text, marks=[pytest.mark.slow] if n > 2 or re.search(SLOW, text) else [])
        for n, text in enumerate(CONSOLES)
    ],
    ids=[re.sub(r"\W+", "_", text.splitlines()[-1])[:40] for text in CONSOLES],
)
def test_the_commands_print_what_the_page_shows(folder, console):
    printed = ""
    for line in console.splitlines():
        if line.startswith("$ "):
            printed = run(line.removeprefix("$ "), folder)
        else:
            assert line.removesuffix(" ...") in printed
