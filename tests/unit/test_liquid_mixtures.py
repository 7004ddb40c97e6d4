"""Several substances in one scene: each flows by its own density and viscosity."""

import mujoco
import numpy as np
import pytest

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.liquids.liquid import Liquid
from labutopia_lerobot.liquids.solver.flow import GRAVITY, LIQUID_HZ, Mixing
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.substances.substance import ETHANOL, GLYCEROL, WATER
from liquid_experiments import filled, move_to, world

GLASS = glassware("beaker", "250 ml", "glass")


def layered(
    lower: str, upper: str, bench: bool = True
) -> tuple[mujoco.MjModel, mujoco.MjData, Liquid]:
    """Return a beaker with one substance in the lower half of the liquid and another on top."""
    model, data = world(GLASS, bench=bench)
    move_to(model, data, (0, 0, 0), 0.0)
    fillings = [Filling(60.0, lower), Filling(60.0, upper)]
    liquid = Liquid(model, data, [GLASS], fillings, 600)
    liquid.fill({GLASS: Filling(120.0, lower)}, np.random.default_rng(0))
    top = liquid.positions[:, 2] > np.median(liquid.positions[:, 2])
    liquid.amounts = np.column_stack([~top, top]).astype(float)
    return model, data, liquid


def heights(liquid: Liquid) -> np.ndarray:
    """Return the mean height of each substance [m]."""
    return np.array([liquid.positions[part == 1.0, 2].mean() for part in liquid.amounts.T])


def test_a_dense_liquid_sinks_below_a_light_one_and_stays_there() -> None:
    _, _, liquid = layered("ethanol", "glycerol")
    assert np.diff(heights(liquid)) > 0.01  # the dense one is on top
    for _ in range(8 * LIQUID_HZ):
        liquid.step()
    assert not liquid.diverged
    assert np.diff(heights(liquid)) < -0.004
    _, _, liquid = layered("glycerol", "ethanol")
    before = np.diff(heights(liquid))
    for _ in range(2 * LIQUID_HZ):
        liquid.step()
    assert np.diff(heights(liquid)) > 0.8 * before


def test_liquids_of_one_density_stay_as_they_were_put() -> None:
    _, _, liquid = filled(GLASS, Filling(120.0), 600)
    level = liquid.positions[:, 2].copy()
    kind = level > np.median(level)
    before = level[kind].mean() - level[~kind].mean()
    for _ in range(2 * LIQUID_HZ):
        liquid.step()
    level = liquid.positions[:, 2]
    assert level[kind].mean() - level[~kind].mean() == pytest.approx(before, abs=0.003)


def test_a_vessel_carries_the_weight_of_all_that_is_in_it() -> None:
    _, data, liquid = layered("glycerol", "ethanol")
    loads = []
    for _ in range(LIQUID_HZ):
        liquid.step()
        loads.append(-data.xfrc_applied[1, 2])
    weight = (GLYCEROL.density + ETHANOL.density) * 60e-6 * GRAVITY
    assert np.mean(loads[LIQUID_HZ // 2 :]) == pytest.approx(weight, rel=0.02)


def test_what_a_mixture_gains_in_momentum_the_vessel_gave_it() -> None:
    model, data, liquid = layered("glycerol", "ethanol", bench=False)
    mass = liquid.amounts @ [GLYCEROL.density, ETHANOL.density] * liquid.volume
    for step in range(LIQUID_HZ // 2):
        before = mass @ liquid.velocities
        shift = 0.05 * np.sin(10 * step / LIQUID_HZ)
        move_to(model, data, (shift, 0, 0), 0.2 * np.sin(7 * step / LIQUID_HZ))
        liquid.step()
        gain = mass @ liquid.velocities - before
        pull = np.array([0, 0, -mass.sum() * GRAVITY])
        given = (pull - data.xfrc_applied[1, :3]) / LIQUID_HZ
        assert gain == pytest.approx(given, abs=1e-11)


def test_each_substance_has_its_own_viscosity_beside_the_other() -> None:
    model, data = world(
        glassware("beaker", "250 ml", "left"),
        glassware("beaker", "250 ml", "right"),
    )
    data.qpos[7] = 0.2
    mujoco.mj_kinematics(model, data)
    contents = {
        glassware("beaker", "250 ml", "left"): Filling(60.0),
        glassware("beaker", "250 ml", "right"): Filling(60.0, "glycerol"),
    }
    liquid = Liquid(model, data, list(contents), list(contents.values()), 600)
    liquid.fill(contents, np.random.default_rng(0))
    centres = np.array([[0.0, 0.0], [0.2, 0.0]])[liquid.origins]
    arm = liquid.positions[:, :2] - centres
    liquid.velocities[:, :2] = 5.0 * np.column_stack([-arm[:, 1], arm[:, 0]])
    for _ in range(LIQUID_HZ // 5):
        liquid.step()
    arm = liquid.positions[:, :2] - centres
    spin = arm[:, 0] * liquid.velocities[:, 1] - arm[:, 1] * liquid.velocities[:, 0]
    water, glycerol = (abs(spin[liquid.origins == vessel].mean()) for vessel in (0, 1))
    assert water > 10 * glycerol


def test_a_mixture_is_between_its_parts_and_what_is_pure_is_its_substance_to_the_last_bit() -> None:
    mixing = Mixing((WATER, GLYCEROL), 1e-7, 0.03)
    matter = mixing.matter(np.array([[1.0, 0.0], [0.5, 0.5], [0.0, 1.0]]))
    assert (np.diff(matter.viscosity) > 0).all()
    assert matter.mass == pytest.approx([1.0, 0.5 + 0.5 * 1258 / 997, 1258 / 997])
    assert (matter.lightness <= 1.0).all()
    alone = Mixing((WATER,), 1e-7, 0.03).matter(np.ones((3, 1)))
    assert (alone.mass == 1.0).all()
    assert (alone.lightness == 1.0).all()


def test_two_fillings_of_one_substance_are_as_one_liquid() -> None:
    _, _, one = filled(GLASS, Filling(100.0), 300)
    model, data = world(GLASS)
    move_to(model, data, (0, 0, 0), 0.0)
    other = Liquid(model, data, [GLASS], [Filling(60.0), Filling(40.0)], 300)
    other.fill({GLASS: Filling(100.0)}, np.random.default_rng(0))
    assert one.state().tobytes() == other.state().tobytes()


def test_a_restored_mixture_goes_on_with_the_same_bits() -> None:
    model, data, liquid = layered("ethanol", "glycerol")
    for _ in range(30):
        liquid.step()
    liquid.take_account()
    saved = liquid.state()
    other = Liquid(model, data, [GLASS], [Filling(60.0, "ethanol"), Filling(60.0, "glycerol")], 600)
    other.restore(saved)
    for _ in range(30):
        liquid.step()
        other.step()
    assert (other.take_account().counts == liquid.take_account().counts).all()
    assert other.state().tobytes() == liquid.state().tobytes()
