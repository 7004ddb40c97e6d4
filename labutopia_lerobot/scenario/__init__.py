"""An episode before it is played: what its seed has drawn."""

from labutopia_lerobot.scenario.draw import AxisError, Draw, Value
from labutopia_lerobot.scenario.scenario import (
    ArmsAloneError,
    NeedsBaseError,
    Scenario,
    canonical_task,
    draw_scenario,
    scenario_seeds,
)

__all__ = [
    "ArmsAloneError",
    "AxisError",
    "Draw",
    "NeedsBaseError",
    "Scenario",
    "Value",
    "canonical_task",
    "draw_scenario",
    "scenario_seeds",
]
