"""What processes may do to the liquid of a scene."""

from typing import NamedTuple, Protocol

from labutopia_lerobot.substances.filling import Dispenser
from labutopia_lerobot.world import FloatArray, Pose, Solution


class Stock(NamedTuple):
    """Liquid somewhere: how much of it there is, and what of it is nearest."""

    volume: float
    """All of it [m^3]: a whole number of particles."""
    density: float
    """[kg/m^3]"""
    viscosity: float
    """Dynamic [Pa s]."""
    surface_tension: float
    """Against air [N/m]."""


class Warmth(NamedTuple):
    """How warm the liquid in a vessel is."""

    volume: float
    """m^3."""
    capacity: float
    """Heat that warms it by 1 K [J/K]."""
    temperature: float
    """Mean, by heat [K]."""
    boiling: float
    """Boiling point, mean by volume [K]."""
    water: float
    """Share of it that is water, by volume."""


class Pool(NamedTuple):
    """A basin, and the liquid that stands in it, in no vessel."""

    frame: Pose
    """Its frame, in the lowest point of its floor, z up."""
    low: FloatArray
    """Least corner, shape (3,) [m]."""
    high: FloatArray
    """Greatest corner, shape (3,) [m]."""
    area: float
    """Of its floor [m^2]."""
    rise: float
    """How far the floor rises towards its walls [m]."""


class LiquidHandling(Protocol):
    """Liquid leaves vessels and is drawn into pipettes, a whole number of particles at a time."""

    @property
    def particle(self) -> float:
        """Volume of a particle [m^3]."""
        ...

    def dispense(self, bottle: Dispenser, volume: float, spout: Pose, duration: float) -> None:
        """Let liquid out of a bottle; `volume` is what has left since the start [m^3]."""
        ...

    def waiting(self, bottle: Dispenser) -> float:
        """Return what is left in a bottle [m^3]."""
        ...

    def stock(self, vessel: str, inlet_w: FloatArray) -> Stock | None:
        """Return what is inside a vessel or a pipette, as it is next to an inlet; None if empty."""
        ...

    def near(self, point_w: FloatArray) -> Stock | None:
        """Return the liquid that a point lies in, if it lies in any that is in motion."""
        ...

    def solution_at(self, point_w: FloatArray) -> Solution | None:
        """Return what is dissolved around a point in a vessel, as if that alone had mixed.

        None where it lies in no vessel's liquid, or nothing is dissolved in the scene.
        """
        ...

    def temperature_at(self, point_w: FloatArray) -> float | None:
        """Return how warm the liquid around a point is [K]; None where it lies in none."""
        ...

    def gas_from(self, vessel: str) -> float:
        """Return how much gas has left what a vessel holds, since the start [mol]."""
        ...

    def drop_at(self, point_w: FloatArray) -> Solution | None:
        """Return what is dissolved in a drop that lies around a point, in no vessel.

        None where none does, or nothing is dissolved in the scene.
        """
        ...

    def drop_on(self, patch: Pose, size: tuple[float, float]) -> Solution | None:
        """Return what is dissolved in what lies on a patch, in no vessel.

        None where nothing does, or nothing is dissolved in the scene.

        Args:
            patch: Its frame, in its middle, z out of it.
            size: Along x and along y [m].
        """
        ...

    def gather(self, vessel: str) -> None:
        """Add what has come into a narrow vessel to the column that stands there."""
        ...

    def let_out(
        self, vessel: str, inlet_w: FloatArray, count: int, outlet: Pose, speed: float
    ) -> int:
        """Move particles out of a vessel or a pipette.

        Args:
            vessel: Its name.
            inlet_w: Those nearest to it leave, or what came in last, of a pipette.
            count: How many, at most.
            outlet: Where they come out; z the way that they leave.
            speed: With which they leave [m/s].

        Returns:
            How many there were.
        """
        ...

    def draw(self, into: str, count: int, tip_w: FloatArray) -> int:
        """Move the particles nearest to a tip into a pipette.

        Args:
            into: Its name.
            count: How many, at most.
            tip_w: Where it draws from.

        Returns:
            How many there were.
        """
        ...

    def lying_in(self, pool: Pool) -> float:
        """Return the volume that stands in a basin; what falls into it is not there yet [m^3]."""
        ...

    def run_down(self, into: str, count: int, pool: Pool) -> int:
        """Move particles of a pool down a hole: those nearest to it.

        Args:
            into: Name of the drain; nothing moves where it only furnishes a room.
            count: How many, at most.
            pool: Its frame lies in the middle of the hole.

        Returns:
            How many there were.
        """
        ...

    def warmth(self, vessel: str) -> Warmth | None:
        """Return how warm what a vessel holds is; None if it holds nothing."""
        ...

    def warm(self, vessel: str, heat: float) -> None:
        """Give what a vessel holds some heat [J]."""
        ...

    def evaporate(self, vessel: str, count: int) -> float:
        """Take particles of water off the surface of what a vessel holds, all but one at most.

        What was dissolved in them stays with what is next to them.

        Args:
            vessel: Name of the vessel.
            count: How many.

        Returns:
            The heat that they had above 0 K [J].
        """
        ...

    def warm_to(self, temperature: float) -> None:
        """Bring all liquid to where it begins in a room of a temperature [K]."""
        ...

    def all_at(self, temperature: float) -> bool:
        """Return whether all liquid has a temperature [K]."""
        ...

    def mix(self, period: float) -> None:
        """Let what is in each vessel share its heat for a time [s]."""
        ...

    def react(self, period: float) -> None:
        """Let what is dissolved in each vessel mix and react for a time [s]."""
        ...

    def stir(self, at: FloatArray, speed: float, radius: float, duration: float) -> None:
        """Draw the liquid of the vessel that a point is in towards a vortex [m, rad/s, m, s]."""
        ...

    def masses(self) -> tuple[FloatArray, FloatArray]:
        """Return where the liquid is, shape (n, 3) [m], and its mass there, shape (n,) [kg]."""
        ...
