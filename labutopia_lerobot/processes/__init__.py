"""Processes: things that pieces do by themselves, and the readings that they give."""

from labutopia_lerobot.processes.process import (
    Apparatus,
    Process,
    ProcessError,
    UnknownReadingError,
    slots_of,
)

__all__ = ["Apparatus", "Process", "ProcessError", "UnknownReadingError", "slots_of"]
