"""Fixtures of the suite: every test here runs over every registered task."""

from functools import cache
from pathlib import Path
from typing import Any

import pytest

from labutopia_lerobot.checks import Check, experts, motions
from labutopia_lerobot.checks.experts import (
    a_step_can_begin_where_the_one_before_is_done,
    the_expert_wins_at_least_nine_of_ten,
)
from labutopia_lerobot.checks.judging import (
    doing_nothing_does_not_succeed,
    doing_nothing_ends_by_timeout_at_the_time_limit,
    random_actions_do_not_succeed,
)
from labutopia_lerobot.checks.motions import the_expert_does_so_in_ten_episodes
from labutopia_lerobot.checks.replaying import (
    observations_are_in_space_own_their_memory_and_vary,
    recorded_actions_replayed_open_loop_give_the_same_states,
    same_seed_gives_the_same_trajectory_bit_for_bit,
)
from labutopia_lerobot.checks.scenes import training_and_evaluation_splits_share_no_scene
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.registry import task_files
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import DEFAULT_ROOM, Setting

TEN_EPISODES: set[Check] = {
    the_expert_wins_at_least_nine_of_ten,
    the_expert_does_so_in_ten_episodes,
}
"""Ten whole episodes each: `make test-slow`."""

MORE_EPISODES: set[Check] = {
    a_step_can_begin_where_the_one_before_is_done,
    doing_nothing_does_not_succeed,
    doing_nothing_ends_by_timeout_at_the_time_limit,
    random_actions_do_not_succeed,
    recorded_actions_replayed_open_loop_give_the_same_states,
    same_seed_gives_the_same_trajectory_bit_for_bit,
    training_and_evaluation_splits_share_no_scene,
}
"""Episodes beside the one that all other checks look at: `make test` plays them in one task of
each of the first levels, `make test-slow` in all others."""

WHOLE_EPISODE: set[Check] = {
    *experts.CHECKS,
    *motions.CHECKS,
    observations_are_in_space_own_their_memory_and_vary,
}
"""Those that look at the expert's episode: `make test` plays it without liquid where it is long."""

LONG_S = 60.0
"""Time limit above which an episode is long [s]: with liquid the expert's then takes 5 to 10 s."""

LONGEST_S = 150.0
"""Time limit above which it takes as long without liquid [s]: `make test-slow` plays it."""

ONE_OF_THE_FIRST_LEVELS = ("level1/pick", "level2/pour_liquid", "level3/pick_sizes")
ONE_OF_EACH_LEVEL = (
    *ONE_OF_THE_FIRST_LEVELS,
    "level4/clean_beaker",
    "level5/navigation_and_manipulation",
)


def _environments() -> list[Any]:
    """Return task and liquid: on and, where an episode is long and can do without, off.

    The checks of a task stay in one process, where several look at one episode (`checks.playing`).
    """
    found = []
    for name in task_files():
        task, label = canonical_task(Setting(name)), name.replace("/", "-")
        dry = task.time_limit_s > LONG_S and not task.needs_liquid
        together = pytest.mark.xdist_group(label)
        marks = [together, pytest.mark.slow] if dry else [together]
        found.append(pytest.param((name, "on"), marks=marks, id=label))
        if dry:
            found.append(pytest.param((name, "off"), marks=together, id=f"{label}-dry"))
    return found


@pytest.fixture(params=_environments(), scope="module")
def env(request: pytest.FixtureRequest) -> LabEnv:
    """One environment per task, without pictures, and with a third of the usual particles.

    Tasks in which one drives are in one room: to compile a room takes seconds.
    """
    task, liquid = request.param
    room = "organic_7" if canonical_task(Setting(task)).drives else DEFAULT_ROOM
    return LabEnv(Setting(task, obs="state", particles=300, liquid=liquid, room=room))


@cache
def is_long(task: str, liquid: str) -> bool:
    limit = canonical_task(Setting(task)).time_limit_s
    return limit > (LONG_S if liquid == "on" else LONGEST_S)


@pytest.hookimpl(tryfirst=True)  # before pytest selects by marks
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark as slow what draws, or plays more episodes, in tasks that are not one of each level."""
    here = Path(__file__).parent
    for item in items:
        if item.path.parent == here and isinstance(item, pytest.Function):
            played = getattr(item, "callspec", None)
            if played is None or "env" not in played.params:
                continue
            (task, liquid), check = played.params["env"], played.params.get("check")
            draws = check is None  # both cameras show what is picked
            played_more = ONE_OF_EACH_LEVEL if draws else ONE_OF_THE_FIRST_LEVELS
            more = (draws or check in MORE_EPISODES) and task not in played_more
            long = check in WHOLE_EPISODE | MORE_EPISODES and is_long(task, liquid)
            if check in TEN_EPISODES or more or long:
                item.add_marker(pytest.mark.slow)
