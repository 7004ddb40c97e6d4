"""Processes: things that pieces do by themselves, and the readings that they give."""

from labutopia_lerobot.processes.electrode import ConductivityCell, PhElectrode, TemperatureSensor
from labutopia_lerobot.processes.energy_regulator import EnergyRegulator
from labutopia_lerobot.processes.heat import DoorGap, HeatZone, ThermalMass
from labutopia_lerobot.processes.heat_exchange import HeatExchange
from labutopia_lerobot.processes.liquid_handling import LiquidHandling, Stock, Warmth
from labutopia_lerobot.processes.photometer import Photometer
from labutopia_lerobot.processes.prisms import Prisms
from labutopia_lerobot.processes.probe import Probe
from labutopia_lerobot.processes.process import (
    AMBIENT,
    Apparatus,
    Process,
    ProcessError,
    UnknownReadingError,
    slots_of,
)
from labutopia_lerobot.processes.reactions import Reactions
from labutopia_lerobot.processes.thermostat import Thermostat

__all__ = [
    "AMBIENT",
    "Apparatus",
    "ConductivityCell",
    "DoorGap",
    "EnergyRegulator",
    "HeatExchange",
    "HeatZone",
    "LiquidHandling",
    "PhElectrode",
    "Photometer",
    "Prisms",
    "Probe",
    "Process",
    "ProcessError",
    "Reactions",
    "Stock",
    "TemperatureSensor",
    "ThermalMass",
    "Thermostat",
    "UnknownReadingError",
    "Warmth",
    "slots_of",
]
