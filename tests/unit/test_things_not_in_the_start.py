"""A predicate or skill about a thing that is not in the start of the task says so, by name."""

from dataclasses import replace

import pytest

from adversary import begun
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.predicates import gripped, lifted, steady, upright
from labutopia_lerobot.progress import Progress
from labutopia_lerobot.sim.view import UnknownThingError
from labutopia_lerobot.skills import Pick

OTHER = glassware("beaker", "250 ml", "flusk")


@pytest.fixture(scope="module")
def env():
    return begun("level1/pick")


@pytest.mark.parametrize(
    "fact",
    [gripped(OTHER), lifted(OTHER, by=0.1), steady(OTHER, below=0.1), upright(OTHER, within_deg=5)],
    ids=lambda fact: fact.name,
)
def test_a_fact_about_it_names_it_and_what_is_there_when_it_is_first_judged(env, fact):
    task = replace(env.workcell.task, goal=(fact,))
    with pytest.raises(UnknownThingError, match=r"'flusk'.*mean 'flask'.*in the start: flask"):
        Progress(task).update(env.workcell.world)


def test_a_skill_about_it_names_it_when_it_is_first_played(env):
    expert = env.workcell.expert((Pick(OTHER, 0.1),))
    expert.start()
    with pytest.raises(UnknownThingError, match=r"'flusk'.*in the start: flask"):
        expert.act()


@pytest.mark.parametrize("ask", ["frame", "joint", "sensor", "reading", "touched_by"])
def test_every_name_is_looked_up_with_the_same_error(env, ask):
    with pytest.raises(UnknownThingError, match=r"'nowhere'.*in the start: flask"):
        getattr(env.workcell.world, ask)("nowhere")
