"""Water points: a tap, its spout over a basin, and the basin's drain."""

import math
from abc import ABC, abstractmethod
from typing import ClassVar

from labutopia_lerobot.labware.parts.drain import Drain
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.stream import Stream
from labutopia_lerobot.labware.parts.supply import Drawn, Supply
from labutopia_lerobot.labware.parts.valve import Tap
from labutopia_lerobot.processes import Process


class WaterPoint(Instrument, ABC):
    """An instrument with a tap over a basin.

    What a task fills it with comes out of its spout as liquid, and then no more; what runs into its
    basin goes down its drain.

    Attributes:
        flow: Of the open tap [l/min].
        nozzle: Inner radius of the spout's end [m].
        fall: From the spout down to what ends the stream at the latest [m].
        contents: The most that a task may let come of it [m^3].
    """

    flow: ClassVar[float]
    nozzle: ClassVar[float]
    fall: ClassVar[float]
    contents: ClassVar[float]

    @property
    @abstractmethod
    def water(self) -> Tap:
        """The tap."""

    @property
    @abstractmethod
    def drain(self) -> Drain:
        """The drain of its basin."""

    @property
    def mounted(self) -> tuple[Drain, ...]:
        """Its drain, where liquid gets to."""
        return (self.drain,)

    @property
    def spout(self) -> str:
        """Name of the frame at the end of the spout; z the way that the water leaves."""
        return f"{self.name}_outlet"

    @property
    def bore_area(self) -> float:
        """Cross-section of the spout's end [m^2]."""
        return math.pi * self.nozzle**2

    @property
    def supply(self) -> Supply:
        """The water that its tap lets through."""
        return Supply(f"{self.name}_flow", self.water, self.flow, self)

    @property
    def stream(self) -> Stream:
        """The water that is seen to run."""
        name, outlets = f"{self.name}_stream", (self.spout,)
        return Stream(name, self.supply, outlets, self.nozzle, falls=self.fall, lengths=10)

    @property
    def plumbing(self) -> tuple[Process, ...]:
        """The water, its meter, its look, its drain."""
        return self.supply, Drawn(f"{self.name}_drawn", self.supply), self.stream, self.drain
