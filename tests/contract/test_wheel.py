"""The wheel works without the repository: from an empty folder, beside the installed packages."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from labutopia_lerobot.datasets.verify import find_problems

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def site(tmp_path_factory) -> Path:
    """A fresh folder with nothing but the wheel."""
    folder = tmp_path_factory.mktemp("wheel")
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "-q"]
    build = ["wheel", "--no-deps", "--no-build-isolation", "-w", str(folder), str(ROOT)]
    subprocess.run([*pip, *build], check=True)
    wheel = next(folder.glob("lerobot_env_labutopia-*.whl"))
    assert wheel.stat().st_size < 5_000_000
    target = folder / "site"
    install = ["install", "--no-deps", "--no-index", "--target", str(target), str(wheel)]
    subprocess.run([*pip, *install], check=True)
    return target


def run(site: Path, folder: Path, code: str) -> subprocess.CompletedProcess[str]:
    """Run Python in a folder, with the wheel before everything else."""
    environment = {**os.environ, "PYTHONPATH": str(site), "HF_HUB_OFFLINE": "1"}
    return subprocess.run(
        [sys.executable, "-c", code],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )


def test_the_wheel_holds_the_package_and_nothing_else(site):
    modules = {path.name for path in site.iterdir()} - {"bin", "__pycache__"}
    installed = {name for name in modules if not name.endswith(".dist-info")}
    assert installed == {"labutopia_lerobot", "lerobot_env_labutopia.py"}


def test_the_table_of_compounds_is_in_the_wheel(site, tmp_path):
    code = (
        "from labutopia_lerobot.chemistry import chem_db\n"
        f"assert chem_db.__file__.startswith({str(site)!r})\n"
        "assert chem_db.lookup({'compounds': ['water']})[0]['chemical_formula'] == 'H2O'"
    )
    done = run(site, tmp_path, code)
    assert done.returncode == 0, done.stderr


@pytest.mark.slow
def test_recording_from_an_empty_folder_leaves_a_dataset_and_nothing_else(site, tmp_path):
    code = (
        "import sys, labutopia_lerobot; from labutopia_lerobot.cli.record import main\n"
        f"assert labutopia_lerobot.__file__.startswith({str(site)!r})\n"
        "sys.argv = ['labutopia-record', 'task=level1/pick', 'episodes=1', 'obs=state',"
        " 'workers=1', 'root=pick']\n"
        "if __name__ == '__main__': main()"
    )
    done = run(site, tmp_path, code)
    assert done.returncode == 0, done.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["pick"]
    assert find_problems(tmp_path / "pick") == []


@pytest.mark.slow
def test_evaluating_from_an_empty_folder_takes_configurations_and_recipes_from_the_wheel(
    site, tmp_path
):
    code = (
        "import sys; from labutopia_lerobot.cli.evaluate import main\n"
        "from labutopia_lerobot.runtime.shipped import shipped\n"
        "recipe = shipped('policies') / 'act' / 'train.json'\n"
        f"assert recipe.is_file() and str(recipe).startswith({str(site)!r})\n"
        "sys.argv = ['labutopia-eval', 'task=level1/pick', 'policy=expert', 'episodes=1',"
        " 'workers=1', 'videos=0', 'out=result']\n"
        "if __name__ == '__main__': main()"
    )
    done = run(site, tmp_path, code)
    assert done.returncode == 0, done.stderr
    assert "1/1" in done.stdout
    assert [path.name for path in tmp_path.iterdir()] == ["result"]


def test_lerobot_discovers_the_environment(site, tmp_path):
    code = (
        "from lerobot.utils.import_utils import register_third_party_plugins as register\n"
        "from lerobot.envs.configs import EnvConfig\n"
        "register()\n"
        "import labutopia_lerobot\n"
        f"assert labutopia_lerobot.__file__.startswith({str(site)!r})\n"
        "config = EnvConfig.get_choice_class('labutopia')\n"
        "assert config().task == 'level1/pick'"
    )
    done = run(site, tmp_path, code)
    assert done.returncode == 0, done.stderr


def test_importing_the_package_brings_neither_torch_nor_mujoco(site, tmp_path):
    code = (
        "import sys, labutopia_lerobot\n"
        "heavy = {'torch', 'lerobot', 'mujoco', 'OpenGL'} & set(sys.modules)\n"
        "assert not heavy, heavy"
    )
    done = run(site, tmp_path, code)
    assert done.returncode == 0, done.stderr
