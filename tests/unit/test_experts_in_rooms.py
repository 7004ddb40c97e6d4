"""Experts play in furnished rooms as well as in the laboratory (issue 15, "Rooms in use")."""

import pytest

from adversary import begun, play
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.scenes.plans import load_plan, plan_names

ROOMS = [name for name in plan_names() if load_plan(name).work_places]
TWENTY = ROOMS[:: max(1, len(ROOMS) // 20)][:20]
UNFIT = {
    *(f"storage_{n}" for n in range(10)),
    *(f"corridor_{n}" for n in (3, 6, 7, 8)),
    *("biology_9", "glove_box_1", "organic_0", "teaching_11", "weighing_room_8", "weighing_room_9"),
}
"""Rooms in which nobody can be asked to drive: without a bench, or with none that a base docks at
and that is far enough from where it may begin."""
SEEDS = 5
"""Of each room, others in each."""


@pytest.mark.slow
@pytest.mark.parametrize("task", ["level1/pick", "level1/pour", "level1/open_drawer"])
def test_the_expert_succeeds_in_95_of_100_episodes_over_20_rooms(task):
    outcomes = {}
    for number, room in enumerate(TWENTY):
        env = begun(task, room=room)
        for seed in range(SEEDS * number, SEEDS * (number + 1)):
            outcomes[room, seed] = play(env, seed=seed)["outcome"]
    failed = {where: outcome for where, outcome in outcomes.items() if outcome != "success"}
    assert len(outcomes) == 100
    assert len(failed) <= 5, failed


@pytest.mark.slow
@pytest.mark.parametrize("room", plan_names())
def test_it_drives_in_a_room_ten_times_or_the_room_is_refused_by_name(room):
    """All hundred rooms, also those of which episodes are not drawn."""
    if room in UNFIT:
        with pytest.raises(UserError, match=f"room='{room}'"):
            begun("level5/navigate", room=room)
        return
    env = begun("level5/navigate", room=room)
    outcomes = [play(env, seed=seed)["outcome"] for seed in range(100_000, 100_010)]
    assert outcomes.count("success") >= 9, outcomes
