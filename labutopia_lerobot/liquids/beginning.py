"""What particles are when they are filled in: of which substance, holding what, how warm."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.chemistry.kept_answers import KeptAnswers
from labutopia_lerobot.liquids.plain_liquids import PlainLiquids
from labutopia_lerobot.liquids.portion import Portion
from labutopia_lerobot.liquids.solutions import Solutions
from labutopia_lerobot.processes import AMBIENT
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.substances.substance import ZERO_C
from labutopia_lerobot.world import FloatArray


class Beginning:
    """What the liquids of a scene are at the start.

    Args:
        fillings: Everything that is to be filled in.
        names: Of all vessels, bottles and pipettes.
        particle: Volume of a particle [m^3].
        answers: Of a language model, which decide what may form; None for the rules.

    Attributes:
        fillings: All of them.
        substances: All that there are, each once.
        solutions: All that is dissolved in them, or will be; None where nothing is.
        plain: Their state where nothing is.
        room: How warm the room is [K].
    """

    def __init__(
        self,
        fillings: Sequence[Filling],
        names: Sequence[str],
        particle: float,
        answers: KeptAnswers | None = None,
    ) -> None:
        self.fillings = tuple(fillings)
        self.substances = tuple(dict.fromkeys(filling.substance for filling in fillings))
        chemical = any(filling.reacts for filling in fillings)
        self.solutions = Solutions(fillings, names, particle, answers) if chemical else None
        self.plain = PlainLiquids(self.substances, particle)
        self.room = AMBIENT
        self._own = np.full(len(names), np.nan)

    @property
    def nothing(self) -> Portion:
        """No particles."""
        return self.fresh([])

    def warm(self, origin: int, celsius: float | None) -> None:
        """Let what comes from somewhere begin at a temperature [degrees C]; None: as the room."""
        self._own[origin] = np.nan if celsius is None else celsius + ZERO_C

    def fresh(self, held: Sequence[tuple[int, Filling]]) -> Portion:
        """Return what particles are that come from where they are, as they begin.

        Args:
            held: Which of the names each comes from, -1 none, and of which filling it is.
        """
        origins = np.array([origin for origin, _ in held], dtype=int)
        kinds = [self.substances.index(filling.substance) for _, filling in held]
        amounts = np.eye(len(self.substances))[np.array(kinds, dtype=int)]
        contents: FloatArray = np.empty((len(held), 0))
        if self.solutions is not None:
            contents = self.solutions.contents([filling for _, filling in held])
        return Portion(origins, origins.copy(), self.temperatures(origins), amounts, contents)

    def strew(
        self, what: Portion, heights: FloatArray, held: Sequence[tuple[int, Filling]]
    ) -> None:
        """Put crystals on the bottom of the vessels that have some, in place.

        Args:
            what: The particles, as `fresh` returned them.
            heights: Where they have come to rest, shape (n,) [m].
            held: As of `fresh`.
        """
        for origin, filling in dict.fromkeys(held):
            if self.solutions is not None and filling.crystals:
                there = np.flatnonzero(what.origins == origin)
                contents = what.contents[there]
                self.solutions.strew(contents, heights[there], filling)
                what.contents[there] = contents

    def temperatures(self, origins: NDArray[np.int64]) -> FloatArray:
        """Return how warm particles begin: as their filling says, or else as the room [K]."""
        own = np.append(self._own, np.nan)[origins]  # the last is that of no origin, -1
        return np.where(np.isnan(own), self.room, own)
