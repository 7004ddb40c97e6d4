"""Checks of what stands there when an episode begins."""

import random  # noqa: TID251  (to prove that nobody uses it)
from contextlib import ExitStack
from dataclasses import replace
from functools import cache
from types import ModuleType
from typing import NoReturn
from unittest.mock import patch

import numpy as np

from labutopia_lerobot.checks.playing import expert, start
from labutopia_lerobot.checks.require import CheckFailed, require
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.registry import task_files
from labutopia_lerobot.scenario import canonical_task, draw_scenario
from labutopia_lerobot.scenario.privileged_state import environment_state_names
from labutopia_lerobot.setting import Setting

_GENERATORS: dict[ModuleType, str] = {
    np.random: "seed rand random uniform normal randint choice shuffle",
    random: "seed random uniform randint choice shuffle gauss",
}


def every_element_of_the_model_has_a_name(env: LabEnv) -> None:
    """Bodies, geoms, joints and so on are all named."""
    start(env, 0)
    model = env.workcell.simulation.scene.model
    counts = {
        "body": model.nbody,
        "geom": model.ngeom,
        "joint": model.njnt,
        "site": model.nsite,
        "camera": model.ncam,
        "light": model.nlight,
        "actuator": model.nu,
        "material": model.nmat,
        "mesh": model.nmesh,
    }
    for kind, count in counts.items():
        require(count > 0, f"the model has no {kind}")
        for index in range(count):
            require(getattr(model, kind)(index).name, f"{kind} {index} has no name")


def the_model_has_the_three_cameras_and_no_welds(env: LabEnv) -> None:
    """Nothing is glued to the hand, and everything can be filmed."""
    start(env, 0)
    scene = env.workcell.simulation.scene
    cameras = {scene.model.camera(index).name for index in range(scene.model.ncam)}
    require(cameras >= {"front", "top", "wrist"}, f"the cameras are {sorted(cameras)}")
    require(scene.welds == 0, f"the model has {scene.welds} welds")


def the_instruction_is_unique(env: LabEnv) -> None:
    """No other task says the same."""
    said = canonical_task(env.setting).instruction
    for task in task_files(env.setting.tasks_dir):
        if task != env.setting.task:
            other = _instruction(task, env.setting.tasks_dir)
            require(other != said, f"{task} has the same instruction: {said!r}")


@cache
def _instruction(task: str, tasks_dir: str | None) -> str | None:
    """Return the instruction of another task, or None if that cannot be made."""
    try:
        return canonical_task(Setting(task, tasks_dir=tasks_dir)).instruction
    except Exception:  # a task file can raise anything, and it fails a check of its own then
        return None


def two_seeds_give_two_scenes(env: LabEnv) -> None:
    """Something is drawn."""
    first, second = (start(env, seed).observation["environment_state"] for seed in range(2))
    same = np.array_equal(first, second)
    require(not same, "seeds 0 and 1 give the same scene: nothing is drawn")


def elements_of_the_state_have_the_same_names_whatever_is_drawn(env: LabEnv) -> None:
    """What a policy has learned of an element is true of it in every episode.

    Names that change with the draw also give away what was drawn.
    """
    known = environment_state_names(canonical_task(env.setting), env.setting.hidden)
    for seed in range(12):
        drawn = environment_state_names(draw_scenario(env.setting, seed).task, env.setting.hidden)
        other = sorted(set(known) ^ set(drawn)) or "their order"
        require(drawn == known, f"the state of seed {seed} has other names: {other}")


def training_and_evaluation_splits_share_no_scene(env: LabEnv) -> None:
    """Five seeds give five scenes in each split, and none of them twice."""
    needed = canonical_task(env.setting).needs_liquid
    empty = env.setting if needed else replace(env.setting, liquid="off")  # it decides nothing here
    scenes = [
        {e.reset(seed=seed)[0]["environment_state"].tobytes() for seed in range(5)}
        for e in (LabEnv(empty), LabEnv(replace(empty, split="train")))
    ]
    require(not scenes[0] & scenes[1], "the splits train and id share a scene")
    for split, drawn in zip(("id", "train"), scenes, strict=True):
        require(len(drawn) == 5, f"5 seeds of the split {split} give {len(drawn)} scenes")


def global_random_generators_are_never_used(env: LabEnv) -> None:
    """An episode is a function of its seed: all chance comes from its own generator."""

    def forbidden(*args: object, **kwargs: object) -> NoReturn:
        raise CheckFailed("a global random generator was used")

    with ExitStack() as patches:
        for module, names in _GENERATORS.items():
            for name in names.split():
                patches.enter_context(patch.object(module, name, forbidden))
        env.reset(seed=3)
        script = expert(env)
        for _ in range(10):
            env.step(script.act())


def no_contact_is_deep_at_the_start(env: LabEnv) -> None:
    """Nothing stands inside something else, to within a millimetre."""
    for seed in range(3):
        deepest = start(env, seed).deepest
        require(deepest > -0.001, f"seed {seed}: a contact is {-1000 * deepest:.1f} mm deep")


CHECKS = (
    every_element_of_the_model_has_a_name,
    the_model_has_the_three_cameras_and_no_welds,
    the_instruction_is_unique,
    two_seeds_give_two_scenes,
    elements_of_the_state_have_the_same_names_whatever_is_drawn,
    training_and_evaluation_splits_share_no_scene,
    global_random_generators_are_never_used,
    no_contact_is_deep_at_the_start,
)
