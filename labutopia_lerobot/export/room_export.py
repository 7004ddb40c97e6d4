"""A furnished room as files: specification, MJCF and picture."""

import math
from pathlib import Path

import mujoco
import numpy as np
from PIL import Image
from scipy.spatial.transform import Rotation

from labutopia_lerobot.export.mjcf import write_mjcf
from labutopia_lerobot.labware.instrument_catalogue import instrument
from labutopia_lerobot.processes import Apparatus
from labutopia_lerobot.scenes.plan import Plan
from labutopia_lerobot.scenes.plan_model import build
from labutopia_lerobot.scenes.plans import text_of
from labutopia_lerobot.sim.classic_renderer import ClassicRenderer

OVERVIEW = "overview"
"""Name of the camera from which the picture is taken."""
WIDTH, HEIGHT = 1280, 800
"""Size of the picture [pixels]."""
_FIELD_OF_VIEW_DEG = 32.0
_FROM = np.array([-0.35, -0.62, 0.85])
"""Direction of the camera from the middle of the room: above its south-west."""


def write_room(plan: Plan, folder: Path) -> tuple[Path, Path, Path]:
    """Write NAME.json, NAME.xml with its textures and NAME.png; the same bytes for the same plan.

    Args:
        plan: The room.
        folder: Where to; made if there is none.

    Returns:
        The three files.
    """
    folder.mkdir(parents=True, exist_ok=True)
    spec = build(plan)
    _add_camera(spec, plan)
    model = spec.compile()
    files = tuple(folder / f"{plan.name}.{kind}" for kind in ("json", "xml", "png"))
    files[0].write_text(text_of(plan), encoding="utf-8")
    write_mjcf(spec, files[1])
    picture(plan, model).save(files[2])
    return files[0], files[1], files[2]


def picture(plan: Plan, model: mujoco.MjModel) -> Image.Image:
    """Return a room seen from above its south-west corner, ceiling and near walls taken off."""
    pieces = (instrument(piece.kind, piece.name) for piece in plan.pieces)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    apparatus = Apparatus(model, data, (p for piece in pieces for p in piece.processes))
    renderer = ClassicRenderer(model, WIDTH, HEIGHT, apparatus=apparatus)
    try:
        return Image.fromarray(renderer.color(data, OVERVIEW))
    finally:
        renderer.close()


def _add_camera(spec: mujoco.MjSpec, plan: Plan) -> None:
    """Add the camera of the picture: it sees the whole floor."""
    back = _FROM / np.linalg.norm(_FROM)
    right = np.cross([0.0, 0.0, 1.0], back)
    right /= np.linalg.norm(right)
    axes = np.column_stack([right, np.cross(back, right), back])
    half = math.tan(math.radians(_FIELD_OF_VIEW_DEG / 2))
    middle = np.array([plan.size[0] / 2, plan.size[1] / 2, 0.6])
    corners = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]) * plan.size
    in_camera = (corners - middle) @ axes  # right, up, towards the camera
    limits = np.array([half * WIDTH / HEIGHT, half])
    away = (np.abs(in_camera[:, :2]) / limits + in_camera[:, 2:]).max()
    spec.worldbody.add_camera(
        name=OVERVIEW,
        pos=middle + 1.03 * away * back,
        quat=Rotation.from_matrix(axes).as_quat(scalar_first=True),
        fovy=_FIELD_OF_VIEW_DEG,
    )
