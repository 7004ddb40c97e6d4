"""Paths of things in a stage: what never moves hangs together, moving bodies lie side by side.

USD's rigid bodies may not be nested. So a body that moves lies below the nearest thing that does
not, or, as the parts of a movable instrument, in a group with the name of the whole.
"""

from collections.abc import Mapping, Sequence

import mujoco
from pxr import Sdf, Tf, Usd


def free_path(stage: Usd.Stage, parent: Sdf.Path, name: str) -> Sdf.Path:
    """Return a path below a parent that is not taken: `name`, or `name_2`, `name_3`, ..."""
    valid = Tf.MakeValidIdentifier(name)
    path, number = parent.AppendChild(valid), 1
    while stage.GetPrimAtPath(path):
        number += 1
        path = parent.AppendChild(f"{valid}_{number}")
    return path


def needs_group(model: mujoco.MjModel, moves_with: Sequence[int], tree: int) -> bool:
    """Return whether a tree of bodies needs a group: its root moves, and parts on their own."""
    own = {moves_with[body] for body in range(model.nbody) if model.body_rootid[body] == tree}
    return moves_with[tree] == tree and len(own) > 1


def parent_path(
    model: mujoco.MjModel,
    moves_with: Sequence[int],
    paths: Mapping[int, Sdf.Path],
    groups: Mapping[int, Sdf.Path],
    body: int,
) -> Sdf.Path:
    """Return below what a body lies.

    Args:
        model: Where the body is from.
        moves_with: Carrier of every body.
        paths: Of the bodies before it; of the world, 0, the root of the stage.
        groups: Path of the group of a tree, by the tree's root.
        body: Its number.
    """
    above = int(model.body_parentid[body])
    if moves_with[body] == body:
        if int(model.body_rootid[body]) in groups:
            return groups[int(model.body_rootid[body])]
        while moves_with[above]:
            above = int(model.body_parentid[above])
    return paths[above]
