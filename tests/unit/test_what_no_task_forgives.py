"""What ends an episode of every task: disorder, dirt, an arm against itself."""

import numpy as np
import pytest

from adversary import begun, begun_with
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.layout import Inside, OnBench
from labutopia_lerobot.predicates import contaminated, gripped
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Step, Substep, Task, TaskError


def wait(env: LabEnv, steps: int = 3) -> str:
    """Hold still for some control steps; return the outcome."""
    hold = env.workcell.simulation.command.astype(np.float32)
    for _ in range(steps):
        info = env.step(hold)[-1]
    return info["outcome"]


def shove(env: LabEnv, name: str, by: float, height: float = 0.0) -> None:
    """Put a thing that stands free aside, and up [m]."""
    env.workcell.simulation.data.joint(f"{name}_free").qpos[:3] += (0.0, by, height)


@pytest.fixture(scope="module")
def crowded() -> LabEnv:
    """A pick with a beaker that stands around."""
    env = begun("level1/pick", axes=("layout",))
    while env.reset(seed=env.seed + 1)[1]["drawn"]["layout"] != "a beaker":
        pass
    return env


def test_what_stands_around_may_be_nudged_but_not_shoved(crowded):
    for by, outcome in ((0.015, "running"), (0.025, "displaced")):
        crowded.reset(seed=crowded.seed)
        shove(crowded, "distractor", by)
        assert wait(crowded) == outcome


def test_what_stands_around_may_not_be_felled(crowded):
    crowded.reset(seed=crowded.seed)
    half = np.radians(40) / 2
    crowded.workcell.simulation.data.joint("distractor_free").qpos[3:] = (
        np.cos(half),
        np.sin(half),
        0.0,
        0.0,
    )
    assert wait(crowded, steps=1) == "displaced"


def test_what_stands_around_may_not_be_broken(crowded):
    crowded.reset(seed=crowded.seed)
    shove(crowded, "distractor", 0.0, height=0.015)
    assert wait(crowded, steps=5) == "broken"


def test_the_target_stays_where_it_is():
    env = begun("level1/place")
    shove(env, "target_plate", 0.03)
    assert wait(env) == "displaced"


def test_liquid_that_gets_into_the_wrong_vessel_contaminates_it():
    env = begun("level4/liquid_fusion")
    for share, outcome in ((0.04, "running"), (0.07, "contaminated")):
        env.reset(seed=0)
        liquid = env.workcell.simulation.liquid
        blue = np.flatnonzero(liquid.origins == liquid.names.index("blue_beaker"))
        astray = blue[: round(share * len(blue))]
        green = env.workcell.world.frame("green_beaker_rim").position_w
        liquid.positions[astray] = green - (0.0, 0.0, 0.03) + 0.004 * np.eye(3)[astray % 3]
        liquid.velocities[astray] = 0.0
        assert wait(env, steps=1) == outcome


def test_liquid_may_get_into_the_vessel_that_it_is_poured_into_but_not_before_its_turn():
    env = begun("level4/clean_beaker", liquid="on")
    first, *_, last = env.workcell.task.steps
    named = [env.workcell.task.forbidden(step)["contaminated"].name for step in (first, last)]
    assert "full_beaker into" not in named[0]
    assert "full_beaker into dirty_beaker or full_beaker into waste_beaker" in named[1]


def test_liquid_on_a_plate_that_stands_is_spilled():
    env = begun("level2/transport_beaker")
    simulation = env.workcell.simulation
    plate = env.workcell.world.pose(env.workcell.task.skills[-1].on.of).position_w
    drops = np.arange(12)
    simulation.liquid.positions[drops] = plate + np.column_stack(
        [0.006 * (drops % 4), 0.006 * (drops // 4), np.full(12, 0.03)]
    )
    simulation.liquid.velocities[drops] = 0.0
    assert wait(env, steps=15) == "spilled"


@pytest.mark.slow
def test_liquid_outside_on_glass_clings_in_the_hand_and_is_spilled_where_it_stands():
    env = begun("level1/pour")
    world, liquid = env.workcell.world, env.workcell.simulation.liquid
    for name, clings in (("beaker", True), ("target_beaker", False)):
        env.reset(seed=0)
        rim = world.frame(f"{name}_rim")
        (vessel,) = (piece for piece in env.workcell.task.start if piece.name == name)
        out = np.array([vessel.grip_width / 2 + 0.004, 0.0, -0.04])
        liquid.positions[:3] = rim.position_w + out + 0.004 * np.eye(3)
        liquid.velocities[:3] = 0.0
        liquid.step()
        account = liquid.take_account()
        assert (account.clinging > 0.0) == clings
        assert (account.spilled > 0.0) == (not clings)


SMALL, BIG = (
    glassware("beaker", "150 ml", "small"),
    glassware("beaker", "800 ml", "big"),
)


def test_liquid_in_a_vessel_inside_another_is_in_the_inner_one(monkeypatch):
    places = {BIG: OnBench(x=(0.3, 0.3), y=(0.0, 0.0)), SMALL: Inside(BIG, at=(0.0, 0.0, 0.006))}
    held = Substep("held", (gripped(SMALL),))
    task = Task(
        instruction="Hold it.",
        start=places,
        steps=(Step("hold", (), (held,), (SMALL,)),),
        goal=(gripped(SMALL),),
        never={},
        time_limit_s=1.0,
        contents={SMALL: Filling(30)},
    )
    env = begun_with("level1/pick", task, monkeypatch)
    account = env.workcell.world.liquid
    assert account.from_in("small", "small") == pytest.approx(30e-6)
    assert account.inside["big"] == 0.0
    assert account.poured == 0.0
    assert not contaminated().holds(env.workcell.world)


def test_an_arm_against_itself_has_collided():
    env = begun("level1/pick")
    action = env.workcell.simulation.command.astype(np.float32)
    action[3], action[5] = -1.0, 0.0  # the hand folds back onto the forearm
    for _ in range(150):
        info = env.step(action)[-1]
        if info["outcome"] != "running":
            break
    task, world = env.workcell.task, env.workcell.world
    assert info["outcome"] == "collided"
    assert "arm pushed hand" in task.forbidden(task.steps[0])["collided"].reason(world)


def test_behind_the_end_the_robot_stays_where_it_is_whatever_is_commanded():
    env = begun("level1/pick")
    ram = env.workcell.simulation.command.astype(np.float32)
    ram[1] += 1.5
    while env.step(ram)[-1]["outcome"] == "running":
        pass
    where = env.workcell.simulation.measured
    for _ in range(60):
        env.step(ram)
        assert np.abs(env.workcell.simulation.data.qvel).max() < 3.0
    assert np.abs(env.workcell.simulation.measured - where).max() < 0.05


def test_behind_which_step_an_episode_began_is_in_its_info():
    env = begun("level2/transport_beaker", liquid="off")
    assert env.reset(seed=0)[1]["after"] is None
    assert env.reset(seed=0, options={"after": "pick"})[1]["after"] == "pick"
    alone = begun("level2/transport_beaker", liquid="off", step="place")
    assert alone.reset(seed=0)[1]["after"] == "pick"


def test_nothing_can_be_played_behind_the_last_step():
    env = begun("level2/transport_beaker", liquid="off")
    with pytest.raises(TaskError, match="Nothing is left to play behind 'place'"):
        env.reset(seed=0, options={"after": "place"})


def test_the_speed_of_a_joint_is_the_greatest_of_all_physics_steps():
    env = begun("level1/open_drawer")
    simulation, world = env.workcell.simulation, env.workcell.world
    (cabinet,) = env.workcell.task.start
    joint = cabinet.top_drawer.joint
    speeds: list[float] = []
    simulation.watch = lambda: speeds.append(abs(float(simulation.data.joint(joint).qvel[0])))
    simulation.data.joint(joint).qvel = 0.4
    simulation.step(simulation.command)
    assert world.joint_speed(joint) == max(speeds) > speeds[-1] + 0.05
