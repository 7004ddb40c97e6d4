"""A fume hood with a sash, a baffle, a sink and taps."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.air import Fan, Vacuum
from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.drain import Drain
from labutopia_lerobot.labware.parts.finish import FINISHES
from labutopia_lerobot.labware.parts.fittings import framed, tub
from labutopia_lerobot.labware.parts.form import Block, Form, Rod, towards
from labutopia_lerobot.labware.parts.guard import Flipped
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import ON_FRONT
from labutopia_lerobot.labware.parts.push_button import PushButton
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.slide import Sash
from labutopia_lerobot.labware.parts.supply import Supply
from labutopia_lerobot.labware.parts.switch import Switch
from labutopia_lerobot.labware.parts.valve import Tap
from labutopia_lerobot.labware.parts.water_point import WaterPoint
from labutopia_lerobot.processes import Process

_DEPTH, _WIDTH, _HEIGHT = 0.850, 1.500, 2.350
_TOP, _OPEN = 0.900, 0.700
"""Height of the work top, and how far the sash goes up [m]."""
_SIDE = 0.100
"""Width of the side posts [m]."""

_FACE_VELOCITY = 0.50
"""Of the air through the opening [m/s]; ours: a hood's controller keeps 0.4 to 0.5 m/s."""
_SINK_X, _SINK_Y, _FLOOR, _RIM = (0.126, 0.244), (-0.114, 0.114), _TOP - 0.094, _TOP + 0.012
"""Inside of its cup sink, its floor and its rim [m]; ours."""
_GAS = 6.0
"""Of the open tap [l/min]; ours: 3.6 kW, a large burner, of natural gas with 36 MJ/m^3."""
_END, _PUMPED, _VOLUME, _LEAKS = 100.0, 0.3, 1.0, 60.0
"""End of the house's vacuum [mbar], how fast it pumps [l/s], out of what [l], and how soon the air
comes back [s]; ours."""


@dataclass(frozen=True)
class FumeHood(WaterPoint):
    """A fume hood over a cupboard: gas and water taps on its posts, a cup sink, a light above.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.874, 1.500, 2.350)
    mass = 250.0
    source = "1500 x 850 x 2350 mm, sash of 700 mm (EN 14175 hoods are alike); from memory"
    left_out = "its gas and vacuum lead nowhere; no fumes"
    flow, nozzle, fall = 6.0, 0.004, 0.36  # ours: half of a sink's
    contents = 5e-3  # ours

    @property
    def sash(self) -> Sash:
        return Sash(f"{self.name}_sash", _OPEN)

    @property
    def taps(self) -> tuple[Tap, Tap, Tap]:
        """Gas on the left post, water and vacuum on the right one."""
        gas, water, vacuum = (
            Tap(f"{self.name}_{line}", 0.050, look)
            for line, look in (("gas", "yellow"), ("water", "green"), ("vacuum", "blue"))
        )
        return gas, water, vacuum

    @property
    def water(self) -> Tap:
        return self.taps[1]

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.sash, *self.taps

    @property
    def fan(self) -> PushButton:
        return PushButton(f"{self.name}_fan", FINISHES["green"].rgba, radius=0.014)

    @property
    def buttons(self) -> tuple[PushButton, ...]:
        return (self.fan,)

    @property
    def places(self) -> tuple[Seat, ...]:
        """The work top, left and right of the middle."""
        return tuple(
            Seat(f"{self.name}_top_{side}", self.name, (-0.10, y, _TOP), width=0.40)
            for side, y in (("left", 0.35), ("right", -0.35))
        )

    @property
    def ventilation(self) -> Switch:
        """Its fan's button, which toggles, and the lamp beside it."""
        return Switch(
            f"{self.name}_fan_on", self.fan.name, f"{self.name}_lamp", (0.2, 1.0, 0.3, 1.0)
        )

    @property
    def air(self) -> Fan:
        """The air that goes in below its sash."""
        return Fan(f"{self.name}_air", self.ventilation.name, _FACE_VELOCITY)

    @property
    def drain(self) -> Drain:
        """The drain of its cup sink, 30 mm wide; ours."""
        (x, far_x), (y, far_y) = _SINK_X, _SINK_Y
        middle = ((x + far_x) / 2, (y + far_y) / 2, _FLOOR)
        low, high = (x, y, _FLOOR - 0.01), (far_x, far_y, _RIM)
        area = (far_x - x) * (far_y - y)
        return Drain(f"{self.name}_drain", area, low, high, middle, 0.030)

    @property
    def lines(self) -> tuple[Process, ...]:
        """What its taps let through: gas, water and what becomes of it, vacuum."""
        gas, _, vacuum = self.taps
        opened = Flipped(vacuum)
        pressure = f"{self.name}_pressure"
        return (
            Supply(f"{self.name}_gas_flow", gas, _GAS),
            *self.plumbing,
            opened,
            Vacuum(pressure, opened.name, _END, _END, _VOLUME / _PUMPED, _LEAKS),
        )

    @property
    def works(self) -> tuple[Process, ...]:
        """Its fan's switch, its sash, its air and its lines."""
        sash = Scale(self.sash, 0, 100, "% open", resolution=5)
        return self.ventilation, sash, self.air, *self.lines

    @property
    def displays(self) -> tuple[Display, ...]:
        sash = Scale(self.sash, 0, 100, "% open", resolution=5)
        return (Display(f"{self.name}_display", (0.080, 0.040), sash),)

    def _forms(self) -> list[Form]:
        x, y, side = _DEPTH / 2, _WIDTH / 2, _SIDE
        hole = (0.12, 0.25), (-0.12, 0.12)
        doors: list[Form] = []
        for sign in (-1, 1):
            doors.append(
                Block(
                    (-x - 0.001, -x + 0.02),
                    _between(sign * 0.006, sign * 0.735),
                    (0.11, _TOP - 0.06),
                    "light_blue",
                    touch=False,
                )
            )
            doors.append(
                Block(
                    (-x - 0.020, -x),
                    _between(sign * 0.04, sign * 0.06),
                    (0.60, 0.78),
                    "steel",
                )
            )
        return [
            Rod((x - 0.165, 0, _TOP + 0.270), (0.185, 0, _TOP + 0.270), 0.014, "chrome"),
            Rod((0.185, 0, _TOP + 0.277), (0.185, 0, _TOP + 0.240), 0.014, "chrome"),
            Block((-x + 0.03, x), (-y + 0.01, y - 0.01), (0.0, 0.10), "anthracite"),
            Block((-x + 0.012, x), (-y, y), (0.10, _FLOOR - 0.006), "white"),
            *framed((-x + 0.012, x), (-y, y), (_FLOOR - 0.006, _TOP - 0.03), hole, "white"),
            *doors,
            *framed((-x, x), (-y, y), (_TOP - 0.03, _TOP), hole, "anthracite"),
            *(
                Block((-x, x), _between(s * y, s * (y - side)), (_TOP, 1.90), "white")
                for s in (-1, 1)
            ),
            Block((x - 0.06, x), (-y + side, y - side), (_TOP, 1.90), "white"),
            Block((x - 0.16, x - 0.14), (-y + side, y - side), (_TOP + 0.12, 1.75), "light_grey"),
            Block((-x + 0.26, x), (-y, y), (1.90, _HEIGHT), "white"),
            Block((-x, -x + 0.18), (-y, y), (1.62, _HEIGHT), "white", edge=0.006),
            Block((-x - 0.001, -x), (-0.60, 0.60), (2.05, 2.22), "petrol", 0.0, touch=False),
            Block((-0.15, 0.15), (-0.45, 0.45), (1.885, 1.901), "glow", 0.0, touch=False),
            *tub(*hole, (_FLOOR - 0.006, _RIM), 0.006, "steel", "dark_steel"),
            *self.drain.forms("dark_steel"),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        x, y, inner = _DEPTH / 2, _WIDTH / 2, _WIDTH / 2 - _SIDE - 0.004
        down = towards((0.0, 0.0, -1.0))
        self.stream.add_to(spec, body, (((0.185, 0.0, _TOP + 0.240), down),))
        self.drain.add_to(body)
        sash = self.sash.add_to(spec, body, (-x + 0.230, 0.0, _TOP + 0.004))
        high = 0.76
        frame: list[Form] = [
            Block(
                (-0.004, 0.004), (-inner + 0.03, inner - 0.03), (0.04, high - 0.03), "glass", 0.0
            ),
            Block((-0.014, 0.014), (-inner, inner), (0.0, 0.045), "steel", edge=0.005),
            Block((-0.014, 0.014), (-inner, inner), (high - 0.03, high), "steel"),
            Block((-0.012, 0.012), (-inner, -inner + 0.03), (0.03, high - 0.02), "steel"),
            Block((-0.012, 0.012), (inner - 0.03, inner), (0.03, high - 0.02), "steel"),
            Block((-0.034, -0.012), (-0.30, 0.30), (0.012, 0.030), "anthracite", edge=0.006),
        ]
        assemble(spec, sash, self.name, frame, mass=16.0)
        for tap, (side, z) in zip(self.taps, ((1, 1.10), (-1, 1.10), (-1, 1.24)), strict=True):
            tap.add_to(spec, self.name, body, (-x, side * (y - 0.05), z), ON_FRONT)
        self.fan.add_to(spec, body, (-x, -y + 0.05, 1.42), ON_FRONT)
        self.ventilation.add_lamp_to(body, (-x, -y + 0.05, 1.36))
        self.displays[0].add_to(spec, body, (-x - 0.001, -y + 0.05, 1.50), ON_FRONT)


def _between(one: float, other: float) -> tuple[float, float]:
    """Return a span from the lesser to the greater."""
    return min(one, other), max(one, other)
