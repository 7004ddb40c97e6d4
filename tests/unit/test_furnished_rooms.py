"""What is built of a plan is as the plan says, and every task can be played in it."""

import time
from dataclasses import replace

import mujoco
import numpy as np
import pytest

from furnished_plans import BRIGHT, PARTED
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.labware.instrument_catalogue import instrument
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import (
    ROOMS,
    NoWorkPlaceError,
    UnknownRoomError,
    load_room,
    rooms_to_draw,
)
from labutopia_lerobot.scenes import __name__ as scenes_module
from labutopia_lerobot.scenes.building.masonry import masonry
from labutopia_lerobot.scenes.finishes import BENCH_FINISHES, WALL_FINISHES
from labutopia_lerobot.scenes.furnished_room import furnished_room
from labutopia_lerobot.scenes.laboratory import LABORATORY
from labutopia_lerobot.scenes.plan import Plan
from labutopia_lerobot.scenes.plan_model import build
from labutopia_lerobot.scenes.plans import load_plan, plan_names
from labutopia_lerobot.scenes.proof import faults
from labutopia_lerobot.scenes.space.boxes import TOUCHING
from labutopia_lerobot.scenes.views import DOOR_VIEW, OVEN_VIEW, PRESS_VIEW, VESSEL_VIEW
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.sim.classic_renderer import ClassicRenderer
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.world import BENCH, ROOM
from labutopia_lerobot.world.model import BEYOND_GROUP

OWN = {plan.name: plan for plan in (BRIGHT, PARTED)}
FEW = (*OWN, *plan_names()[::50])


def plan_of(name: str) -> Plan:
    return OWN[name] if name in OWN else load_plan(name)


@pytest.fixture
def rooms(monkeypatch):
    for plan in OWN.values():
        monkeypatch.setitem(ROOMS, plan.name, furnished_room(plan))


def overlaps(model: mujoco.MjModel, data: mujoco.MjData) -> dict[tuple[str, str], float]:
    """Return how deep things are in each other [m], by their names."""
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    mujoco.mj_collision(model, data)
    deep: dict[tuple[str, str], float] = {}
    for contact in data.contact:
        if (model.geom_contype[contact.geom] != 1).any():  # inside a panel: see `Detent`
            continue
        roots = model.body_rootid[model.geom_bodyid[contact.geom]]
        if roots[0] != roots[1]:
            pair = tuple(sorted(model.body(root).name for root in roots))
            deep[pair] = max(deep.get(pair, 0.0), -float(contact.dist))
    return deep


def sweep(plan: Plan) -> None:
    """Open everything that opens, one after the other; nothing may hit anything else."""
    model = build(plan).compile()
    data = mujoco.MjData(model)
    resting = overlaps(model, data)
    assert {pair: depth for pair, depth in resting.items() if depth > TOUCHING} == {}
    for joint in range(model.njnt):
        if model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_FREE or not model.jnt_limited[joint]:
            continue
        address = model.jnt_qposadr[joint]
        shut = data.qpos[address]
        for position in np.linspace(*model.jnt_range[joint], 7):
            data.qpos[address] = position
            for pair, depth in overlaps(model, data).items():
                assert depth < TOUCHING, (model.joint(joint).name, float(position), pair, depth)
        data.qpos[address] = shut


@pytest.mark.slow
@pytest.mark.parametrize("name", FEW)
def test_nothing_hits_anything_at_rest_or_when_it_is_opened(name):
    sweep(plan_of(name))


@pytest.mark.slow
@pytest.mark.parametrize("name", plan_names())
def test_in_no_room_anything_hits_anything(name):
    sweep(load_plan(name))


@pytest.mark.parametrize("plan", OWN.values(), ids=OWN)
def test_the_plans_of_these_tests_are_rooms_that_one_can_work_in(plan):
    assert faults(plan) == []


@pytest.mark.parametrize("name", FEW)
def test_a_room_without_its_ware_is_built_and_compiled_in_two_seconds(name):
    start = time.process_time()
    build(replace(plan_of(name), ware=())).compile()
    assert time.process_time() - start < 2.0


@pytest.mark.parametrize("plan", OWN.values(), ids=OWN)
def test_every_piece_is_where_the_plan_says_and_everything_that_opens_does(plan):
    model = build(plan).compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    for placed in plan.pieces:
        body = data.body(placed.name)
        np.testing.assert_allclose(body.xpos, (placed.x, placed.y, placed.height), atol=1e-9)
        front = -body.xmat.reshape(3, 3)[:2, 0]
        angle = np.radians(placed.heading)
        np.testing.assert_allclose(front, (np.cos(angle), np.sin(angle)), atol=1e-9)
        for joint in instrument(placed.kind, placed.name).joints:
            assert data.joint(joint).qpos.size == 1
    leaves = [name for name in (model.joint(j).name for j in range(model.njnt)) if "leaf" in name]
    doors = [opening for opening in plan.openings if opening.kind == "door"]
    assert len(leaves) == sum(2 if door.width > 1.25 else 1 for door in doors)


@pytest.mark.parametrize("plan", OWN.values(), ids=OWN)
def test_openings_are_holes_and_walls_are_not(plan):
    """A ray through an opening meets its door or pane, or nothing; beside it, the wall."""
    model = build(plan).compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    solid = np.array([0, 0, 0, 1, 0, 0], np.uint8)

    def met(x: float, y: float, z: float, way: tuple[float, float]) -> str:
        geom = np.array([-1], np.int32)
        start = np.array([x - 0.45 * way[0], y - 0.45 * way[1], z])
        far = mujoco.mj_ray(model, data, start, np.array([*way, 0.0]), solid, 1, -1, geom)
        return model.geom(geom[0]).name if 0 <= far < 0.9 else ""

    for opening in plan.openings:
        angle = np.radians(opening.heading)
        way = (-np.cos(angle), -np.sin(angle))
        middle, z = (opening.x, opening.y), opening.sill + 0.3
        assert not met(*middle, z, way).startswith("wall_")
        off = opening.width / 2 + 0.1
        for side in (-1, 1):
            beside = middle[0] - side * off * way[1], middle[1] + side * off * way[0]
            assert met(*beside, 3.1, way).startswith("wall_")
        assert met(*middle, opening.sill + opening.height + 0.05, way).startswith("wall_")
    assert sum(len(wall.openings) for wall in masonry(plan)) == len(plan.openings)


@pytest.mark.parametrize("plan", OWN.values(), ids=OWN)
def test_bench_and_robot_of_the_plan_are_where_the_task_has_them(plan):
    """The room is moved around the bench of the laboratory."""
    model = compile_scene([], PANDA, furnished_room(plan), VESSEL_VIEW).model
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    place = plan.work_places[0]
    bench = next(piece for piece in plan.pieces if piece.name == place.bench)
    room = data.body(ROOM)
    turn = room.xmat.reshape(3, 3)
    here = room.xpos + turn @ (place.x, place.y, LABORATORY.robot_stand[2])
    np.testing.assert_allclose(here, LABORATORY.robot_stand, atol=1e-9)
    middle = room.xpos + turn @ (bench.x, bench.y, LABORATORY.bench.height)
    np.testing.assert_allclose(middle, data.body(BENCH).xpos, atol=1e-9)


@pytest.mark.parametrize("name", ["organic_5", "teaching_1"])
def test_what_cannot_be_reached_is_a_few_geoms_without_physics(name):
    bare = compile_scene([], PANDA, LABORATORY, DOOR_VIEW).model
    room = furnished_room(load_plan(name))
    model = compile_scene([], PANDA, room, DOOR_VIEW).model
    drawn = [np.flatnonzero(m.geom_group < 3).size for m in (bare, model)]
    assert not room.pieces
    assert drawn[1] - drawn[0] < 10
    assert (model.nbody, model.nv, model.nu) == (bare.nbody, bare.nv, bare.nu)
    scenery = [g for g in range(model.ngeom) if model.geom(g).name.startswith("scenery")]
    assert scenery
    assert not model.geom_contype[scenery].any()
    assert not model.geom_conaffinity[scenery].any()


def test_what_the_robot_can_reach_is_a_body_of_its_own():
    room = furnished_room(BRIGHT)
    model = compile_scene([], PANDA, room, VESSEL_VIEW).model
    assert room.pieces
    for piece in room.pieces:
        assert model.geom_contype[model.geom_bodyid == model.body(piece.name).id].any()


@pytest.mark.parametrize("view", [VESSEL_VIEW, DOOR_VIEW, OVEN_VIEW, PRESS_VIEW])
@pytest.mark.parametrize("plan", OWN.values(), ids=OWN)
def test_fixed_cameras_see_all_there_is_to_see(plan, view):
    """What is left out of their pictures would not be in them."""
    model = compile_scene([], PANDA, furnished_room(plan), view).model
    data = mujoco.MjData(model)
    model.cam_pos[: model.ncam] += (0.04, -0.05, 0.04)
    mujoco.mj_forward(model, data)
    renderer = ClassicRenderer(model, 256, 256)
    for camera in ("front", "top"):
        drawn = renderer.color(data, camera)
        model.geom_group[model.geom_group == BEYOND_GROUP] = 2
        complete = renderer.color(data, camera)
        assert np.array_equal(drawn, complete)
    renderer.close()


@pytest.mark.slow
@pytest.mark.parametrize("task", ["level1/pick", "level1/open_drawer"])
def test_the_expert_moves_in_a_room_bit_by_bit_as_in_the_laboratory(rooms, task):
    """Where nothing is within its reach; what is shares the solver's rounding."""
    ends = []
    for room in ("laboratory", "parted", "organic_5"):
        env = LabEnv(Setting(task, obs="state", room=room))
        env.reset(seed=2)
        expert, over = env.expert(), False
        expert.start()
        while not over:
            _, _, terminated, truncated, info = env.step(expert.act())
            over = terminated or truncated
        assert info["outcome"] == "success"
        assert not expert.unexpected
        ends.append(env.workcell.simulation.data.qpos.copy())
    assert all(np.array_equal(end, ends[0]) for end in ends)


def test_the_axes_of_material_and_wall_paint_a_furnished_room(rooms):
    setting = Setting("level1/pick", cameras=("top",), room="bright", axes=("material", "wall"))
    env = LabEnv(setting)
    for seed in (1, 2):
        _, info = env.reset(seed=seed)
        model, drawn = env.workcell.simulation.scene.model, info["drawn"]
        wall, bench = WALL_FINISHES[drawn["wall"]], BENCH_FINISHES[drawn["material"]]
        np.testing.assert_allclose(model.material("wall").rgba, wall.rgba, atol=1e-6)
        np.testing.assert_allclose(model.material("bench_top").rgba, bench.rgba, atol=1e-6)
    env.close()


def test_the_axis_of_rooms_draws_where_an_episode_is_played_and_nothing_else():
    bare = LabEnv(Setting("level1/pick", obs="state"))
    env = LabEnv(Setting("level1/pick", obs="state", axes=("room",)))
    for seed in range(3):
        observation, info = env.reset(seed=seed)
        assert env.workcell.simulation.scene.room.name == info["drawn"]["room"]
        usual, _ = bare.reset(seed=seed)
        assert np.array_equal(observation["environment_state"], usual["environment_state"])


def test_rooms_to_train_in_and_rooms_for_tests_are_others_of_the_same_families():
    train, test = rooms_to_draw()
    assert not set(train) & set(test)
    assert {load_plan(name).family for name in train} == {load_plan(name).family for name in test}
    assert all(load_plan(name).work_places for name in (*train, *test))


def test_a_room_without_a_work_place_is_refused_with_rooms_that_have_one(monkeypatch):
    idle = replace(BRIGHT, name="idle", work_places=())
    plans = {"idle": idle, "bright": BRIGHT}
    monkeypatch.setattr(f"{scenes_module}.plan_names", lambda: tuple(plans))
    monkeypatch.setattr(f"{scenes_module}.load_plan", plans.__getitem__)
    with pytest.raises(NoWorkPlaceError, match=r"'idle' has no work place.*: laboratory, bright$"):
        LabEnv(Setting("level1/pick", room="idle"))
    with pytest.raises(UnknownRoomError, match=r"'brigth' is unknown. Did you mean: bright"):
        LabEnv(Setting("level1/pick", room="brigth"))


def test_the_laboratory_is_still_the_bare_one():
    assert load_room("laboratory") is LABORATORY
    assert LABORATORY.decorator is None


def test_instruments_of_a_task_stand_where_this_episode_has_them_among_sleeping_things():
    env = LabEnv(Setting("level1/press", obs="state", room="physics_5"))
    for seed in (1, 2):
        env.reset(seed=seed)
        simulation = env.workcell.simulation
        (panel,) = env.workcell.task.start
        assert simulation.scene.model.opt.enableflags & mujoco.mjtEnableBit.mjENBL_SLEEP
        stands = simulation.scene.model.body(panel.name).pos
        assert stands[0] > 0.3
        np.testing.assert_array_equal(simulation.data.body(panel.name).xpos, stands)
