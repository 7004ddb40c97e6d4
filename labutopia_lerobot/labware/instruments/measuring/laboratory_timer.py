"""A laboratory timer."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.finish import FINISHES
from labutopia_lerobot.labware.parts.form import Block, Form, Prism
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.panel import leaning
from labutopia_lerobot.labware.parts.push_button import PushButton
from labutopia_lerobot.labware.parts.timer import Stopwatch


@dataclass(frozen=True)
class LaboratoryTimer(Instrument):
    """A timer that counts seconds, started and reset with two keys before its window.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.077, 0.120, 0.090)
    mass = 0.25
    source = "60 x 120 x 90 mm, digits of 25 mm, as usual; from memory"
    movable = True

    @property
    def keys(self) -> tuple[PushButton, ...]:
        """Start, which also stops, and reset."""
        return tuple(
            PushButton(
                f"{self.name}_{key}", FINISHES[look].rgba, radius=0.011, travel=0.003, proud=0.006
            )
            for key, look in (("start", "green"), ("reset", "red"))
        )

    @property
    def buttons(self) -> tuple[PushButton, ...]:
        return self.keys

    @property
    def displays(self) -> tuple[Display, ...]:
        ink, paper = (20, 30, 25), (165, 185, 160)
        start, reset = (key.name for key in self.keys)
        time = Stopwatch(f"{self.name}_time", start, reset)
        return (Display(f"{self.name}_display", (0.094, 0.034), time, ink, paper),)

    def _forms(self) -> list[Form]:
        side = ((-0.040, 0.002), (0.035, 0.002), (0.035, 0.020), (0.010, 0.090), (-0.010, 0.090))
        return [
            Prism(side, (-0.060, 0.060), "white", edge=0.006),
            Block((-0.038, 0.033), (-0.056, 0.056), (0.0, 0.006), "rubber", 0.001),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        lean = leaning(18.8)
        self.displays[0].add_to(spec, body, (-0.0198, 0.0, 0.063), lean)
        for key, y in zip(self.keys, (0.028, -0.028), strict=True):
            key.add_to(spec, body, (-0.0327, y, 0.0236), lean)
