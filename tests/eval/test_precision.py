"""Precision, measured in the simulation."""

import numpy as np
import pytest

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.evaluation.precision import Precision
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.world import ARM


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return LabEnv(Setting("level2/transport_beaker", obs="state", liquid="off"))


def test_what_stands_off_its_place_is_measured_in_millimetres_and_degrees(env: LabEnv) -> None:
    env.reset(seed=0)
    cell = env.workcell
    beaker, plate = (cell.world.pose(piece) for piece in cell.task.start)
    apart = np.linalg.norm((beaker.position_w - plate.position_w)[:2])
    columns = Precision(cell.task, cell.world).columns
    assert columns["mm_off_place"] == pytest.approx(1e3 * apart, abs=0.01)
    assert columns["deg_off_place"] == pytest.approx(np.degrees(beaker.tilt), abs=0.01)
    assert columns["ml_off_target"] is None


def test_what_should_not_touch_is_counted(env: LabEnv) -> None:
    _, info = env.reset(seed=0)
    precision = Precision(env.workcell.task, env.workcell.world)
    precision.note(info["substeps"])
    assert precision.columns["unwanted_contacts"] == {}
    down = env.workcell.simulation.command.astype(np.float32)
    down[1] += 1.2  # the shoulder bends the forearm down onto the bench
    for _ in range(75):
        *_, info = env.step(down)
        precision.note(info["substeps"])
    touched = precision.columns["unwanted_contacts"]
    assert touched[f"{ARM} and bench"] > 3


def test_what_is_not_poured_yet_is_off_target() -> None:
    env = LabEnv(Setting("level2/pour_liquid", obs="state", particles=100))
    env.reset(seed=0)
    columns = Precision(env.workcell.task, env.workcell.world).columns
    assert columns["ml_off_target"] == pytest.approx(100.0)
