"""A series: one kind of vessel in all its sizes, as a catalogue has it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.labware.glass.material import Material
from labutopia_lerobot.labware.glass.outlines import Outline
from labutopia_lerobot.labware.glass.profile import Profile
from labutopia_lerobot.labware.glass.vessel import Vessel

_UNITS = {"ml": 1.0, "l": 1000.0}


class UnknownGlasswareError(UserError, ValueError):
    """A kind or a size of ware that does not exist; the message lists those that do."""


@dataclass(frozen=True)
class Series:
    """A kind of vessel in all its sizes.

    Attributes:
        kind: Such as `beaker_low`.
        what: What it is, in a sentence.
        outline: From the first numbers of a row to the corners of the outside, all in mm.
        material: What it is made of.
        source: Of the numbers.
        sizes: Numbers of every size [mm]: those that the outline takes, the thickness of the wall,
            measured horizontally, and that of the bottom. What has a nominal volume is called
            after it, the rest after its diameter and height.
        grip: Height at which a gripper closes, as a share of the whole.
        stands: Whether it stands by itself.
        graduated: Whether it has a scale.
        one_mark: Whether the only graduation is a ring at the nominal volume.
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
    one_mark: bool = False

    def vessel(self, size: str, name: str) -> Vessel:
        """Return a vessel of a size.

        Raises:
            UnknownGlasswareError: There is no such size.
        """
        if size not in self.sizes:
            raise UnknownGlasswareError(
                f"No {self.kind} of size '{size}'; sizes: {', '.join(self.sizes)}"
            )
        *numbers, wall, bottom = self.sizes[size]
        outer = tuple((1e-3 * r, 1e-3 * z) for r, z in self.outline(*numbers))
        volume = nominal(size)
        return Vessel(
            name,
            Profile(outer, 1e-3 * wall, 1e-3 * bottom),
            grip_height=self.grip * outer[-1][1],
            one_mark=1e-6 * volume if self.one_mark and volume is not None else None,
            material=self.material,
            stands=self.stands,
            graduated=self.graduated or self.one_mark,
        )

    @property
    def vessels(self) -> tuple[Vessel, ...]:
        """One of every size, called after it."""
        return tuple(self.vessel(size, size.replace(" ", "_")) for size in self.sizes)


def nominal(size: str) -> float | None:
    """Return the nominal volume that a size is called after [ml]; None if after its diameter."""
    number, _, unit = size.partition(" ")
    return float(number) * _UNITS[unit] if unit in _UNITS else None
