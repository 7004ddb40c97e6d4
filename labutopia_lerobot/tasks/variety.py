"""Choices that tasks draw from: vessels by name, liquids, and how warm solutions begin."""

from collections.abc import Callable
from functools import partial

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.scenario import Draw
from labutopia_lerobot.substances.filling import Filling

VESSELS: dict[str, Callable[[str], Vessel]] = {
    "300 ml conical flask": partial(glassware, "conical_flask", "300 ml"),
    "500 ml conical flask": partial(glassware, "conical_flask", "500 ml"),
    "1000 ml conical flask": partial(glassware, "conical_flask", "1000 ml"),
    "graduated cylinder": partial(glassware, "measuring_cylinder", "250 ml"),
    "volumetric flask": partial(glassware, "pear_shaped_flask", "250 ml"),
    "150 ml beaker": partial(glassware, "beaker", "150 ml"),
    "250 ml beaker": partial(glassware, "beaker", "250 ml"),
}
"""Name of a vessel in instructions -> function that makes it, given its role in the task."""


def draw_filling(draw: Draw, ml: float) -> Filling:
    """Return what a vessel holds: water, or on the axis `liquid` more or less of some substance.

    Water and ethanol are for training. Ethylene glycol, eighteen times as viscous, is for tests, as
    are amounts outside the training range. All ours: the paper's vessels hold "a solution", and
    those of its code are empty.

    Args:
        draw: The episode's draw.
        ml: Volume where nothing varies [ml].
    """
    if not draw.varies("liquid"):
        return Filling(ml)
    shares = {"water": (1.0, 0.8, 1.2), "ethanol": (0.9, 1.1), "ethylene glycol": (0.6, 1.4)}
    fillings = [Filling(round(share * ml), of) for of in shares for share in shares[of]]
    named = {f"{filling.ml:g} ml of {filling.of}": filling for filling in fillings}
    names = list(named)
    return named[draw.choice("liquid", train=names[:5], test=names[5:])]


def start_temperature(draw: Draw) -> float | None:
    """Return how warm solutions begin [degrees C]; None where the axis does not vary: as the room.

    The room has 20 degrees meanwhile. Ours: training is what has stood in a room, a test what comes
    out of a refrigerator, or off a hot plate some time ago.

    Args:
        draw: The episode's draw.
    """
    if not draw.varies("start_temperature"):
        return None
    cold, hot = (8.0, 15.0), (30.0, 40.0)
    return draw.uniform("start_temperature", train=(18.0, 25.0), test=[cold, hot])
