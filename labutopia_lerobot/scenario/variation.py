"""The axes that every task has.

How bench and walls look, the light, where cameras and robot start, what else stands around, how the
instruction is said, in which room: `material`, `wall`, `light`, `camera`, `robot_start`, `layout`,
`instruction`, `room`. And one of those in which something heats or cools: `ambient`.
Nothing of this varies unless the user (`axes=`) or the task (`Draw.vary`) says so. The ranges are
ours; the bench tops, and which of them are for tests, are the original's (level 3).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from labutopia_lerobot.labware.piece import Piece
from labutopia_lerobot.processes import ThermalMass
from labutopia_lerobot.scenario.distractors import held_out_sets, training_sets
from labutopia_lerobot.scenario.draw import Draw
from labutopia_lerobot.scenario.in_the_way import SETS
from labutopia_lerobot.scenes import rooms_to_draw
from labutopia_lerobot.scenes.finishes import BENCH_FINISHES, WALL_FINISHES
from labutopia_lerobot.scenes.left_stool import LeftStool
from labutopia_lerobot.scenes.passer_by import PasserBy
from labutopia_lerobot.scenes.views import MOST_DISPLACED
from labutopia_lerobot.task import Task
from labutopia_lerobot.world import FloatArray

AXES = ("material", "wall", "light", "camera", "robot_start", "layout", "instruction", "room")
"""Their names."""

BENCHES = tuple(BENCH_FINISHES)
WALLS = tuple(WALL_FINISHES)


@dataclass(frozen=True)
class Variation:
    """Values that an episode has drawn on the axes of every task; as built where it drew nothing.

    Attributes:
        bench: Finish of the bench top, one of `BENCH_FINISHES`.
        walls: Finish of the walls, one of `WALL_FINISHES`.
        brightness: Factor on all light.
        cameras: Displacement of both fixed cameras, shape (3,), metres, world frame.
        robot_start: Displacement of the arm at the start, shape (joints,), radians.
        distractors: Things that stand around.
        in_the_way: Things and people in the way of a robot that drives.
        room: Where it is, instead of the room of the setting.
        ambient: Temperature of the room [degrees C]; None for the usual one.
    """

    bench: str | None = None
    walls: str | None = None
    brightness: float = 1.0
    cameras: FloatArray | None = None
    robot_start: FloatArray | None = None
    distractors: tuple[Piece, ...] = ()
    in_the_way: tuple[LeftStool | PasserBy, ...] = ()
    room: str | None = None
    ambient: float | None = None


def draw_variation(
    draw: Draw, joints: int, *, drives_in: tuple[Sequence[str], Sequence[str]] | None = None
) -> Variation:
    """Draw on every axis that varies but `instruction`.

    Args:
        draw: The episode's draw.
        joints: How many joints the robot's arm has.
        drives_in: Rooms for training and for tests with what a robot that drives is to get to; None
            for one that does not. Nothing stands around on its benches but what belongs to the
            room. Somebody or something may be in its way (axis `dynamic`).
    """
    drives = drives_in is not None
    drawn: dict[str, Any] = {}
    if draw.varies("material"):
        drawn["bench"] = draw.choice("material", train=BENCHES[:5], test=BENCHES[5:])
    if draw.varies("wall"):
        drawn["walls"] = draw.choice("wall", train=WALLS[:4], test=WALLS[4:])
    if draw.varies("light"):
        dim, bright = (0.45, 0.65), (1.35, 1.55)
        drawn["brightness"] = draw.uniform("light", train=(0.8, 1.2), test=(dim, bright))
    if draw.varies("camera"):  # a hand's breadth at most: the things stay in view
        far = (0.05, MOST_DISPLACED)
        drawn["cameras"] = draw.displacement("camera", 3, train=(0.0, 0.03), test=[far])
    if draw.varies("robot_start"):
        drawn["robot_start"] = draw.displacement(
            "robot_start", joints, train=(0.0, 0.10), test=[(0.15, 0.25)]
        )
    if not drives and draw.varies("layout"):
        train, test = training_sets(), held_out_sets()
        name = draw.choice("layout", train=list(train), test=list(test))
        drawn["distractors"] = (train | test)[name]
    if drives and draw.varies("dynamic"):
        name = draw.choice("dynamic", train=("stool", "passer_by"), test=("both",))
        drawn["in_the_way"] = SETS[name]
    if draw.varies("room"):
        rooms, rooms_for_tests = drives_in or rooms_to_draw()
        drawn["room"] = draw.choice("room", train=rooms, test=rooms_for_tests)
    return Variation(**drawn)


def draw_ambient(draw: Draw, task: Task) -> float | None:
    """Draw how warm the room is [degrees C], where something in the task heats or cools.

    What is in the room begins as warm as that. Ours: training is a room that is kept warm or cool,
    a test a cold or a hot day.
    """
    processes = (process for piece in task.start for process in piece.processes)
    if not any(isinstance(process, ThermalMass) for process in processes):
        return None
    if not draw.varies("ambient"):
        return None
    return draw.uniform("ambient", train=(18.0, 25.0), test=[(12.0, 17.0), (26.0, 32.0)])


def draw_instruction(draw: Draw, task: Task) -> str:
    """Draw how the instruction is said; the last paraphrase is for tests."""
    if not draw.varies("instruction"):
        return task.instruction
    said = (task.instruction, *task.paraphrases)
    train = said[:-1] or said
    return draw.choice("instruction", train=train, test=said[len(train) :])
