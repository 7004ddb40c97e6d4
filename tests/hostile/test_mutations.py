"""A thousand datasets, checkpoints, results and rooms, each with a byte or a value changed."""

import json
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tiny_act
from hostile.programs import run
from hostile.test_checkpoints import arguments
from hostile.test_results import READING, result
from labutopia_lerobot.scenes.plans.shipped_plans import FOLDER

pytestmark = pytest.mark.slow

MUTATIONS = 250
"""Of each kind of file."""

ODD = (None, True, -1, 0, 2**70, 1e300, "", "x", "../../x", [], [[]], {}, {"x": None})


def mutated(content: Any, rng: np.random.Generator) -> Any:
    """Return JSON of which one value is another, missing, or of another type."""
    places = list(_places(content))
    parents, key = places[rng.integers(len(places))]
    parent = content
    for step in parents:
        parent = parent[step]
    if rng.random() < 0.2:
        del parent[key]
    else:
        parent[key] = ODD[rng.integers(len(ODD))]
    return content


def _places(content: Any, above: tuple[Any, ...] = ()) -> Iterator[tuple[tuple[Any, ...], Any]]:
    inner = (
        content.items()
        if isinstance(content, dict)
        else enumerate(content)
        if isinstance(content, list)
        else ()
    )
    for key, value in inner:
        yield above, key
        yield from _places(value, (*above, key))


def flipped(file: Path, rng: np.random.Generator) -> None:
    """Change some bytes of a file, or cut it."""
    content = bytearray(file.read_bytes())
    if rng.random() < 0.2:
        del content[rng.integers(len(content)) :]
    for _ in range(rng.integers(1, 5)):
        if content:
            content[rng.integers(len(content))] = rng.integers(256)
    file.write_bytes(content)


def change(file: Path, rng: np.random.Generator) -> None:
    """Change a file: JSON by a value, anything by bytes."""
    if file.suffix == ".json" and rng.random() < 0.8:
        file.write_text(json.dumps(mutated(json.loads(file.read_text()), rng)))
    else:
        flipped(file, rng)


@pytest.mark.parametrize("seed", range(MUTATIONS))
def test_a_mutated_dataset_is_reported_clearly(seed: int, dataset: Path, tmp_path: Path) -> None:
    rng = np.random.default_rng(seed)
    files = sorted(file for file in dataset.rglob("*") if file.is_file())
    change(files[rng.integers(len(files))], rng)
    clear("verify", "dataset", folder=tmp_path)


@pytest.mark.parametrize("seed", range(MUTATIONS))
def test_a_mutated_checkpoint_is_reported_clearly(seed: int, policy: Path, tmp_path: Path) -> None:
    rng = np.random.default_rng(seed)
    folder = Path(shutil.copytree(policy, tmp_path / "policy"))
    files = sorted(folder.iterdir())
    change(files[rng.integers(len(files))], rng)
    clear("publish", *arguments("publish"), folder=tmp_path)
    clear("evaluate", *arguments("evaluate"), folder=tmp_path)


@pytest.mark.parametrize("seed", range(MUTATIONS))
def test_a_mutated_result_is_reported_clearly(seed: int, tmp_path: Path) -> None:
    rng = np.random.default_rng(seed)
    content = mutated(result() | {"actions": [{}] * 3}, rng)
    (tmp_path / "result").mkdir()
    (tmp_path / "result/result.json").write_text(json.dumps(content))
    for program, words in READING.items():
        clear(program, *words, folder=tmp_path)


@pytest.mark.parametrize("seed", range(MUTATIONS))
def test_a_mutated_room_is_reported_clearly(seed: int, tmp_path: Path) -> None:
    rng = np.random.default_rng(seed)
    plan = json.loads((FOLDER / "organic_7.json").read_text())
    (tmp_path / "room.json").write_text(json.dumps(mutated(plan, rng)))
    clear("scene", "check", "room.json", folder=tmp_path)


@pytest.fixture(scope="module")
def policy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tiny_act.save(tmp_path_factory.mktemp("policy") / "policy", privileged=21)


def clear(program: str, *words: str, folder: Path) -> None:
    """Make sure that a program ends, with a sentence, and does no harm."""
    ended = run(program, *words, folder=folder, limit_s=60.0)
    assert ended.status in (0, 1, 2), ended
    assert "Traceback" not in ended.output, ended.output
    assert ended.harmless, ended
