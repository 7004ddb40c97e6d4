"""Turn stopcock: what has run counts, and that the plug is shut; spilled or too much ends it."""

import numpy as np
import pytest

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.setting import Setting


def played(seconds_open: float, seconds: float, *, shut: float = 0.0) -> dict:
    """Return the info after the plug was open for a time, the robot standing still."""
    env = LabEnv(Setting("level1/turn_stopcock", obs="state", particles=300))
    env.reset(seed=0)
    simulation = env.workcell.simulation
    wing, info = simulation.data.joint("stand_burette_stopcock_hinge"), {}
    for step in range(round(30 * seconds)):
        wing.qpos[0] = np.pi / 2 if step < 30 * seconds_open else shut
        _, _, terminated, _, info = env.step(simulation.command.astype(np.float32))
        if terminated:
            break
    env.close()
    return info


@pytest.mark.slow
def test_seven_millilitres_and_a_shut_plug_are_success():
    assert played(8.0, 12.0)["outcome"] == "success"


def test_too_little_is_none():
    info = played(4.0, 8.0)
    assert info["outcome"] == "running"
    assert info["substeps"]["run"] == np.inf


@pytest.mark.slow
def test_too_much_ends_the_episode():
    assert played(30.0, 30.0)["outcome"] == "overshot"


@pytest.mark.slow
def test_a_plug_that_lets_nothing_through_is_not_yet_shut():
    info = played(8.0, 12.0, shut=np.radians(45.0))
    assert info["outcome"] == "running"
    assert info["substeps"]["run"] < 12.0
    assert info["substeps"]["shut"] == np.inf
