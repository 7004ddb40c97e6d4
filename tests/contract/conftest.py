import numpy as np
import pytest
from numpy.typing import NDArray

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.setting import Setting


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
