"""What bench centrifuges have in common: a locked lid, a rotor, knobs, keys, timer and drive."""

import math
from abc import abstractmethod
from dataclasses import dataclass, replace
from typing import ClassVar

from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.drive import Drive
from labutopia_lerobot.labware.parts.finish import FINISHES
from labutopia_lerobot.labware.parts.guard import Balanced, Lock, Shut
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.lid import Lid
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.motor import Bolt
from labutopia_lerobot.labware.parts.push_button import PushButton
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.timer import Countdown
from labutopia_lerobot.processes import Process


@dataclass(frozen=True)
class Spinning(Instrument):
    """A centrifuge with upright bores.

    Attributes:
        name: Name of its root body; prefix of all its elements.
        set_to: What its speed is set to when an episode begins [rpm].
        minutes: What its time is set to then [min].
        lid_open: How far its lid is open then [rad].
        highest: Its highest speed [rpm].
        longest: The longest time that it can be set to [min].
        ramp: How fast it speeds up and slows down [rpm/s].
        bores: How many it has.
        circle: Radius of their circle [m].
        bottom: Height of their bottoms in the rotor's frame [m].
        deep: How deep they are [m].
        takes: Diameter of the largest tube that fits [m].
        uneven: The most that it bears on one side only, in the circle of its bores [kg].
        lid_thickness: Height of the lid's upper side above its frame [m].
        dial: Diameter of its knobs [m].
        panes: Width and height of its displays [m].
    """

    name: str
    set_to: float = 0.0
    minutes: float = 0.0
    lid_open: float = 0.0
    highest: ClassVar[float]
    longest: ClassVar[float]
    ramp: ClassVar[float]
    bores: ClassVar[int]
    circle: ClassVar[float]
    bottom: ClassVar[float]
    deep: ClassVar[float]
    takes: ClassVar[float]
    uneven: ClassVar[float]
    lid_thickness: ClassVar[float]
    dial: ClassVar[float]
    panes: ClassVar[tuple[float, float]]

    @property
    @abstractmethod
    def lid(self) -> Lid:
        """What shuts it."""

    @property
    def rotor(self) -> Rotor:
        return Rotor(f"{self.name}_rotor", friction=0.02, effort=0.3, stall=1.5)

    @property
    def speed(self) -> Knob:
        return self._knob("speed", self.set_to / self.highest)

    @property
    def time(self) -> Knob:
        return self._knob("time", self.minutes / self.longest)

    def _knob(self, knob: str, share: float) -> Knob:
        dial = Knob(f"{self.name}_{knob}", diameter=self.dial)
        return replace(dial, begins=share * dial.widest)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.lid, self.rotor, self.speed, self.time

    @property
    def latch(self) -> PushButton:
        """What releases the lid."""
        return self._key("latch", "yellow")

    @property
    def start(self) -> PushButton:
        return self._key("start", "green")

    @property
    def stop(self) -> PushButton:
        return self._key("stop", "red")

    def _key(self, key: str, look: str) -> PushButton:
        color = FINISHES[look].rgba
        return PushButton(f"{self.name}_{key}", color, radius=0.011, travel=0.004, proud=0.014)

    @property
    def buttons(self) -> tuple[PushButton, ...]:
        return self.latch, self.start, self.stop

    @property
    def places(self) -> tuple[Seat, ...]:
        """The bores, counterclockwise from the back."""
        return tuple(
            Seat(
                f"{self.name}_bore_{n}",
                self.rotor.name,
                (x, y, self.bottom),
                self.takes,
                self.deep,
            )
            for n, (x, y) in enumerate(self._places_around())
        )

    def _places_around(self) -> list[tuple[float, float]]:
        """Return where the bores are, x and y in the rotor's frame [m]."""
        angles = [2 * math.pi * n / self.bores for n in range(self.bores)]
        return [(self.circle * math.cos(a), self.circle * math.sin(a)) for a in angles]

    @property
    def closed(self) -> Shut:
        """What feels its lid."""
        return Shut(self.lid)

    @property
    def timer(self) -> Countdown:
        """Time left of its run; it does not start with its lid open."""
        setting, buttons = self._minutes, (self.start.name, self.stop.name)
        return Countdown(f"{self.name}_left", setting, *buttons, (self.closed, self.balanced))

    @property
    def drive(self) -> Drive:
        """What turns the rotor while the timer runs; it is seen to turn slowly."""
        return Drive(
            f"{self.name}_rpm",
            self._set_speed,
            ramp=self.ramp,
            brake=self.ramp,
            on=(f"{self.name}_left",),
            motors=(self.rotor.motor,),
            resolution=50.0,
            seen=60.0,
        )

    @property
    def balanced(self) -> Balanced:
        """What trips where its load is uneven."""
        return Balanced(
            f"{self.name}_balanced",
            self.rotor.name,
            self.drive,
            self.highest,
            self.circle,
            0.20,
            self.closed,
            self.uneven,
        )

    @property
    def lock(self) -> Lock:
        """What keeps its lid shut until its latch is pressed at a standstill."""
        return Lock(f"{self.name}_locked", self._bolt, self.closed, self.latch.name, self.drive)

    @property
    def _bolt(self) -> Bolt:
        return Bolt(self.lid.name, self.lid.joint)

    @property
    def _set_speed(self) -> Scale:
        return Scale(self.speed, 0, self.highest, "rpm", resolution=50)

    @property
    def _minutes(self) -> Scale:
        return Scale(self.time, 0, self.longest, "min")

    @property
    def works(self) -> tuple[Process, ...]:
        """What feels its lid and its balance, its knobs, its timer, its drive and its lock."""
        return (
            self.closed,
            self.balanced,
            self._set_speed,
            self._minutes,
            self.timer,
            self.drive,
            self.lock,
        )

    @property
    def displays(self) -> tuple[Display, ...]:
        return (
            Display(f"{self.name}_speed_display", self.panes, self.drive),
            Display(f"{self.name}_time_display", self.panes, self.timer),
        )
