"""Our evaluator and `lerobot-eval` tell the same of the same checkpoint, seed by seed."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from labutopia_lerobot.evaluation.config import EvaluationConfig
from labutopia_lerobot.runtime.video import video_size_and_frames

pytestmark = pytest.mark.slow

EPISODES = 8
SEED = EvaluationConfig.__dataclass_fields__["seed"].default


def run(*command: object) -> None:
    """Run a program of the environment, offline and on one thread, as our workers do."""
    environment = {**os.environ, "HF_HUB_OFFLINE": "1", "OMP_NUM_THREADS": "1"}
    program = Path(sys.executable).parent / str(command[0])
    done = subprocess.run(
        [str(program), *map(str, command[1:])],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr[-3000:]


@pytest.fixture(scope="module")
def brief(tmp_path_factory) -> tuple[Path, list[dict]]:
    """A checkpoint of a brief training, however well it does, and its rows."""
    folder = tmp_path_factory.mktemp("parity")
    data, train = folder / "data", folder / "train"
    run("labutopia-record", "task=level1/pick", "obs=state", "episodes=60", f"root={data}")
    run(
        *("lerobot-train", "--config_path=policies/act/train_state.json"),
        *("--dataset.repo_id=local/pick", f"--dataset.root={data}", f"--output_dir={train}"),
        *("--steps=700", "--eval_steps=0", "--num_workers=1"),
    )
    checkpoint = train / "checkpoints" / "last" / "pretrained_model"
    run(
        *("python", "eval/run.py", "task=level1/pick", "policy=act", f"out={folder / 'eval'}"),
        *(f"policy.path={checkpoint}", f"episodes={EPISODES}", "videos=0"),
    )
    return checkpoint, json.loads((folder / "eval" / "result.json").read_text())["rows"]


def test_success_and_length_equal_those_of_lerobot_eval_seed_by_seed(brief, tmp_path):
    checkpoint, rows = brief
    run(
        *("lerobot-eval", f"--policy.path={checkpoint}", "--policy.device=cpu"),
        *("--env.type=labutopia", "--env.task=level1/pick", "--env.obs=state", "--env.split=id"),
        *("--eval.batch_size=1", f"--eval.n_episodes={EPISODES}", f"--seed={SEED}"),
        f"--output_dir={tmp_path}",
    )
    reported = json.loads((tmp_path / "eval_info.json").read_text())["per_task"][0]["metrics"]
    assert reported["successes"] == [row["success"] for row in rows]
    # A film shows the state before every step that was played, and nothing after the last one.
    films = [tmp_path / "videos" / "level1_pick" / f"eval_episode_{i}.mp4" for i in range(EPISODES)]
    assert [video_size_and_frames(film)[2] for film in films] == [row["steps"] for row in rows]
