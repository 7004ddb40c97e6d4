"""Electrodes and other sensors: what one whose tip lies in a liquid reads there."""

import math
from dataclasses import dataclass
from typing import ClassVar, override

from labutopia_lerobot.chemistry.conductivity import conductivity
from labutopia_lerobot.processes.heat import CELSIUS
from labutopia_lerobot.processes.process import Apparatus
from labutopia_lerobot.processes.solution_sensor import SolutionSensor
from labutopia_lerobot.substances.substance import ZERO_C


@dataclass(frozen=True)
class PhElectrode(SolutionSensor):
    """The pH of the liquid around the tip of an electrode; dashes where that is in no solution.

    It measures what is there, mixed or not: before a vessel has been stirred it shows a layer.

    Attributes:
        name: What its reading is called.
        tip: Name of the frame at its end.
        lag: Its time constant [s]; ours: makers state that a glass electrode shows 95 % of a
            change within some seconds, which is three time constants.
        resolution: Step of the last digit.
    """

    name: str
    tip: str
    lag: float = 1.5
    resolution: float = 0.01
    unit: ClassVar[str] = "pH"

    @override
    def sensed(self, apparatus: Apparatus) -> float:
        if apparatus.liquid is None:
            return math.nan
        solution = apparatus.liquid.solution_at(apparatus.site(self.tip).position_w)
        return math.nan if solution is None else solution.ph


@dataclass(frozen=True)
class ConductivityCell(SolutionSensor):
    """The conductivity around the tip of a cell, brought to 25 C, as meters do by default.

    Dashes where the tip is in no solution, or more than 2 % of the ions are of unknown conduct.

    Attributes:
        name: What its reading is called.
        tip: Name of the frame at its end.
        lag: Its time constant [s]; ours: it answers at once, what is shown is a mean.
        resolution: Step of the last digit.
    """

    name: str
    tip: str
    lag: float = 0.5
    resolution: float = 0.001
    unit: ClassVar[str] = "mS/cm"
    most: ClassVar[float] = 200.0
    """As usual for cells of four poles; from memory."""

    @override
    def sensed(self, apparatus: Apparatus) -> float:
        if apparatus.liquid is None:
            return math.nan
        solution = apparatus.liquid.solution_at(apparatus.site(self.tip).position_w)
        if solution is None:
            return math.nan
        return 10.0 * conductivity(solution.concentrations)


@dataclass(frozen=True)
class TemperatureSensor(SolutionSensor):
    """The temperature around the tip of a sensor: of the liquid there, or else of the room.

    It measures what is there, mixed or not.

    Attributes:
        name: What its reading is called.
        tip: Name of the frame at its end.
        lag: Its time constant [s]; ours: a Pt1000 in a thin sheath takes seconds in water.
        resolution: Step of the last digit [K].
    """

    name: str
    tip: str
    lag: float = 2.0
    resolution: float = 0.1
    unit: ClassVar[str] = CELSIUS

    @override
    def sensed(self, apparatus: Apparatus) -> float:
        liquid, kelvin = apparatus.liquid, apparatus.ambient
        if liquid is not None:
            around = liquid.temperature_at(apparatus.site(self.tip).position_w)
            kelvin = kelvin if around is None else around
        return kelvin - ZERO_C
