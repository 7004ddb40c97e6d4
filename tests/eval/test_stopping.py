"""A run that stops by what it has seen: the same rows for any number of workers and order."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from rich.console import Console

from labutopia_lerobot.evaluation.compare import NoCommonEpisodesError, played_episodes
from labutopia_lerobot.evaluation.config import EvaluationConfig, EvaluationOptionError
from labutopia_lerobot.evaluation.config import PolicyConfig as Policy
from labutopia_lerobot.evaluation.jobs import make_jobs
from labutopia_lerobot.evaluation.load_results import LoadedResult, load_results
from labutopia_lerobot.evaluation.origin import origin
from labutopia_lerobot.evaluation.result_folder import OccupiedFolderError, claim
from labutopia_lerobot.evaluation.rows import UnreadableResultError
from labutopia_lerobot.evaluation.run import run
from labutopia_lerobot.evaluation.stopping import SequentialMonitor, StoppingRule, find_rival
from labutopia_lerobot.evaluation.uncertainty.intervals import PrecisionError

from .written_rows import keep, written

ROWS = written("level1/pick", "act", 0.95, n=400)
PICK = ROWS[0].condition
RULE = StoppingRule(0.1)


def first_enough(rule: StoppingRule, successes: Sequence[bool]) -> int:
    """Return after how many episodes it is enough, looking back from the end of them all."""
    wins = np.cumsum(successes)
    return 1 + int(rule.enough(wins, np.arange(1, len(wins) + 1)).argmax())


def test_the_order_in_which_episodes_are_finished_decides_nothing() -> None:
    kept = []
    for order in (ROWS, ROWS[::-1], ROWS[1::2] + ROWS[::2]):
        monitor = SequentialMonitor(RULE, 100_000)
        for row in order:
            monitor.note(row)
        assert monitor.enough(PICK)
        kept.append([row.seed for row in ROWS if monitor.counts(row)])
    assert kept[0] == kept[1] == kept[2]
    assert len(kept[0]) == first_enough(RULE, [row.success for row in ROWS])


def test_a_gap_in_the_seeds_is_waited_for() -> None:
    monitor = SequentialMonitor(RULE, 100_000)
    for row in ROWS[1:]:
        monitor.note(row)
    assert not monitor.enough(PICK)
    monitor.note(ROWS[0])
    assert monitor.enough(PICK)


def test_tasks_splits_and_ways_of_playing_are_enough_each_by_itself() -> None:
    monitor = SequentialMonitor(RULE, 100_000)
    for row in ROWS:
        monitor.note(row)
    assert not monitor.enough(replace(PICK, split="ood"))
    assert monitor.counts(replace(ROWS[-1], split="ood"))
    assert monitor.counts(replace(ROWS[-1], play="staged"))


def test_without_a_rule_every_episode_is_played() -> None:
    monitor = SequentialMonitor(None, 100_000)
    for row in ROWS:
        monitor.note(row)
    assert not monitor.enough(PICK)
    assert all(monitor.counts(row) for row in ROWS)


def test_a_rival_on_the_same_seeds_is_distinguished() -> None:
    rival = written("level1/pick", "diffusion", 0.3, n=400, luck=1)
    played = played_episodes([LoadedResult(Path("dp"), True, tuple(rival), {})])
    monitor = SequentialMonitor(StoppingRule(0.02), 100_000, played)
    for row in ROWS:
        monitor.note(row)
    assert monitor.enough(PICK)
    assert sum(map(monitor.counts, ROWS)) < 60


def test_every_episode_is_looked_at_once() -> None:
    looked: list[int] = []

    class Watched(StoppingRule):
        def enough(self, successes, n, better=0, worse=0):  # type: ignore[no-untyped-def]
            looked.append(n)
            return super().enough(successes, n, better, worse)

    monitor = SequentialMonitor(Watched(0.001), 100_000)
    for row in ROWS[1::2] + ROWS[::2]:
        monitor.note(row)
    assert looked == list(range(1, len(ROWS) + 1))


def test_what_a_policy_sees_of_a_scene_does_not_keep_it_from_being_distinguished() -> None:
    lost = [replace(row, policy="dp", obs="state", success=False) for row in ROWS]
    rival = played_episodes([LoadedResult(Path("dp"), True, tuple(lost), {})])
    monitor = SequentialMonitor(StoppingRule(0.01), 100_000, rival)
    for row in ROWS[:40]:
        monitor.note(row)
    assert monitor.enough(PICK)


def test_a_rival_that_met_another_scene_under_the_same_seed_stops_the_run() -> None:
    other = [replace(ROWS[0], drawn={"light": "dim"})]
    rival = played_episodes([LoadedResult(Path("dp"), True, tuple(other), {})])
    with pytest.raises(NoCommonEpisodesError, match="not the same scene"):
        SequentialMonitor(RULE, 100_000, rival).note(ROWS[0])


@pytest.mark.parametrize(
    "columns",
    [
        {"robot": "iiwa"},
        {"room": "organic_7"},
        {"liquid": "off"},
        {"axes": ["light"]},
        {"split": "ood"},
        {"step": "pick"},
        {"play": "staged"},
        {"seed": 5},
    ],
)
def test_a_rival_that_played_otherwise_is_refused_before_anything_is_played(
    tmp_path: Path, columns: dict[str, object]
) -> None:
    rows = [replace(ROWS[0], policy="dp", **columns)]  # type: ignore[arg-type]
    place = keep(tmp_path / "dp", rows)
    with pytest.raises(NoCommonEpisodesError) as refusal:
        run(config(tmp_path / "out", until=0.1, versus=str(place)), Console(quiet=True))
    reported = str(refusal.value)
    assert f"versus={place} has no episode of level1/pick ID, seeds 100000 to 100029" in reported
    assert f"It holds: {rows[0].condition.scene.description}, seed {rows[0].seed}." in reported
    assert not (tmp_path / "out").exists()


def test_a_rival_of_several_policies_or_none_is_refused(tmp_path: Path) -> None:
    keep(tmp_path / "both" / "act", ROWS[:3])
    keep(tmp_path / "both" / "dp", written("level3/pick", "dp", 0.5, n=3))
    with pytest.raises(NoCommonEpisodesError, match=r"several policies: act, dp .*level3/pick ID"):
        find_rival(tmp_path / "both", [PICK], range(100_000, 100_003))
    keep(tmp_path / "both" / "again", [replace(row, policy="dp") for row in ROWS[:3]])
    with pytest.raises(NoCommonEpisodesError, match="is there twice"):
        find_rival(tmp_path / "both", [PICK], range(100_000, 100_003))
    with pytest.raises(UnreadableResultError, match="holds neither"):
        find_rival(tmp_path / "nothing", [PICK], range(100_000, 100_003))


def test_a_rival_that_has_changed_does_not_go_on_with_it(tmp_path: Path) -> None:
    options = config(tmp_path / "out", until=0.1, versus="dp")
    jobs, seeds = make_jobs(options), range(100_000, 100_030)
    place = keep(tmp_path / "dp", ROWS[:9])
    with claim(tmp_path / "out", origin(options, jobs, find_rival(place, [PICK], seeds))):
        pass
    with claim(tmp_path / "out", origin(options, jobs, find_rival(place, [PICK], seeds))):
        pass
    first = replace(ROWS[0], success=not ROWS[0].success)
    changed = keep(tmp_path / "changed", [first, *ROWS[1:9]])
    other = origin(options, jobs, find_rival(changed, [PICK], seeds))
    refused = pytest.raises(OccupiedFolderError, match=r"rival_sha256: '\w{64}' there")
    with refused, claim(tmp_path / "out", other):
        pass


def config(out: Path, **options: object) -> EvaluationConfig:
    chosen = {"task": "level1/pick", "obs": "state", "videos": 0, "episodes": 30, "workers": 2}
    return EvaluationConfig(policy=Policy("still"), out=str(out), **(chosen | options))  # type: ignore[arg-type]


@pytest.mark.slow
def test_a_run_stops_by_itself_whatever_the_number_of_workers(tmp_path: Path) -> None:
    found = []
    for workers in (1, 2):
        run(config(tmp_path / str(workers), until=0.2, workers=workers), Console(quiet=True))
        (result,) = load_results(tmp_path / str(workers))
        found.append([replace(row, device=None) for row in result.rows])
    assert found[0] == found[1]
    assert len(found[0]) == first_enough(StoppingRule(0.2), [False] * 30)


def test_the_cost_of_a_precision_is_reported_and_nothing_is_played(tmp_path: Path) -> None:
    console = Console(record=True, width=120, quiet=False)
    assert run(config(tmp_path / "out", episodes_for=0.05), console) is None
    reported = console.export_text()
    assert "381" in reported
    assert "plus or minus 5 points" in reported
    assert not (tmp_path / "out").exists()


def test_impossible_ways_to_stop_are_refused(tmp_path: Path) -> None:
    with pytest.raises(PrecisionError, match="half width"):
        config(tmp_path, until=0.9).check()
    with pytest.raises(EvaluationOptionError, match="versus= needs until="):
        config(tmp_path, versus="somewhere").check()
