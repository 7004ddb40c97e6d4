"""Two results on common seeds."""

import json
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from scipy.stats import binomtest

from labutopia_lerobot.evaluation.compare import POOLED, NothingCommonError, compare

from .written_rows import keep, written

COMPARE = Path(__file__).parents[2] / "eval" / "compare.py"

BETTER = written("level1/pick", "act", 0.9) + written("level2/pour_liquid", "act", 0.9, luck=1)
WORSE = [
    *written("level1/pick", "diffusion", 0.6, luck=2),
    *written("level2/pour_liquid", "diffusion", 0.6, luck=3),
]


def test_only_where_they_differ_counts() -> None:
    pick, pour, pooled = compare(BETTER, WORSE)
    assert (pick.task, pour.task, pooled.task) == ("level1/pick", "level2/pour_liquid", POOLED)
    mine, theirs = BETTER[:120], WORSE[:120]
    only = [(a.success, b.success) for a, b in zip(mine, theirs, strict=True)]
    assert (pick.pairs.first, pick.pairs.second) == (
        only.count((True, False)),
        only.count((False, True)),
    )
    total = pick.pairs.first + pick.pairs.second
    assert pick.told["p_value"] == pytest.approx(binomtest(pick.pairs.first, total).pvalue)
    assert pooled.pairs == pick.pairs + pour.pairs
    assert pick.p_value_holm >= pick.pairs.p_value


def test_only_common_seeds_are_compared() -> None:
    (found,) = compare(BETTER[:50], WORSE[30:120])
    assert found.pairs.n == 20


def test_a_policy_is_as_good_as_itself() -> None:
    for found in compare(BETTER, BETTER):
        assert found.told["difference"] == 0.0
        assert found.told["p_value"] == 1.0


def test_results_without_a_common_episode_are_refused() -> None:
    with pytest.raises(NothingCommonError, match="no episode in common"):
        compare(BETTER[:50], WORSE[60:120])
    with pytest.raises(NothingCommonError, match="twice"):
        compare(BETTER[:5] + WORSE[:5], WORSE)
    other = [replace(row, drawn={"light": "dim"}) for row in WORSE]
    with pytest.raises(NothingCommonError, match="not the same scene"):
        compare(BETTER, other)


def test_the_program_tells_p_values_as_json_and_a_table(tmp_path: Path) -> None:
    folders = [str(keep(tmp_path / name, rows)) for name, rows in (("act", BETTER), ("dp", WORSE))]
    line = [sys.executable, str(COMPARE), *folders]
    done = subprocess.run([*line, "--json"], capture_output=True, text=True, check=True)
    told = json.loads(done.stdout)["comparisons"]
    assert [line["task"] for line in told] == ["level1/pick", "level2/pour_liquid", POOLED]
    for entry in told:
        assert 0.0 <= entry["p_value"] <= entry["p_value_holm"] <= 1.0
        assert entry["difference95"][0] < entry["difference"] < entry["difference95"][1]
