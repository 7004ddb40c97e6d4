"""What a chemist can ask wrongly: each is one line that names the thing and the cure."""

from labutopia_lerobot.errors import UserError


class ChemistryError(UserError, ValueError):
    """Something was asked that the engine does not answer."""


class UnknownCompoundError(ChemistryError):
    """No compound has this name, formula or number; the message lists the nearest ones."""


class AmbiguousCompoundError(ChemistryError):
    """Several compounds have this name or formula; the message lists them."""


class ImpossibleConditionsError(ChemistryError):
    """A temperature, concentration, volume or amount that cannot be; the message says the range."""


class HazardRefusedError(ChemistryError):
    """The mixture burns, explodes or makes a controlled substance; the message says which."""
