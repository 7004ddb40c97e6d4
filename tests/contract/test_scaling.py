"""What stands still in all demonstrations is not blown up where a policy scales a state."""

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
import torch
from lerobot.configs.types import FeatureType, NormalizationMode, PolicyFeature
from lerobot.processor import NormalizerProcessorStep, TransitionKey
from numpy.typing import NDArray

from labutopia_lerobot.datasets.declaration import ENVIRONMENT_STATE, STATE
from labutopia_lerobot.datasets.description import INFO, STATISTICS, read_info, read_statistics
from labutopia_lerobot.datasets.scaling import SCALED, widened
from labutopia_lerobot.datasets.tables import column, frames_of_episodes, read_episodes
from labutopia_lerobot.datasets.verify import verify
from labutopia_lerobot.scenario.privileged_state import least_span
from recordings import recording

HEATED = ["task=level2/heat_beaker", "obs=state", "episodes=2", "liquid=off", "seed=20"]
SPREAD = ["min", "max", "std", "q01", "q10", "q90", "q99"]


@pytest.fixture(scope="module")
def heated(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return recording(tmp_path_factory.mktemp("scaling") / "heated", *HEATED)


def names_of(root: Path, key: str) -> list[str]:
    return list(read_info(root)["features"][key]["names"])


def frames_of(root: Path, key: str) -> NDArray[np.float64]:
    tables = frames_of_episodes(root, read_episodes(root))
    return np.concatenate([column(frames, key) for _, frames in tables]).astype(float)


def scaled(root: Path, state: NDArray[np.float64], mode: NormalizationMode) -> NDArray[np.float64]:
    """Return a state as LeRobot's policies are given it."""
    statistics = {
        key: {name: np.array(values) for name, values in said.items()}
        for key, said in read_statistics(root).items()
        if key in SCALED
    }
    normalizer = NormalizerProcessorStep(
        features={ENVIRONMENT_STATE: PolicyFeature(FeatureType.ENV, state.shape)},
        norm_map={FeatureType.ENV: mode},
        stats=statistics,
    )
    observation = {ENVIRONMENT_STATE: torch.tensor(state)}
    transition = normalizer({TransitionKey.OBSERVATION: observation})
    return np.array(transition[TransitionKey.OBSERVATION][ENVIRONMENT_STATE].numpy())


MODES = [NormalizationMode.MIN_MAX, NormalizationMode.MEAN_STD, NormalizationMode.QUANTILES]


@pytest.mark.parametrize("mode", MODES, ids=[mode.value for mode in MODES])
def test_a_centimetre_is_little_to_a_policy_whatever_stood_still(
    mode: NormalizationMode, heated: Path
) -> None:
    names, frames = names_of(heated, ENVIRONMENT_STATE), frames_of(heated, ENVIRONMENT_STATE)
    still = frames.max(axis=0) - frames.min(axis=0) < 1e-6
    assert still.sum() > 5  # such as how high the hot plate stands
    moved = frames[0] + [0.1 * least_span(name) for name in names]
    change = scaled(heated, moved, mode) - scaled(heated, frames[0], mode)
    assert np.abs(change).max() < 0.5


def test_what_varies_has_its_own_statistics(heated: Path) -> None:
    for key in SCALED:
        names, frames = names_of(heated, key), frames_of(heated, key)
        said = {name: np.array(values) for name, values in read_statistics(heated)[key].items()}
        assert (frames.min(axis=0) >= said["min"] - 1e-6).all()
        assert (frames.max(axis=0) <= said["max"] + 1e-6).all()
        wide = frames.max(axis=0) - frames.min(axis=0) > [least_span(name) for name in names]
        assert wide.any()
        assert np.allclose(said["min"][wide], frames.min(axis=0)[wide])
        assert np.allclose(said["max"][wide], frames.max(axis=0)[wide])
        assert np.allclose(said["mean"], frames.mean(axis=0), atol=1e-4)


def test_what_is_widened_stays_as_it_is() -> None:
    names = ["x", "lamp.lit", "beaker.solid"]
    once = widened({name: np.zeros(3) for name in ("mean", *SPREAD)}, names)
    assert np.allclose(once["max"] - once["min"], [0.1, 1.0, 1e-4])
    assert np.allclose(once["std"], (once["max"] - once["min"]) / np.sqrt(12))
    twice = widened(once, names)
    assert all(np.allclose(twice[name], once[name], rtol=1e-12) for name in once)


@pytest.mark.parametrize("names", [None, {"motors": ["joint1"]}, ["joint1"]], ids=repr)
def test_a_state_that_others_named_is_read(
    names: list[str] | dict[str, list[str]] | None, heated: Path, tmp_path: Path
) -> None:
    root = Path(shutil.copytree(heated, tmp_path / "foreign"))
    info = json.loads((root / INFO).read_text())
    info["features"][ENVIRONMENT_STATE]["names"] = names
    (root / INFO).write_text(json.dumps(info))
    faults = verify(root, 0).faults
    assert any(f"names of {ENVIRONMENT_STATE}" in fault for fault in faults)
    assert not any("cannot be read" in fault for fault in faults)


@pytest.mark.parametrize("statistic", SPREAD)
def test_statistics_that_are_wider_than_that_are_found(statistic: str, tmp_path: Path) -> None:
    root = recording(tmp_path / "heated", *HEATED[:2], "liquid=off", "episodes=1", "seed=20")
    assert not verify(root, 0).faults
    statistics = read_statistics(root)
    outwards = -0.2 if statistic in ("min", "q01", "q10") else 0.2
    statistics[STATE][statistic] = (np.array(statistics[STATE][statistic]) + outwards).tolist()
    (root / STATISTICS).write_text(json.dumps(statistics))
    assert verify(root, 0).faults == [
        f"{STATISTICS}: {statistic} of {STATE} is not that of the frames"
    ]
