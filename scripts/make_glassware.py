"""`python scripts/make_glassware.py`: `docs/glassware.md`, every kind of ware in all its sizes."""

from collections.abc import Iterator
from pathlib import Path

import mujoco
import numpy as np
from numpy.typing import NDArray
from PIL import Image

import piece_pictures
from labutopia_lerobot.labware.glass.catalogue import Kind, catalogue, vessels
from labutopia_lerobot.labware.glass.series import ClosureSeries, Series, called
from labutopia_lerobot.labware.glass.utensil import Utensil
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.robots.franka_hand import FRANKA_HAND
from labutopia_lerobot.sim.classic_renderer import ClassicRenderer
from word_tables import cell, code

DOCS = Path(__file__).parents[1] / "docs"
PAGE = DOCS / "glassware.md"
PICTURES = DOCS / "glassware"

WIDTH, HEIGHT = 640, 240
"""Size of a picture [pixels]."""
_DETAIL = 2
"""Pictures are drawn this many times larger and shrunk, which smooths their edges."""
_GAP = 0.015
"""Between two sizes in a row [m]."""
_SCALE_IN_FRONT = (np.cos(np.pi / 2 + 0.2), 0.0, 0.0, np.sin(np.pi / 2 + 0.2))
"""Turns what looks along x to the camera."""
_ASIDE = (np.cos(np.pi / 4 - 0.35), 0.0, 0.0, -np.sin(np.pi / 4 - 0.35))
"""Turns arms and what lies, which are along x, across what the camera sees."""
_HEAD = (
    "size",
    "diameter x height [mm]",
    "wall, bottom [mm]",
    "brimful [ml]",
    "mass [g]",
    "grip [mm]",
)
_SHORT_HEAD = ("size", "height [mm]", "mass [g]", "grip [mm]")


def main() -> None:
    """Write the page and its pictures."""
    PAGE.write_text(page())
    PICTURES.mkdir(exist_ok=True)
    for file in PICTURES.glob("*.jpg"):
        file.unlink()
    for kind, series in catalogue().items():
        picture(series).save(PICTURES / f"{kind}.jpg", quality=76, optimize=True)


def page() -> str:
    """Return the page in Markdown."""
    return "\n".join(_lines()).rstrip() + "\n"


def _lines() -> Iterator[str]:
    count = sum(len(series.sizes) for series in catalogue().values())
    closures = [kind for kind, one in catalogue().items() if isinstance(one, ClosureSeries)]
    yield "# Glass, porcelain and plastic ware"
    yield ""
    yield "[To the README](../README.md)"
    yield ""
    yield "Made by `python scripts/make_glassware.py` from `labware/glass/ware`; do not edit."
    yield f"{len(catalogue())} kinds in {count} sizes, {len(vessels())} of them vessels and"
    yield f"{len(closures)} closures, beside the vessels of the tasks (docs/vocabulary.md). The bar"
    yield "is 100 mm long, black and white by 50 mm. What does not stand needs a rack, a ring or a"
    yield 'hand. "From memory" means that no text of the standard was at hand.'
    yield ""
    yield "To liquid a vessel is its wall of revolution: side arms, necks, jackets, spouts and"
    yield "filter plates are drawn and touched, but sealed where they join. Stopcocks let liquid"
    yield "through ([small volumes](small_volumes.md)). Funnels, pipettes and condensers are open"
    yield "below: liquid runs out there."
    yield "Closures are pieces of their own: plugs hold by friction, screw caps by the contact of"
    yield "their lugs with a ridge, lids lie on the lip."
    yield ""
    yield '`labware.glass.catalogue.glassware("beaker_low", "250 ml", name="beaker")` makes a'
    yield 'vessel, `closed("reagent_bottle", "250 ml")` one with its closure,'
    yield '`ware("stirring_bar", "25 x 8 mm")` anything.'
    for kind, series in catalogue().items():
        yield from ("", f"## {code(kind)}", "", f"![{kind}](glassware/{kind}.jpg)", "")
        of = series.material
        sentences = [f"{series.what} Of {of.called}, {of.density:g} kg/m3.", *_more(series)]
        yield " ".join(sentences)
        yield f"Source: {series.source}."
        yield ""
        head = _HEAD if isinstance(series, Series) else _SHORT_HEAD
        yield f"| {' | '.join(head)} |"
        yield f"|{' --- |' * len(head)}"
        for size in series.sizes:
            yield f"| {' | '.join(cell(column) for column in _columns(series, size))} |"


def _more(series: Kind) -> Iterator[str]:
    """Yield sentences about what a kind stands in, comes with, holds by and moves."""
    if not series.stands:
        yield "It does not stand by itself."
    if series.holder:
        yield f"{code(series.holder)} holds it."
    if isinstance(series, Series) and series.closure:
        yield f"Comes with {code(series.closure)}."
    if isinstance(series, ClosureSeries) and series.pull[1]:
        unit = "N m turn" if series.kind.startswith("screw") else "N pull"
        yield f"{series.pull[0]:g} to {series.pull[1]:g} {unit} it off."
    elif isinstance(series, ClosureSeries):
        yield "It lies on the lip, and falls off what is tipped."
    for part in series.make(next(iter(series.sizes)), "it").mechanisms:
        yield f"Its {part.name.removeprefix('it_')} moves by {part.format_position(part.widest)}."


def _columns(series: Kind, size: str) -> tuple[str, ...]:
    piece = series.make(size, "it")
    wide = piece.grip_width
    grip = f"{1e3 * wide:.0f} at {1e3 * piece.grip_height:.0f}"
    if wide >= FRANKA_HAND.element.upper:
        grip = f"too wide: {grip}"
    mass = _three(1e3 * piece.mass)
    if isinstance(piece, Utensil):
        return size, f"{1e3 * piece.height:.4g}", mass, grip
    diameter, height, *_, wall, bottom = series.sizes[size]
    return (
        size,
        f"{diameter:g} x {height:g}",
        f"{wall:g}, {bottom:g}" if bottom else f"{wall:g}, open",
        _three(piece.capacity),
        mass,
        grip,
    )


def _three(number: float) -> str:
    """Write a number with three digits that count, and no exponent."""
    return f"{float(f'{number:.3g}'):g}"


def picture(series: Kind) -> Image.Image:
    """Return all sizes of a kind in a row, the smallest first, beside a bar of 100 mm."""
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    piece_pictures._add_surroundings(spec)
    spec.visual.global_.offwidth, spec.visual.global_.offheight = _DETAIL * WIDTH, _DETAIL * HEIGHT
    back = piece_pictures._FROM / np.linalg.norm(piece_pictures._FROM)
    right = np.cross([0.0, 0.0, 1.0], back)
    right /= np.linalg.norm(right)
    pieces = [series.make(size, called(size)) for size in series.sizes]
    gap = _GAP + 0.05 * max(piece.footprint_radius for piece in pieces)
    corners, at = [], 0.0
    for piece in pieces:
        radius = piece.footprint_radius
        middle = (at + radius) * right
        plain = isinstance(piece, Vessel) and not piece.joined
        turn = _SCALE_IN_FRONT if plain else _ASIDE
        piece.add_to(spec, spec.worldbody.add_body(pos=middle, quat=turn))
        ring = [(radius * x, radius * y, 0.0) for x, y in ((-1, -1), (-1, 1), (1, -1), (1, 1))]
        corners += [middle + foot + (0, 0, z) for foot in ring for z in (0.0, piece.height)]
        at += 2 * radius + gap
    corners += _add_bar(spec, right, at)
    model = spec.compile()
    model.geom("floor").pos = (0.0, 0.0, -0.001)
    model.camera("front").pos = _eye(np.array(corners), back, right)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    renderer = ClassicRenderer(model, _DETAIL * WIDTH, _DETAIL * HEIGHT)
    drawn = Image.fromarray(renderer.color(data, "front"))
    renderer.close()
    return drawn.resize((WIDTH, HEIGHT), Image.Resampling.LANCZOS)


def _add_bar(
    spec: mujoco.MjSpec, right: NDArray[np.float64], at: float
) -> list[NDArray[np.float64]]:
    """Add a bar of 100 mm along the row, from a place on it on; return its ends."""
    turn = np.arctan2(right[1], right[0])
    for number, grey in enumerate((0.95, 0.10)):
        spec.worldbody.add_geom(
            type=mujoco.mjtGeom.mjGEOM_BOX,
            size=(0.025, 0.003, 0.003),
            pos=(at + 0.025 + 0.05 * number) * right + (0.0, 0.0, 0.003),
            quat=(np.cos(turn / 2), 0.0, 0.0, np.sin(turn / 2)),
            rgba=(grey, grey, grey, 1.0),
        )
    return [at * right, (at + 0.1) * right]


def _eye(
    points: NDArray[np.float64], back: NDArray[np.float64], right: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return where the camera sees all points, with a little around them [m]."""
    axes = np.column_stack([right, np.cross(back, right), back])
    in_camera = points @ axes
    middle = (in_camera.min(axis=0) + in_camera.max(axis=0)) / 2
    half = np.tan(np.radians(piece_pictures._FIELD_OF_VIEW_DEG / 2))
    offset = abs(in_camera - middle) / (half * WIDTH / HEIGHT, half, 1.0)
    away = float(np.max(np.maximum(offset[:, 0], offset[:, 1]) + in_camera[:, 2] - middle[2]))
    return np.asarray(axes @ (middle + np.array([0.0, 0.0, 1.04 * away])))


if __name__ == "__main__":
    main()
