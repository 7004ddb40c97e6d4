"""Near misses of clean_beaker that a person would call failures."""

from dataclasses import replace

import numpy as np
import pytest

from adversary import Beside, begun, begun_with, play
from labutopia_lerobot.skills import Pick, Place, Shake
from labutopia_lerobot.tasks.level4.clean_beaker import clean_beaker

TASK = "level4/clean_beaker"


def skills_of(env):
    return list(env.workcell.task.skills)


def test_a_beaker_put_back_five_centimetres_off_is_not_back(monkeypatch):
    env = begun_with(TASK, replace(clean_beaker(), time_limit_s=22.0), monkeypatch, liquid="off")
    skills = skills_of(env)
    place = next(skill for skill in skills if isinstance(skill, Place))
    off = replace(place, on=Beside(place.thing))
    info = play(env, *[off if skill is place else skill for skill in skills[:3]])
    assert info["outcome"] == "running"
    assert np.isfinite(info["substeps"]["2_pour/righted"])
    assert not np.isfinite(info["substeps"]["3_place/placed"])


def test_the_other_beaker_first_is_out_of_order():
    env = begun(TASK, liquid="off")
    second = [skill for skill in skills_of(env) if isinstance(skill, Pick)][1]
    assert play(env, second)["outcome"] == "struck"


@pytest.mark.slow
def test_who_does_not_shake_has_not_cleaned():
    env = begun(TASK, liquid="off")
    skills = [skill for skill in skills_of(env) if not isinstance(skill, Shake)]
    info = play(env, *skills)
    assert info["outcome"] in {"running", "interrupted"}
    assert np.isfinite(info["substeps"]["4_pick/lifted"])
    assert not np.isfinite(info["substeps"]["5_shake/shaken"])
    assert not np.isfinite(info["substeps"]["7_place/released"])


def test_where_a_beaker_stood_stays_while_it_is_carried():
    env = begun(TASK, liquid="off")
    full = next(iter(env.workcell.task.start))
    before = env.workcell.world.pose(full).position_w
    env.reset(seed=0, options={"after": "1_pick"})
    world = env.workcell.world
    assert world.pose(full).position_w[2] > before[2] + 0.1
    assert np.abs(world.stood(full).position_w - before).max() < 1e-3
