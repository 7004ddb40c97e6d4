"""Photometers: how much light of one wavelength what stands in the beam takes away."""

import math
from dataclasses import dataclass
from typing import ClassVar, override

from labutopia_lerobot.chemistry.colour import absorptivity
from labutopia_lerobot.processes.process import Apparatus
from labutopia_lerobot.processes.solution_sensor import SolutionSensor

_PATH_CM = 1.0
"""Way of the light through a cell [cm]: that of all cuvettes here, and of round tubes of 12 mm."""
_CLOUDY = 0.01
"""What floats in a solution that scatters instead [mol/m^3]; ours, as `predicates.dissolved`."""
_NEGLIGIBLE = 1e-3
"""Absorbance that an unknown spectrum may have [1 cm]: none is seen; ours."""
_UNKNOWN_ABSORPTIVITY = 10.0
"""What a coloured species of unknown spectrum may have at most [l/(mol cm)]; ours: d-d bands."""


@dataclass(frozen=True)
class Photometer(SolutionSensor):
    """The absorbance of the solution in a beam, by Beer and Lambert, against water.

    Dashes while its lid is open, where no solution stands in the beam, and where the spectrum of
    something coloured in it is not known or something floats in it.

    Attributes:
        name: What its reading is called.
        beam: Name of the frame in the middle of the beam, where a cell stands in it.
        wavelength: Name of the reading that it is set to [nm].
        lid: Joint of its lid [rad].
        shut_within: Where that counts as shut [rad].
        lag: Its time constant [s]; ours, as of other meters that show a mean.
        resolution: Step of the last digit.
    """

    name: str
    beam: str
    wavelength: str
    lid: str
    shut_within: float
    lag: float = 0.5
    resolution: float = 0.001
    unit: ClassVar[str] = "A"
    most: ClassVar[float] = 3.0
    """As usual: a thousandth of the light comes through; from memory."""

    @override
    def sensed(self, apparatus: Apparatus) -> float:
        if apparatus.liquid is None or apparatus.joint(self.lid) > self.shut_within:
            return math.nan
        solution = apparatus.liquid.solution_at(apparatus.site(self.beam).position_w)
        if solution is None or sum(solution.solids.values()) > _CLOUDY * solution.volume:
            return math.nan
        nanometres = apparatus.reading(self.wavelength).value
        total = 0.0
        for key, amount in solution.concentrations.items():
            known, molar = absorptivity(key, nanometres), 1e-3 * amount
            if not math.isnan(known):
                total += _PATH_CM * molar * known
            elif molar * _UNKNOWN_ABSORPTIVITY > _NEGLIGIBLE:
                return math.nan
        return total
