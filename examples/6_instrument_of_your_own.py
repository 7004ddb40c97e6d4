"""An instrument of your own: the cork mat of `tasks/level1/set_on_mat.py`, looked at and used.

`CorkMat` says of what forms it is made; what is seen and touched of it, and its inertia, follow.
"""

import argparse
from pathlib import Path

from PIL import Image

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.setting import Setting

TASKS = Path(__file__).parent / "tasks"


def main() -> None:
    """Set a beaker on the mat, and draw it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("mat.png"))
    given = parser.parse_args()
    env = LabEnv(
        Setting("level1/set_on_mat", obs="state", width=512, height=512, tasks_dir=str(TASKS))
    )
    env.reset(seed=0)
    expert = env.expert()
    expert.start()
    over = False
    while not over:
        _, _, terminated, truncated, info = env.step(expert.act())
        over = terminated or truncated
    given.out.parent.mkdir(parents=True, exist_ok=True)
    Image.fromarray(env.render()).save(given.out)
    mat = env.workcell.simulation.scene.model.body("mat")
    print(f"The mat weighs {1000 * mat.mass[0]:.0f} g. {info['outcome']}; wrote {given.out}")


if __name__ == "__main__":
    main()
