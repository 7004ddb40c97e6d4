"""Adversarial cases of stirring, played in the real simulation: nearly is not enough."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from adversary import Spoil, begun, play, turning
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.skills.stir import Stir


@pytest.fixture(scope="module")
def env() -> LabEnv:
    """What does not need the liquid is played without: it is judged by where it would stand."""
    return begun("level1/stir", liquid="off")


@pytest.fixture(scope="module")
def wet() -> LabEnv:
    return begun("level1/stir")


@pytest.fixture(scope="module")
def from_the_rack() -> LabEnv:
    return begun("level2/stir_glassrod", liquid="off")


def stir(env: LabEnv) -> Stir:
    return env.workcell.task.skills[-1]


def after(env: LabEnv, label: str, seconds: float, do: Callable[[np.ndarray], None]) -> Spoil:
    """Spoil the actions from some time after the beginning of a phase."""
    begun: list[float] = []

    def spoil(expert, action):
        if expert.label == label:
            begun.append(env.workcell.world.time)
        if begun and env.workcell.world.time - begun[0] > seconds:
            do(action)

    return spoil


def let_go(action: np.ndarray) -> None:
    action[-1] = PANDA.max_opening


def test_the_unspoilt_skill_succeeds_and_the_liquid_goes_round(wet):
    info = play(wet)
    assert info["outcome"] == "success"
    (moving,) = wet.workcell.task.steps[-1].notes
    assert wet.workcell.progress.history[moving.name].first > 3.0  # not before the rod is in


def test_the_rod_neither_slips_nor_spins_in_the_grip(env):
    in_hand = []

    def watch(expert, action):
        in_hand.append(
            env.workcell.world.gripper.inverse() @ env.workcell.world.pose(stir(env).rod)
        )

    play(env, spoil=watch)
    assert max(pose.distance_to(in_hand[0]) for pose in in_hand) < 0.002
    assert max(pose.angle_to(in_hand[0]) for pose in in_hand) < np.radians(1.0)


def test_four_turns_are_not_five(env):
    info = play(env, replace(stir(env), turns=4.0))
    assert info["outcome"] == "interrupted"  # the rod comes out too early
    assert info["substeps"]["stirred"] == np.inf


def test_a_rod_that_turns_about_the_axis_of_the_beaker_does_not_stir(env):
    info = play(env, replace(stir(env), radius=0.08))
    assert info["outcome"] == "running"
    assert info["substeps"]["stirred"] == np.inf


def test_a_rod_that_stops_half_way_has_not_stirred(env):
    stopped: list[np.ndarray] = []

    def stop(action):
        stopped.append(action.copy())
        action[:] = stopped[0]

    info = play(env, spoil=after(env, "stir/circle", 5.0, stop))
    assert info["outcome"] == "running"
    assert np.isfinite(info["substeps"]["inserted"])
    assert info["substeps"]["stirred"] == np.inf


@pytest.mark.slow
def test_a_rod_that_circles_above_the_liquid_is_not_inserted(wet):
    info = play(wet, replace(stir(wet), bottom_gap=0.035))  # 8 mm above where 60 ml stand
    assert info["outcome"] == "running"
    assert info["substeps"]["inserted"] == np.inf


def test_a_rod_that_circles_above_the_beaker_does_not_stir(env):
    info = play(env, replace(stir(env), bottom_gap=0.12))
    assert info["outcome"] == "running"
    assert info["substeps"]["inserted"] == np.inf


def test_a_rod_pushed_onto_the_bottom_collides(env):
    def press(action):
        action[1] += 0.035  # at the shoulder: 23 mm lower

    middle = replace(stir(env), radius=0.0)
    info = play(env, middle, spoil=after(env, "stir/circle", 0.0, press))
    tip = env.workcell.world.frame("beaker_rim").inverse() @ env.workcell.world.pose(middle.rod)
    assert info["outcome"] == "struck"
    assert np.hypot(*tip.position_w[:2]) < middle.vessel.mouth_radius / 2  # nowhere near the wall


def test_a_rod_that_drags_the_beaker_along_displaces_it(env):
    assert play(env, replace(stir(env), radius=0.85))["outcome"] == "displaced"


def test_a_rod_may_brush_along_the_wall(env):
    pushes = []

    def watch(expert, action):
        pushes.append(env.workcell.world.contact_force("glass_rod", "beaker"))

    assert play(env, replace(stir(env), radius=0.75), spoil=watch)["outcome"] == "success"
    assert max(pushes) > 0.5


def test_a_rod_let_go_in_the_beaker_fails(env):
    info = play(env, spoil=after(env, "stir/circle", 5.0, let_go))
    assert info["outcome"] in {"interrupted", "dropped", "struck", "broken"}


@pytest.mark.slow
def test_a_rod_four_centimetres_above_the_beaker_is_not_withdrawn(env):
    info = play(env, replace(stir(env), clearance=0.04))
    assert info["outcome"] == "running"
    assert np.isfinite(info["substeps"]["stirred"])
    assert info["substeps"]["withdrawn"] == np.inf


def test_a_rod_let_go_after_one_and_a_half_seconds_is_dropped(env):
    info = play(env, spoil=after(env, "stir/hold", 1.5, let_go))
    assert info["ever_success"]
    assert info["outcome"] == "dropped"


@pytest.mark.slow
def test_a_rod_carried_away_from_the_beaker_is_not_held_over_it(env):
    info = play(env, spoil=turning(0.2, "stir/hold", joint=0))
    assert info["outcome"] == "running"
    assert np.isfinite(info["substeps"]["withdrawn"])
    assert info["facts"]["glass_rod gripped"]


@pytest.mark.slow
def test_the_unspoilt_skills_succeed_from_the_rack(from_the_rack):
    assert play(from_the_rack)["outcome"] == "success"


def test_a_rod_lifted_nineteen_centimetres_is_not_lifted(from_the_rack):
    pick, honest = from_the_rack.workcell.task.skills
    info = play(from_the_rack, replace(pick, lift=0.19), replace(honest, rise=0.0))
    assert info["outcome"] == "running"
    assert np.isfinite(info["substeps"]["gripped"])
    assert info["substeps"]["lifted"] == np.inf


def test_a_hand_that_comes_too_low_strikes_the_rack(from_the_rack):
    def low(action):
        action[1] += 0.15

    info = play(from_the_rack, spoil=after(from_the_rack, "pick/reach", 0.0, low))
    assert info["outcome"] == "rack_struck"
