"""Water and gas from the mains: what comes through a tap, by how far that is open."""

import math
from dataclasses import dataclass
from typing import override

import numpy as np

from labutopia_lerobot.labware.parts.dials import MovingPart
from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.substances.filling import Dispenser
from labutopia_lerobot.world import Reading

_SHUT = 0.1
"""Share of its way up to which a tap lets nothing through; ours: 9 degrees of a quarter-turn."""
_AUTHORITY = 0.5
"""Share of the pressure that falls in the open tap, the rest in pipe and spout; ours, what valves
are chosen for (valve authority; Emerson, Control Valve Handbook, on sizing; from memory)."""
_PER_MINUTE = 1e-3 / 60.0
"""One l/min [m^3/s]."""


def area_share(opening: float) -> float:
    """Return which share of its area a tap opens that is a share of its way open (ours)."""
    return min(1.0, max(0.0, (opening - _SHUT) / (1.0 - _SHUT)))


def share_of_flow(opening: float) -> float:
    """Return which share of the full flow passes, of a tap that is a share of its way open.

    The tap's own area grows with its way. What falls in it and what falls in the rest of the
    line add up to the pressure of the mains, each with the square of the flow: the installed
    characteristic of a valve of linear characteristic.
    """
    area = area_share(opening)
    if not area:
        return 0.0
    return 1.0 / math.sqrt(1.0 + _AUTHORITY * (area**-2 - 1.0))


@dataclass(frozen=True)
class Supply(Process):
    """A line that a tap opens; its reading is the flow [l/min].

    Where a task fills the piece that it belongs to (`contents={sink: Filling(ml=200)}`), that much
    comes out of its spout as liquid, counted as from there, and then no more. Else what runs is
    seen and read, and fills nothing.

    Attributes:
        name: What its reading is called.
        tap: What opens it.
        full: Flow at which it is wide open [l/min].
        spout: Where liquid leaves it that a task has filled in; None if none can be.
    """

    name: str
    tap: MovingPart
    full: float
    spout: Dispenser | None = None

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        """What has been drawn since the episode began, and what a task has filled in [m^3]."""
        return ("drawn", "filled")

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        waiting = 0.0
        if self.spout is not None and apparatus.liquid is not None:
            waiting = apparatus.liquid.waiting(self.spout)
        apparatus.memory(self)[:] = 0.0, waiting

    @override
    def step(self, apparatus: Apparatus) -> None:
        flow, memory = self.flow(apparatus), apparatus.memory(self)
        if not flow:
            return
        memory[0] += flow * apparatus.period
        if self.spout is None or apparatus.liquid is None or not self.pours(apparatus):
            return
        memory[0] = min(memory[0], memory[1])
        outlet, rounding = apparatus.site(self.spout.spout), 1e-6 * apparatus.liquid.particle
        drawn = float(memory[0]) + rounding
        apparatus.liquid.dispense(self.spout, drawn, outlet, apparatus.period)

    def flow(self, apparatus: Apparatus) -> float:
        """Return what runs now [m^3/s]."""
        drawn, filled = apparatus.memory(self)
        if filled and drawn >= filled:
            return 0.0
        opening = apparatus.joint(self.tap.joint) / self.tap.widest
        return self.full * _PER_MINUTE * share_of_flow(opening)

    def pours(self, apparatus: Apparatus) -> bool:
        """Return whether what runs is liquid that a task has filled in."""
        return bool(apparatus.memory(self)[1])

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        return Reading(self.flow(apparatus) / _PER_MINUTE, "l/min", 0.1)


@dataclass(frozen=True)
class Drawn(Process):
    """A meter in a line: what has been drawn since the episode began [l].

    Attributes:
        name: What its reading is called.
        of: The line.
    """

    name: str
    of: Supply

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        return Reading(1e3 * float(apparatus.memory(self.of)[0]), "l", 0.01)
