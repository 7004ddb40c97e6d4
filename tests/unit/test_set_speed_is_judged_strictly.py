"""Set speed: what the stirrer does counts, not what its knob is set to, and the hand is away."""

import numpy as np
import pytest

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.setting import Setting


def played(share_of_wanted: float, seconds: float) -> dict:
    """Return the info after the knob has been put somewhere, the robot standing still."""
    env = LabEnv(Setting("level1/set_speed", obs="state"))
    env.reset(seed=0)
    simulation = env.workcell.simulation
    wanted = int(env.workcell.task.instruction.split(" rpm")[0].split()[-1])
    knob = simulation.data.joint("stirrer_speed_hinge")
    knob.qpos[0] = share_of_wanted * wanted / 2000.0 * np.radians(300.0)
    info: dict = {}
    for _ in range(round(30 * seconds)):
        _, _, terminated, _, info = env.step(simulation.command.astype(np.float32))
        if terminated:
            break
    env.close()
    return info


def test_a_knob_that_is_set_right_is_not_yet_a_stirrer_that_turns_right():
    info = played(1.0, 1.0)
    assert info["substeps"]["set"] < 1.0
    assert info["substeps"]["running"] == np.inf
    assert info["outcome"] == "running"


def test_it_succeeds_once_the_stirrer_has_turned_right_for_two_seconds():
    assert played(1.0, 9.0)["outcome"] == "success"


@pytest.mark.parametrize("share", [0.93, 1.07])
def test_another_speed_is_no_success(share):
    assert played(share, 9.0)["outcome"] == "running"


@pytest.mark.slow
def test_no_joint_of_the_expert_comes_near_its_end():
    env = LabEnv(Setting("level1/set_speed", obs="state"))
    env.reset(seed=100032)
    script, nearest = env.expert(), np.inf
    script.start()
    least, greatest = np.array([(joint.lower, joint.upper) for joint in PANDA.joints]).T
    while not (script.finished or script.failure):
        env.step(script.act())
        joints = env.workcell.simulation.measured[:-1]
        nearest = min(nearest, (joints - least).min(), (greatest - joints).min())
    env.close()
    assert script.failure is None
    assert nearest > 0.5  # at its end a wrist swings to and fro, and hits the panel
