"""What must hold for every registered task; a new task adds no test code."""

import random  # noqa: TID251  (to prove that nobody uses it)
from itertools import pairwise

import mujoco
import numpy as np
import pytest

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.features import environment_state_names
from labutopia_lerobot.registry import require_task, task_files
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import Setting


def play(env: LabEnv, policy, seed: int) -> list[tuple]:
    """Play an episode; return what reset and every step gave."""
    trace = [env.reset(seed=seed)]
    act = policy(env)
    over = False
    while not over:
        observation, _, terminated, truncated, info = env.step(act())
        trace.append((observation, info))
        over = terminated or truncated
    return trace


def expert(env: LabEnv):
    script = env.expert()
    script.start()
    return script.act


def still(env: LabEnv):
    command = env.workcell.simulation.command.astype(np.float32)
    return lambda: command


def random_walk(env: LabEnv):
    rng = np.random.default_rng(env.seed)
    return lambda: rng.uniform(env.action_space.low, env.action_space.high).astype(np.float32)


def test_every_element_of_the_model_has_a_name(env):
    env.reset(seed=0)
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
        assert count > 0
        for index in range(count):
            assert getattr(model, kind)(index).name, (kind, index)


def test_same_seed_gives_the_same_trajectory_bit_for_bit(env):
    def states() -> list[bytes]:
        env.reset(seed=7)
        act = random_walk(env)
        result = [env.workcell.simulation.state().tobytes()]
        for _ in range(30):
            env.step(act())
            result.append(env.workcell.simulation.state().tobytes())
        return result

    first = states()
    play(env, still, seed=8)
    assert states() == first


def test_two_seeds_give_two_scenes(env):
    first, _ = env.reset(seed=0)
    second, _ = env.reset(seed=1)
    assert not np.array_equal(first["environment_state"], second["environment_state"])


def test_training_and_evaluation_splits_share_no_scene(env):
    other = LabEnv(Setting(env.setting.task, obs="state", split="train"))
    scenes = [
        {e.reset(seed=seed)[0]["environment_state"].tobytes() for seed in range(20)}
        for e in (env, other)
    ]
    assert not scenes[0] & scenes[1]
    assert all(len(scene) == 20 for scene in scenes)


def test_global_random_generators_are_never_used(env, monkeypatch):
    def forbidden(*args, **kwargs):
        raise AssertionError("a global random generator was used")

    for name in ("seed", "rand", "random", "uniform", "normal", "randint", "choice", "shuffle"):
        monkeypatch.setattr(np.random, name, forbidden)
    for name in ("seed", "random", "uniform", "randint", "choice", "shuffle", "gauss"):
        monkeypatch.setattr(random, name, forbidden)
    env.reset(seed=3)
    act = expert(env)
    for _ in range(10):
        env.step(act())


def test_the_goal_is_false_at_the_start(env):
    _, info = env.reset(seed=0)
    assert not info["is_success"]
    goal = [info["facts"][fact.name] for fact in env.workcell.task.goal]
    # Where things end as they began, it is the sub-steps that are missing.
    assert not all(goal) or not any(np.isfinite(time) for time in info["substeps"].values())


def test_nothing_forbidden_has_happened_at_the_start(env):
    for seed in range(10):
        _, info = env.reset(seed=seed)
        assert info["outcome"] == "running", info["outcome"]


@pytest.mark.parametrize("policy", [still, random_walk])
def test_neither_doing_nothing_nor_random_actions_succeed(env, policy):
    for seed in range(3):
        trace = play(env, policy, seed)
        assert not any(info["is_success"] or info["ever_success"] for _, info in trace)


def test_doing_nothing_ends_by_timeout_at_the_time_limit(env):
    trace = play(env, still, seed=0)
    assert trace[-1][1]["outcome"] == "timeout"
    assert len(trace) - 1 == env.workcell.task.max_steps


def test_the_expert_wins_at_least_nine_of_ten(env):
    usual = LabEnv(Setting(env.setting.task, obs="state"))
    outcomes = [play(usual, expert, seed)[-1][1]["outcome"] for seed in range(100, 110)]
    assert outcomes.count("success") >= 9, outcomes


def test_the_expert_touches_only_what_its_phases_list(env):
    for seed in range(110, 113):
        env.reset(seed=seed)
        script = env.expert()
        script.start()
        over = False
        while not over:
            _, _, terminated, truncated, _ = env.step(script.act())
            over = terminated or truncated
        assert not script.unexpected


def test_expert_commands_are_never_clipped_and_sub_steps_latch_in_order(env):
    info = play(env, expert, seed=100)[-1][1]
    assert info["clipped_actions"] == 0
    assert info["nonfinite_actions"] == 0
    latched = list(info["substeps"].values())
    assert latched == sorted(latched)


def test_recorded_actions_replayed_open_loop_give_the_same_states(env):
    trace = play(env, expert, seed=101)
    actions = [info["applied_action"] for _, info in trace[1:]]
    final = env.workcell.simulation.state().tobytes()
    env.reset(seed=101)
    for action in actions:
        _, _, _, _, info = env.step(action)
    assert info["is_success"]
    assert env.workcell.simulation.state().tobytes() == final


def test_success_needs_two_seconds_of_the_goal(env):
    trace = play(env, expert, seed=100)
    held = 0
    for _, info in reversed(trace):
        if not all(info["facts"][fact.name] for fact in env.workcell.task.goal):
            break
        held += 1
    assert trace[-1][1]["is_success"]
    assert held >= 61  # both ends of sixty control periods


def _of_moved_things(env: LabEnv, states: np.ndarray) -> list[int]:
    """Return which elements of `environment_state` belong to things that move by a millimetre.

    Without fill depths, which stay as they are where nothing is poured.
    """
    names = environment_state_names(env.workcell.task)
    moves = dict(zip(names, np.ptp(states, axis=0) > 1e-3, strict=True))
    things = [piece.name for piece in env.workcell.task.start]
    moved = tuple(f"{name}." for name in things if any(moves[f"{name}.{axis}"] for axis in "xyz"))
    return [
        index
        for index, name in enumerate(names)
        if name.startswith(moved) and not name.endswith(".fill")
    ]


def test_observations_are_in_space_own_their_memory_and_vary(env):
    trace = play(env, expert, seed=102)
    observations = [observation for observation, _ in trace]
    assert all(env.observation_space.contains(observation) for observation in observations)
    for key in ("agent_pos", "environment_state"):
        values = [observation[key] for observation in observations]
        assert not any(np.shares_memory(a, b) for a, b in pairwise(values))
        varies = np.ptp(np.stack(values), axis=0) > 0.0
        if key == "environment_state":
            varies = varies[_of_moved_things(env, np.stack(values))]
        assert varies.all(), (key, np.flatnonzero(~varies))


def test_reading_facts_changes_nothing(env):
    env.reset(seed=0)
    before = env.workcell.simulation.state().tobytes()
    for fact in env.workcell.task.facts.values():
        fact.holds(env.workcell.world)
    assert env.workcell.simulation.state().tobytes() == before


def test_no_contact_is_deep_at_the_start(env):
    for seed in range(5):
        env.reset(seed=seed)
        contact = env.workcell.simulation.data.contact
        assert contact.dist.size == 0 or contact.dist.min() > -0.001


def test_the_model_has_the_three_cameras_and_no_welds(env):
    model = env.workcell.simulation.scene.model
    assert {model.camera(index).name for index in range(model.ncam)} >= {"front", "top", "wrist"}
    assert not (model.eq_type == mujoco.mjtEq.mjEQ_WELD).any()


def test_instructions_are_unique_and_files_short():
    tasks = {task_id: canonical_task(Setting(task_id)) for task_id in task_files()}
    instructions = [task.instruction for task in tasks.values()]
    assert len(set(instructions)) == len(instructions)
    for task_id in tasks:
        assert len(require_task(task_id).read_text().splitlines()) <= 120, task_id
