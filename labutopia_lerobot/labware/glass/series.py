"""A series: one kind of ware in all its sizes, as a catalogue has it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.labware.glass.closure import Closure, Hold
from labutopia_lerobot.labware.glass.material import Material
from labutopia_lerobot.labware.glass.moving_fittings import Fitting
from labutopia_lerobot.labware.glass.outlines import Outline
from labutopia_lerobot.labware.glass.profile import Profile
from labutopia_lerobot.labware.glass.thread import Thread
from labutopia_lerobot.labware.glass.utensil import Shape, Utensil
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.labware.parts.contact import FRICTION
from labutopia_lerobot.labware.parts.form import Form

_UNITS = {"ml": 1.0, "l": 1000.0}


class UnknownGlasswareError(UserError, ValueError):
    """A kind or a size of ware that does not exist; the message lists those that do."""


@dataclass(frozen=True)
class Series:
    """A kind of vessel in all its sizes: a wall of revolution, and what is joined to it.

    Attributes:
        kind: Such as `beaker_low`.
        what: What it is, in a sentence.
        outline: From the first numbers of a row to the corners of the outside, all in mm.
        material: What it is made of.
        source: Of the numbers.
        sizes: Numbers of every size [mm]: those that the outline takes, the thickness of the wall,
            measured horizontally, and that of the bottom, 0 of what is open below. What has a
            nominal volume is called after it, the rest after its diameter and height.
        grip: Height at which a gripper closes, as a share of the whole.
        stands: Whether it stands by itself.
        graduated: Whether it has a scale.
        numbered: Whether the scale has numbers.
        one_mark: Whether the only graduation is a ring at the nominal volume.
        joined: From the wall to side arms, necks, jackets and handles.
        thread: On the neck.
        fitted: From name and wall to what moves on it.
        closure: Kind of closure that it comes with, if any.
        holder: Kind of instrument that holds what does not stand, if there is one.
    """

    kind: str
    what: str
    outline: Callable[..., Outline]
    material: Material
    source: str
    sizes: Mapping[str, tuple[float, ...]]
    grip: float = 0.5
    stands: bool = True
    graduated: bool = False
    numbered: bool = True
    one_mark: bool = False
    joined: Callable[[Profile], tuple[Form, ...]] | None = None
    thread: Thread | None = None
    fitted: Callable[[str, Profile], tuple[Fitting, ...]] | None = None
    closure: str = ""
    holder: str = ""

    def make(self, size: str, name: str) -> Vessel:
        """Return a vessel of a size; see `vessel`."""
        return self.vessel(size, name)

    def vessel(self, size: str, name: str) -> Vessel:
        """Return a vessel of a size.

        Raises:
            UnknownGlasswareError: There is no such size.
        """
        *numbers, wall, bottom = numbers_of(self, size)
        outer = tuple((1e-3 * r, 1e-3 * z) for r, z in self.outline(*numbers))
        profile = Profile(outer, 1e-3 * wall, 1e-3 * bottom)
        volume = nominal(size)
        return Vessel(
            name,
            profile,
            grip_height=self.grip * outer[-1][1],
            one_mark=1e-6 * volume if self.one_mark and volume is not None else None,
            material=self.material,
            stands=self.stands,
            graduated=self.graduated or self.one_mark,
            numbered=self.graduated and self.numbered,
            joined=self.joined(profile) if self.joined else (),
            thread=self.thread,
            fittings=self.fitted(name, profile) if self.fitted else (),
        )

    @property
    def vessels(self) -> tuple[Vessel, ...]:
        """One of every size, called after it."""
        return tuple(self.vessel(size, called(size)) for size in self.sizes)


@dataclass(frozen=True)
class UtensilSeries:
    """A kind of ware that is no vessel of revolution, in all its sizes.

    Attributes:
        kind: Such as `petri_lid`.
        what: What it is, in a sentence.
        shape: From its name and the numbers of a row, now in metres, to its forms.
        material: What it is made of.
        source: Of the numbers.
        sizes: Numbers of every size [mm]: outer sides or diameter and height first, what they are
            for stands in the table.
        stands: Whether it stays as it is put, by itself.
        holder: Kind of instrument that holds what does not stand, if there is one.
    """

    kind: str
    what: str
    shape: Callable[..., Shape]
    material: Material
    source: str
    sizes: Mapping[str, tuple[float, ...]]
    stands: bool = True
    holder: str = ""

    def make(self, size: str, name: str) -> Utensil:
        """Return a utensil of a size.

        Raises:
            UnknownGlasswareError: There is no such size.
        """
        numbers = [1e-3 * number for number in numbers_of(self, size)]
        return Utensil(name, self.shape(name, *numbers), self.material, self.stands)


@dataclass(frozen=True)
class ClosureSeries(UtensilSeries):
    """A kind of closure in all its sizes.

    Attributes:
        hold: From the numbers of a row, now in metres, to how it stays on.
        friction: Of its surface.
        pull: Force straight up, or torque of what is screwed on, that takes it off: least and most
            of all vessels that come with it [N or N m]; a test measures it.
    """

    hold: Callable[..., Hold] | None = None
    friction: float = FRICTION[0]
    pull: tuple[float, float] = (0.0, 0.0)

    def make(self, size: str, name: str) -> Closure:
        """Return a closure of a size; see `UtensilSeries.make`."""
        numbers = [1e-3 * number for number in numbers_of(self, size)]
        assert self.hold is not None
        shape = self.shape(name, *numbers)
        hold = self.hold(*numbers)
        return Closure(name, shape, self.material, self.stands, self.friction, hold)

    def fitting(self, vessel: Vessel, name: str) -> Closure:
        """Return the first size that closes a vessel.

        Raises:
            UnknownGlasswareError: None does.
        """
        for size in self.sizes:
            closure = self.make(size, name)
            if closure.hold.fits(vessel):
                return closure
        raise UnknownGlasswareError(
            f"No {self.kind} closes {vessel.name}, whose mouth is {2e3 * vessel.mouth_radius:.1f} "
            f"mm wide; sizes: {', '.join(self.sizes)}"
        )


def numbers_of(series: Series | UtensilSeries, size: str) -> tuple[float, ...]:
    """Return the numbers of a size [mm].

    Raises:
        UnknownGlasswareError: There is no such size.
    """
    if size not in series.sizes:
        raise UnknownGlasswareError(
            f"No {series.kind} of size '{size}'; sizes: {', '.join(series.sizes)}"
        )
    return series.sizes[size]


def called(size: str) -> str:
    """Return a size as a name."""
    return size.replace(" ", "_").replace("/", "_")


def nominal(size: str) -> float | None:
    """Return the nominal volume that a size is called after [ml]; None if after its diameter."""
    number, _, unit = size.partition(" ")
    return float(number) * _UNITS[unit] if unit in _UNITS else None
