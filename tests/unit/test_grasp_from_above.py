"""What is flat is picked up from above and set down again, by a hand that points down."""

import numpy as np
import pytest

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.skills import Pick

TASK = """
from labutopia_lerobot.labware.glass.profile import Profile
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.labware.instruments.target_plate import TargetPlate
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.places import OnTop
from labutopia_lerobot.predicates import gripped, lifted, released, standing_on, withdrawn
from labutopia_lerobot.skills import Pick, Place
from labutopia_lerobot.task import Substep, Step, Task

DISH = ((0.0285, 0.0), (0.0300, 0.0015), (0.0300, 0.0150))  # 60 mm x 15 mm


def move_dish():
    dish = Vessel("dish", Profile(DISH, wall=0.0015, bottom=0.0015), grip_height=0.0075)
    plate = TargetPlate("plate")
    picked = Substep("picked", (gripped(dish), lifted(dish, by=0.1)))
    placed = Substep("placed", (standing_on(dish, OnTop(plate)),))
    return Task(
        instruction="Move the dish onto the plate.",
        start={
            dish: OnBench(x=(0.15, 0.30), y=(0.08, 0.23)),
            plate: OnBench(x=(0.15, 0.30), y=(-0.28, -0.13)),
        },
        steps=(
            Step("pick", (Pick(dish, lift=0.15, approach="above"),), (picked,), (dish,)),
            Step("place", (Place(dish, OnTop(plate)),), (placed,), (dish,)),
        ),
        goal=(standing_on(dish, OnTop(plate)), released(dish), withdrawn(dish, by=0.05)),
        never={},
        time_limit_s=25.0,
    )
"""


@pytest.mark.parametrize("robot", ["panda", pytest.param("iiwa", marks=pytest.mark.slow)])
def test_a_dish_is_moved_by_a_hand_that_points_down(tmp_path, robot):
    file = tmp_path / "level1" / "move_dish.py"
    file.parent.mkdir()
    file.write_text(TASK)
    env = LabEnv(Setting("level1/move_dish", obs="state", tasks_dir=str(tmp_path), robot=robot))
    for seed in range(6):
        env.reset(seed=seed)
        expert = env.expert()
        expert.start()
        over, pointing = False, []
        while not over:
            _, _, terminated, truncated, info = env.step(expert.act())
            if expert.label in ("pick/lift", "place/align"):
                pointing.append(env.workcell.world.gripper.z_axis[2])
            over = terminated or truncated
        assert info["outcome"] == "success", (seed, expert.label, expert.failure, info["facts"])
        assert not expert.unexpected
        assert info["clipped_actions"] == 0
        assert np.max(pointing) < -0.99


def test_from_the_side_the_same_dish_cannot_be_had(tmp_path):
    file = tmp_path / "level1" / "move_dish.py"
    file.parent.mkdir()
    file.write_text(TASK)
    env = LabEnv(Setting("level1/move_dish", obs="state", tasks_dir=str(tmp_path)))
    _, info = env.reset(seed=0)
    dish = next(piece for piece in env.workcell.task.start if piece.name == "dish")
    expert = env.workcell.expert((Pick(dish, lift=0.15, tries=1),))
    expert.start()
    while expert.failure is None and not expert.finished:
        _, _, _, _, info = env.step(expert.act())
    assert not info["facts"]["dish lifted by 0.1 m"]
