"""Numbers of things in a segmentation, which mean the same in every episode of a task."""

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.pictures import BACKGROUND, LIQUID, ROBOT
from labutopia_lerobot.scenario.distractors import held_out_sets, training_sets
from labutopia_lerobot.sim.scene import ROBOT_MOUNT, Scene
from labutopia_lerobot.task import Task


def segment_names(task: Task) -> tuple[str, ...]:
    """Name what the numbers of a segmentation mean, 0 first.

    Args:
        task: As any episode has it: names are those of all draws.
    """
    sets = (*training_sets().values(), *held_out_sets().values())
    distractors = {piece.name for pieces in sets for piece in pieces}
    things = (piece.name for piece in task.start)
    return (BACKGROUND, ROBOT, LIQUID, *things, *sorted(distractors))


def segment_of_body(scene: Scene, names: tuple[str, ...]) -> NDArray[np.uint8]:
    """Return the number of every body; a moving part has that of its thing.

    Args:
        scene: The compiled scene.
        names: What the numbers mean.

    Returns:
        Shape (bodies + 1,); the last, which -1 finds, is that of no body.
    """
    model = scene.model
    called = {ROBOT_MOUNT: ROBOT}
    if scene.liquid is not None:
        called[scene.liquid.name] = LIQUID
    roots = [model.body(root).name for root in model.body_rootid]
    numbers = {name: number for number, name in enumerate(names)}
    return np.array([*(numbers.get(called.get(root, root), 0) for root in roots), 0], np.uint8)
