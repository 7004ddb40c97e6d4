"""`python scripts/measure_sizes.py`: how large what is handled is in the pictures.

Prints a table in Markdown: for every task the median height of each thing that its steps touch,
over the frames of those steps as the expert plays them, in pixels of every camera; bold where it is
below 24 in more than one of three. A handle counts with the drawer or the door that it moves too.
"""

import argparse
import sys
from collections.abc import Iterator

import mujoco
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.registry import task_files
from labutopia_lerobot.setting import CAMERAS, Setting
from labutopia_lerobot.task import Step, Task
from labutopia_lerobot.world.model import COLLISION_GROUP

SIDE = 256
"""Width and height of the pictures [pixels]."""

LEAST = 24
"""Height from which a thing can be learned from [pixels]: three patches of 8, ours."""

EVERY = 5
"""One of so many frames is looked at."""

FIRST_SEED = 300000
"""First seed of the episodes."""


@clear_errors
def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("tasks", nargs="*", help="default: all")
    parser.add_argument("--episodes", type=int, default=5, help="of every task (default: 5)")
    arguments = parser.parse_args()
    lines = [
        f"| task | thing | {' | '.join(CAMERAS)} |",
        "| --- | --- |" + " ---: |" * len(CAMERAS),
    ]
    sys.stdout.write("\n".join(lines) + "\n")
    for task in arguments.tasks or task_files():
        for row in rows(task, arguments.episodes):
            sys.stdout.write(f"{row}\n")
            sys.stdout.flush()


def rows(task: str, episodes: int) -> Iterator[str]:
    """Yield a row of the table for each thing that the task's steps touch."""
    env = LabEnv(Setting(task, obs="state", liquid="off"))
    heights: dict[str, list[list[float]]] = {}
    for seed in range(FIRST_SEED, FIRST_SEED + episodes):
        env.reset(seed=seed)
        cell = env.workcell
        model, data = cell.simulation.scene.model, cell.simulation.data
        expert = env.expert()
        expert.start()
        over, frame = False, 0
        while not over:
            if frame % EVERY == 0:
                for name in handled(model, cell.progress.step or cell.steps[-1], cell.task):
                    points = visible_points(model, data, name)
                    pixels = [height(data, model, camera, points) for camera in CAMERAS]
                    heights.setdefault(name, []).append(pixels)
            _, _, terminated, truncated, _ = env.step(expert.act())
            over, frame = terminated or truncated, frame + 1
    env.close()
    for name, per_frame in heights.items():
        medians = np.median(per_frame, axis=0)
        small = (medians < LEAST).sum() > 1
        cells = (f"**{pixels:.0f}**" if small else f"{pixels:.0f}" for pixels in medians)
        yield f"| `{task}` | {name} | {' | '.join(cells)} |"


def handled(model: mujoco.MjModel, step: Step, task: Task) -> list[str]:
    """Return what a step touches, and what it moves by that; else what it may move."""
    touched = [thing.name for thing in step.touches if has_body(model, thing.name)]
    moved = [
        model.body(model.body(name).parentid[0]).name
        for name in touched
        if not model.body(name).jntnum[0] and model.body(name).parentid[0]
    ]
    return [*touched, *moved] or [piece.name for piece in task.start if piece.movable]


def has_body(model: mujoco.MjModel, name: str) -> bool:
    """Return whether a thing is a body of its own, as a handle or a button is."""
    return bool(mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, name) >= 0)


def visible_points(model: mujoco.MjModel, data: mujoco.MjData, name: str) -> NDArray[np.float64]:
    """Return corners of what is drawn of a body and all that hangs on it [m], world frame."""
    root, points = model.body(name).id, []
    signs = np.array(np.meshgrid(*([-1, 1],) * 3)).reshape(3, -1).T
    for geom in range(model.ngeom):
        body = int(model.geom_bodyid[geom])
        while body not in (0, root):
            body = int(model.body_parentid[body])
        if body == root and model.geom_group[geom] < COLLISION_GROUP:
            mesh = int(model.geom_dataid[geom])
            if mesh >= 0:
                first, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
                local = model.mesh_vert[first : first + count].astype(float)
            else:
                local = signs * model.geom_aabb[geom, 3:] + model.geom_aabb[geom, :3]
            points.append(local @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom])
    return np.vstack(points)


def height(
    data: mujoco.MjData, model: mujoco.MjModel, camera: str, points_w: NDArray[np.float64]
) -> float:
    """Return how many rows of a picture points span, as far as they are in it and not hidden."""
    view = data.camera(camera)
    local = (points_w - view.xpos) @ view.xmat.reshape(3, 3)
    ahead = -local[:, 2]
    focal = SIDE / 2 / np.tan(np.radians(model.camera(camera).fovy[0]) / 2)
    if (ahead <= 0.01).all():
        return 0.0
    local, ahead = local[ahead > 0.01], ahead[ahead > 0.01]
    across, up = (focal * local[:, axis] / ahead for axis in (0, 1))
    if np.abs(across).min() > SIDE / 2:
        return 0.0
    up = np.clip(up, -SIDE / 2, SIDE / 2)
    return float(up.max() - up.min())


if __name__ == "__main__":
    main()
