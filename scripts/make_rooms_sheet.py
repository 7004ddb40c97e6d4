"""`python scripts/make_rooms_sheet.py`: `docs/rooms.md`, all rooms from above, some inside."""

from collections.abc import Iterator, Sequence
from pathlib import Path

import mujoco
import numpy as np
from PIL import Image, ImageDraw, ImageFont

from labutopia_lerobot.scenes.plan import Plan
from labutopia_lerobot.scenes.plan_model import build
from labutopia_lerobot.scenes.plans import load_plan, plan_names
from labutopia_lerobot.sim.classic_renderer import ClassicRenderer
from word_tables import cell, code

DOCS = Path(__file__).parents[1] / "docs"
PAGE, SHEET, VIEWS = DOCS / "rooms.md", DOCS / "rooms" / "plans.jpg", DOCS / "rooms" / "views.jpg"

_COLUMNS, _CELL, _LABEL = 10, 190, 18
"""Layout of the sheet: cells in a row, side of a cell and height of its label [pixels]."""
_VIEW = (900, 560)
"""Width and height of a perspective view [pixels]."""
_ANGLE = 31.0
"""Its field of view [deg]."""
_DETAIL = 2
"""Pictures are drawn this many times larger and shrunk, which smooths their edges."""
_PAPER = (255, 255, 255)
_FAR = 45.0
"""Height of the camera, so that walls are seen almost from the edge [m]."""


def main() -> None:
    """Write the page and its two pictures."""
    plans = [load_plan(name) for name in plan_names()]
    PAGE.write_text("\n".join(_lines(plans)) + "\n")
    SHEET.parent.mkdir(exist_ok=True)
    sheet(plans).save(SHEET, quality=80, optimize=True)
    views(_one_of_each(plans)).save(VIEWS, quality=82, optimize=True)


def _lines(plans: Sequence[Plan]) -> Iterator[str]:
    yield "# Rooms"
    yield ""
    yield "[To the README](../README.md)"
    yield ""
    yield "Made by `python scripts/make_rooms_sheet.py` from `scenes/plans`; do not edit."
    yield f"{len(plans)} furnished rooms, from above and without their ceilings. Every task of"
    yield "levels 1 to 4 can be played in those that have a work place, which ninety of them have:"
    yield "`room=NAME`. There the work place takes the place of the default room's bench: experts"
    yield "move as there, bit by bit where nothing is within their reach. What is nearer than"
    yield "1.25 m to the robot's base is real: it opens, moves and works; all else is a picture"
    yield "without joints or contacts. docs/room_generation.md says how many rooms have what."
    yield ""
    yield f"![All rooms from above](rooms/{SHEET.name})"
    yield ""
    yield "One room of each family:"
    yield ""
    yield f"![A room of each family](rooms/{VIEWS.name})"
    yield ""
    yield "| room | family | size [m] | pieces | ware | work places |"
    yield "| --- | --- | --- | --- | --- | --- |"
    for plan in plans:
        size = " x ".join(f"{side:g}" for side in plan.size)
        counts = [str(len(of)) for of in (plan.pieces, plan.ware, plan.work_places)]
        columns = (code(plan.name), plan.family, size, *counts)
        yield f"| {' | '.join(cell(column) for column in columns)} |"


def _one_of_each(plans: Sequence[Plan]) -> list[Plan]:
    """Return of each family the room in which most stands."""
    best: dict[str, Plan] = {}
    for plan in plans:
        if len(plan.pieces) > len(best.get(plan.family, plan).pieces) or plan.family not in best:
            best[plan.family] = plan
    return list(best.values())


def sheet(plans: Sequence[Plan]) -> Image.Image:
    """Return all plans from above, with their names."""
    rows = -(-len(plans) // _COLUMNS)
    side = _CELL + _LABEL
    paper = Image.new("RGB", (_COLUMNS * _CELL, rows * side), _PAPER)
    draw, font = ImageDraw.Draw(paper), ImageFont.load_default(13)
    for number, plan in enumerate(plans):
        x, y = number % _COLUMNS * _CELL, number // _COLUMNS * side
        paper.paste(from_above(plan, _CELL), (x, y))
        middle = (x + _CELL / 2, y + _CELL + _LABEL / 2 - 3)
        draw.text(middle, plan.name, fill=(50, 55, 60), font=font, anchor="mm")
    return paper


def views(plans: Sequence[Plan]) -> Image.Image:
    """Return plans as one sees them over their near corner, two in a row."""
    wide, high = _VIEW
    paper = Image.new("RGB", (2 * wide, -(-len(plans) // 2) * high), _PAPER)
    draw, font = ImageDraw.Draw(paper), ImageFont.load_default(22)
    for number, plan in enumerate(plans):
        x, y = number % 2 * wide, number // 2 * high
        paper.paste(over_the_corner(plan), (x, y))
        draw.text((x + 20, y + 16), plan.name, fill=(50, 55, 60), font=font)
    return paper


def from_above(plan: Plan, side: int) -> Image.Image:
    """Return a room from above, without its ceiling, in a square of so many pixels."""
    width, depth, height = plan.size
    middle = np.array([width / 2, depth / 2, 0.0])
    half = max(width, depth) / 2 + 0.45
    angle = 2 * np.degrees(np.arctan(half / (_FAR - height)))
    eye = middle + np.array([0.0, 0.0, _FAR])
    return _picture(plan, eye, middle, angle, (0.0, 1.0, 0.0), (side, side))


def over_the_corner(plan: Plan) -> Image.Image:
    """Return a room as one sees it from outside, over its south-west corner."""
    middle = np.array([plan.size[0] / 2, plan.size[1] / 2, 0.5 * plan.size[2]])
    back = np.array([-0.55, -0.80, 0.78])
    back /= np.linalg.norm(back)
    right = np.cross([0.0, 0.0, 1.0], back)
    right /= np.linalg.norm(right)
    corners = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]) * plan.size
    x, y, near = ((corners - middle) @ np.column_stack([right, np.cross(back, right), back])).T
    slope = np.tan(np.radians(_ANGLE / 2))
    away = np.maximum(np.abs(x) * _VIEW[1] / _VIEW[0], np.abs(y)) / slope + near
    eye = middle + 1.08 * away.max() * back
    return _picture(plan, eye, middle, _ANGLE, (0.0, 0.0, 1.0), _VIEW)


def _picture(
    plan: Plan,
    eye: np.ndarray,
    target: np.ndarray,
    angle: float,
    up: tuple[float, float, float],
    size: tuple[int, int],
) -> Image.Image:
    spec = build(plan)
    spec.visual.global_.offwidth, spec.visual.global_.offheight = (_DETAIL * side for side in size)
    paper = spec.add_material(name="paper", rgba=(*(np.array(_PAPER) / 255), 1.0))
    paper.emission = 1.0
    spec.worldbody.add_geom(
        type=mujoco.mjtGeom.mjGEOM_PLANE, pos=(0, 0, -0.03), size=(90, 90, 1), material="paper"
    )
    back = (eye - target) / np.linalg.norm(eye - target)
    right = np.cross(up, back)
    right /= np.linalg.norm(right)
    quat = np.empty(4)
    mujoco.mju_mat2Quat(quat, np.column_stack([right, np.cross(back, right), back]).ravel())
    spec.worldbody.add_camera(name="sheet", pos=eye, quat=quat, fovy=angle)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    renderer = ClassicRenderer(model, _DETAIL * size[0], _DETAIL * size[1])
    drawn = Image.fromarray(renderer.color(data, "sheet"))
    renderer.close()
    return drawn.resize(size, Image.Resampling.LANCZOS)


if __name__ == "__main__":
    main()
