"""What files that others made are damaged copies of."""

import shutil
from pathlib import Path

import pytest

from recordings import recording


@pytest.hookimpl(tryfirst=True)  # before those of a file are kept together (tests/conftest.py)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Keep all tests here in one process: it starts one server that forks (`programs`)."""
    for item in items:
        if item.path.parent == Path(__file__).parent:
            item.add_marker(pytest.mark.xdist_group("hostile"))


@pytest.fixture(scope="session")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A dataset of one episode without pictures."""
    root = tmp_path_factory.mktemp("recorded") / "dataset"
    return recording(root, "task=level1/press", "obs=state", "episodes=1")


@pytest.fixture(scope="session")
def filmed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A dataset of one episode with pictures."""
    root = tmp_path_factory.mktemp("filmed") / "dataset"
    size = ("width=64", "height=48", "cameras=[front]")
    return recording(root, "task=level1/press", "episodes=1", *size)


@pytest.fixture
def dataset(recorded: Path, tmp_path: Path) -> Path:
    """A copy of the dataset without pictures, to be changed."""
    return Path(shutil.copytree(recorded, tmp_path / "dataset"))


@pytest.fixture
def pictured(filmed: Path, tmp_path: Path) -> Path:
    """A copy of the dataset with pictures, to be changed."""
    return Path(shutil.copytree(filmed, tmp_path / "dataset"))
