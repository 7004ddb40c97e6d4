"""Fixtures of the suite: every test here runs over every registered task."""

from pathlib import Path
from typing import Any

import pytest

from labutopia_lerobot.checks import Check
from labutopia_lerobot.checks.experts import (
    a_step_can_begin_where_the_one_before_is_done,
    the_expert_wins_at_least_nine_of_ten,
)
from labutopia_lerobot.checks.judging import (
    doing_nothing_does_not_succeed,
    random_actions_do_not_succeed,
)
from labutopia_lerobot.checks.motions import the_expert_does_so_in_ten_episodes
from labutopia_lerobot.checks.replaying import (
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
    random_actions_do_not_succeed,
    recorded_actions_replayed_open_loop_give_the_same_states,
    same_seed_gives_the_same_trajectory_bit_for_bit,
    training_and_evaluation_splits_share_no_scene,
}
"""Episodes beside the one that all other checks look at: `make test` plays them in one task of
each level, `make test-slow` in all others."""

ONE_OF_EACH_LEVEL = (
    "level1/pick",
    "level2/pour_liquid",
    "level3/pick_sizes",
    "level4/clean_beaker",
    "level5/navigation_and_manipulation",
)


def _environments() -> list[Any]:
    """Return task and liquid; what takes long, levels 4 and 5 with liquid, is `make test-slow`.

    The checks of a task stay in one process, where several look at one episode (`checks.playing`).
    """
    found = []
    for task in task_files():
        long, name = task.startswith(("level4/", "level5/")), task.replace("/", "-")
        together = pytest.mark.xdist_group(name)
        marks = [together, pytest.mark.slow] if long else [together]
        found.append(pytest.param((task, "on"), marks=marks, id=name))
        if long and not canonical_task(Setting(task)).needs_liquid:
            found.append(pytest.param((task, "off"), marks=together, id=f"{name}-dry"))
    return found


@pytest.fixture(params=_environments(), scope="module")
def env(request: pytest.FixtureRequest) -> LabEnv:
    """One environment per task, without pictures, and with a third of the usual particles.

    Tasks in which one drives are in one room: to compile a room takes seconds.
    """
    task, liquid = request.param
    room = "organic_7" if canonical_task(Setting(task)).drives else DEFAULT_ROOM
    return LabEnv(Setting(task, obs="state", particles=300, liquid=liquid, room=room))


@pytest.hookimpl(tryfirst=True)  # before pytest selects by marks
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark as slow what plays more episodes in tasks that are not one of each level."""
    here = Path(__file__).parent
    for item in items:
        if item.path.parent == here and isinstance(item, pytest.Function):
            played = getattr(item, "callspec", None)
            if played is None or "check" not in played.params:
                continue
            task, _ = played.params["env"]
            check = played.params["check"]
            more = check in MORE_EPISODES and task not in ONE_OF_EACH_LEVEL
            if check in TEN_EPISODES or more:
                item.add_marker(pytest.mark.slow)
