"""Stoppers, caps and lids: what closes a vessel, a body of its own that can be taken off."""

from dataclasses import dataclass
from typing import Protocol

import mujoco

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.labware.glass.thread import Thread
from labutopia_lerobot.labware.glass.utensil import Utensil
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.world.model import COLLISION_GROUP

_HARD = (0.99, 0.999, 0.0005, 0.5, 2.0)
"""Impedance of a tight fit: it gives way by hundredths of a millimetre."""


class DoesNotFitError(UserError, ValueError):
    """A closure that is too wide, too narrow or of another thread for a vessel."""


class Hold(Protocol):
    """Fastening of a closure on a vessel, and the vessels that it fits."""

    @property
    def tight(self) -> bool:
        """Whether it stays when the vessel is tipped; else it only lies on it."""
        ...

    @property
    def needs(self) -> str:
        """Requirement on a vessel, in words for the user."""
        ...

    def fits(self, vessel: Vessel) -> bool:
        """Return whether it closes a vessel."""
        ...

    def seat(self, vessel: Vessel) -> float:
        """Return the height of its origin above the base of a vessel that it closes [m]."""
        ...


@dataclass(frozen=True)
class Plug:
    """A cone pressed into the mouth: friction holds it, as the cone is slimmer than friction steep.

    Attributes:
        low: Diameter of its lower end [m].
        high: Diameter where its head begins [m].
        length: Of the cone [m].
        squeeze: How much wider than the mouth it is pressed in, in radius [m]: what glass and
            rubber give way.
    """

    low: float
    high: float
    length: float
    squeeze: float
    tight = True

    @property
    def needs(self) -> str:
        return f"a mouth of {1e3 * self.low:g} to {1e3 * self.high:g} mm"

    def fits(self, vessel: Vessel) -> bool:
        """Return whether it goes in by a seventh of its length at least, and not in to its head."""
        seat = self.seat(vessel)
        inside = (vessel.height - seat) / self.length
        return 0.14 < inside < 0.95

    def seat(self, vessel: Vessel) -> float:
        """Return where its lower end is when it is pressed in [m]."""
        profile, slope = vessel.profile, (self.high - self.low) / 2 / self.length
        corners = [height for _, height in profile.inner]
        seats = []
        for height in corners:
            room = profile.inner_radius(height) + self.squeeze - self.low / 2
            if room <= 0.0:
                seats.append(height)  # it does not get past this corner
            elif slope:
                seats.append(height - min(room / slope, self.length))
        return max(seat for seat in seats if seat <= vessel.height)


@dataclass(frozen=True)
class Cover:
    """A plate that lies on the lip; a rim keeps it from sliding off, and nothing from falling off.

    Attributes:
        drop: From its origin up to what lies on the lip [m].
        around: Inner diameter of the rim around the lip [m]; 0 if it has none.
        within: Outer diameter of the rim within the mouth [m]; 0 if it has none.
    """

    drop: float
    around: float = 0.0
    within: float = 0.0
    tight = False

    @property
    def needs(self) -> str:
        if self.around:
            return f"a lip a little less than {1e3 * self.around:g} mm wide"
        return f"a mouth a little more than {1e3 * self.within:g} mm wide"

    def fits(self, vessel: Vessel) -> bool:
        """Return whether its rim has play around or within the lip, of 8 mm at most."""
        lip = 2 * vessel.profile.outer_radius(vessel.height)
        play = self.around - lip if self.around else 2 * vessel.mouth_radius - self.within
        return 0.0002 < play < 0.008

    def seat(self, vessel: Vessel) -> float:
        """Return where its origin is when the plate lies on the lip [m]."""
        return vessel.height - self.drop


@dataclass(frozen=True)
class Screw:
    """A cap whose lugs run under the ridge of a thread.

    Attributes:
        thread: Of the neck that it goes on.
        drop: From its origin up to what lies on the lip [m].
        squeeze: How far it is tightened beyond touching [m].
    """

    thread: Thread
    drop: float
    squeeze: float
    tight = True

    @property
    def needs(self) -> str:
        return f"a thread of {1e3 * self.thread.diameter:g} x {1e3 * self.thread.pitch:g} mm"

    def fits(self, vessel: Vessel) -> bool:
        """Return whether a vessel has this thread."""
        return vessel.thread == self.thread

    def seat(self, vessel: Vessel) -> float:
        """Return where its origin is when the plate lies on the lip [m]."""
        return vessel.height - self.drop

    def add_lugs_to(self, body: mujoco.MjsBody) -> None:
        """Build the lugs into a cap."""
        for number, (x, y, z) in enumerate(self.thread.lugs(self.squeeze)):
            body.add_geom(
                name=f"{body.name}_lug_{number}",
                type=mujoco.mjtGeom.mjGEOM_SPHERE,
                size=(self.thread.bead, 0.0, 0.0),
                pos=(x, y, z + self.drop),
                group=COLLISION_GROUP,
                mass=0.0,
            )


@dataclass(frozen=True)
class Closure(Utensil):
    """A stopper, a cap or a lid: a piece of its own, held on a vessel by friction or thread.

    Attributes:
        hold: How it stays on, and on which vessels.
    """

    hold: Hold = Cover(0.0)

    def seat(self, vessel: Vessel) -> float:
        """Return the height of its origin above the base of the vessel that it closes [m].

        Raises:
            DoesNotFitError: It does not close this vessel.
        """
        if not self.hold.fits(vessel):
            raise DoesNotFitError(
                f"{self.name} does not close {vessel.name}: it needs {self.hold.needs}; the mouth "
                f"is {2e3 * vessel.mouth_radius:.1f} mm wide. Take another size of it"
            )
        return self.hold.seat(vessel)

    @property
    def _hardness(self) -> tuple[tuple[float, ...], int]:
        return (_HARD, 1) if self.hold.tight else super()._hardness

    def _add_more(self, body: mujoco.MjsBody) -> None:
        if isinstance(self.hold, Screw):
            self.hold.add_lugs_to(body)
