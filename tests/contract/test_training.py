"""Every training setting is accepted by `lerobot-train` with three flags added, and resumes."""

import subprocess
import sys
from pathlib import Path

import pytest

import tiny_vla

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
SETTINGS = sorted(path.relative_to(ROOT) for path in ROOT.glob("policies/*/train*.json"))
SMALL = {
    # What makes a step of the paper's setting affordable here; nothing that it is about.
    "policies/act/train.json": ["--policy.pretrained_backbone_weights=null"],
    "policies/diffusion/train.json": ["--policy.down_dims=[32,64,128]"],
    # Without it LeRobot refuses any `--policy.` option beside the path in the recipe.
    "policies/smolvla/train.json": [f"--policy.path={tiny_vla.SMOLVLA}"],
    "policies/pi0/train.json": [f"--policy.path={tiny_vla.PI0}"],
}


def run(home: Path, *command: object) -> None:
    program = Path(sys.executable).parent / str(command[0])
    line = [str(program), *map(str, command[1:])]
    environment = tiny_vla.environment(home)
    done = subprocess.run(line, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-3000:]


@pytest.fixture(scope="module")
def datasets(tmp_path_factory, tiny_hub) -> dict[str, Path]:
    """A few demonstrations of each kind; one in ten is held out, so there are ten."""
    folder = tmp_path_factory.mktemp("data")
    for obs in ("state", "pixels"):
        options = ["task=level1/pick", "episodes=10", f"obs={obs}", f"root={folder / obs}"]
        run(tiny_hub, "labutopia-record", *options)
    return {obs: folder / obs for obs in ("state", "pixels")}


@pytest.mark.parametrize("setting", SETTINGS, ids=str)
def test_the_setting_trains_and_resumes(setting, datasets, tiny_hub, tmp_path):
    root = datasets["state" if "state" in setting.name else "pixels"]
    out = tmp_path / "train"
    brief = ["--batch_size=2", "--num_workers=0", "--eval_steps=0"]
    run(
        tiny_hub,
        *("lerobot-train", f"--config_path={ROOT / setting}", "--dataset.repo_id=local/pick"),
        *(f"--dataset.root={root}", f"--output_dir={out}"),
        *("--steps=1", "--policy.device=cpu", *brief, *SMALL.get(str(setting), [])),
    )
    last = out / "checkpoints/last/pretrained_model/train_config.json"
    run(tiny_hub, "lerobot-train", f"--config_path={last}", "--resume=true", "--steps=2")
    assert (out / "checkpoints/last").resolve().name.lstrip("0") == "2"
