"""What passes the mouth of a vessel that was poured into; learned policies repeat it less well."""

import itertools

import mujoco
import pytest

from adversary import begun
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.sim.simulation import Simulation

FAR = 0.3
"""Distance beyond which nobody asks how far it is [m]."""


def colliding(simulation: Simulation, *roots: str) -> list[int]:
    """Return the geoms of bodies and of what they carry that touch things."""
    model = simulation.scene.model
    wanted = {model.body(name).id for name in roots}

    def part_of(body: int) -> bool:
        while body and body not in wanted:
            body = model.body_parentid[body]
        return body in wanted

    touches = model.geom_contype | model.geom_conaffinity
    return [g for g in range(model.ngeom) if touches[g] and part_of(model.geom_bodyid[g])]


def nearest(env: LabEnv, seed: int, phases: tuple[str, ...], *moving: str) -> float:
    """Return how near bodies come to the second vessel of a task as its expert plays [m]."""
    env.reset(seed=seed)
    simulation, expert = env.workcell.simulation, env.expert()
    model, data = simulation.scene.model, simulation.data
    _, target = env.workcell.task.start
    ours, others = colliding(simulation, *moving), colliding(simulation, target.name)
    expert.start()
    near, over = FAR, False
    while not over:
        _, _, terminated, truncated, info = env.step(expert.act())
        over = terminated or truncated
        if expert.label.startswith(phases):
            pairs = itertools.product(ours, others)
            near = min(
                near, *(mujoco.mj_geomDistance(model, data, *pair, FAR, None) for pair in pairs)
            )
    assert info["outcome"] == "success"
    return near


@pytest.mark.parametrize(
    ("task", "seed"), [("level3/pour_sizes", 100_002), ("level3/pour_liquid", 100_000)]
)
def test_a_tall_vessel_and_the_hand_turn_a_centimetre_above_the_rim(task, seed):
    env = begun(task, liquid="off")
    assert nearest(env, seed, ("pour/",), "vessel", "hand") > 0.010


def test_a_flask_is_not_poured_from_so_high_that_its_jet_misses_the_mouth():
    env = begun("level3/pour_liquid")
    env.reset(seed=100_019)
    expert, over = env.expert(), False
    expert.start()
    while not over:
        _, _, terminated, truncated, info = env.step(expert.act())
        over = terminated or truncated
    assert env.task.startswith("Lift the 500 ml conical flask")
    assert info["outcome"] == "success"
    assert info["ml_spilled"] < 1.0


def test_a_beaker_that_is_put_back_leaves_nine_millimetres_above_the_rim():
    env = begun("level2/pour_liquid", liquid="off")
    assert nearest(env, 100_000, ("place/",), "beaker") > 0.009
