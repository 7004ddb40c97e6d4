"""Two results on common seeds."""

import io
import json
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from rich.console import Console
from scipy.stats import binomtest

from labutopia_lerobot.evaluation.compare import (
    POOLED,
    Comparison,
    NoCommonEpisodesError,
    adjusted,
    compare,
    comparison_table,
)
from labutopia_lerobot.evaluation.load_results import LoadedResult
from labutopia_lerobot.evaluation.reporting.table import TextTable
from labutopia_lerobot.evaluation.rows import Row
from labutopia_lerobot.evaluation.stopping import StoppingRule
from labutopia_lerobot.evaluation.uncertainty import anytime
from labutopia_lerobot.evaluation.uncertainty.paired import PairedOutcomes

from .written_rows import keep, written

COMPARE = Path(__file__).parents[2] / "eval" / "compare.py"

BETTER = written("level1/pick", "act", 0.9) + written("level2/pour_liquid", "act", 0.9, luck=1)
WORSE = [
    *written("level1/pick", "diffusion", 0.6, luck=2),
    *written("level2/pour_liquid", "diffusion", 0.6, luck=3),
]
Counts = NDArray[Any]
PICK = BETTER[0].condition.scene
UNTIL = {"config": {"until": 0.05}}


def of(rows: Sequence[Row], place: str = "out", **provenance: object) -> list[LoadedResult]:
    return [LoadedResult(Path(place), True, tuple(rows), provenance)]


def compared(first: Sequence[Row], second: Sequence[Row]) -> list[Comparison]:
    return compare(of(first), of(second))


def test_only_where_they_differ_counts() -> None:
    pick, pour, pooled = compared(BETTER, WORSE)
    assert (pick.task, pour.task, pooled.task) == ("level1/pick", "level2/pour_liquid", POOLED)
    mine, theirs = BETTER[:120], WORSE[:120]
    only = [(a.success, b.success) for a, b in zip(mine, theirs, strict=True)]
    assert (pick.pairs.first, pick.pairs.second) == (
        only.count((True, False)),
        only.count((False, True)),
    )
    total = pick.pairs.first + pick.pairs.second
    assert pick.p_value == pytest.approx(binomtest(pick.pairs.first, total).pvalue)
    assert pooled.pairs == pick.pairs + pour.pairs
    assert pick.p_value_holm >= pick.p_value


def test_only_common_seeds_are_compared() -> None:
    (found,) = compared(BETTER[:50], WORSE[30:120])
    assert found.pairs.n == 20


def test_a_policy_is_as_good_as_itself() -> None:
    for found in compared(BETTER, BETTER):
        assert found.pairs.difference == 0.0
        assert found.p_value == 1.0


@pytest.mark.parametrize(
    ("column", "value"),
    [
        ("split", "ood"),
        ("axes", ["light"]),
        ("play", "staged"),
        ("step", "pour"),
        ("after", "pick"),
        ("liquid", "off"),
        ("particles", 100),
        ("robot", "iiwa"),
        ("room", "organic_7"),
    ],
)
def test_two_conditions_are_two_lines_and_never_one_number(column: str, value: object) -> None:
    """What is won under one condition must not make up for what is lost under another."""
    won = written("level2/pour_liquid", "act", 1.0, n=10)
    lost = [replace(row, policy="dp", success=False) for row in won]
    other = {column: value}
    ours = [*won, *(replace(row, success=False, **other) for row in won)]
    theirs = [*lost, *(replace(row, policy="dp", **other) for row in won)]
    found = compared(ours, theirs)
    assert len(found) == 2
    assert {(line.pairs.first, line.pairs.second) for line in found} == {(10, 0), (0, 10)}
    assert len({line.condition for line in found}) == 2
    with pytest.raises(NoCommonEpisodesError, match="no episode in common"):
        compared(won, theirs[10:])


def test_what_a_policy_sees_of_a_scene_makes_no_other_condition() -> None:
    state = [replace(row, obs="state") for row in WORSE[:120]]
    (found,) = compared(BETTER[:120], state)
    assert found.pairs.n == 120


def test_results_without_a_common_episode_are_refused_with_what_each_holds() -> None:
    with pytest.raises(NoCommonEpisodesError) as refusal:
        compared(BETTER[:50], WORSE[60:120])
    assert "First: level1/pick ID, seeds 100000 to 100049." in str(refusal.value)
    assert "Second: level1/pick ID, seeds 100060 to 100119." in str(refusal.value)
    with pytest.raises(NoCommonEpisodesError, match=r"seeds 100050 to 100118 \(35 of them\)"):
        compared(BETTER[:50], WORSE[50:120:2])
    with pytest.raises(NoCommonEpisodesError, match="no episode in common"):
        compared(BETTER, [])
    other = [replace(row, drawn={"light": "dim"}) for row in WORSE]
    with pytest.raises(NoCommonEpisodesError, match="not the same scene"):
        compared(BETTER, other)


def test_two_policies_or_results_on_one_side_are_refused() -> None:
    for first in (
        of(BETTER[:5] + WORSE[:5]),
        of(BETTER[:5]) + of(WORSE[:5], "out/dp"),
        of(BETTER[:5]) + of(BETTER[5:10], "out/again"),
        of(BETTER[:5] + BETTER[:1]),
    ):
        with pytest.raises(NoCommonEpisodesError, match="there twice: by act in out and by "):
            compare(first, of(WORSE))


def test_of_a_run_that_could_stop_early_only_what_is_valid_anytime_is_reported() -> None:
    fixed = compared(BETTER, WORSE)
    found = compare(of(BETTER, **UNTIL), of(WORSE))
    assert [line.task for line in found] == ["level1/pick", "level2/pour_liquid"]  # not pooled
    for before, line in zip(fixed, found, strict=False):
        pairs = line.pairs
        assert line.p_value == anytime.p_value(pairs.first, pairs.second) > before.p_value
        assert line.p_value_holm >= line.p_value
        for rate, narrower in zip(line.rates, before.rates, strict=True):
            assert rate.interval == tuple(anytime.confidence_sequence(rate.count, rate.n))
            assert rate.interval[0] < narrower.interval[0]
        assert line.interval[0] < before.interval[0]
        assert line.interval[1] > before.interval[1]
    note = comparison_table(found, ("a", "b")).note
    assert "until" in note
    assert "McNemar" not in note
    assert "until" not in comparison_table(fixed, ("a", "b")).note
    assert compare(of(BETTER), of(WORSE, **UNTIL)) == found


def test_conditions_beside_the_task_are_not_pooled() -> None:
    shifted = [replace(row, split="ood") for row in BETTER[:120]]
    found = compared([*BETTER[:120], *shifted], [*WORSE[:120], *shifted])
    assert len(found) == 2
    assert POOLED not in [line.task for line in found]


def test_no_path_is_broken_inside_a_word() -> None:
    names = ("outputs/evaluations/2026-11-23/act", "outputs/evaluations/2026-11-24/diffusion")
    lines = io.StringIO()
    Console(file=lines, width=80).print(TextTable(comparison_table(compared(BETTER, WORSE), names)))
    assert set(names) <= set(lines.getvalue().split())


RUNS = 20_000
ALARM = 0.05
TOLERANCE = 3 * np.sqrt(ALARM * (1 - ALARM) / RUNS)


def equal_policies(rate: float, most: int) -> tuple[Counts, Counts, Counts]:
    """Simulate runs of two equally good policies.

    Returns:
        Successes of the first, episodes that only it won, that only the second won: after every
        episode, shape (runs, episodes).
    """
    first, second = np.random.default_rng(6).random((2, RUNS, most)) < rate
    return tuple(  # type: ignore[return-value]
        won.cumsum(axis=1, dtype=np.int32) for won in (first, first & ~second, second & ~first)
    )


def printed(better: Counts, worse: Counts, n: Counts, sequential: bool) -> Counts:
    """Return the p-value that the table shows for each run, shape (runs,)."""
    counts = np.stack([better, worse, n])
    kinds, of = np.unique(counts, axis=1, return_inverse=True)
    shown = [
        adjusted([Comparison(PICK, PairedOutcomes(k - b - w, b, w, 0), sequential)])[0].p_value_holm
        for b, w, k in kinds.T.tolist()
    ]
    return np.array(shown)[of]


@pytest.mark.parametrize("rate", [0.5, 0.9])
def test_of_runs_of_fixed_length_no_more_false_alarms_are_printed_than_stated(rate: float) -> None:
    _, better, worse = equal_policies(rate, 120)
    n = np.full(RUNS, 120)
    p_values = printed(better[:, -1], worse[:, -1], n, sequential=False)
    assert (p_values <= ALARM).mean() <= ALARM + TOLERANCE


@pytest.mark.parametrize("rate", [0.5, 0.9])
def test_of_runs_that_stop_when_distinguished_no_more_false_alarms_are_printed_than_stated(
    rate: float,
) -> None:
    """Each stops when its interval is narrow enough, or it seems better or worse than its rival."""
    most = 300
    wins, better, worse = equal_policies(rate, most)
    rule, counts = StoppingRule(0.05), np.arange(most + 1)
    narrow = rule.enough(np.minimum(counts[:, None], counts), counts)  # by successes and episodes
    distinguished = rule.enough(0, 1, counts[:, None], counts)
    done = narrow[wins, np.arange(1, most + 1)] | distinguished[better, worse]
    last = np.where(done.any(axis=1), done.argmax(axis=1), most - 1)
    at_end = (np.arange(RUNS), last)
    p_values = printed(better[at_end], worse[at_end], last + 1, sequential=True)
    assert (p_values <= ALARM).mean() <= ALARM + TOLERANCE
    # What is printed of runs of fixed length would not do.
    fixed = printed(better[at_end], worse[at_end], last + 1, sequential=False)
    assert (fixed <= ALARM).mean() > (p_values <= ALARM).mean()
    if rate == 0.5:
        assert (fixed <= ALARM).mean() > ALARM + TOLERANCE


@pytest.mark.slow
@pytest.mark.parametrize("sequential", [False, True])
def test_over_several_tasks_no_more_runs_have_a_false_alarm_than_stated(sequential: bool) -> None:
    runs, tasks, n = 1500, 4, 60
    first, second = np.random.default_rng(7).random((2, runs, tasks, n)) < 0.7
    alarms = 0
    for better, worse in zip((first & ~second).sum(2), (second & ~first).sum(2), strict=True):
        found = [
            Comparison(PICK, PairedOutcomes(n - int(b) - int(w), int(b), int(w), 0), sequential)
            for b, w in zip(better, worse, strict=True)
        ]
        alarms += any(line.p_value_holm <= ALARM for line in adjusted(found))
    assert alarms / runs <= ALARM + 3 * np.sqrt(ALARM * (1 - ALARM) / runs)


def test_the_program_says_p_values_as_json_and_a_table(tmp_path: Path) -> None:
    folders = [str(keep(tmp_path / name, rows)) for name, rows in (("act", BETTER), ("dp", WORSE))]
    line = [sys.executable, str(COMPARE), *folders]
    done = subprocess.run([*line, "--json"], capture_output=True, text=True, check=True)
    reported = json.loads(done.stdout)["comparisons"]
    assert [line["task"] for line in reported] == ["level1/pick", "level2/pour_liquid", POOLED]
    for entry in reported:
        assert 0.0 <= entry["p_value"] <= entry["p_value_holm"] <= 1.0
        assert entry["difference95"][0] < entry["difference"] < entry["difference95"][1]
    assert reported[0]["condition"]["room"] == "laboratory"


def test_results_are_called_by_their_policies_and_the_note_says_where_they_lie(
    tmp_path: Path,
) -> None:
    kept = [(tmp_path / "05-38-46", BETTER), (tmp_path / "05-39-07", WORSE)]
    folders = [str(keep(folder, rows)) for folder, rows in kept]
    line = [sys.executable, str(COMPARE), *folders, "tables=markdown"]
    done = subprocess.run(line, capture_output=True, text=True, check=True)
    assert "| act | diffusion | difference, points |" in done.stdout
    assert f"act: {folders[0]}, diffusion: {folders[1]}." in done.stdout
    assert "the first less the second" in done.stdout


def test_folders_of_one_name_are_distinguished_without_breaking_their_paths(tmp_path: Path) -> None:
    of_act = [replace(row, policy="act") for row in WORSE]
    kept = [(tmp_path / "a" / "long" / "run", BETTER), (tmp_path / "b" / "long" / "run", of_act)]
    folders = [str(keep(folder, rows)) for folder, rows in kept]
    line = [sys.executable, str(COMPARE), *folders, "tables=markdown"]
    done = subprocess.run(line, capture_output=True, text=True, check=True)
    assert "| A | B |" in done.stdout
    assert f"A: {folders[0]}, B: {folders[1]}." in done.stdout
