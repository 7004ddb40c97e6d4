"""Processes: things that pieces do by themselves while time passes, and what they are given."""

import difflib
from collections import Counter
from collections.abc import Callable, Hashable, Iterable
from functools import cached_property
from typing import TYPE_CHECKING

import mujoco
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.processes.liquid_handling import LiquidHandling
from labutopia_lerobot.world import CONTROL_HZ, FloatArray, Pose
from labutopia_lerobot.world.reading import PRESSED, Reading

AMBIENT = 293.15
"""Temperature of a room, unless an episode has drawn another [K]: 20 degrees C."""


class ProcessError(UserError, ValueError):
    """A process that cannot be; the message names it and says what to change."""


class Process:
    """What a piece declares in `processes`: a frozen dataclass, whose methods get an `Apparatus`.

    A process keeps nothing in itself. The numbers that it remembers are its `slots`; they are part
    of the physics state, so that saving, restoring and replaying follow. The simulation steps all
    processes once per control period, in the order in which the pieces declare them.

    Attributes:
        name: What the world calls its reading; no two processes of a scene have one name.
    """

    if TYPE_CHECKING:  # a field of most, a property of some

        @property
        def name(self) -> str: ...

    @property
    def slots(self) -> tuple[str, ...]:
        """Names of the numbers that it remembers, all 0 before `start`."""
        return ()

    @property
    def sensors(self) -> tuple[str, ...]:
        """Names of the sensors that are averaged for it over the physics steps of a period."""
        return ()

    @property
    def displayed(self) -> tuple[str, ...]:
        """Names of the readings that it shows to a person."""
        return ()

    @property
    def lit_by(self) -> tuple[str, ...]:
        """Names of the buttons that switch the lamp which shows its reading; none without one."""
        return ()

    def start(self, apparatus: "Apparatus", rng: np.random.Generator) -> None:
        """Begin: all things have come to rest where the episode begins."""

    def step(self, apparatus: "Apparatus") -> None:
        """Move on by `apparatus.period`, to the present positions."""

    def reading(self, apparatus: "Apparatus") -> Reading | None:
        """Return what is to be read of it now, or None if it is nothing that is read."""
        return None

    def text(self, apparatus: "Apparatus") -> str:
        """Return what a display writes of it."""
        reading = self.reading(apparatus)
        return "" if reading is None else reading.text

    def show(self, apparatus: "Apparatus") -> None:
        """Bring what the eye sees of it, colours and textures, up to now."""


class UnknownReadingError(UserError, LookupError):
    """Something asks for a reading that no piece gives; the message lists those that there are."""


class Apparatus:
    """The processes of a scene at work.

    Args:
        model: What the pieces have been built into.
        data: Its state, with positions of the present moment.
        processes: In the order in which they step.
        numbers: What they remember, shape (`slots_of(processes)`,): a view into the state.

    Attributes:
        model: The model.
        data: Its state.
        processes: By name.
        liquid: The liquid of the scene, or None.
        ambient: Temperature of the room [K].
        period: Time between two steps [s].
        paintings: Number of each texture that a process has painted -> how often.

    Raises:
        ProcessError: If two processes have one name.
    """

    period = 1.0 / CONTROL_HZ

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        processes: Iterable[Process],
        numbers: FloatArray | None = None,
    ) -> None:
        self.model, self.data = model, data
        order = tuple(processes)
        twice = [name for name, count in Counter(p.name for p in order).items() if count > 1]
        if twice:
            raise ProcessError(
                f"Two processes are called {', '.join(twice)}: begin the name of each with that of "
                "its piece"
            )
        self.processes = {process.name: process for process in order}
        self.liquid: LiquidHandling | None = None
        self.ambient = AMBIENT
        self.paintings: dict[int, int] = {}
        self._painted: dict[str, Hashable] = {}
        self._memory: dict[str, FloatArray] = {}
        self._joints: dict[str, int] = {}
        self._masses: dict[str, float] = {}
        self._sensors: dict[str, tuple[int, int]] = {}
        numbers = np.zeros(slots_of(order)) if numbers is None else numbers
        first = 0
        for process in order:
            last = first + len(process.slots)
            if process.slots:
                self._memory[process.name] = numbers[first:last]
            first = last
        self._moving = [p for p in order if type(p).step is not Process.step]
        shown = (name for process in order for name in process.displayed)
        self._displayed = tuple(dict.fromkeys(shown))
        self._averaging = any(process.sensors for process in order)
        self._now, self._sum, self._count = data.sensordata, np.zeros(model.nsensordata), 0

    def memory(self, process: Process) -> FloatArray:
        """Return the numbers that a process remembers, a view, shape (slots,).

        Raises:
            ProcessError: If it has no slots.
        """
        memory = self._memory.get(process.name)
        if memory is None:
            raise ProcessError(
                f"'{process.name}' ({type(process).__name__}) remembers nothing: name its numbers "
                "in `slots`"
            )
        return memory

    @cached_property
    def gravity(self) -> float:
        """Acceleration of what falls [m/s^2]."""
        return float(np.linalg.norm(self.model.opt.gravity))

    def joint(self, name: str) -> float:
        """Return the position of a hinge [rad] or slide [m]."""
        address = self._joints.get(name)
        if address is None:
            address = self._joints[name] = int(self.model.joint(name).qposadr[0])
        return float(self.data.qpos[address])

    def mass(self, body: str) -> float:
        """Return the mass of a body alone, without those that hang on it [kg]."""
        if body not in self._masses:
            self._masses[body] = float(self.model.body(body).mass[0])
        return self._masses[body]

    def site(self, name: str) -> Pose:
        """Return the pose of a site, world frame."""
        site = self.data.site(name)
        return Pose(site.xpos, site.xmat.reshape(3, 3))

    def mean(self, sensor: str) -> FloatArray:
        """Return the mean of a sensor over the physics steps since the last step, a copy."""
        first, last = self._sensed(sensor)
        if not self._count:
            now: FloatArray = self._now[first:last].copy()
            return now
        mean: FloatArray = self._sum[first:last] / self._count
        return mean

    def _sensed(self, sensor: str) -> tuple[int, int]:
        """Return where the numbers of a sensor begin and end."""
        if sensor not in self._sensors:
            numbers = self.model.sensor(sensor)
            first = int(numbers.adr[0])
            self._sensors[sensor] = first, first + int(numbers.dim[0])
        return self._sensors[sensor]

    def reading(self, name: str) -> Reading:
        """Return what a process gives to read.

        Raises:
            UnknownReadingError: If there is none of that name.
        """
        process = self.processes.get(name)
        reading = None if process is None else process.reading(self)
        if reading is None:
            known = list(self.readings)
            near = difflib.get_close_matches(name, known, n=1)
            hint = f" Did you mean '{near[0]}'?" if near else ""
            raise UnknownReadingError(
                f"Nothing gives a reading called '{name}'.{hint} Readings: "
                f"{', '.join(known) or 'none'}"
            )
        return reading

    @property
    def readings(self) -> dict[str, Reading]:
        """All readings that there are, by name."""
        given = {name: process.reading(self) for name, process in self.processes.items()}
        return {name: reading for name, reading in given.items() if reading is not None}

    @property
    def displayed(self) -> dict[str, Reading]:
        """The readings that a person can see on a display now, by name."""
        return {name: self.reading(name) for name in self._displayed}

    @property
    def pressed(self) -> frozenset[str]:
        """Names of the push-buttons that are in."""
        return frozenset(name for name in self._buttons if self.reading(name).value > 0.0)

    @cached_property
    def _buttons(self) -> tuple[str, ...]:
        return tuple(name for name, reading in self.readings.items() if reading.unit == PRESSED)

    def start(self, rng: np.random.Generator) -> None:
        """Begin, where all has come to rest."""
        for process in self.processes.values():
            process.start(self, rng)

    def sample(self) -> None:
        """Take note of the sensors, after a physics step."""
        if self._averaging:
            self._sum += self._now
            self._count += 1

    def step(self) -> None:
        """Let every process move on by one control period."""
        for process in self._moving:
            process.step(self)
        if self._averaging:
            self._sum[:] = 0.0
            self._count = 0

    def show(self) -> None:
        """Bring what the eye sees of all processes up to now."""
        for process in self.processes.values():
            process.show(self)

    def paint(
        self, texture: str, content: Hashable, picture: Callable[[], NDArray[np.uint8]]
    ) -> None:
        """Fill a texture of the model, unless it shows that already.

        Args:
            texture: Its name.
            content: What it is to show.
            picture: Returns its pixels, shape (height, width, 3), the lowest row first.
        """
        if self._painted.get(texture, "") == content:
            return
        self._painted[texture] = content
        number = int(self.model.texture(texture).id)
        pixels = picture()
        start = int(self.model.tex_adr[number])
        self.model.tex_data[start : start + pixels.size] = pixels.ravel()
        self.paintings[number] = self.paintings.get(number, 0) + 1


def slots_of(processes: Iterable[Process]) -> int:
    """Return how many numbers processes remember together."""
    return sum(len(process.slots) for process in processes)
