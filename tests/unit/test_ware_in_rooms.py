"""Ware stands on the benches and shelves of furnished rooms, and what is near is real."""

from dataclasses import replace

import mujoco
import numpy as np
import pytest

from furnished_plans import BRIGHT
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.labware.glass.catalogue import catalogue
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.families import families, family
from labutopia_lerobot.scenes.furnished_room import furnished_room
from labutopia_lerobot.scenes.generation import generate
from labutopia_lerobot.scenes.generation.stock import stocked
from labutopia_lerobot.scenes.plan import PlacedWare, Plan
from labutopia_lerobot.scenes.plan_model import build
from labutopia_lerobot.scenes.plans import load_plan, plan_names
from labutopia_lerobot.scenes.proof import faults
from labutopia_lerobot.scenes.scenery import scenery
from labutopia_lerobot.scenes.still_ware import still_ware
from labutopia_lerobot.scenes.views import VESSEL_VIEW
from labutopia_lerobot.scenes.within_reach import real_names, real_pieces
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.sim.scene import compile_scene

CLOSE = "physics_5"
"""A room in which instruments and ware are within reach of the robot."""
WITH_PLACE = [name for name in plan_names() if load_plan(name).work_places]


def triangles(plan: Plan) -> int:
    return sum(len(mesh.colors) for mesh in scenery(plan))


def test_ware_moves_no_piece_and_its_racks_come_behind_them():
    plan = load_plan("biology_0")
    bare = generate(replace(family("biology"), stock=()), plan.seed)
    assert plan.pieces[: len(bare.pieces)] == bare.pieces
    added = plan.pieces[len(bare.pieces) :]
    assert {piece.kind for piece in added} <= {"tube_rack", "cork_ring"}
    assert {ware.on for ware in plan.ware} >= {piece.name for piece in added}


def test_the_same_plan_is_stocked_alike_and_another_seed_is_not():
    plan, stock = replace(load_plan("weighing_room_0"), ware=()), family("weighing_room").stock
    assert stocked(plan, stock) == stocked(plan, stock)
    assert stocked(plan, stock).ware != stocked(replace(plan, seed=99), stock).ware


@pytest.mark.parametrize("name", families())
def test_what_a_family_works_with_is_in_the_catalogue_and_can_stand_or_be_held(name):
    stock = family(name).stock
    assert stock
    for one in stock:
        series = catalogue()[one.kind]
        assert set(one.sizes) <= set(series.sizes)
        assert series.stands or series.holder
        assert not one.closed or series.closure  # type: ignore[union-attr]


def test_every_room_with_a_bench_bears_ware_as_a_working_laboratory_does():
    for name in plan_names():
        plan = load_plan(name)
        benches = {p.name for p in plan.pieces if p.kind in ("wall_bench", "island_bench")}
        racks = {p.name: p.on for p in plan.pieces if p.kind in ("tube_rack", "cork_ring")}
        stands = [ware for ware in plan.ware if racks.get(ware.on, ware.on) in benches]
        assert len(stands) >= len(benches), name
        assert not [ware for ware in plan.ware if ware.on.startswith("work_bench")]


def test_a_stopper_a_level_and_a_substance_are_seen():
    bare = still_ware("reagent_bottle", "500 ml")
    closed = still_ware("reagent_bottle", "500 ml", closed=True)
    full = still_ware("reagent_bottle", "500 ml", closed=True, contents="water", level=0.5)
    assert max(mesh[0][:, 2].max() for mesh, *_ in closed) > max(
        mesh[0][:, 2].max() for mesh, *_ in bare
    )
    assert len(full) == len(closed) + 1
    assert sum(len(mesh[2]) for mesh, *_ in full) < 160


def test_clear_glass_is_clear_and_amber_glass_is_not():
    opacity = {
        kind: still_ware(kind, "500 ml")[0][1][3]
        for kind in ("reagent_bottle", "reagent_bottle_amber")
    }
    assert opacity["reagent_bottle"] < 0.5
    assert opacity["reagent_bottle_amber"] == 1.0


def test_ware_is_drawn_where_it_stands():
    ware = PlacedWare("beaker_low", "600 ml", "beaker", 2.6, 5.6, 0.9, "wall_bench_1")
    drawn = replace(BRIGHT, ware=(ware,))
    assert faults(drawn) == []
    assert triangles(drawn) > triangles(BRIGHT)
    (added,) = (mesh for mesh in scenery(drawn) if mesh.look == "clear")
    vertices = added.mesh[0]
    beside = np.abs(vertices[:, :2] - (2.6, 5.6)).max(axis=1) < 0.07
    assert vertices[beside, 2].min() == pytest.approx(0.9, abs=1e-6)


def test_an_exported_room_has_ware_that_can_be_taken():
    ware = PlacedWare("reagent_bottle", "500 ml", "acid", 2.6, 5.6, 0.9, "wall_bench_1", True)
    model = build(replace(BRIGHT, ware=(ware,))).compile()
    assert model.body("acid").mass > 0.1
    assert model.joint("acid_free").id != model.joint("acid_closure_free").id


@pytest.mark.slow
def test_what_is_within_reach_can_be_opened_moved_and_read():
    plan = load_plan(CLOSE)
    real = real_names(plan)
    assert {"polarimeter_1", "wall_bench_2"} < real
    assert real & {ware.name for ware in plan.ware}
    scene = compile_scene([], PANDA, furnished_room(plan), VESSEL_VIEW)
    model, names = scene.model, {piece.piece.name for piece in real_pieces(plan)}
    assert names >= {f"room_{name}" for name in real}
    for each in real_pieces(plan):
        for joint in each.piece.joints:
            assert model.joint(joint).id >= 0
        assert not each.piece.movable or model.body(each.piece.name).mass > 0
        assert set(each.piece.processes) <= set(scene.processes)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    before = {name: data.body(name).xpos.copy() for name in names}
    mujoco.mj_step(model, data, 100)
    for name in names:
        np.testing.assert_allclose(data.body(name).xpos, before[name], atol=1e-3)


def test_what_stands_around_sleeps_until_it_is_pushed_and_the_flask_of_the_task_never_does():
    env = LabEnv(Setting("level1/pick", obs="state", room=CLOSE))
    env.reset(seed=0)
    simulation = env.workcell.simulation
    model, data = simulation.scene.model, simulation.data
    (bottle, *_) = [p.name for p in simulation.scene.room.pieces if isinstance(p, Vessel)]
    own = int(model.dof_treeid[model.joint("flask_free").dofadr[0]])
    theirs = int(model.dof_treeid[model.joint(f"{bottle}_free").dofadr[0]])
    simulation.step(simulation.command)
    assert data.tree_awake[own]
    assert not data.tree_awake[theirs]
    state, before = simulation.state(), data.body(bottle).xpos.copy()
    data.body(bottle).xfrc_applied[0] = 20.0
    for _ in range(6):
        simulation.step(simulation.command)
    assert data.tree_awake[theirs]
    assert np.linalg.norm(data.body(bottle).xpos - before) > 0.01
    data.body(bottle).xfrc_applied[:] = 0.0
    ends = []
    for _ in range(2):  # woken, and put back to where it slept
        simulation.restore(state)
        for _ in range(6):
            simulation.step(simulation.command)
        ends.append(simulation.state().tobytes())
    assert ends[0] == ends[1]


def test_the_bare_room_knows_no_sleep():
    scene = compile_scene([], PANDA, LABORATORY, VESSEL_VIEW)
    assert not scene.model.opt.enableflags & mujoco.mjtEnableBit.mjENBL_SLEEP


def test_what_is_real_is_not_in_the_picture_of_the_rest():
    plan = load_plan(CLOSE)
    real = real_names(plan)
    away = replace(
        plan,
        pieces=tuple(piece for piece in plan.pieces if piece.name not in real),
        ware=tuple(ware for ware in plan.ware if ware.on not in real),
    )
    left = [ware for ware in plan.ware if ware.on in real and ware.name not in real]
    still = sum(
        len(mesh[2])
        for ware in left
        for mesh, *_ in still_ware(ware.kind, ware.size, ware.closed, ware.contents, ware.level)
    )
    assert triangles(plan) == triangles(away) + still


@pytest.mark.slow
@pytest.mark.parametrize("name", WITH_PLACE)
def test_nothing_that_is_real_moves_by_itself(name):
    scene = compile_scene([], PANDA, furnished_room(load_plan(name)), VESSEL_VIEW)
    names = [piece.name for piece in scene.room.pieces]
    data = mujoco.MjData(scene.model)
    mujoco.mj_forward(scene.model, data)
    before = {name: data.body(name).xpos.copy() for name in names}
    mujoco.mj_step(scene.model, data, 600)
    for name in names:
        np.testing.assert_allclose(data.body(name).xpos, before[name], atol=2e-3)
