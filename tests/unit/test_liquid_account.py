"""Liquid by origin: what was filled where, and where it is, in whole particles."""

from dataclasses import dataclass, replace

import mujoco
import numpy as np
import pytest

from adversary import begun_with
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.soft.wash_bottle import WashBottle
from labutopia_lerobot.liquids.liquid import Liquid
from labutopia_lerobot.liquids.solver.flow import LIQUID_HZ
from labutopia_lerobot.predicates import dispensed, poured, spilled
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.world import LiquidAccount
from labutopia_lerobot.world.liquid_account import UnknownVesselError
from liquid_experiments import world

UPPER, LOWER = (
    glassware("beaker", "250 ml", "upper"),
    glassware("beaker", "800 ml", "lower"),
)
CONTENTS = {UPPER: Filling(100.0, "glycerol"), LOWER: Filling(200.0)}


@dataclass(frozen=True)
class Seen:
    """A world in which only the liquid is looked at."""

    liquid: LiquidAccount


def place(
    model: mujoco.MjModel, data: mujoco.MjData, tilt: float, aside: float, height: float = 0.2
) -> None:
    """Put the upper beaker beside and over the lower one [m], tilted [rad] towards it."""
    data.qpos[:7] = (-aside, 0.0, height, np.cos(tilt / 2), 0.0, np.sin(tilt / 2), 0.0)
    data.qpos[7:] = (0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0)
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)


def filled(count: int = 600) -> tuple[mujoco.MjModel, mujoco.MjData, Liquid]:
    model, data = world(UPPER, LOWER)
    place(model, data, 0.0, 0.08)
    liquid = Liquid(model, data, [UPPER, LOWER], list(CONTENTS.values()), count)
    liquid.fill(CONTENTS, np.random.default_rng(0))
    return model, data, liquid


def pour_wildly(model: mujoco.MjModel, data: mujoco.MjData, liquid: Liquid, steps: int):
    """Pour half of it beside the mouth, swinging; yield the account of every control step."""
    for step in range(steps):
        seconds = step / LIQUID_HZ
        aside = 0.08 + 0.06 * np.sin(9.0 * seconds)
        place(model, data, np.radians(130) * min(1.0, 2.0 * seconds), aside)
        liquid.step()
        if step % 5 == 4:
            yield liquid.take_account()


def test_the_parts_add_up_to_the_total_at_every_step_of_a_wild_pour() -> None:
    model, data, liquid = filled()
    before = liquid.take_account().counts
    assert before.tolist() == [[200, 0, 0, 0, 0], [0, 400, 0, 0, 0], [0, 0, 0, 0, 0]]
    busy = np.zeros_like(before)
    gone = np.zeros((2, 2), int)
    for account in pour_wildly(model, data, liquid, 2 * LIQUID_HZ):
        assert account.counts.sum(axis=1).tolist() == [200, 400, 0]  # no origin loses or gains any
        parts = (account.poured, account.retained, account.spilled)
        parts += (account.clinging, account.in_flight)
        assert [round(part / liquid.volume) for part in parts] == [
            pytest.approx(part / liquid.volume) for part in parts
        ]
        assert sum(round(part / liquid.volume) for part in parts) == 600
        assert account.total == 600 * liquid.volume
        busy = np.maximum(busy, account.counts)
        gone += account.moves
    # Some was in either vessel, spilled and in flight; nothing clings where no hand is.
    assert (busy[0] > 0).tolist() == [True, True, True, False, True]
    assert gone[0, 1] == account.counts[0, 1] + gone[1, 0]
    assert account.from_in("upper", "lower") == gone[0, 1] * liquid.volume > 0
    assert account.inside["lower"] == account.counts[:, 1].sum() * liquid.volume


def test_a_transfer_is_reported_in_the_step_in_which_it_arrives_and_only_then() -> None:
    _, _, liquid = filled(150)
    assert liquid.take_account().transfers == {}
    drop = np.flatnonzero(liquid.origins == 0)[:3]
    liquid.positions[drop] = np.array([0.0, 0.0, 0.08]) + 0.008 * np.eye(3)
    assert liquid.take_account().transfers == {("upper", "lower"): 3 * liquid.volume}
    assert liquid.take_account().transfers == {}
    assert liquid.take_account().counts[0, 1] == 3


def test_poured_is_a_share_of_what_the_vessel_held_though_the_target_held_more() -> None:
    _, _, liquid = filled(150)
    most, all_of_it = (poured(UPPER, LOWER, share=share, origin=UPPER) for share in (0.8, 1.0))
    assert most.name == "80 % of what was in upper poured out of upper into lower"
    assert not most.holds(Seen(liquid.take_account()))  # 200 ml are in the target: not of these
    mine = np.flatnonzero(liquid.origins == 0)
    liquid.positions[mine[:39]] = (0.0, 0.0, 0.08)
    assert not most.holds(Seen(liquid.take_account()))
    liquid.positions[mine[:40]] = (0.0, 0.0, 0.08)
    assert most.holds(Seen(liquid.take_account()))
    assert not all_of_it.holds(Seen(liquid.take_account()))
    assert not poured(LOWER, UPPER, share=0.01, origin=LOWER).holds(Seen(liquid.take_account()))


def test_nothing_is_poured_where_nothing_was_filled() -> None:
    _, _, liquid = filled(150)
    liquid.empty()
    assert liquid.take_account().total == 0.0
    assert not poured(UPPER, LOWER, share=0.0, origin=UPPER).holds(Seen(liquid.take_account()))


def test_spilled_is_a_share_of_what_the_vessel_held() -> None:
    _, _, liquid = filled(150)
    fact, other = spilled(UPPER, share=0.05), spilled(LOWER, share=0.05)
    assert fact.name.startswith("more than 5 % of upper spilled")
    mine = np.flatnonzero(liquid.origins == 0)[:3]  # 6 % of 50, 2 % of all
    liquid.positions[mine] = [(0.3, 0.0, 0.003), (0.35, 0.0, 0.003), (0.4, 0.0, 0.003)]
    liquid.velocities[mine] = 0.0
    liquid.step()
    account = liquid.take_account()
    assert account.spilled_from("upper") == account.spilled == 3 * liquid.volume
    assert fact.holds(Seen(account))
    assert not other.holds(Seen(account))


INNER = glassware("beaker", "150 ml", "inner")


@pytest.mark.parametrize(
    "vessels", [(LOWER, INNER), (INNER, LOWER)], ids=["outer_first", "inner_first"]
)
def test_in_whatever_order_they_are_listed_liquid_is_in_the_inner_of_two_vessels(vessels) -> None:
    model, data = world(*vessels)
    for index, vessel in enumerate(vessels):
        above = 0.006 if vessel is INNER else 0.0
        data.qpos[7 * index : 7 * index + 7] = (0.0, 0.0, above, 1.0, 0.0, 0.0, 0.0)
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    liquid = Liquid(model, data, list(vessels), [Filling(30.0)], 150)
    liquid.fill({INNER: Filling(30.0)}, np.random.default_rng(0))
    account = liquid.take_account()
    assert account.from_in("inner", "inner") == account.retained == account.total > 0.0
    assert account.inside["lower"] == account.poured == 0.0
    assert not poured(INNER, LOWER, share=0.0, origin=INNER).holds(Seen(account))


def test_what_the_account_does_not_know_is_refused_with_what_it_knows() -> None:
    _, _, liquid = filled(150)
    with pytest.raises(UnknownVesselError, match=r"'mug', which holds none.*: upper, lower"):
        liquid.take_account().from_in("mug", "lower")


@pytest.mark.slow
def test_only_what_comes_out_of_the_bottle_is_dispensed(monkeypatch: pytest.MonkeyPatch) -> None:
    task = canonical_task(Setting("level1/squeeze"))
    bottle, target = task.start
    assert isinstance(bottle, WashBottle)
    contents = {bottle: Filling(100, "ethanol"), target: Filling(50)}
    task = replace(task, contents=contents)
    env = begun_with("level1/squeeze", task, monkeypatch, particles=200)
    env.reset(seed=1)
    fact = dispensed(bottle, target, at_least_ml=5)
    assert env.workcell.world.liquid.inside["beaker"] == pytest.approx(50e-6, abs=1e-6)
    assert not fact.holds(env.workcell.world)
    expert = env.expert()
    expert.start()
    while not fact.holds(env.workcell.world):
        assert not env.step(expert.act())[2]
    account, liquid = env.workcell.world.liquid, env.workcell.simulation.liquid
    assert account.from_in("bottle", "beaker") >= 5e-6
    assert account.transfers == {
        ("bottle", "beaker"): pytest.approx(account.transfers["bottle", "beaker"])
    }
    ethanol = [substance.name for substance in liquid.substances].index("ethanol")
    from_bottle = liquid.origins == liquid.names.index("bottle")
    assert (liquid.amounts[:, ethanol] == from_bottle).all()
