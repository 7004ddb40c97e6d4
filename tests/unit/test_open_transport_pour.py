"""open_transport_pour: the order is drawn, said and judged."""

import numpy as np
import pytest

from adversary import begun, play
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.scenario import draw_scenario
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks.level4.beyond.open_transport_pour import JOBS, ORDERS

TASK = "level4/open_transport_pour"


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return begun(TASK, liquid="off")


def jobs_of(task: Task) -> list[str]:
    """Return the jobs in the order of a task's steps."""
    return list(dict.fromkeys(step.name.split("_")[0] for step in task.steps))


def test_every_order_is_drawn_and_the_steps_and_the_instruction_follow_it():
    setting = Setting(TASK, obs="state")
    drawn = set()
    for seed in range(60):
        scenario = draw_scenario(setting, seed)
        order = scenario.drawn["order"]
        jobs = order.split(", ")
        assert jobs_of(scenario.task) == jobs
        said = [scenario.task.instruction.index(JOBS[job]) for job in jobs]
        assert said == sorted(said)
        drawn.add(order)
    assert drawn == set(ORDERS)


def test_the_first_job_left_out_is_no_success(env):
    env.reset(seed=5)
    first, *_ = jobs_of(env.workcell.task)
    steps = [step for step in env.workcell.task.steps if not step.name.startswith(first)]
    info = play(env, *(skill for step in steps for skill in step.skills))
    assert info["outcome"] in {"struck", "collided", "running"}
    assert not np.isfinite(info["substeps"][steps[0].substeps[0].name])
