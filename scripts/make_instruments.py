"""`python scripts/make_instruments.py`: `docs/instruments.md`, every instrument shut and open."""

import re
from collections.abc import Iterator
from pathlib import Path

import mujoco
import numpy as np
from numpy.typing import NDArray
from PIL import Image

import piece_pictures
from labutopia_lerobot.labware.instrument_catalogue import catalogue, instrument
from labutopia_lerobot.labware.parts.instrument import Equipment
from labutopia_lerobot.processes import Apparatus
from labutopia_lerobot.sim.classic_renderer import ClassicRenderer
from word_tables import cell, code, summary

DOCS = Path(__file__).parents[1] / "docs"
PAGE = DOCS / "instruments.md"
PICTURES = DOCS / "instruments"

SIZE = 260
"""Width and height of a picture [pixels]; two stand side by side."""
_OPENED = 0.9
"""Opening of every moving part, as a share of its range."""


def main() -> None:
    """Write the page and its pictures."""
    PICTURES.mkdir(exist_ok=True)
    for kind in catalogue():
        picture(kind).save(PICTURES / f"{kind}.jpg", quality=78, optimize=True)
    for file in PICTURES.glob("*.jpg"):
        if file.stem not in catalogue():
            file.unlink()
    PAGE.write_text(page())


def page() -> str:
    """Return the page in Markdown."""
    return "\n".join(_lines()).rstrip() + "\n"


def _lines() -> Iterator[str]:
    yield "# Instruments"
    yield ""
    yield "[To the README](../README.md)"
    yield ""
    yield "Made by `python scripts/make_instruments.py` from `labware/instruments`; do not edit."
    yield "Left: shut; right: all that moves opened. The bar on the floor is 100 mm long. Size is"
    yield 'depth x width x height with all that stands out. "From memory" means that no'
    yield 'catalogue was at hand. "Works" names the processes that remember something, buttons'
    yield "excepted; what is passive does nothing in reality either. In *italics*: what a real one"
    yield "does besides and this one does not."
    yield ""
    yield f"{len(catalogue())} kinds. `labware.instrument_catalogue.instrument(kind)` makes one."
    yield ""
    yield "| | kind | what it is | size [mm], mass [kg] | moves | works | source |"
    yield "| --- | --- | --- | --- | --- | --- | --- |"
    for kind in catalogue():
        piece = instrument(kind)
        assert isinstance(piece, Equipment)
        size = " x ".join(f"{1e3 * side:.0f}" for side in piece.size)
        moves = [f"{_part(kind, m.name)} {m.format_position(m.widest)}" for m in piece.mechanisms]
        moves += [f"{_part(kind, button.name)} (button)" for button in piece.buttons]
        columns = (
            f"![{kind}](instruments/{kind}.jpg)",
            code(kind),
            summary(type(piece)),
            f"{size}, {piece.mass:g}{'' if piece.movable else ' (fixed)'}",
            ", ".join(moves),
            _works(piece),
            piece.source,
        )
        yield f"| {' | '.join(cell(column) for column in columns)} |"


def _works(piece: Equipment) -> str:
    if piece.passive:
        return "passive"
    read = (*piece.works, *(display.of for display in piece.displays))
    kinds = dict.fromkeys(type(process).__name__ for process in read if process.slots)
    words = ", ".join(re.sub(r"(?<!^)(?=[A-Z])", " ", kind).lower() for kind in kinds)
    return "; ".join(filter(None, (words, piece.left_out and f"*{piece.left_out}*")))


def _part(kind: str, name: str) -> str:
    return name.removeprefix(f"{kind}_").replace("_", " ")


def picture(kind: str) -> Image.Image:
    """Return an instrument shut and open, beside a bar of 100 mm."""
    piece = instrument(kind)
    assert isinstance(piece, Equipment)
    model = _compiled(piece)
    data = mujoco.MjData(model)
    shut = np.vstack(_visible_points(model, data))
    low = shut.min(axis=0)
    for number in range(2):
        model.geom(f"bar_{number}").pos = (low[0] - 0.03, 0.025 - 0.05 * number, low[2] + 0.004)
    model.geom("floor").pos = (0.0, 0.0, low[2] - 0.001)
    mujoco.mj_forward(model, data)
    apparatus = Apparatus(model, data, piece.processes)
    apparatus.start(np.random.default_rng(0))
    renderer = ClassicRenderer(model, 2 * SIZE, 2 * SIZE, apparatus=apparatus)
    drawn = Image.new("RGB", (2 * SIZE, SIZE))
    for number, share in enumerate((0.0, _OPENED)):
        for part in piece.mechanisms:
            endless = not model.jnt_limited[model.joint(part.joint).id]
            data.joint(part.joint).qpos = 0.3 * share if endless else share * part.widest
        for gear in range(model.neq):  # what follows another joint
            follower, leader = (
                model.jnt_qposadr[j[gear]] for j in (model.eq_obj1id, model.eq_obj2id)
            )
            data.qpos[follower] = np.polyval(model.eq_data[gear, 4::-1], data.qpos[leader])
        apparatus.show()
        points = np.vstack([shut, *_visible_points(model, data), [[low[0] - 0.035, 0.0, low[2]]]])
        _aim(model, points.min(axis=0), points.max(axis=0))
        mujoco.mj_forward(model, data)
        view = Image.fromarray(renderer.color(data, "front"))
        drawn.paste(view.resize((SIZE, SIZE), Image.Resampling.LANCZOS), (number * SIZE, 0))
    renderer.close()
    return drawn


def _compiled(piece: Equipment) -> mujoco.MjModel:
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    piece_pictures._add_surroundings(spec)
    spec.visual.global_.offwidth = spec.visual.global_.offheight = 2 * SIZE
    for number, grey in enumerate((0.95, 0.10)):
        spec.worldbody.add_geom(
            name=f"bar_{number}",
            type=mujoco.mjtGeom.mjGEOM_BOX,
            size=(0.004, 0.025, 0.004),
            pos=(0.0, 0.0, -1.0),  # as of the floor
            rgba=(grey, grey, grey, 1.0),
        )
    piece.add_to(spec, spec.worldbody)  # type: ignore[attr-defined]
    return spec.compile()


def _visible_points(model: mujoco.MjModel, data: mujoco.MjData) -> list[NDArray[np.float64]]:
    """Return points around all that is seen of an instrument now, each of shape (n, 3) [m]."""
    mujoco.mj_kinematics(model, data)
    clouds = []
    for geom in range(model.ngeom):
        seen = model.geom_group[geom] <= 2 and model.geom_rgba[geom, 3] > 0.0
        if model.geom_bodyid[geom] and seen:
            if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_MESH:
                mesh = model.geom_dataid[geom]
                start = model.mesh_vertadr[mesh]
                local = model.mesh_vert[start : start + model.mesh_vertnum[mesh]]
            else:
                centre, half = model.geom_aabb[geom, :3], model.geom_aabb[geom, 3:]
                local = np.array(np.meshgrid(*([-1, 1],) * 3)).reshape(3, -1).T * half + centre
            clouds.append(local @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom])
    return clouds


def _aim(model: mujoco.MjModel, low: NDArray[np.float64], high: NDArray[np.float64]) -> None:
    """Put the camera where it sees a box."""
    way = piece_pictures._FROM / np.linalg.norm(piece_pictures._FROM)
    half = np.radians(piece_pictures._FIELD_OF_VIEW_DEG / 2)
    distance = 0.93 * float(np.linalg.norm(high - low)) / 2 / np.sin(half)
    model.camera("front").pos = (low + high) / 2 + distance * way


if __name__ == "__main__":
    main()
