import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.vector import LabVectorEnv

SEEDS = range(4)
STEPS = 40


@contextmanager
def playing(num_envs: int, asynchronous: bool = False, **options: Any) -> Iterator[LabVectorEnv]:
    envs = LabVectorEnv(
        Setting("level1/pick", **{"obs": "state"} | options), num_envs, asynchronous
    )
    try:
        yield envs
    finally:
        envs.close()


def actions_of(seed: int, steps: int) -> NDArray[np.float32]:
    space = LabEnv(Setting("level1/pick", obs="state")).action_space
    rng = np.random.default_rng(seed)
    return rng.uniform(space.low, space.high, (steps, *space.shape)).astype(np.float32)


def flat(observation: dict[str, Any]) -> list[NDArray[Any]]:
    """Return the arrays of an observation in a fixed order."""
    return [
        array
        for key in sorted(observation)
        for array in (
            flat(observation[key]) if isinstance(observation[key], dict) else [observation[key]]
        )
    ]


def episodes(
    batch: int, asynchronous: bool, steps: int, **options: Any
) -> dict[int, list[NDArray[Any]]]:
    """Return what each seed's episode shows: all observations, then its last picture."""
    shown: dict[int, list[NDArray[Any]]] = {seed: [] for seed in SEEDS}
    with playing(batch, asynchronous, **options) as envs:
        for first in range(0, len(SEEDS), batch):
            seeds = list(SEEDS[first : first + batch])
            actions = np.stack([actions_of(seed, steps) for seed in seeds])
            observations, _ = envs.reset(seed=list(seeds))
            for step in range(steps + 1):
                for member, seed in enumerate(seeds):
                    shown[seed] += [array[member].copy() for array in flat(observations)]
                if step < steps:
                    observations, *_ = envs.step(actions[:, step])
            for seed, picture in zip(seeds, envs.render(), strict=True):
                shown[seed].append(picture)
    return shown


@pytest.mark.parametrize(
    "options",
    [
        pytest.param({"obs": "state"}, id="state"),
        pytest.param(
            {"obs": "pixels", "width": 64, "height": 64}, id="pixels", marks=pytest.mark.slow
        ),
    ],
)
@pytest.mark.parametrize(
    "batches",
    [
        pytest.param([(4, False), (4, True)], id="of_all"),
        pytest.param([(2, False), (1, True), (2, True)], id="of_fewer", marks=pytest.mark.slow),
    ],
)
def test_an_episode_is_the_same_bit_for_bit_in_every_batch_and_process(
    options: dict[str, Any], batches: list[tuple[int, bool]]
) -> None:
    alone = episodes(1, False, STEPS, **options)
    assert not np.array_equal(alone[0][0], alone[1][1])
    for batch, asynchronous in batches:
        together = episodes(batch, asynchronous, STEPS, **options)
        for seed in SEEDS:
            pairs = zip(alone[seed], together[seed], strict=True)
            assert all(np.array_equal(one, other) for one, other in pairs)


@pytest.mark.parametrize("asynchronous", [False, True])
def test_a_member_whose_episode_is_over_stays_over(
    asynchronous: bool, solution: list[NDArray[np.float32]]
) -> None:
    with playing(2, asynchronous) as envs:
        observations, _ = envs.reset(seed=[0, 1])
        still = observations["agent_pos"][1]
        rewards = np.zeros(2)
        for action in solution:
            observations, reward, terminated, _, infos = envs.step(np.stack([action, still]))
            rewards += reward
        assert terminated.tolist() == [True, False]
        end = observations["environment_state"][0].copy()
        for _ in range(5):
            observations, reward, terminated, truncated, infos = envs.step(np.stack([still, still]))
            rewards += reward
            assert terminated.tolist() == [True, False]
            assert not truncated.any()
            assert np.array_equal(observations["environment_state"][0], end)
            assert infos["is_success"].tolist() == [True, False]
            assert infos["outcome"].tolist() == ["success", "running"]
        assert rewards.tolist() == [1.0, 0.0]

        _, infos = envs.reset()
        assert infos["outcome"].tolist() == ["running", "running"]
        _, _, terminated, _, _ = envs.step(np.stack([still, still]))
        assert not terminated.any()


@pytest.mark.parametrize("asynchronous", [False, True])
def test_info_survives_vectorisation(asynchronous: bool) -> None:
    env = LabEnv(Setting("level1/pick", obs="state"))
    with playing(2, asynchronous) as envs:
        _, infos = envs.reset(seed=[5, 6])
        for member, seed in enumerate([5, 6]):
            _, info = env.reset(seed=seed)
            assert infos["seed"][member] == seed
            assert infos["is_success"].dtype == bool
            for name, holds in info["facts"].items():
                assert infos["facts"][name].dtype == bool
                assert infos["facts"][name][member] == holds
            for name in info["substeps"]:
                assert np.isinf(infos["substeps"][name][member])
            assert np.array_equal(infos["applied_action"][member], info["applied_action"])


def test_nothing_starts_before_the_first_reset() -> None:
    envs = LabVectorEnv(Setting("level1/pick", obs="state"), 2)
    assert envs._members is None
    assert envs.observation_space["agent_pos"].shape == (2, 8)
    assert envs.action_space.shape == (2, 8)
    envs.close()


def test_a_closed_vector_starts_again() -> None:
    with playing(1) as envs:
        first, _ = envs.reset(seed=3)
        envs.close()
        again, _ = envs.reset(seed=3)
        assert np.array_equal(first["environment_state"], again["environment_state"])


@pytest.mark.slow
def test_workers_load_no_torch_even_where_the_main_program_does(tmp_path: Path) -> None:
    program = tmp_path / "program.py"  # without a guard: workers must not run it again
    program.write_text(
        "import multiprocessing, pathlib, torch\n"
        "from labutopia_lerobot.vector import LabVectorEnv\n"
        "from labutopia_lerobot.setting import Setting\n"
        "envs = LabVectorEnv(Setting('level1/pick', obs='state'), 2)\n"
        "envs.reset(seed=0)\n"
        "workers = multiprocessing.active_children()\n"
        "maps = [pathlib.Path(f'/proc/{one.pid}/maps').read_text() for one in workers]\n"
        "assert ['libmujoco' in text for text in maps] == [True, True]\n"
        "assert ['libtorch' in text for text in maps] == [False, False]\n"
        "envs.close()\n"
    )
    subprocess.run([sys.executable, str(program)], check=True)


@pytest.mark.parametrize("asynchronous", [False, True])
def test_a_masked_reset_leaves_the_others_ended(asynchronous: bool) -> None:
    with playing(2, asynchronous) as envs:
        envs.reset(seed=[0, 1])
        still = np.stack([PANDA.start] * 2).astype(np.float32)
        limit = canonical_task(Setting("level1/pick")).max_steps
        for _ in range(limit):
            *_, truncated, _ = envs.step(still)
        assert truncated.all()
        envs.reset(seed=[5, 6], options={"reset_mask": np.array([True, False])})
        *_, truncated, _ = envs.step(still)
        assert truncated.tolist() == [False, True]
