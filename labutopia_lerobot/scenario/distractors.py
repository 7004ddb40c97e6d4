"""Things that stand around and have nothing to do with the task."""

import math
from collections.abc import Mapping, Sequence
from functools import cache

import numpy as np

from labutopia_lerobot.labware.glass.catalogue import catalogue, glassware
from labutopia_lerobot.labware.glass.series import ClosureSeries
from labutopia_lerobot.labware.glass.utensil import Utensil
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.labware.instruments.test_tube_rack import TestTubeRack
from labutopia_lerobot.labware.piece import Piece
from labutopia_lerobot.layout import CLEARANCE, ImpossibleStartError, Placement, Workspace
from labutopia_lerobot.world import FloatArray

DISTRACTOR_GAP = 0.13
"""Least gap between a distractor and what the task needs [m]: the open hand passes, 0.2 m wide."""
INSTRUMENT_GAP = 0.45
"""The same before an instrument [m]: the drying oven's door sweeps so far."""

HAND_REACH = 0.35
"""Reach of the hand and the wrist behind a vessel that they come to [m]."""

_IN_SETS = ("beaker", "conical_flask", "measuring_cylinder", "pear_shaped_flask")
"""Kinds that are in sets of more things."""

_TRIES = 1000
"""Places that are tried for a thing."""
_ARRANGEMENTS = 10
"""Number of fresh starts where the last of them finds no place."""


_WIDEST, _TALLEST, _LOWEST = 0.08, 0.24, 0.012
"""Footprint radius and height up to which ware stands around, so that the hand has room beside it
and the cameras see over it, and height from which it stands and does not lie [m]; ours."""
_HELD_OUT = (
    "crucible",
    "crucible_quartz",
    "filter_crucible",
    "gas_washing_bottle",
    "jug_plastic",
    "microplate_24",
    "microplate_6",
    "microplate_96",
    "mortar",
    "pycnometer",
    "staining_jar",
    "weighing_boat",
)
"""Kinds of shapes that no other kind has; they stand around in tests only."""


@cache
def training_sets() -> dict[str, tuple[Piece, ...]]:
    """Return what can stand around in training: nothing, or things of kinds for training."""
    name = "distractor"
    return {
        "bare": (),
        "a beaker": (glassware("beaker", "150 ml", name),),
        "a flask and a cylinder": (
            glassware("conical_flask", "500 ml", name),
            glassware("measuring_cylinder", "250 ml", f"{name}_2"),
        ),
        "two beakers": (
            glassware("beaker", "250 ml", name),
            glassware("beaker", "800 ml", f"{name}_2"),
        ),
        **_sets_of_ware(held_out=False),
    }


@cache
def held_out_sets() -> dict[str, tuple[Piece, ...]]:
    """Return what can stand around in tests only; of each set a shape is in none for training."""
    name = "distractor"
    return {
        "a rack and a beaker": (
            TestTubeRack(name),
            glassware("beaker", "800 ml", f"{name}_2"),
        ),
        "three flasks": (
            glassware("conical_flask", "1000 ml", name),
            glassware("pear_shaped_flask", "250 ml", f"{name}_2"),
            glassware("conical_flask", "300 ml", f"{name}_3"),
        ),
        **_sets_of_ware(held_out=True),
    }


def _sets_of_ware(held_out: bool) -> dict[str, tuple[Piece, ...]]:
    """Return a piece of every further kind that can stand around, the largest that may."""
    sets: dict[str, tuple[Piece, ...]] = {}
    for kind, series in catalogue().items():
        in_others = kind in _IN_SETS or isinstance(series, ClosureSeries)
        if series.stands and not in_others and (kind in _HELD_OUT) is held_out:
            for size in reversed(tuple(series.sizes)):
                piece = series.make(size, "distractor")
                if _stands_around(piece):
                    sets[f"{kind} {size}"] = (piece,)
                    break
    return sets


def _stands_around(piece: Vessel | Utensil) -> bool:
    """Return whether ware is of a size in which it can be a distractor, and nothing on it moves."""
    fits = piece.footprint_radius <= _WIDEST and _LOWEST <= piece.height <= _TALLEST
    return fits and not piece.joints


def place_distractors(
    distractors: Sequence[Piece],
    layout: Mapping[Piece, Placement],
    workspace: Workspace,
    approach: float,
    rng: np.random.Generator,
    spots: Sequence[FloatArray] = (),
) -> dict[Piece, Placement]:
    """Draw where things stand that the task does not need: in view, but out of the way.

    They stand around the middle of the task's things, further out the more tries it takes.

    Args:
        distractors: The things.
        layout: Where what the task needs stands.
        workspace: The bench and the robot.
        approach: Yaw of the hand that comes to a vessel, to the left of the bearing [rad].
        rng: Where the placements come from.
        spots: Free points of the bench that things are brought to, shape (2,) each [m].

    Raises:
        ImpossibleStartError: If there is no room for them.
    """
    middle = np.mean([(stands.x, stands.y) for stands in layout.values()], axis=0)
    for _ in range(_ARRANGEMENTS):
        placed: dict[Piece, Placement] = {}
        for piece in distractors:
            others = {**layout, **placed}
            stands = _place(piece, middle, others, workspace, approach, rng, spots)
            if stands is None:
                break
            placed[piece] = stands
        else:
            return placed
    names = ", ".join(piece.name for piece in distractors)
    raise ImpossibleStartError(f"There is no room on the bench for {names}")


def _place(
    piece: Piece,
    middle: FloatArray,
    others: Mapping[Piece, Placement],
    workspace: Workspace,
    approach: float,
    rng: np.random.Generator,
    spots: Sequence[FloatArray],
) -> Placement | None:
    """Draw where a thing stands around a point; return None if no place is found."""
    inner = piece.footprint_radius + CLEARANCE
    bench = np.array([workspace.x, workspace.y]) + np.array([inner, -inner])
    for spread in np.linspace(0.25, 1.5, _TRIES):
        around = np.column_stack([middle - spread, middle + spread])
        x, y = rng.uniform(*np.clip(around, bench[:, :1], bench[:, 1:]).T)
        placement = Placement(x, y, rng.uniform(-math.pi, math.pi))
        least = piece.footprint_radius + _WIDEST + DISTRACTOR_GAP
        point = np.array([x, y])
        clear = all(_from_arm(point, spot, workspace, approach) >= least for spot in spots)
        if clear and _out_of_the_way(piece, placement, others, workspace, approach):
            return placement
    return None


def _out_of_the_way(
    piece: Piece,
    at: Placement,
    layout: Mapping[Piece, Placement],
    workspace: Workspace,
    approach: float,
) -> bool:
    """Return whether a thing is in the way of neither the arm nor the hand."""
    point = np.array([at.x, at.y])
    for other, placement in layout.items():
        thing = np.array([placement.x, placement.y])
        beside = piece.footprint_radius + other.footprint_radius
        if not other.movable and _is_behind(placement, point):
            if math.dist(point, thing) < beside + DISTRACTOR_GAP:
                return False
            continue
        least = beside + (DISTRACTOR_GAP if other.movable else INSTRUMENT_GAP)
        if _from_arm(point, thing, workspace, approach) < least:
            return False
    return True


def _from_arm(point: FloatArray, thing: FloatArray, workspace: Workspace, approach: float) -> float:
    """Return how far a point is from the arm, and from the hand, that come to a thing [m]."""
    robot = np.array(workspace.robot)
    yaw = math.atan2(*(thing - robot)[::-1]) + approach
    hand = thing - HAND_REACH * np.array([math.cos(yaw), math.sin(yaw)])
    return min(_distance(point, thing, end) for end in (robot, hand))


def _is_behind(instrument: Placement, point: FloatArray) -> bool:
    """Return whether a point is behind the middle of an instrument, which faces its own -x."""
    dx, dy = point - (instrument.x, instrument.y)
    return bool(math.cos(instrument.yaw) * dx + math.sin(instrument.yaw) * dy > 0.0)


def _distance(point: FloatArray, start: FloatArray, end: FloatArray) -> float:
    """Return how far a point is from the line from `start` to `end` [m]."""
    way = end - start
    share = np.clip((point - start) @ way / (way @ way), 0.0, 1.0)
    return float(np.linalg.norm(point - start - share * way))
