"""Experts play in furnished rooms as well as in the laboratory (issue 15, "Rooms in use")."""

import pytest

from adversary import begun, play
from labutopia_lerobot.scenes.plans import load_plan, plan_names

ROOMS = [name for name in plan_names() if load_plan(name).work_places]
TWENTY = ROOMS[:: max(1, len(ROOMS) // 20)][:20]
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
