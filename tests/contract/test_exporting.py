"""What is exported says the same, to MuJoCo and to OpenUSD, without this package."""

import json
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest

from labutopia_lerobot.cli import scene
from labutopia_lerobot.export import (
    ExportError,
    ExportSubject,
    UnknownSubjectError,
    export,
    find_subject,
    require_writable,
)
from labutopia_lerobot.export.summary import Summary
from labutopia_lerobot.labware.glass.catalogue import catalogue as ware
from labutopia_lerobot.labware.instrument_catalogue import catalogue, instrument
from labutopia_lerobot.labware.parts.instrument import Equipment

PIECES = [(kind, None) for kind in catalogue()]
PIECES += [(kind, list(series.sizes)[-1]) for kind, series in ware().items()]
every_piece = pytest.mark.parametrize(
    "what",
    [
        pytest.param(piece, id=piece[0], marks=[pytest.mark.slow] if number % 4 else [])
        for number, piece in enumerate(PIECES)
    ],
)

FRESH = """
import json, sys
import mujoco
found = {}
for path in sys.argv[1:]:
    model = mujoco.MjModel.from_xml_path(path)
    found[path] = {
        "mass": float(model.body_mass.sum()),
        "range": {model.joint(j).name: model.jnt_range[j].tolist() for j in range(model.njnt)},
        "triangles": int(model.nmeshface),
        "texture": int(model.tex_data.astype(int).sum()),
        "geoms": model.ngeom,
    }
assert not any(name.startswith("labutopia") for name in sys.modules)
print(json.dumps(found))
"""


def in_a_fresh_process(*files: Path) -> dict[str, dict]:
    """Return what MuJoCo says of MJCF files where this package cannot be imported."""
    command = [sys.executable, "-I", "-c", FRESH, *map(str, files)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.fixture(scope="module")
def opened(tmp_path_factory) -> dict[str, tuple[mujoco.MjModel, dict]]:
    """Return every piece as it is here, and as it is said to be elsewhere."""
    folder = tmp_path_factory.mktemp("pieces")
    subjects = {kind: find_subject(kind, size) for kind, size in PIECES}
    files = {kind: folder / f"{kind}.xml" for kind in subjects}
    for kind, subject in subjects.items():
        export(subject, files[kind])
    reported = in_a_fresh_process(*files.values())
    return {k: (subjects[k].model, reported[str(file)]) for k, file in files.items()}


@every_piece
def test_mjcf_of_a_piece_is_the_same_model_without_this_package(what, opened):
    here, there = opened[what[0]]
    assert there["mass"] == pytest.approx(here.body_mass.sum(), rel=1e-4)
    assert set(there["range"]) == {here.joint(joint).name for joint in range(here.njnt)}
    for name, limits in there["range"].items():
        assert limits == pytest.approx(here.joint(name).range.tolist(), rel=1e-5, abs=1e-5)
    assert there["triangles"] == here.nmeshface > 0 or not here.nmesh
    assert there["texture"] == here.tex_data.astype(int).sum()
    assert there["geoms"] == here.ngeom


@pytest.mark.parametrize("suffix", ["xml", "usda", "usdc"])
def test_the_same_piece_gives_the_same_bytes(tmp_path, suffix):
    if suffix != "xml":
        pytest.importorskip("pxr", reason="an extra")
    for folder in ("first", "second"):
        export(find_subject("centrifuge"), tmp_path / folder / f"centrifuge.{suffix}")
    files = sorted(p.relative_to(tmp_path / "first") for p in (tmp_path / "first").rglob("*.*"))
    assert len(files) == 3  # and two displays
    for file in files:
        assert (tmp_path / "first" / file).read_bytes() == (tmp_path / "second" / file).read_bytes()


def test_what_is_exported_can_be_moved(tmp_path):
    export(find_subject("centrifuge"), tmp_path / "here" / "centrifuge.xml")
    shutil.move(tmp_path / "here", tmp_path / "there")
    file = tmp_path / "there" / "centrifuge.xml"
    assert in_a_fresh_process(file)[str(file)]["texture"] > 0
    assert str(tmp_path) not in file.read_text()


@pytest.mark.parametrize(
    ("task", "thing"), [("level1/pick", "flask"), ("level1/squeeze", "beaker")]
)
def test_the_exported_start_of_a_task_stands_still(tmp_path, task, thing):
    export(find_subject(task, seed=3), tmp_path / "start.xml")
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "start.xml"))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    drawn = data.body(thing).xpos.copy()  # as a viewer shows it before a keyframe is loaded
    mujoco.mj_resetDataKeyframe(model, data, model.key("start").id)
    mujoco.mj_forward(model, data)
    start = data.xpos.copy()
    assert drawn == pytest.approx(data.body(thing).xpos, abs=1e-5)
    mujoco.mj_step(model, data, 600)
    assert np.abs(data.xpos - start).max() < 0.002


def test_seeds_start_elsewhere():
    starts = [find_subject("level1/pick", seed=seed).spec.body("flask").pos for seed in (1, 2, 1)]
    assert not np.allclose(starts[0], starts[1])
    assert np.array_equal(starts[0], starts[2])


@pytest.fixture
def usd():
    return pytest.importorskip("pxr", reason="an extra")


def opened_again(subject: ExportSubject, folder: Path):
    """Export as OpenUSD and return the stage."""
    from pxr import Usd

    out = folder / f"{subject.name}.usdc"
    export(subject, out)
    return Usd.Stage.Open(str(out))


def require_joints_where_they_are(stage) -> None:
    """Make sure that both sides of every joint are in one place, turned or moved along its axis."""
    from pxr import Gf, Usd, UsdGeom, UsdPhysics

    cache = UsdGeom.XformCache(Usd.TimeCode.Default())
    for prim in stage.Traverse():
        if not prim.IsA(UsdPhysics.Joint):
            continue
        joint, frames = UsdPhysics.Joint(prim), []
        for number in (0, 1):
            (body,) = getattr(joint, f"GetBody{number}Rel")().GetTargets()
            turn = Gf.Rotation(getattr(joint, f"GetLocalRot{number}Attr")().Get())
            local = Gf.Matrix4d(turn, Gf.Vec3d(getattr(joint, f"GetLocalPos{number}Attr")().Get()))
            frames.append(local * cache.GetLocalToWorldTransform(stage.GetPrimAtPath(body)))
        first, second = (np.array(frame) for frame in frames)
        axis, apart = first[2, :3], second[3, :3] - first[3, :3]
        assert second[2, :3] == pytest.approx(axis, abs=1e-5), prim
        if prim.IsA(UsdPhysics.RevoluteJoint):
            assert apart == pytest.approx(np.zeros(3), abs=1e-5), prim
        else:
            assert np.cross(apart, axis) == pytest.approx(np.zeros(3), abs=1e-5), prim
            assert second[0, :3] == pytest.approx(first[0, :3], abs=1e-5), prim


def require_mechanisms(stage, piece: Equipment) -> None:
    """Make sure that everything that moves does so as far as the piece says."""
    from pxr import UsdPhysics

    joints = {prim.GetName(): prim for prim in stage.Traverse() if prim.IsA(UsdPhysics.Joint)}
    for part in piece.mechanisms:
        prim = joints[part.joint]
        hinge = prim.IsA(UsdPhysics.RevoluteJoint)
        joint = (UsdPhysics.RevoluteJoint if hinge else UsdPhysics.PrismaticJoint)(prim)
        stop = joint.GetUpperLimitAttr().Get()
        if np.isfinite(stop):
            assert stop * (np.pi / 180 if hinge else 1.0) == pytest.approx(part.widest, abs=1e-3)
        assert prim.GetAttribute("physics:body1").IsValid() or joint.GetBody1Rel().GetTargets()


@pytest.mark.parametrize("kind", ["centrifuge", "muffle_furnace", "cabinet", "microscope"])
def test_an_instrument_is_the_same_to_openusd(usd, tmp_path, kind):
    from pxr import UsdGeom, UsdPhysics, UsdShade

    stage = opened_again(find_subject(kind), tmp_path)
    assert (UsdGeom.GetStageMetersPerUnit(stage), UsdGeom.GetStageUpAxis(stage)) == (1.0, "Z")
    require_mechanisms(stage, instrument(kind))
    require_joints_where_they_are(stage)
    prims = list(stage.Traverse())
    touched = [prim for prim in prims if prim.HasAPI(UsdPhysics.CollisionAPI)]
    assert {UsdGeom.Imageable(prim).ComputePurpose() for prim in touched} == {"guide"}
    seen = [
        prim
        for prim in prims
        if prim.IsA(UsdGeom.Gprim) and UsdGeom.Imageable(prim).ComputePurpose() == "default"
    ]
    assert all(UsdShade.MaterialBindingAPI(p).ComputeBoundMaterial()[0] for p in seen)
    rigid = [prim for prim in prims if prim.HasAPI(UsdPhysics.RigidBodyAPI)]
    assert not any(above in rigid for prim in rigid for above in (prim.GetParent(),))


@pytest.mark.slow
@every_piece
def test_every_piece_is_the_same_to_openusd(usd, tmp_path, what):
    stage = opened_again(find_subject(*what), tmp_path)
    require_joints_where_they_are(stage)
    if what[1] is None:
        require_mechanisms(stage, instrument(what[0]))


def test_a_task_is_the_same_to_openusd(usd, tmp_path):
    from pxr import UsdGeom, UsdPhysics

    subject = find_subject("level1/open_door")
    stage = opened_again(subject, tmp_path)
    require_joints_where_they_are(stage)
    prims = list(stage.Traverse())
    assert sum(prim.HasAPI(UsdPhysics.ArticulationRootAPI) for prim in prims) == 1  # the arm
    drives = [prim for prim in prims if prim.HasAPI(UsdPhysics.DriveAPI)]
    assert {prim.GetName() for prim in drives} == {f"joint{number}" for number in range(1, 8)}
    cameras = {prim.GetName() for prim in prims if prim.IsA(UsdGeom.Camera)}
    assert cameras == {"front", "top", "wrist"}


def test_a_door_stays_where_the_world_is_turned_about_it(usd, tmp_path):
    """Bodies and joints hang below one prim, so that a stage can be put anywhere."""
    from pxr import Usd, UsdGeom

    export(find_subject("muffle_furnace"), tmp_path / "furnace.usda")
    stage = Usd.Stage.CreateInMemory()
    put = UsdGeom.Xform.Define(stage, "/room/furnace")
    put.GetPrim().GetReferences().AddReference(str(tmp_path / "furnace.usda"))
    put.AddTranslateOp().Set((1.0, 2.0, 3.0))
    put.AddRotateZOp().Set(30.0)
    require_joints_where_they_are(stage)


def test_what_is_heavier_larger_or_opens_further_is_reported():
    reported = Summary(2, 3, 4, ((0.0, 1.0),), (0.5, 0.7), (0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
    assert reported.differences(replace(reported, masses=(0.5, 0.701))) == []
    wrong = {
        "masses": (0.5, 0.71),
        "limits": ((0.0, 1.01),),
        "high": (1.0, 1.0, 1.01),
        "moving": 1,
    }
    for name, value in wrong.items():
        (line,) = reported.differences(replace(reported, **{name: value}))
        assert line.startswith(name)


def test_what_does_not_exist_is_reported_with_what_is_called_like_it():
    with pytest.raises(UnknownSubjectError, match="Did you mean 'centrifuge'") as reported:
        find_subject("centrifuuge")
    assert "instruments alcohol_lamp" in str(reported.value)
    assert "rooms laboratory, " in str(reported.value)
    with pytest.raises(UnknownSubjectError, match="'level1/pick'"):
        find_subject("level1/pik")


def test_ware_of_several_sizes_needs_one_and_nothing_else_has_any():
    with pytest.raises(UnknownSubjectError, match=r"Choose a size of beaker_low: .*250 ml"):
        find_subject("beaker_low")
    with pytest.raises(UnknownSubjectError, match="'centrifuge' has no sizes"):
        find_subject("centrifuge", "250 ml")


def test_a_file_that_cannot_be_written_is_reported_before_anything_is_built(tmp_path, monkeypatch):
    with pytest.raises(ExportError, match=r"none of \.xml, \.usda, \.usdc"):
        require_writable(tmp_path / "centrifuge.stl")
    (tmp_path / "folder.xml").mkdir()
    with pytest.raises(ExportError, match="is a folder"):
        require_writable(tmp_path / "folder.xml")
    monkeypatch.setitem(sys.modules, "pxr", None)
    with pytest.raises(ExportError, match=r"pip install 'lerobot_env_labutopia\[usd\]'"):
        require_writable(tmp_path / "centrifuge.usda")


def test_the_program_writes_and_says_so(tmp_path, monkeypatch, capsys):
    out = tmp_path / "beaker.xml"
    command = ["export", "beaker_low", "--size", "250 ml", "--out", str(out)]
    monkeypatch.setattr(sys, "argv", ["labutopia-scene", *command])
    scene.main()
    assert "1 moving bodies of" in capsys.readouterr().out
    assert out.exists()
    monkeypatch.setattr(sys, "argv", ["labutopia-scene", "export", "nothing", "--out", str(out)])
    with pytest.raises(SystemExit, match="2"):
        scene.main()
    assert "Nothing is called 'nothing'" in capsys.readouterr().err


@pytest.mark.slow
@pytest.mark.parametrize("suffix", ["xml", "usdc"])
def test_a_furnished_room_is_the_same_elsewhere(tmp_path, suffix):
    if suffix == "usdc":
        pytest.importorskip("pxr", reason="an extra")
    reported = export(find_subject("organic_7"), tmp_path / f"organic_7.{suffix}")
    assert reported.moving > 50
    assert len(reported.limits) > 50
    assert reported.high[2] < 3.5
