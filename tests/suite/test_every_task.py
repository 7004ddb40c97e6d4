"""What must hold for every registered task; a new task adds no test code."""

import re

import mujoco
import numpy as np
import pytest

from labutopia_lerobot.checks import CHECKS, Check
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.registry import require_task, task_files
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.scenes.views import FIXED_CAMERAS
from labutopia_lerobot.setting import Setting


@pytest.mark.parametrize("check", CHECKS, ids=[check.__name__ for check in CHECKS])
def test_it_is_so_that(env: LabEnv, check: Check):
    check(env)


def test_files_are_short():
    for task_id in task_files():
        assert len(require_task(task_id).read_text().splitlines()) <= 120, task_id


def test_where_a_robot_is_to_face_something_every_wording_says_so():
    for task_id in task_files():
        task = canonical_task(Setting(task_id))
        if any(fact.name.startswith("base facing") for fact in task.facts.values()):
            for wording in (task.instruction, *task.paraphrases):
                assert re.search(r"\b(face|facing|turn to|turned to)\b", wording.lower()), wording


def test_both_fixed_cameras_show_the_vessels_that_are_picked_and_one_of_them_all_else(env: LabEnv):
    env.reset(seed=0)
    task, met = env.workcell.task, set[str]()
    for number, step in enumerate(task.steps):
        new = [thing for thing in step.touches if thing.name not in met]
        if task.drives and new and number:  # they ride along, and doors open
            env.reset(seed=0, options={"after": task.steps[number - 1].name})
        cell = env.workcell
        model = cell.simulation.scene.model
        pixels = {camera: cell.segmentation(camera).ravel() for camera in FIXED_CAMERAS if new}
        for thing in new:
            met.add(thing.name)
            body = model.body(thing.name)
            root = int(body.rootid[0])
            loose = (
                model.body_jntnum[root]
                and model.jnt_type[model.body_jntadr[root]] == mujoco.mjtJoint.mjJNT_FREE
            )
            # A part of what is in the hand is seen with it: a finger may hide a grip.
            shown = model.body_rootid == root if loose else np.arange(model.nbody) == body.id
            seen = [int(shown[each[each >= 0]].sum()) for each in pixels.values()]
            assert max(seen) >= 20, (thing.name, seen)
            if thing in task.start and thing.movable:
                assert min(seen) > 0, (thing.name, seen)
