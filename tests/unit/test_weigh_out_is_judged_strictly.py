"""Adversarial cases of `level3/weigh_out`, played in the real simulation."""

from dataclasses import replace

import pytest

from adversary import begun, play
from labutopia_lerobot.scenario import Draw
from labutopia_lerobot.skills import PourMeasured
from labutopia_lerobot.tasks.level3.beyond.weigh_out import GRAMS, GRAMS_FOR_TESTS, weigh_out


@pytest.mark.parametrize("split", ["train", "ood"])
def test_the_mass_that_is_said_is_the_mass_that_is_judged(split):
    seen = set()
    for seed in range(40):
        draw = Draw(split, seeds=(seed,))
        task = weigh_out(draw)
        grams = draw.values["mass"]
        seen.add(grams)
        for said in (task.instruction, *task.paraphrases):
            assert f" {grams} g" in said
            assert str(draw.values["object"]) in said
        judged = f"reads {grams - 1} to {grams + 1}"
        assert any(judged in fact.name for fact in task.goal)
        assert f"more than {grams + 2} ml" in task.never["overshot"].name
    assert seen == set(GRAMS if split == "train" else GRAMS_FOR_TESTS)


def test_no_vessel_and_no_mass_of_the_tests_is_trained_on():
    drawn = {
        split: [Draw(split, seeds=(seed,)) for seed in range(40)] for split in ("train", "ood")
    }
    for draws in drawn.values():
        for draw in draws:
            weigh_out(draw)
    for axis in ("object", "mass"):
        train, ood = ({draw.values[axis] for draw in drawn[split]} for split in drawn)
        assert len(ood) > 1
        assert not train & ood


@pytest.mark.slow
def test_the_mass_of_another_episode_is_refused():
    env = begun("level3/weigh_out", split="ood")
    tare, pick, pour, place = env.workcell.task.skills
    assert isinstance(pour, PourMeasured)
    info = play(env, tare, pick, replace(pour, amount=pour.amount - 5.0), place, seed=0)
    assert info["outcome"] != "success"
    info = play(env, tare, pick, replace(pour, amount=pour.amount + 5.0), place, seed=0)
    assert info["outcome"] == "overshot"


@pytest.mark.slow
def test_weighing_out_in_two_goes_is_as_good():
    env = begun("level3/weigh_out", split="train")
    tare, pick, pour, place = env.workcell.task.skills
    assert isinstance(pour, PourMeasured)
    info = play(env, tare, pick, replace(pour, amount=pour.amount / 2), pour, place, seed=0)
    assert info["outcome"] == "success"
