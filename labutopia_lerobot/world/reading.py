"""A reading: one number, its unit, and how finely it is shown."""

import math
from dataclasses import dataclass

from labutopia_lerobot.errors import UserError

PRESSED, ON = "pressed", "on"
"""Units of readings that are 1 or 0: of push-buttons, and of what is switched."""


def observed_of_reading(name: str) -> tuple[str, str]:
    """Name what is observed of a reading, as `Reading.observed` has it."""
    return name, f"{name}.settled"


class ReadingError(UserError, ValueError):
    """A reading without a unit or a resolution; the message shows it."""


@dataclass(frozen=True)
class Reading:
    """The number that a display shows and a judge may ask for.

    Attributes:
        value: In the unit, as finely as it is known; not a number where there is nothing to read,
            infinite beyond the capacity.
        unit: As a display writes it, such as `g`.
        resolution: Step of the last digit that is shown.
        settled: Whether the instrument says that the number stays.

    Raises:
        ReadingError: If it has no unit, or its resolution is not positive.
    """

    value: float
    unit: str
    resolution: float = 1.0
    settled: bool = True

    def __post_init__(self) -> None:
        if not self.unit or not self.resolution > 0.0:
            raise ReadingError(
                f"{self}: a reading needs a unit, 1 where it has none, and a resolution above 0"
            )

    @property
    def shown(self) -> float:
        """The value rounded to the resolution, as a display shows it."""
        if not math.isfinite(self.value):
            return self.value
        steps = round(self.value / self.resolution)
        return round(steps * self.resolution, self._digits + 2) + 0.0  # no minus zero

    @property
    def observed(self) -> tuple[float, float]:
        """What a display shows, and 1 if it is settled, else 0; dashes and errors are 0 and 0."""
        known = math.isfinite(self.shown)
        return self.shown if known else 0.0, float(known and self.settled)

    @property
    def text(self) -> str:
        """The value as a display writes it: dashes for no number, `Err` beyond the capacity."""
        if math.isinf(self.value):
            return "Err"
        digits = self._digits
        number = f"{self.shown:.{digits}f}"
        if math.isnan(self.value):
            number = "--" + ("." + "-" * digits if digits else "")
        return f"{number} {self.unit}"

    @property
    def _digits(self) -> int:
        """How many digits a display writes behind the point."""
        return max(0, -math.floor(math.log10(self.resolution)))
