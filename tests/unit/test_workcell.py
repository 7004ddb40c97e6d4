"""An episode is drawn and begun in a workcell: reused, cached by variant, begun behind a step."""

import pickle

import numpy as np
import pytest
from gymnasium.error import ResetNeeded

from adversary import begun, play
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.setting import Setting, UnknownOptionError
from labutopia_lerobot.task import TaskError


def test_step_before_reset_says_what_to_do():
    env = LabEnv(Setting("level1/pick", obs="state"))
    action = np.zeros(8, dtype=np.float32)
    for call in (lambda: env.step(action), env.expert, env.render, lambda: env.workcell):
        with pytest.raises(ResetNeeded, match=r"level1/pick yet: call reset\(\) first"):
            call()


def test_a_workcell_is_compiled_once_per_variant():
    env = begun("level1/pick", axes=("layout",))
    cells = {}
    for seed in (*range(5), *range(5)):
        _, info = env.reset(seed=seed)
        assert cells.setdefault(info["drawn"]["layout"], env.workcell) is env.workcell
    assert len({id(cell) for cell in cells.values()}) == len(cells) > 3


def test_an_environment_is_pickled_as_what_it_was_made_of():
    env = begun("level1/pick")
    other = pickle.loads(pickle.dumps(env))
    for each in (env, other):
        each.reset(seed=4)
    assert np.array_equal(env.environment_state(), other.environment_state())


def test_any_whole_number_is_a_seed():
    env = begun("level1/pick")
    first, _ = env.reset(seed=7)
    second, info = env.reset(seed=np.int64(7))
    assert info["seed"] == 7
    assert np.array_equal(first["environment_state"], second["environment_state"])
    with pytest.raises(TypeError):
        env.reset(seed=7.5)


@pytest.mark.slow
def test_an_episode_can_begin_behind_a_step_with_the_liquid_in_place():
    env = begun("level2/pour_liquid")
    _, info = env.reset(seed=3, options={"after": "pour"})
    assert info["step"] == "place"
    assert info["ml_poured"] > 80
    assert [time for time in info["substeps"].values() if np.isfinite(time)] == [0.0] * 4
    assert env.workcell.world.time == 0.0
    assert play_from_here(env)["outcome"] == "success"


def test_an_unknown_step_is_an_error_that_lists_the_steps():
    env = begun("level2/heat_beaker", particles=100)
    with pytest.raises(TaskError, match="Steps of this task: pick, place, press"):
        env.reset(seed=0, options={"after": "pour"})


def test_a_step_played_alone_begins_where_the_one_before_is_done_and_ends_where_it_is():
    env = begun("level2/heat_beaker", step="place", liquid="off")
    first = env.workcell.world.time
    assert (first, env.workcell.progress.step.name) == (0.0, "place")
    info = play_from_here(env)
    assert info["outcome"] == "success"
    assert np.isfinite(info["substeps"]["retracted"])
    assert not np.isfinite(info["substeps"]["pressed"])
    assert env.workcell.world.time < 10.0


def play_from_here(env):
    expert, over = env.expert(), False
    expert.start()
    while not over:
        *_, terminated, truncated, info = env.step(expert.act())
        over = terminated or truncated
    return info


def test_a_step_played_alone_has_its_own_beginning():
    env = begun("level2/operate_drawer", step="open")
    with pytest.raises(UnknownOptionError, match="step=open begins behind the step before it"):
        env.reset(seed=0, options={"after": "open"})
    with pytest.raises(TaskError, match=r"no step 'shut'\. Steps of this task: open, close"):
        begun("level2/operate_drawer", step="shut")


def test_a_missed_grasp_is_tried_once_more():
    env = begun("level1/pick")
    missed = []

    def spoil(expert, action):
        if expert.label == "pick/close" and len(missed) < 70:
            missed.append(action[-1])
            action[-1] = 0.08

    assert play(env, spoil=spoil)["outcome"] == "success"
    assert len(missed) > 50


def test_success_is_rewarded_once():
    env = begun("level1/pick")
    play(env)
    action = env.workcell.simulation.command.astype(np.float32)
    assert env.step(action)[1] == 0.0


def test_the_picture_that_render_gives_is_nobody_elses():
    env = LabEnv(Setting("level1/pick", width=32, height=32))
    observation, _ = env.reset(seed=0)
    env.render()[:] = 0
    assert observation["pixels"]["front"].any()
    assert env.render().any()
    env.close()


def test_depth_shows_the_liquid_of_the_moment_without_pictures_in_the_observation():
    seen, state = (
        LabEnv(Setting("level1/pour", obs=obs, width=96, height=96, particles=300))
        for obs in ("pixels", "state")
    )
    for env in (seen, state):
        env.reset(seed=1)
    assert np.array_equal(seen.segmentation("top"), state.segmentation("top"))
    assert np.array_equal(seen.depth("top"), state.depth("top"))
    names = {
        state.workcell.simulation.scene.model.body(index).name
        for index in np.unique(state.segmentation("top"))
        if index >= 0
    }
    assert "water" in names
    for env in (seen, state):
        env.close()
