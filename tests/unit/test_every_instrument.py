"""What must hold for every instrument of the catalogue; an instrument adds no code here."""

from functools import cache

import mujoco
import numpy as np
import pytest
from numpy.typing import NDArray

from labutopia_lerobot.labware.instrument_catalogue import catalogue, instrument
from labutopia_lerobot.labware.parts.dials import Unmeasured
from labutopia_lerobot.labware.parts.instrument import Equipment
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import DOOR_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.world.model import COLLISION_GROUP, PHYSICS_HZ, SOLIMP, SOLREF, VISUAL_GROUP

KINDS = list(catalogue())

every = pytest.mark.parametrize("kind", KINDS)

DEEPEST = 0.001
"""How far two parts may go into each other [m]."""
CREEPS = {"vacuum_oven": 0.003}
"""How far a part sinks in 10 s that its friction alone holds [m]: the lever, which tasks use."""
MOST_TRIANGLES, MOST_SEEN, MOST_GEOMS = 9000, 60, 400
"""Of one instrument: triangles and geoms that are drawn, geoms of all kinds."""


@cache
def alone(kind: str, *, overlapping: bool = False) -> mujoco.MjModel:
    """Return an instrument on a floor, as in a scene.

    With `overlapping` nothing is excluded from touching: what moves may touch what carries it.
    """
    piece = instrument(kind)
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    spec.default.geom.solref[:] = SOLREF
    spec.default.geom.solimp[:] = SOLIMP
    spec.option.timestep = 1.0 / PHYSICS_HZ
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.impratio = 30.0
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    body = piece.add_to(spec, spec.worldbody)
    if piece.movable:
        body.add_freejoint(name=f"{kind}_free")
        spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[5, 5, 0.1], name="floor")
    if overlapping:
        spec.option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_FILTERPARENT)
        for pair in list(spec.excludes):
            spec.delete(pair)
    return spec.compile()


def run(model: mujoco.MjModel, data: mujoco.MjData, seconds: float) -> None:
    mujoco.mj_step(model, data, round(seconds * PHYSICS_HZ))


def corners(model: mujoco.MjModel) -> NDArray[np.float64]:
    """Return points around all that is seen, shape (n, 3), world frame [m]."""
    data, points = mujoco.MjData(model), []
    mujoco.mj_forward(model, data)
    seen = (model.geom_group == VISUAL_GROUP) & (model.geom_bodyid > 0)
    for geom in np.flatnonzero(seen & (model.geom_rgba[:, 3] > 0)):  # no flame that is not lit
        if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_MESH:
            mesh = model.geom_dataid[geom]
            start = model.mesh_vertadr[mesh]
            local = model.mesh_vert[start : start + model.mesh_vertnum[mesh]]
        else:
            centre, half = model.geom_aabb[geom, :3], model.geom_aabb[geom, 3:]
            local = np.array(np.meshgrid(*([-1, 1],) * 3)).reshape(3, -1).T * half + centre
        points.append(local @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom])
    return np.vstack(points)


@every
def test_every_element_is_named_after_it(kind):
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    catalogue()[kind]("thing").add_to(spec, spec.worldbody)
    elements = [*spec.bodies[1:], *spec.geoms, *spec.joints, *spec.sites, *spec.materials]
    elements += [*spec.meshes, *spec.textures, *spec.sensors, *spec.tendons, *spec.equalities]
    # All glass of a scene shares one gleam.
    assert {e.name for e in elements if not e.name.startswith("thing")} <= {"gleam"}


def test_all_of_them_compile_in_one_room():
    scene = compile_scene([instrument(kind) for kind in KINDS], PANDA, LABORATORY, DOOR_VIEW)
    assert {kind for kind in KINDS if scene.model.body(kind).id > 0} == set(KINDS)


@every
def test_it_says_what_it_is_and_where_its_sizes_are_from(kind):
    piece = instrument(kind)
    assert isinstance(piece, Equipment)
    assert piece.source
    assert piece.mass > 0
    assert piece == instrument(kind)
    assert hash(piece) == hash(instrument(kind))


@every
def test_it_does_something_by_itself_or_says_that_it_does_not(kind):
    piece = instrument(kind)
    remembers = any(process.slots for process in piece.processes)
    if piece.passive:
        assert not piece.processes
        assert not piece.left_out
    else:
        assert remembers or piece.left_out
    if any(isinstance(display.of, Unmeasured) for display in piece.displays):
        assert piece.left_out


@every
def test_it_is_as_large_as_it_says(kind):
    points, piece = corners(alone(kind)), instrument(kind)
    assert np.ptp(points, axis=0) == pytest.approx(piece.size, rel=0.03, abs=0.004)


@every
def test_what_stands_free_weighs_what_it_says_and_all_else_is_fixed(kind):
    model, piece = alone(kind), instrument(kind)
    root = model.body(kind)
    if piece.movable:
        assert model.body_subtreemass[root.id] == pytest.approx(piece.mass, rel=0.2)
    assert bool(root.dofnum[0] == 6) is piece.movable


@every
def test_it_stands_still(kind):
    model = alone(kind)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    start, furthest = data.xipos.copy(), 0.0
    for _ in range(50):
        run(model, data, 0.2)
        furthest = max(furthest, float(np.abs(data.xipos - start).max()))
    assert furthest < CREEPS.get(kind, 0.001)


@every
def test_everything_that_moves_opens_and_shuts_again(kind):
    model, piece = alone(kind), instrument(kind)
    data = mujoco.MjData(model)
    parts = piece.mechanisms
    for part, way in [(p, 1.0) for p in parts] + [(p, -1.0) for p in reversed(parts)]:
        joint = data.joint(part.joint)
        joint.qfrc_applied[:] = way * part.effort
        for _ in range(100):
            run(model, data, 0.05)
            share = float(joint.qpos[0]) / part.widest
            if reached := (share > 0.98 if way > 0 else share < 0.02):
                run(model, data, 0.1)
                break
        joint.qfrc_applied[:] = 0.0
        assert reached, (
            f"{part.name} is at {part.format_position(share * part.widest)} after {way:+g}"
        )
        assert np.isfinite(data.qpos).all()
        data.qvel[:] = 0.0  # a hand stops it
    for part in parts:
        if model.jnt_limited[data.joint(part.joint).id]:
            assert abs(float(data.joint(part.joint).qpos[0])) < 0.03 * part.widest, part.name


@every
def test_every_button_goes_in_and_comes_back(kind):
    model, piece = alone(kind), instrument(kind)
    data = mujoco.MjData(model)
    for button in piece.buttons:
        joint = data.joint(button.joint)
        joint.qfrc_applied[:] = 5.0
        run(model, data, 0.5)
        assert joint.qpos[0] > button.travel
        joint.qfrc_applied[:] = 0.0
        run(model, data, 0.5)
        assert abs(joint.qpos[0]) < 0.0005


def overlaps(model: mujoco.MjModel, data: mujoco.MjData) -> dict[tuple[str, str], float]:
    """Return how deep geoms of different bodies are in each other now [m], by their names."""
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    mujoco.mj_collision(model, data)
    deep: dict[tuple[str, str], float] = {}
    for contact in data.contact:
        if (model.geom_contype[contact.geom] != 1).any():  # inside a panel: see `Detent`
            continue
        pair = tuple(sorted(model.geom(geom).name for geom in contact.geom))
        deep[pair] = max(deep.get(pair, 0.0), -float(contact.dist))
    return deep


@every
def test_nothing_that_moves_goes_into_anything(kind):
    model, piece = alone(kind, overlapping=True), instrument(kind)
    model.eq_active0[:] = 0
    data = mujoco.MjData(model)
    built = overlaps(model, data)
    for part in piece.mechanisms:
        for share in np.linspace(0.0, 1.0, 13):
            data.joint(part.joint).qpos[0] = share * part.widest
            for pair, depth in overlaps(model, data).items():
                # What is fitted into its bearing is so from the start, and goes no deeper.
                assert depth < DEEPEST + built.get(pair, 0.0), (part.name, share, pair, depth)


@every
def test_it_is_cheap_to_draw_and_to_touch(kind):
    model = alone(kind)
    seen = model.geom_group == VISUAL_GROUP
    meshes = model.geom_dataid[seen & (model.geom_type == mujoco.mjtGeom.mjGEOM_MESH)]
    assert model.mesh_facenum[meshes].sum() <= MOST_TRIANGLES
    assert seen.sum() <= MOST_SEEN
    assert model.ngeom <= MOST_GEOMS
    assert not model.geom_contype[seen].any()


@every
def test_what_moves_has_a_hull_for_the_planner(kind):
    model, piece = alone(kind), instrument(kind)
    hulls = {int(model.geom_bodyid[geom]) for geom in np.flatnonzero(model.geom_group == 4)}
    assert {model.body(part.name).id for part in piece.mechanisms} <= hulls


@every
def test_things_stand_in_its_places(kind):
    piece = instrument(kind)
    if not piece.places:
        pytest.skip("it has no places")
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    spec.default.geom.solref[:], spec.default.geom.solimp[:] = SOLREF, SOLIMP
    spec.option.timestep = 1.0 / PHYSICS_HZ
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    piece.add_to(spec, spec.worldbody)
    opened = spec.compile()
    data = mujoco.MjData(opened)
    for part in piece.mechanisms:
        if part.joint in piece.joints:
            data.joint(part.joint).qpos[0] = 0.0
    mujoco.mj_forward(opened, data)
    for number, place in enumerate(piece.places):
        frame = data.site(place.name)
        tall = max(0.02, place.depth)
        body = spec.worldbody.add_body(name=f"stands_{number}", pos=frame.xpos)
        body.add_freejoint()
        body.add_geom(
            type=mujoco.mjtGeom.mjGEOM_CYLINDER,
            size=(0.45 * place.width, tall / 2, 0.0),
            pos=(0.0, 0.0, tall / 2 + 0.0002),
            mass=0.05,
            group=COLLISION_GROUP,
        )
    model = spec.compile()
    data = mujoco.MjData(model)
    run(model, data, 1.5)
    mujoco.mj_forward(model, data)
    touching = {
        frozenset(model.body(model.geom_bodyid[geom]).name for geom in contact.geom)
        for contact in data.contact
    }
    for number, place in enumerate(piece.places):
        moved = data.body(f"stands_{number}").xpos - data.site(place.name).xpos
        assert np.linalg.norm(moved) < 0.004, place.name
        assert {f"stands_{number}", place.support} in touching, place.name
