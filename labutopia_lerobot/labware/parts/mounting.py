"""Mounting of things, free on the bench or fixed to it; what most share is said once, here."""

from labutopia_lerobot.labware.parts.push_button import PushButton
from labutopia_lerobot.processes import Process


class Still:
    """A `Piece` of which nothing moves, unless it says otherwise."""

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of its hinges and slides that are its state: none."""
        return ()

    @property
    def buttons(self) -> tuple[PushButton, ...]:
        return ()

    @property
    def processes(self) -> tuple[Process, ...]:
        """What it does by itself: its buttons click."""
        return self.buttons


class Loose(Still):
    """A piece that stands free, as glassware does."""

    @property
    def movable(self) -> bool:
        """It can be picked up, pushed and knocked over."""
        return True


class Fixed(Still):
    """A piece that is screwed to the bench or too heavy to be moved, as instruments are."""

    @property
    def movable(self) -> bool:
        return False
