"""Every example runs, from a folder that is not its own, and is short."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).parents[2] / "examples"
SCRIPTS = sorted(EXAMPLES.glob("*.py"))
NOTEBOOK = EXAMPLES / "8_all_in_order.ipynb"


def run(folder: Path, script: str, *arguments: str) -> str:
    """Run an example in a folder; return what it prints."""
    done = subprocess.run(
        [sys.executable, str(EXAMPLES / script), *arguments],
        cwd=folder,
        env={**os.environ, "HF_HUB_OFFLINE": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_the_page_lists_every_example_and_each_is_short():
    page = (EXAMPLES / "README.md").read_text()
    assert len([*SCRIPTS, NOTEBOOK]) == 8
    for script in (*SCRIPTS, NOTEBOOK):
        assert f"`{script.name}`" in page
    for script in EXAMPLES.rglob("*.py"):
        assert len(script.read_text().splitlines()) <= 60, script


def test_the_loop_says_what_is_observed_and_how_an_episode_ended(tmp_path):
    told = run(tmp_path, "1_environment_loop.py")
    assert "Observations: Dict('agent_pos'" in told
    assert "gripped after" in told
    assert "Outcome: success, reward 1" in told
    assert "reward 0" in run(tmp_path, "1_environment_loop.py", "--random")


@pytest.mark.slow
def test_a_policy_is_recorded_for_trained_and_evaluated(tmp_path):
    few = ("--demonstrations", "2", "--steps", "2", "--episodes", "2")
    assert "0/2" in run(tmp_path, "2_record_and_train.py", *few)


@pytest.mark.slow
def test_a_network_of_plain_pytorch_copies_and_plays(tmp_path):
    few = ("--demonstrations", "1", "--steps", "20", "--episodes", "1")
    assert "/1 successes, 95 %: " in run(tmp_path, "3_policy_of_your_own.py", *few)


@pytest.mark.slow
def test_a_policy_on_a_server_is_asked(tmp_path):
    told = run(tmp_path, "4_policy_on_a_server.py", "--episodes", "1")
    assert "times: Pick up the conical flask" in told


@pytest.mark.slow
def test_a_task_and_an_instrument_of_ones_own_are_played(tmp_path):
    assert "Seed 0: success" in run(tmp_path, "5_task_of_your_own.py", "--episodes", "1")
    assert "success; wrote mat.png" in run(tmp_path, "6_instrument_of_your_own.py")
    assert (tmp_path / "mat.png").is_file()


@pytest.mark.slow
def test_the_dense_reward_can_be_climbed(tmp_path):
    told = run(tmp_path, "7_reward_for_learning.py", "--generations", "4", "--tries", "10")
    means = [float(line.split()[3].rstrip(",")) for line in told.splitlines()]
    assert means[-1] > means[0]


@pytest.mark.slow
def test_the_notebook_runs_in_its_order(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("HF_HUB_OFFLINE", "1")
    cells = json.loads(NOTEBOOK.read_text())["cells"]
    text = ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]
    assert len(text) >= 8
    assert not any(cell.get("outputs") for cell in cells)
    script = "\n\n".join(text).replace("QUICK = False", "QUICK = True")
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "level1/pick, seed 0: success. Wrote" in done.stdout
