"""A bench-top drying oven: a heated box with a hinged door, a window and a bar handle.

It may have a push button that starts it, and a lamp that shows it.
"""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.instruments.button_panel import INTO_FRONT
from labutopia_lerobot.labware.parts.catch import Catch
from labutopia_lerobot.labware.parts.colors import COLORS
from labutopia_lerobot.labware.parts.instrument import Equipment
from labutopia_lerobot.labware.parts.materials import add_materials
from labutopia_lerobot.labware.parts.mouth import Mouth
from labutopia_lerobot.labware.parts.openable import Door, Handle
from labutopia_lerobot.labware.parts.push_button import PushButton
from labutopia_lerobot.labware.parts.shelf import Shelf
from labutopia_lerobot.labware.parts.solid import CYLINDER, Vector, add_feet, add_look, add_part
from labutopia_lerobot.labware.parts.switch import Switch
from labutopia_lerobot.labware.parts.warmth import Regulated, chamber
from labutopia_lerobot.processes import DoorGap, Process

_DEPTH, _WIDTH, _HEIGHT = 0.576, 0.741, 0.630
"""Outer size [m] (original, DryingBox_01)."""
_DOOR_WIDTH, _DOOR_HEIGHT, _DOOR_THICKNESS = 0.546, 0.594, 0.040
"""Size of the door [m] (original, DryingBox_01; its thickness is ours)."""
_HANDLE_LENGTH = 0.202
"""Length of the bar [m] (original, DryingBox_01)."""
_HANDLE_INSET = 0.050
"""Distance from the door's free edge to the bar [m]."""
_FOOT = 0.018
"""Height of the feet, on which door and box are level [m]."""
_WALL = 0.040
"""Insulated wall [m]."""
_LEG = 0.030
"""Width of the legs of its stand, of square tube, and thickness of the plate on them [m]."""
_CATCH_INSET = 0.050
"""Distance from the door's free edge to its catch [m]."""
_BUTTON_HEIGHT = 0.24
"""Height of the button on the control column, between knob and main switch [m]; ours."""
_LAMP_ASIDE = 0.045
"""Distance from the button to its lamp, on the left [m]; as on the heater."""

_WATT, _SET_POINT, _LEAK = 1200.0, 105.0, 1.5
"""Power [W], temperature that it holds [degrees C], loss through its walls [W/K]; ours: ovens of
100 l have 1 to 1.6 kW and lose some 130 W at 105 C, at which samples are dried (ISO 11465)."""

_DOOR_MASS = 6.5
"""Two skins of 0.8 mm steel (4.1 kg), a double pane of 4 mm glass (1.4 kg), frame and wool [kg]."""
_WIDEST = math.radians(120.0)
"""Angle at which the hinge stops (original, DryingBox_01)."""
_SEAL = math.radians(0.3)
"""Angle at which the free edge stands 3 mm off, which the silicone seal still fills [rad]."""
_FRICTION = 0.5
"""Dry friction of hinge and seal [N m]: about 1 N at the handle, so that the door stays where it is
let go of. The original has 0.1 for a door that weighs next to nothing."""
_DAMPING = 1.0
"""Grease in the hinge [N m s/rad]; ours: a door let go of at 0.5 m/s swings on for 17 degrees."""

_ALONG_X = (math.sqrt(0.5), 0.0, math.sqrt(0.5), 0.0)


@dataclass(frozen=True)
class DryingOven(Equipment):
    """A drying oven whose door is hinged on the left of who stands before it.

    Its front faces -x of its own frame. It weighs 50 kg and stays where it is.

    Attributes:
        name: Name of its root body; prefix of all its elements.
        ajar: How far the door stands open at the start [rad].
        latching: Whether a roller catch keeps the door shut.
        stand: Height of the stand below it [m]; 0 for none.
        shelf_height: Of the shelf's middle above the feet [m]; it hangs on rails.
        button_color: Colour of the push button that starts it and stops it again, one of `COLORS`;
            None for an oven without one.
    """

    name: str
    ajar: float = 0.0
    latching: bool = False
    stand: float = 0.0
    shelf_height: float = (_FOOT + _HEIGHT) / 2
    button_color: str | None = None
    size = (0.67, 0.741, 0.630)
    mass = 50.0
    source = "original (DryingBox_01); mass ours"
    left_out = "it heats where it has a `button_color`"

    @property
    def door(self) -> Door[Handle]:
        name = f"{self.name}_door"
        handle = Handle(f"{self.name}_handle", _HANDLE_LENGTH)
        catch = Catch(f"{name}_catch") if self.latching else None
        return Door(name, handle, _WIDEST, _SEAL, catch)

    @property
    def shelf(self) -> Shelf:
        """Place for things."""
        return Shelf(f"{self.name}_shelf")

    @property
    def opening(self) -> Mouth:
        """Its doorway, in the middle between the side of the hinge and the other."""
        return Mouth(self.shelf.name, (-0.38, -0.05, 0.0), ahead=(0.585, 0.625))

    @property
    def button(self) -> PushButton:
        """Button that starts it, and stops it again.

        Raises:
            ValueError: If it has none.
        """
        if self.button_color is None:
            raise ValueError(f"{self.name} has no button: give it a `button_color`")
        return PushButton(f"{self.name}_button", COLORS[self.button_color])

    @property
    def switch(self) -> Switch:
        """Switch that the button works, if there is one."""
        return Switch(f"{self.name}_switch", self.button.name, f"{self.name}_lamp")

    @property
    def buttons(self) -> tuple[PushButton, ...]:
        return () if self.button_color is None else (self.button,)

    @property
    def works(self) -> tuple[Process, ...]:
        return () if self.button_color is None else (self.switch, *self.heat)

    @property
    def heat(self) -> tuple[Process, ...]:
        """What keeps its inside warm while it is on."""
        x, y, bottom = _DEPTH / 2, _WIDTH / 2, self.stand + _FOOT
        low = (-x, y - _DOOR_WIDTH, bottom + _WALL)
        high = (x - _WALL, y - _WALL, bottom - _FOOT + _HEIGHT - _WALL)
        doorway = DoorGap(
            self.door.joint, (high[1] - low[1]) * (high[2] - low[2]), high[2] - low[2]
        )
        by = Regulated(_WATT, _SET_POINT, self.switch.name)
        return chamber(self.name, low, high, _LEAK, doorway, by)

    @property
    def mechanisms(self) -> tuple[Door[Handle], ...]:
        return (self.door,)

    @property
    def bodies(self) -> frozenset[str]:
        parts = {self.name, self.shelf.name, self.door.name, self.door.handle.name}
        return frozenset(parts | {button.name for button in self.buttons})

    @property
    def footprint_radius(self) -> float:
        """Radius of the circle around its origin that it needs on the bench [m]."""
        return math.hypot(_DEPTH, _WIDTH) / 2

    def add_to(self, spec: mujoco.MjSpec, parent: mujoco.MjsBody) -> mujoco.MjsBody:
        """Build its body into a spec (angles in radians), at the origin of the parent.

        Sites: frames of the door's joint, of its handle, of the shelf and of the button (see
        `Door`, `Handle`, `Shelf`, `PushButton`).

        Returns:
            The body; its origin is the centre of the base, z up.
        """
        self._add_materials(spec)
        box = parent.add_body(name=self.name)
        if self.stand:
            self._add_stand(box)
        self._add_box(spec, box)
        hinge = (-_DEPTH / 2, _WIDTH / 2, self.stand + _FOOT)
        door = self.door.add_to(
            spec, box, hinge, ajar=self.ajar, friction=_FRICTION, damping=_DAMPING
        )
        self._add_door(door)
        if self.door.catch is not None:
            edge = (-_DOOR_THICKNESS / 2, _CATCH_INSET - _DOOR_WIDTH, _DOOR_HEIGHT)
            self.door.catch.add_to(box, door, hinge, edge, f"{self.name}_metal")
        return box

    def _add_materials(self, spec: mujoco.MjSpec) -> None:
        add_materials(
            spec,
            self.name,
            ("shell", (0.94, 0.93, 0.90, 1.0), 0.2),
            ("leaf", (0.74, 0.78, 0.82, 1.0), 0.3),
            ("inside", (0.62, 0.65, 0.68, 1.0), 0.4),
            ("trim", (0.13, 0.24, 0.42, 1.0), 0.2),
            ("metal", (0.16, 0.17, 0.19, 1.0), 0.5),
            ("window", (0.10, 0.14, 0.17, 0.55), 0.8),
            ("display", (0.05, 0.06, 0.07, 1.0), 0.3),
            ("digits", (0.95, 0.35, 0.15, 1.0), 0.0),
        )

    def _add_stand(self, body: mujoco.MjsBody) -> None:
        """Add four legs and the plate that the oven stands on."""
        x, y, half = _DEPTH / 2, _WIDTH / 2, _LEG / 2
        material = f"{self.name}_trim"
        plate, top = (x, y, half), (0.0, 0.0, self.stand - half)
        add_part(body, f"{self.name}_stand_plate", plate, top, material)
        leg = (half, half, self.stand / 2 - half)
        for corner, (end, side) in enumerate(((-1, -1), (-1, 1), (1, -1), (1, 1))):
            at = (end * (x - half), side * (y - half), self.stand / 2 - half)
            add_part(body, f"{self.name}_stand_leg_{corner}", leg, at, material)

    def _add_box(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        """Add the hollow box behind the door and the control column to the right of it."""
        x, y = _DEPTH / 2, _WIDTH / 2
        bottom, top = self.stand + _FOOT, self.stand + _HEIGHT
        middle, tall = (bottom + top) / 2, (top - bottom) / 2
        right = y - _DOOR_WIDTH  # where the door ends and the control column begins
        chamber, wide = (y + right) / 2, _DOOR_WIDTH / 2
        column = (right - y) / 2
        half = _WALL / 2
        walls: dict[str, tuple[Vector, Vector]] = {
            "column": ((x, (right + y) / 2, tall), (0.0, column, middle)),
            "left": ((x, half, tall), (0.0, y - half, middle)),
            "back": ((half, wide, tall), (x - half, chamber, middle)),
            "floor": ((x, wide, half), (0.0, chamber, bottom + half)),
            "roof": ((x, wide, half), (0.0, chamber, top - half)),
        }
        for wall, (size, pos) in walls.items():
            add_part(body, f"{self.name}_{wall}", size, pos, f"{self.name}_shell")
        plate = (2 * (x - _WALL), 2 * wide - _WALL)
        level = (0.0, chamber - half, self.stand + self.shelf_height)
        self.shelf.add_to(body, plate, level, f"{self.name}_inside")
        add_feet(body, self.name, (x, y), _FOOT, f"{self.name}_trim", above=self.stand)
        self._add_controls(body, -x, column)
        for button in self.buttons:
            self._add_button(spec, body, button, (-x, column, self.stand + _BUTTON_HEIGHT))

    def _add_controls(self, body: mujoco.MjsBody, front: float, column: float) -> None:
        """Paint the control column: a display with digits, a knob and a main switch."""
        for part, material, size, height in (
            ("panel", "trim", (0.001, 0.075, 0.26), 0.32),
            ("display", "display", (0.002, 0.055, 0.035), 0.49),
            ("digits", "digits", (0.003, 0.030, 0.012), 0.49),
            ("power", "display", (0.004, 0.015, 0.022), 0.15),
        ):
            pos = (front, column, self.stand + height)
            add_look(body, f"{self.name}_{part}", size, pos, f"{self.name}_{material}")
        add_look(
            body,
            f"{self.name}_knob",
            (0.028, 0.010, 0.0),
            (front - 0.008, column, self.stand + 0.33),
            f"{self.name}_metal",
            shape=CYLINDER,
            quat=_ALONG_X,
        )

    def _add_button(
        self, spec: mujoco.MjSpec, body: mujoco.MjsBody, button: PushButton, at: Vector
    ) -> None:
        """Add a plate of the shell's colour, the button in its bezel, its lamp in a socket."""
        x, y, z = at
        beside, metal = (x, y + _LAMP_ASIDE, z), f"{self.name}_metal"
        plate, middle = (0.002, 0.050, 0.034), (x, y + _LAMP_ASIDE / 2, z)
        add_look(body, f"{self.name}_plate", plate, middle, f"{self.name}_shell")
        for part, size, pos in (
            ("bezel", (1.25 * button.radius, 0.004, 0.0), at),
            ("socket", (0.013, 0.004, 0.0), beside),
        ):
            add_look(body, f"{self.name}_{part}", size, pos, metal, shape=CYLINDER, quat=_ALONG_X)
        self.switch.add_lamp_to(body, beside)
        button.add_to(spec, body, at, INTO_FRONT)

    def _add_door(self, body: mujoco.MjsBody) -> None:
        """Add the door: a frame around a window, in front of the box, and the bar on its right."""
        x, wide, tall = -_DOOR_THICKNESS / 2, _DOOR_WIDTH / 2, _DOOR_HEIGHT / 2
        edge = 0.11  # width of the frame around the window
        frame: dict[str, tuple[Vector, Vector]] = {
            "door_near": ((-x, edge / 2, tall), (x, -_DOOR_WIDTH + edge / 2, tall)),
            "door_far": ((-x, edge / 2, tall), (x, -edge / 2, tall)),
            "door_lower": ((-x, wide - edge, edge / 2), (x, -wide, edge / 2)),
            "door_upper": ((-x, wide - edge, edge / 2), (x, -wide, 2 * tall - edge / 2)),
        }
        for part, (size, pos) in frame.items():
            share = _DOOR_MASS / (len(frame) + 1)
            add_part(body, f"{self.name}_{part}", size, pos, f"{self.name}_leaf", mass=share)
        add_part(
            body,
            f"{self.name}_window",
            (-0.6 * x, wide - edge, tall - edge),
            (x, -wide, tall),
            f"{self.name}_window",
            mass=_DOOR_MASS / (len(frame) + 1),
        )
        spot = (-_DOOR_THICKNESS, -_DOOR_WIDTH + _HANDLE_INSET, tall)
        self.door.handle.add_to(body, spot, f"{self.name}_metal", lying=False)
