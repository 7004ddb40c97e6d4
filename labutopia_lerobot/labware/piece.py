"""What every piece of labware says of itself, so that it can be put into a scene."""

from typing import TYPE_CHECKING, Protocol

from labutopia_lerobot.world import Button, Thing

if TYPE_CHECKING:
    import mujoco

    from labutopia_lerobot.processes import Process


class Piece(Thing, Protocol):
    """A thing that can be put into a scene."""

    @property
    def footprint_radius(self) -> float:
        """Radius of the circle around its origin that it needs on the bench [m]."""
        ...

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of its hinges and slides, as in the model; their positions are its state."""
        ...

    @property
    def buttons(self) -> tuple[Button, ...]:
        """Its push-buttons."""
        ...

    @property
    def processes(self) -> "tuple[Process, ...]":
        """What it does by itself, in the order in which it is done."""
        ...

    @property
    def movable(self) -> bool:
        """Whether it stands free (a vessel) or is fixed to the bench (an instrument)."""
        ...

    def add_to(self, spec: "mujoco.MjSpec", parent: "mujoco.MjsBody") -> "mujoco.MjsBody":
        """Build its root body, of its name, into a spec: origin at the centre of its base, z up."""
        ...
