"""A hot plate: a low box with a ceramic top, and in front a deck with a push button and a lamp."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.colors import COLORS
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.instrument import Equipment
from labutopia_lerobot.labware.parts.materials import add_materials
from labutopia_lerobot.labware.parts.panel import ON_TOP
from labutopia_lerobot.labware.parts.push_button import PushButton
from labutopia_lerobot.labware.parts.solid import CYLINDER, Quaternion, Vector, add_look, add_part
from labutopia_lerobot.labware.parts.switch import Switch
from labutopia_lerobot.processes import HeatZone, Probe, Process, ThermalMass, Thermostat
from labutopia_lerobot.processes.heat import UPWARDS
from labutopia_lerobot.processes.hot_surface import ON_CERAMIC

_SIDE = 0.16
"""Side of the square top [m]: a usual size of laboratory hot plates (original: not on record)."""
_TOP = 0.060
"""Height of the top above the bench [m]; low, so that the hand can set a beaker down sideways."""
_PLATE = 0.008
"""Thickness of the ceramic top [m]."""
_DECK_DEPTH, _DECK_HEIGHT = 0.080, 0.042
"""Depth and height of the deck in front of it [m]; the button ends below the top."""
_BUTTON_X = -_SIDE / 2 - 0.045
"""Position of the button [m]; 0.09 m from a beaker in the middle, so that a hand fits between."""
_LAMP_Y = 0.045
"""Position of the lamp, to the left of the button [m]."""
_DISPLAY_Y = -0.053
"""Position of the display, to the right of the button [m]."""
_ZONE = 0.060
"""Radius of the zone printed on the top, which gets hot [m]."""
_WATT, _SET_POINT = 500.0, 300.0
"""Power of its heater [W] and what its surface is regulated at [degrees C]; ours: laboratory hot
plates of this size have 400 to 600 W and reach 300 to 350."""
_CAPACITY = math.pi * _ZONE**2 * _PLATE * 2570.0 * 800.0
"""Of the zone [J/K]: 2.57 g/cm3 and 0.8 J/g K (glass ceramic, Schott Ceran data sheet)."""
_LEAK = 0.2
"""Through the insulation below, into the housing [W/K]; ours: 20 mm of mineral wool of 0.05 W/m K
below the zone have 0.03, the rim of the ceramic the rest."""

_DOWN: Quaternion = (0.0, 0.0, 1.0, 0.0)
"""z down, x towards who stands before it: a hand is then no wider than the gap to the beaker, and
the last joint of the default robot in the middle of its range."""


@dataclass(frozen=True)
class Heater(Equipment):
    """A hot plate that faces -x of its own frame; its origin is below the middle of its top.

    It weighs 3 kg and stands on rubber feet.

    Attributes:
        name: Name of its root body; prefix of all its elements.
        button_color: Colour of the button, one of `COLORS`.
        probe_in: Name of the vessel that its temperature probe is in, which a display then shows;
            none for a hot plate without.
    """

    name: str
    button_color: str = "green"
    probe_in: str = ""
    size = (0.240, 0.160, 0.060)
    mass = 3.0
    source = "a usual size, ours"

    @property
    def button(self) -> PushButton:
        """Button that switches it on, and off again."""
        return PushButton(f"{self.name}_button", COLORS[self.button_color], radius=0.020)

    @property
    def switch(self) -> Switch:
        return Switch(f"{self.name}_switch", self.button.name, f"{self.name}_lamp")

    @property
    def hot(self) -> ThermalMass:
        """The zone of its top that gets hot."""
        reach = 0.7 * _ZONE  # a vessel whose middle is further out stands half beside it
        return ThermalMass(
            f"{self.name}_surface",
            self.name,
            _CAPACITY,
            area=math.pi * _ZONE**2,
            length=_ZONE / 2,  # area over circumference
            convection=UPWARDS,
            leak=_LEAK,
            zone=HeatZone(
                (-reach, -reach, _TOP - 0.002), (reach, reach, _TOP + 0.003), ON_CERAMIC, base=True
            ),
            surfaces=(f"{self.name}_plate_contact",),
            print=f"{self.name}_zone",
        )

    @property
    def thermostat(self) -> Thermostat:
        """What keeps it at its set point while it is switched on."""
        name = f"{self.name}_thermostat"
        return Thermostat(name, self.hot.name, _WATT, _SET_POINT, self.switch.name)

    @property
    def probe(self) -> Probe:
        """Its temperature probe, if it has one."""
        return Probe(f"{self.name}_probe", self.probe_in)

    @property
    def displays(self) -> tuple[Display, ...]:
        ink = (255, 130, 90)
        display = Display(f"{self.name}_display", (0.048, 0.020), self.probe, ink)
        return (display,) if self.probe_in else ()

    @property
    def top_height(self) -> float:
        """Height of its top above its origin [m]."""
        return _TOP

    @property
    def bodies(self) -> frozenset[str]:
        return frozenset({self.name, self.button.name})

    @property
    def footprint_radius(self) -> float:
        """Radius of the circle around its origin that it needs on the bench [m]."""
        return math.hypot(_SIDE / 2 + _DECK_DEPTH, _SIDE / 2)

    @property
    def buttons(self) -> tuple[PushButton, ...]:
        return (self.button,)

    @property
    def works(self) -> tuple[Process, ...]:
        return self.switch, self.hot, self.thermostat

    def add_to(self, spec: mujoco.MjSpec, parent: mujoco.MjsBody) -> mujoco.MjsBody:
        """Build its body into a spec (angles in radians), at the origin of the parent.

        Sites: the frame of the button (see `PushButton`).

        Returns:
            The body.
        """
        add_materials(
            spec,
            self.name,
            ("shell", (0.20, 0.35, 0.50, 1.0), 0.2),
            ("ceramic", (0.90, 0.90, 0.88, 1.0), 0.5),
            ("print", (0.70, 0.70, 0.69, 1.0), 0.5),
            ("metal", (0.66, 0.68, 0.70, 1.0), 0.6),
        )
        body = parent.add_body(name=self.name)
        half, low = _SIDE / 2, (_TOP - _PLATE) / 2
        front = -half - _DECK_DEPTH / 2
        boxes: dict[str, tuple[Vector, Vector, str]] = {
            "housing": ((half, half, low), (0, 0, low), "shell"),
            "plate": ((half, half, _PLATE / 2), (0, 0, _TOP - _PLATE / 2), "ceramic"),
            "deck": (
                (_DECK_DEPTH / 2, half, _DECK_HEIGHT / 2),
                (front, 0, _DECK_HEIGHT / 2),
                "shell",
            ),
        }
        for part, (size, pos, material) in boxes.items():
            add_part(body, f"{self.name}_{part}", size, pos, f"{self.name}_{material}")
        zone = (_ZONE, 0.0003, 0.0)
        top = (0.0, 0.0, _TOP)
        add_look(body, f"{self.name}_zone", zone, top, f"{self.name}_print", shape=CYLINDER)
        self._add_deck(spec, body)
        return body

    def _add_deck(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        """Add the button in its bezel and the lamp in its socket."""
        button, metal = self.button, f"{self.name}_metal"
        at_button = (_BUTTON_X, 0.0, _DECK_HEIGHT)
        at_lamp = (_BUTTON_X, _LAMP_Y, _DECK_HEIGHT)
        bezel, socket = (1.25 * button.radius, 0.002, 0.0), (0.013, 0.002, 0.0)
        add_look(body, f"{self.name}_bezel", bezel, at_button, metal, shape=CYLINDER)
        add_look(body, f"{self.name}_socket", socket, at_lamp, metal, shape=CYLINDER)
        self.switch.add_lamp_to(body, at_lamp)
        button.add_to(spec, body, at_button, _DOWN)
        for display in self.displays:
            display.add_to(spec, body, (_BUTTON_X, _DISPLAY_Y, _DECK_HEIGHT + 0.0005), ON_TOP)
