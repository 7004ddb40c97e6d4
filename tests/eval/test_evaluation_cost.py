"""What an evaluation costs over its parts is measured by one command."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parents[2] / "scripts" / "evaluation_cost.py"


@pytest.mark.slow
def test_an_evaluation_is_measured_against_its_parts(tmp_path: Path) -> None:
    options = ["task=level1/pick", "policy=still", "episodes=2"]
    done = subprocess.run(
        [sys.executable, str(SCRIPT), *options], cwd=tmp_path, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    reported = json.loads(done.stdout)
    assert (reported["episodes"], reported["steps"]) == (
        2,
        800,
    )  # nothing happens until the time is up
    assert reported["evaluation_s"] > reported["simulation_s"] > reported["policy_s"]
    assert not list(tmp_path.iterdir())
