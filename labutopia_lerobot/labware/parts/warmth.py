"""What heats or cools in instruments: a chamber of air with its walls, a bath of water, a block."""

import math
from dataclasses import dataclass

from labutopia_lerobot.labware.parts.solid import Vector
from labutopia_lerobot.processes import DoorGap, HeatZone, Process, ThermalMass, Thermostat
from labutopia_lerobot.processes.heat import UPWARDS
from labutopia_lerobot.processes.hot_surface import IN_AIR, IN_WATER

AIR = 1.19 * 1007.0
"""Heat capacity of air [J/m^3 K] (Incropera, table A.4)."""
_STEEL = 480.0 * 7900.0 * 0.8e-3
"""Of a liner of 0.8 mm stainless steel [J/m^2 K] (EN 10088-1); ours that it is all that warms up
within minutes."""
_WATER = 997.0 * 4182.0
"""Of water [J/m^3 K] (CRC Handbook)."""
_AT_A_DOOR = 2.0 * _STEEL
"""Of liner and shelves [J/m^2 K]; ours: shelves weigh as much as the liner."""


@dataclass(frozen=True)
class Regulated:
    """How a device is regulated.

    Attributes:
        watt: Of its heater [W]; below 0 of a chiller.
        set_to: Set point [degrees C], or the name of the reading that gives it.
        switch: Reading that is 1 while it is on; none for what is always on.
        begins: Temperature at the start [degrees C]; None for that of the room.
        resolution: Of its display [K].
        warning: What its display writes while its door is open; nothing else by default.
    """

    watt: float
    set_to: float | str
    switch: str = ""
    begins: float | None = None
    resolution: float = 1.0
    warning: str = ""


def thermometer(piece: str) -> str:
    """Return what the reading of a device's own thermometer is called."""
    return f"{piece}_thermometer"


def chamber(
    piece: str,
    low: Vector,
    high: Vector,
    leak: float,
    gap: DoorGap,
    by: Regulated,
    called: str = "",
) -> tuple[Process, ...]:
    """Return a chamber: a liner that is heated, its air, which an open door lets out, a thermostat.

    Args:
        piece: Name of the device, and of the body that the box is in.
        low: Least corner of its inside [m].
        high: Greatest corner [m].
        leak: Through the insulation [W/K].
        gap: What an open door lets through.
        by: How it is regulated.
        called: What the names of its processes begin with; with that of the device if not said.
    """
    called = called or piece
    wide, deep, tall = (b - a for a, b in zip(low, high, strict=True))
    inside = 2.0 * (wide * deep + deep * tall + tall * wide)
    air, liner = f"{called}_air", f"{called}_liner"
    zone = HeatZone(low, high, IN_AIR)
    volume = wide * deep * tall * AIR
    links = ((liner, IN_AIR * inside),)
    return (
        ThermalMass(air, piece, volume, links=links, zone=zone, gap=gap, begins=by.begins),
        ThermalMass(liner, piece, inside * _AT_A_DOOR, leak=leak, begins=by.begins),
        _thermostat(called, liner, by, air, gap.joint),
    )


def bath(piece: str, low: Vector, high: Vector, leak: float, by: Regulated) -> tuple[Process, ...]:
    """Return a bath of water, open above, and its thermostat.

    Args:
        piece: Name of the device, and of the body that the box is in.
        low: Least corner of the water [m].
        high: Greatest corner [m].
        leak: Through its walls [W/K].
        by: How it is regulated.
    """
    wide, deep, tall = (b - a for a, b in zip(low, high, strict=True))
    water = ThermalMass(
        f"{piece}_water",
        piece,
        wide * deep * tall * _WATER,
        area=wide * deep,
        length=wide * deep / (2.0 * (wide + deep)),
        convection=UPWARDS,
        leak=leak,
        zone=HeatZone(low, high, IN_WATER),
        begins=by.begins,
    )
    return water, _thermostat(piece, water.name, by)


def block(
    piece: str,
    capacity: float,
    area: float,
    zone: HeatZone,
    surfaces: tuple[str, ...],
    by: Regulated,
    leak: float = 0.2,
) -> tuple[Process, ...]:
    """Return a plate or a block with a heater in it, and its thermostat.

    Args:
        piece: Name of the device, and of the body that it is part of.
        capacity: Heat that warms it by 1 K [J/K].
        area: Of its surface towards the room [m^2].
        zone: Where it warms what stands there.
        surfaces: Geoms that burn a hand.
        by: How it is regulated.
        leak: Into the housing [W/K]; ours.
    """
    length = math.sqrt(area) / 4.0  # area over circumference of a square
    plate = ThermalMass(
        f"{piece}_surface",
        piece,
        capacity,
        area=area,
        length=length,
        convection=UPWARDS,
        leak=leak,
        zone=zone,
        begins=by.begins,
        surfaces=surfaces,
    )
    return plate, _thermostat(piece, plate.name, by)


def _thermostat(
    piece: str, heats: str, by: Regulated, senses: str = "", door: str = ""
) -> Thermostat:
    return Thermostat(
        thermometer(piece),
        heats,
        by.watt,
        by.set_to,
        by.switch,
        senses,
        resolution=by.resolution,
        door=door,
        warning=by.warning,
    )
