"""What instruments read off themselves: the position of a knob, the time; or nothing yet."""

import math
from dataclasses import dataclass
from typing import Protocol, override

from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.world import Reading


class MovingPart(Protocol):
    """A mechanism with one joint: a knob, a slide, a door."""

    @property
    def name(self) -> str:
        """Name of its body."""
        ...

    @property
    def joint(self) -> str:
        """Name of its hinge [rad] or slide [m]."""
        ...

    @property
    def widest(self) -> float:
        """Where it stops [rad or m]."""
        ...


@dataclass(frozen=True)
class Scale(Process):
    """A scale: what a knob is set to, or how far something has moved.

    Attributes:
        of: The part that is turned or moved; the reading has its name.
        lowest: Reading at 0.
        highest: Reading at its stop.
        unit: Of the reading.
        resolution: Step of the last digit.
    """

    of: MovingPart
    lowest: float
    highest: float
    unit: str
    resolution: float = 1.0

    @property
    def name(self) -> str:
        return self.of.name

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        share = min(1.0, max(0.0, apparatus.joint(self.of.joint) / self.of.widest))
        return Reading(
            self.lowest + share * (self.highest - self.lowest), self.unit, self.resolution
        )


@dataclass(frozen=True)
class Unmeasured(Process):
    """A quantity that is not simulated: its display shows dashes, or that something is open.

    Attributes:
        name: What its reading, no number, is called.
        unit: Of the reading.
        resolution: Step of the last digit.
        warning: Text instead, while a door is open.
        door: The door, if any.
        beyond: Position up to which the door counts as shut [rad or m].
    """

    name: str
    unit: str
    resolution: float
    warning: str = ""
    door: MovingPart | None = None
    beyond: float = math.radians(2.0)

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        return Reading(math.nan, self.unit, self.resolution)

    @override
    def text(self, apparatus: Apparatus) -> str:
        if self.door is not None and apparatus.joint(self.door.joint) > self.beyond:
            return self.warning
        return super().text(apparatus)


@dataclass(frozen=True)
class Clock(Process):
    """The time since the episode began, or what is left of a time.

    Attributes:
        name: What its reading is called.
        left: Time that is counted down [s]; 0 counts up.
    """

    name: str
    left: float = 0.0

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        """Return whole seconds."""
        time = float(apparatus.data.time)
        return Reading(max(0, math.ceil(self.left - time)) if self.left else int(time), "s")

    @override
    def text(self, apparatus: Apparatus) -> str:
        """Return minutes and seconds."""
        seconds = int(self.reading(apparatus).value)
        return f"{seconds // 60:02d}:{seconds % 60:02d}"
