"""The privileged state: what is known of every thing of a task where no picture is looked at.

Imports neither mujoco nor torch.
"""

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.labware.piece import Piece
from labutopia_lerobot.places import WhereItStood
from labutopia_lerobot.predicates.openables import Bar
from labutopia_lerobot.setting import (
    DISPLAYS,
    HANDLES,
    HOMES,
    LAMPS,
    LEVELS,
    SIZES,
    SOLUTIONS,
)
from labutopia_lerobot.substances.filling import Fillable, with_mounted
from labutopia_lerobot.task import Task
from labutopia_lerobot.world import SOLUTION_NAMES, Graspable, Standing, Thing, World
from labutopia_lerobot.world.reading import observed_of_reading

_POSE_NAMES = ("x", "y", "z", "xx", "xy", "xz", "yx", "yy", "yz")

HOME_NAMES = ("home.x", "home.y", "home.z")

SIZE_NAMES = ("height", "footprint_radius", "grip_height", "grip_width")

_LEAST_SPANS = (
    dict.fromkeys(_POSE_NAMES[3:], 0.2)
    | dict.fromkeys(("lit", "settled"), 1.0)
    | dict.fromkeys(("solid", "gas"), 1e-4)
)
"""Last word of a name -> `least_span`, where it is not `_LEAST_SPAN`: of the axes of a thing (6
degrees to either side), of what is 1 or 0, of amounts (a tenth of a millimole)."""

_LEAST_SPAN = 0.1
"""A decimetre, 6 degrees, a tenth of what a colour, an acidity or a display shows. Ours, chosen by
what policies then do (`policies/act/README.md`)."""


@dataclass(frozen=True)
class ObservedPiece:
    """A piece that the privileged state is about, and the names of what is observed of it.

    Put together once for an episode, since it is looked at in every control step.

    Attributes:
        piece: The piece.
        joints: Names of its hinges and slides.
        parts: Names of the frames of its parts whose places are observed.
        put_back: Whether it is observed where it stood, since the task wants it back there.
        lamps: Names of what its lamps show that light by a button which a step presses.
        displays: Names of what its displays show.
        sizes: Of what stands by itself and is grasped, as `SIZE_NAMES` has them [m]; else none.
        levels: Vessels whose levels are observed: itself, or what is mounted on it; else none.
        solutions: Those of which it is observed what is dissolved in them.
    """

    piece: Thing
    joints: tuple[str, ...]
    parts: tuple[str, ...]
    put_back: bool
    lamps: tuple[str, ...]
    displays: tuple[str, ...]
    sizes: tuple[float, ...]
    levels: tuple[Fillable, ...]
    solutions: tuple[Fillable, ...]


def observed_pieces(task: Task, hidden: Collection[str] = ()) -> tuple[ObservedPiece, ...]:
    """Return the pieces that the privileged state of a task is about.

    Args:
        task: The task.
        hidden: What of it is left out, of `setting.HIDEABLE`.
    """
    reacts = any(filling.reacts for filling in task.contents.values())
    taken = {thing.name: thing for step in task.steps for thing in step.touches}
    bars = [name for name, thing in taken.items() if isinstance(thing, Bar)]
    handles = [] if HANDLES in hidden else bars
    put_back = set() if HOMES in hidden else _put_back(task)
    return tuple(
        ObservedPiece(
            piece,
            piece.joints,
            (*region.shuffled, *(name for name in handles if name.startswith(f"{piece.name}_"))),
            put_back=piece.name in put_back,
            lamps=() if LAMPS in hidden else _lamps(piece, taken),
            displays=() if DISPLAYS in hidden else displayed_by(piece),
            sizes=() if SIZES in hidden else _sizes(piece),
            levels=_vessels(piece) if task.contents and LEVELS not in hidden else (),
            solutions=_vessels(piece) if reacts and SOLUTIONS not in hidden else (),
        )
        for piece, region in task.start.items()
    )


def _put_back(task: Task) -> set[str]:
    """Return the names of what steps put back where it stood: no later frame shows where."""
    # What the hand may take in its stead is among them: which of them it is would else be seen.
    return {
        thing.name
        for step in task.steps
        for substep in step.substeps
        for fact in substep.facts
        if any(isinstance(each, WhereItStood) for each in fact.about)
        for thing in step.touches
    }


def _lamps(piece: Piece, taken: Collection[str]) -> tuple[str, ...]:
    """Return the names of what its lamps show that light by one of the things that steps take."""
    return tuple(each.name for each in piece.processes if not set(each.lit_by).isdisjoint(taken))


def displayed_by(piece: Piece) -> tuple[str, ...]:
    """Return the names of what the displays of a piece show, each once."""
    return tuple(dict.fromkeys(name for each in piece.processes for name in each.displayed))


def _vessels(piece: Thing) -> tuple[Fillable, ...]:
    """Return what liquid stays in: the piece itself, or what is mounted on it."""
    return tuple(thing for thing in with_mounted([piece]) if isinstance(thing, Fillable))


def _sizes(piece: Thing) -> tuple[float, ...]:
    """Return the sizes of a piece that are observed [m]."""
    if isinstance(piece, Graspable) and isinstance(piece, Standing):
        return piece.height, piece.footprint_radius, piece.grip_height, piece.grip_width
    return ()


def environment_state_names(task: Task, hidden: Collection[str] = ()) -> tuple[str, ...]:
    """Name the elements of `environment_state`.

    For each thing its position [m] in the robot's base frame and the first two axes of its frame
    there: the continuous representation of rotations (Zhou et al. 2019, "On the Continuity of
    Rotation Representations in Neural Networks"), since quaternions jump. Then the position of each
    of its hinges [rad] and slides [m], the place [m] of each of its parts that is shuffled and of
    each handle that a step takes, where it stood [m] if it is to be put back there, whether a lamp
    is lit (1 or 0) that a button switches which a step presses, what its displays show, in their
    units, and 1 behind each that is settled, else 0 (`Reading.observed`), and the sizes [m] of what
    stands by itself and is grasped: a task may draw it of many kinds.
    Where there is liquid: how deep it would be in each vessel [m], were that upright. Where
    something is dissolved: what `Solution.observed` has of each.

    Args:
        task: The task.
        hidden: What of it is left out, of `setting.HIDEABLE`.
    """
    return tuple(
        name
        for one in observed_pieces(task, hidden)
        for name in (
            *(f"{one.piece.name}.{part}" for part in _POSE_NAMES),
            *one.joints,
            *(f"{part}.{axis}" for part in one.parts for axis in "xyz"),
            *(f"{one.piece.name}.{home}" for home in HOME_NAMES if one.put_back),
            *(f"{lamp}.lit" for lamp in one.lamps),
            *(each for name in one.displays for each in observed_of_reading(name)),
            *(f"{one.piece.name}.{size}" for size in SIZE_NAMES if one.sizes),
            *(f"{vessel.name}.fill" for vessel in one.levels),
            *(f"{vessel.name}.{part}" for vessel in one.solutions for part in SOLUTION_NAMES),
        )
    )


def least_span(name: str) -> float:
    """Return by how much a policy is to take an element to vary at least, in its own unit.

    In all demonstrations some things stand still. What is less than this is to be little to a
    policy as well, and not to be blown up.

    Args:
        name: Name of the element, of `environment_state_names` or a joint of the robot.
    """
    return _LEAST_SPANS.get(name.rpartition(".")[2], _LEAST_SPAN)


def environment_state(pieces: tuple[ObservedPiece, ...], world: World) -> NDArray[np.float32]:
    """Return the elements that `environment_state_names` names, shape (elements,).

    Args:
        pieces: The observed pieces of the task.
        world: The world.
    """
    to_base = world.robot_base.inverse()
    numbers: list[float] = []
    for one in pieces:
        pose_b = to_base @ world.pose(one.piece)
        for three in (pose_b.position_w, pose_b.x_axis, pose_b.y_axis):
            numbers += three.tolist()
        numbers += [world.joint(name) for name in one.joints]
        for name in one.parts:
            numbers += (to_base @ world.frame(name)).position_w.tolist()
        if one.put_back:
            numbers += (to_base @ world.stood(one.piece)).position_w.tolist()
        numbers += [float(world.reading(lamp).value > 0.0) for lamp in one.lamps]
        for name in one.displays:
            numbers += world.reading(name).observed
        numbers += one.sizes
        if world.liquid is not None:
            inside = world.liquid.inside
            numbers += [vessel.profile.depth(inside[vessel.name]) for vessel in one.levels]
        for vessel in one.solutions:
            solution = world.solution(vessel)
            if solution is not None:
                numbers += solution.observed.values()
    return np.array(numbers, np.float32)
