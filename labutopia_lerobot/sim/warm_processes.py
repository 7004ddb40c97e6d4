"""What a scene needs beside where something heats, cools or reacts: warm vessels, the exchange."""

import math
from collections.abc import Iterable
from itertools import pairwise

from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.labware.piece import Piece
from labutopia_lerobot.processes import HeatExchange, Process, Reactions, ThermalMass


def warm_processes(
    pieces: Iterable[Piece], processes: Iterable[Process], hand: str, *, reacts: bool = False
) -> tuple[Process, ...]:
    """Return what keeps the heat of a scene; nothing where nothing heats, cools or reacts.

    Args:
        pieces: Everything in the scene.
        processes: What they do by themselves.
        hand: Body that the robot's fingers hang on.
        reacts: Whether there is something dissolved.
    """
    masses = [process for process in processes if isinstance(process, ThermalMass)]
    if not masses and not reacts:
        return ()
    vessels = [warm_vessel(piece) for piece in pieces if isinstance(piece, Vessel)]
    exchange = HeatExchange((*masses, *vessels), hand)
    return (*vessels, Reactions(), exchange) if reacts else (*vessels, exchange)


def warm_vessel(vessel: Vessel) -> ThermalMass:
    """Return a vessel as a thing of one temperature, whose outside loses heat to the room."""
    outer = vessel.profile.outer
    area = sum(math.pi * (a + b) * math.hypot(a - b, y - x) for (a, x), (b, y) in pairwise(outer))
    return ThermalMass(
        f"{vessel.name}_temperature",
        vessel.name,
        vessel.mass * vessel.material.specific_heat,
        area=area,
        length=vessel.height,
        wall=vessel.profile,
    )
