"""Fillings of vessels."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol, runtime_checkable

from labutopia_lerobot.chemistry.crystals import Crystals
from labutopia_lerobot.chemistry.inventory import Solute
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.substances.substance import ZERO_C, Substance, substance
from labutopia_lerobot.world import Thing

if TYPE_CHECKING:
    from labutopia_lerobot.labware.glass.profile import Profile


class ImpossibleFillingError(UserError, ValueError):
    """Contents that cannot be; the message names the vessel and what it holds."""


@runtime_checkable
class Fillable(Thing, Protocol):
    """A vessel that liquid stays in: its wall is a closed surface of revolution."""

    @property
    def profile(self) -> "Profile":
        """The wall's half cross-section."""
        ...


@runtime_checkable
class Dispenser(Thing, Protocol):
    """A bottle that liquid leaves when it is squeezed."""

    @property
    def spout(self) -> str:
        """Name of the frame at the end of the spout; z the way that the liquid leaves."""
        ...

    @property
    def bore_area(self) -> float:
        """Cross-section of the spout [m^2]."""
        ...

    @property
    def contents(self) -> float:
        """The most that is in it [m^3]."""
        ...


@runtime_checkable
class Narrow(Fillable, Protocol):
    """A vessel that may be so narrow that its liquid stands in it as one column."""

    @property
    def column(self) -> bool:
        """Whether it is: what is in it is not moved as particles, it is only counted."""
        ...


@runtime_checkable
class Mounting(Thing, Protocol):
    """An instrument with mounted ware, as a burette is on its stand, or with a drain."""

    @property
    def mounted(self) -> "tuple[Fillable | Intake, ...]":
        """The ware, each a body of its own, and drains."""
        ...


@runtime_checkable
class Intake(Thing, Protocol):
    """What draws liquid in and keeps it: pipettes and syringes at their tip; drains."""

    @property
    def draws_at(self) -> str:
        """Name of the frame at the end of its tip or in its hole; z the way that liquid leaves."""
        ...


@dataclass(frozen=True)
class Filling:
    """Some millilitres of a substance, or of a solution in it.

    Attributes:
        ml: Volume [ml].
        of: Name of the substance; of a solution `water`.
        celsius: How warm it is at the start, and its vessel with it [degrees C]; None for as warm
            as the room.
        dissolved: Its solutes. Where any filling of a task has something, all that its
            vessels hold can react.
        crystals: What lies on the bottom, not dissolved yet; with it too all can react.
    """

    ml: float
    of: str = "water"
    celsius: float | None = None
    dissolved: tuple[Solute, ...] = ()
    crystals: tuple[Crystals, ...] = ()

    @property
    def substance(self) -> Substance:
        """The substance.

        Raises:
            UnknownSubstanceError: There is none of that name.
        """
        return substance(self.of)

    @property
    def reacts(self) -> bool:
        """Whether something is dissolved in it, or will be."""
        return bool(self.dissolved or self.crystals)

    @property
    def compounds(self) -> tuple[str, ...]:
        """Names of all that is dissolved in it, or will be, by the table of substances."""
        held: tuple[Solute | Crystals, ...] = (*self.dissolved, *self.crystals)
        return tuple(one.compound.name for one in held)

    @property
    def volume(self) -> float:
        """Volume [m^3]."""
        return self.ml * 1e-6


def with_mounted(pieces: Iterable[Thing]) -> tuple[Thing, ...]:
    """Return pieces, each followed by the ware that is mounted on it."""
    return tuple(
        thing
        for piece in pieces
        for thing in (piece, *(piece.mounted if isinstance(piece, Mounting) else ()))
    )


def require_fillable[Present: Thing](
    contents: Mapping[Present, Filling], present: Iterable[Present]
) -> None:
    """Make sure, before anything is compiled, that vessels can hold what a task puts into them.

    Args:
        contents: What each vessel holds.
        present: Everything that there is in the task.

    Raises:
        ImpossibleFillingError: A volume is not positive or more than its vessel holds, or a vessel
            is not in the task or not watertight.
        UnknownSubstanceError: A substance does not exist.
    """
    there = with_mounted(present)
    for vessel, filling in contents.items():
        filling.substance  # noqa: B018 - raises if there is none of that name
        if vessel not in there:
            names = ", ".join(thing.name for thing in there)
            raise ImpossibleFillingError(
                f"{vessel.name} is to be filled but not in the task, which has: {names}"
            )
        if not isinstance(vessel, Fillable | Dispenser):
            raise ImpossibleFillingError(
                f"{vessel.name} ({type(vessel).__name__}) is not watertight: it has no `profile`, "
                "the closed half cross-section that holds a liquid. Fill a beaker or a flask"
            )
        capacity = _capacity(vessel) * 1e6
        if not (math.isfinite(filling.ml) and 0 < filling.ml <= capacity):
            raise ImpossibleFillingError(
                f"{vessel.name} cannot hold {filling.ml:g} ml of {filling.of}: "
                f"it takes more than 0 and at most {capacity:.0f} ml"
            )
        melting = round(filling.substance.melting_point - ZERO_C, 2)
        boiling = round(filling.substance.boiling_point - ZERO_C, 2)
        if filling.celsius is not None and not melting <= filling.celsius < boiling:
            raise ImpossibleFillingError(
                f"{vessel.name} cannot hold {filling.of} of {filling.celsius:g} degrees C: it is "
                f"liquid from {melting:g} to below {boiling:g}"
            )


def _capacity(vessel: Fillable | Dispenser) -> float:
    """Return the most that a vessel holds [m^3]."""
    if isinstance(vessel, Dispenser):
        return vessel.contents
    _require_watertight(vessel)
    return vessel.profile.capacity


def _require_watertight(vessel: Fillable) -> None:
    """Make sure that there is glass between the cavity and the outside everywhere.

    Raises:
        ImpossibleFillingError: There is a hole.
    """
    profile = vessel.profile
    inner = profile.inner
    holes = [z for r, z in inner if not 0.0 < r < profile.outer_radius(z)]
    if holes or inner[0][1] <= 0.0 or inner[-1][1] < profile.height:
        raise ImpossibleFillingError(
            f"{vessel.name} is not watertight: at the heights {holes} m its cavity reaches the "
            "outside or closes. Mend its profile"
        )
