import shutil
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import tiny_vla
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.setting import Setting
from recordings import FILM, PICK, recording


@pytest.hookimpl(tryfirst=True)  # before those of a file are kept together (tests/conftest.py)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Keep files that look at the recording with pictures in one process, which makes it once."""
    looking = {item.path for item in items if "filmed" in getattr(item, "fixturenames", ())}
    for item in items:
        if item.path in looking and item.path.parent == Path(__file__).parent:
            item.add_marker(pytest.mark.xdist_group("filmed"))


@pytest.fixture(scope="session")
def solution() -> list[NDArray[np.float32]]:
    """What the expert commands in the episode of seed 0 of `level1/pick`, until it succeeds."""
    env = LabEnv(Setting("level1/pick", obs="state"))
    env.reset(seed=0)
    expert = env.expert()
    expert.start()
    actions = []
    over = False
    while not over:
        actions.append(expert.act())
        _, _, terminated, truncated, _ = env.step(actions[-1])
        over = terminated or truncated
    return actions


@pytest.fixture(scope="session")
def picked(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A finished recording without pictures."""
    return recording(tmp_path_factory.mktemp("picked") / "dataset", *PICK)


@pytest.fixture(scope="session")
def filmed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A finished recording with pictures."""
    return recording(tmp_path_factory.mktemp("filmed") / "dataset", *FILM)


@pytest.fixture
def copied(filmed: Path, tmp_path: Path) -> Path:
    """A copy of the recording with pictures, to be damaged."""
    return Path(shutil.copytree(filmed, tmp_path / "copy"))


@pytest.fixture(scope="session")
def tiny_hub(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A cache of the Hub with tiny models under the names of the real ones."""
    return tiny_vla.build(tmp_path_factory.mktemp("hub") / "home")
