"""The expert's rows in eval/results are what this build plays."""

from dataclasses import asdict, replace
from typing import Any

import pytest

import expert_rows
import make_results
from labutopia_lerobot.evaluation.condition import EXPERT
from labutopia_lerobot.evaluation.jobs import EvaluationJob
from labutopia_lerobot.evaluation.policies import ExpertPolicy
from labutopia_lerobot.evaluation.rollout import play
from labutopia_lerobot.evaluation.rows import Row
from labutopia_lerobot.registry import task_files
from labutopia_lerobot.setting import Setting

QUICK = ("level1/pick", "level2/pour_liquid", "level3/pick_sizes")
"""Tasks of `make test`: one of each level below the longest, one of them with liquid."""

NEWER = {"readings", "solutions", "unwanted_contacts"}
"""Columns that rows of earlier versions lack."""


def _slow(*values: Any, name: str) -> Any:
    """Return a parameter of `make test-slow`."""
    return pytest.param(*values, marks=pytest.mark.slow, id=name)


def _tasks() -> list[Any]:
    """Return every task; most are `make test-slow`."""
    return [task if task in QUICK else _slow(task, name=task) for task in task_files()]


def _shifted() -> list[Any]:
    """Return every task of which rows of `ood` are measured."""
    tasks = expert_rows.read(expert_rows.RESULTS, expert_rows.OOD)
    return [_slow(task, name=f"{task} ood") for task in tasks]


def _others() -> list[Any]:
    """Return the expert's measured evaluations with other robots and in other rooms."""
    experiments = ("other_robots", "expert_elsewhere")
    results = make_results.measured(*experiments, learned=False).results
    return [_slow(each, result.rows[0], name=each.name) for each, result in results.items()]


@pytest.mark.parametrize("task", _tasks())
def test_a_committed_row_played_again_is_the_same_row(task):
    assert_played_again(expert_rows.read(expert_rows.RESULTS)[task][0])


@pytest.mark.parametrize("task", _shifted())
def test_a_committed_row_of_ood_played_again_is_the_same_row(task):
    assert_played_again(expert_rows.read(expert_rows.RESULTS, expert_rows.OOD)[task][0])


@pytest.mark.parametrize(("evaluation", "row"), _others())
def test_a_committed_row_of_the_expert_elsewhere_played_again_is_the_same_row(evaluation, row):
    assert_played_again(row, axes=evaluation.shift.axes, **dict(evaluation.options))


def assert_played_again(committed: Row, **options: Any) -> None:
    setting = Setting(committed.task, split=committed.split, obs="state", **options)
    job = EvaluationJob(setting, EXPERT, ExpertPolicy)
    played = replace(play(job, committed.seed).row, facts={}, history={})
    expected, actual = asdict(committed), asdict(played)
    for column in NEWER:
        if not expected[column]:
            del expected[column], actual[column]
    if expected["driving"]:  # rows of earlier versions say less about the way
        actual["driving"] = {name: actual["driving"][name] for name in expected["driving"]}
    # Exponentials and logarithms differ from processor to processor in their last digit; rows of
    # earlier versions have no species.
    for vessel, numbers in expected.pop("solutions", {}).items():
        again = {name: actual["solutions"][vessel][name] for name in numbers}
        assert again == pytest.approx(numbers, rel=1e-6)
    actual.pop("solutions", None)
    # So do products of matrices: a kernel for AVX-512 sums in another order than one for AVX2.
    where = {name: expected[name] for name in ("mm_off_place", "deg_off_place")}
    assert {name: actual[name] for name in where} == pytest.approx(where, rel=1e-4)
    assert actual | where == expected
