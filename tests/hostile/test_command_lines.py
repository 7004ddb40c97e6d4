"""Five hundred command lines that make no sense: each is reported in a sentence."""

from pathlib import Path

import numpy as np
import pytest

from hostile.programs import MODULES, run

PROGRAMS = [program for program in MODULES if program != "check-submission"]
WORDS = (
    "",
    "-",
    "--",
    "=",
    "é",
    "nowhere",
    "level1/none",
    "task=",
    "task={a:1}",
    "task=[",
    "task=level9/x",
    "level=6",
    "level=-1",
    "episodes=-1",
    "episodes=x",
    "seed=99999999999999999999",
    "obs=sight",
    "--obs",
    "--episode",
    "--episode=-1",
    "--out",
    "--out=nan",
    "--cameras=/etc/passwd",
    "width=0",
    "axes=[lite]",
    "room=../../x",
    "robot=7",
    "policy=wizard",
    "policy.path=nowhere",
    "nonsense=1",
    "--nonsense",
    "x" * 5000,
    "\x1b[31m",
    "../../..",
)
MOST = 3
"""Words of a line."""


def lines(count: int) -> list[tuple[str, ...]]:
    """Return so many lines, the same every time."""
    rng = np.random.default_rng(0)
    found = []
    for number in range(count):
        words = rng.choice(len(WORDS), rng.integers(0, MOST + 1))
        found.append((PROGRAMS[number % len(PROGRAMS)], *(WORDS[word] for word in words)))
    return found


LINES = lines(500)


@pytest.mark.parametrize(
    "number",
    [
        pytest.param(number, marks=[pytest.mark.slow] if number >= 36 else [])
        for number in range(len(LINES))
    ],
)
def test_a_line_that_makes_no_sense_is_reported_clearly(number: int, tmp_path: Path) -> None:
    program, *words = LINES[number]
    ended = run(program, *words, folder=tmp_path, limit_s=60.0)
    assert ended.status in (0, 1, 2), (program, words, ended)
    assert "Traceback" not in ended.output, (program, words, ended.output)
    assert ended.harmless, (program, words, ended)
