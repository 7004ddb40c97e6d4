"""A run that stops by what it has seen: the same rows for any number of workers and order."""

from dataclasses import replace
from pathlib import Path

import pytest
from rich.console import Console

from labutopia_lerobot.evaluation.config import EvaluationConfig, EvaluationOptionError
from labutopia_lerobot.evaluation.config import PolicyConfig as Policy
from labutopia_lerobot.evaluation.found import find_results
from labutopia_lerobot.evaluation.run import run
from labutopia_lerobot.evaluation.stopping import Seen, StoppingRule
from labutopia_lerobot.evaluation.uncertainty.planning import PrecisionError

from .written_rows import written

ROWS = written("level1/pick", "act", 0.95, n=400)
RULE = StoppingRule(0.1)


def test_the_order_in_which_episodes_are_finished_decides_nothing() -> None:
    kept = []
    for order in (ROWS, ROWS[::-1], ROWS[1::2] + ROWS[::2]):
        seen = Seen(RULE, 100_000)
        for row in order:
            seen.note(row)
        assert seen.enough(("level1/pick", "id", "single"))
        kept.append([row.seed for row in ROWS if seen.counts(row)])
    assert kept[0] == kept[1] == kept[2]
    assert len(kept[0]) == RULE.enough([row.success for row in ROWS])


def test_a_gap_in_the_seeds_is_waited_for() -> None:
    seen = Seen(RULE, 100_000)
    for row in ROWS[1:]:
        seen.note(row)
    assert not seen.enough(("level1/pick", "id", "single"))
    seen.note(ROWS[0])
    assert seen.enough(("level1/pick", "id", "single"))


def test_tasks_splits_and_ways_of_playing_are_enough_each_by_itself() -> None:
    seen = Seen(RULE, 100_000)
    for row in ROWS:
        seen.note(row)
    assert not seen.enough(("level1/pick", "ood", "single"))
    assert seen.counts(replace(ROWS[-1], split="ood"))
    assert seen.counts(replace(ROWS[-1], play="staged"))


def test_without_a_rule_every_episode_is_played() -> None:
    seen = Seen(None, 100_000)
    for row in ROWS:
        seen.note(row)
    assert not seen.enough(("level1/pick", "id", "single"))
    assert all(seen.counts(row) for row in ROWS)


def test_a_rival_on_the_same_seeds_is_told_apart_from() -> None:
    rival = written("level1/pick", "diffusion", 0.3, n=400, luck=1)
    seen = Seen(StoppingRule(0.02), 100_000, rival)
    for row in ROWS:
        seen.note(row)
    assert seen.enough(("level1/pick", "id", "single"))
    assert sum(map(seen.counts, ROWS)) < 60


def config(out: Path, **options: object) -> EvaluationConfig:
    chosen = {"task": "level1/pick", "obs": "state", "videos": 0, "episodes": 30, "workers": 2}
    return EvaluationConfig(policy=Policy("still"), out=str(out), **(chosen | options))  # type: ignore[arg-type]


@pytest.mark.slow
def test_a_run_stops_by_itself_whatever_the_number_of_workers(tmp_path: Path) -> None:
    found = []
    for workers in (1, 2):
        run(config(tmp_path / str(workers), until=0.2, workers=workers), Console(quiet=True))
        (result,) = find_results(tmp_path / str(workers))
        found.append([replace(row, device=None) for row in result.rows])
    assert found[0] == found[1]
    assert len(found[0]) == StoppingRule(0.2).enough([False] * 30)


def test_the_cost_of_a_precision_is_told_and_nothing_is_played(tmp_path: Path) -> None:
    console = Console(record=True, width=120, quiet=False)
    assert run(config(tmp_path / "out", episodes_for=0.05), console) is None
    told = console.export_text()
    assert "381" in told
    assert "plus or minus 5 points" in told
    assert not (tmp_path / "out").exists()


def test_impossible_ways_to_stop_are_refused(tmp_path: Path) -> None:
    with pytest.raises(PrecisionError, match="half width"):
        config(tmp_path, until=0.9).check()
    with pytest.raises(EvaluationOptionError, match="versus= needs until="):
        config(tmp_path, versus="somewhere").check()
