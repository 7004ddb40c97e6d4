"""A chemical engine: compounds, what happens when they meet, and what one would see.

It imports neither mujoco nor torch. Paper: "Chemical Process Modeling" and its appendix ("Database
of Chemical Substances", "Process Reasoning Pipeline").
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from labutopia_lerobot.chemistry.reaction import (
        Amounts,
        Conditions,
        Outcome,
        Reactant,
        Reaction,
    )
    from labutopia_lerobot.chemistry.reasoning import react

__all__ = ["Amounts", "Conditions", "Outcome", "Reactant", "Reaction", "react"]


def __getattr__(name: str) -> Any:
    """Import the engine when it is asked for: all that holds a liquid imports its compounds."""
    if name not in __all__:
        raise AttributeError(f"{__name__} has no {name}. Choose from: {', '.join(__all__)}")
    module = "reasoning" if name == "react" else "reaction"
    return getattr(import_module(f"{__name__}.{module}"), name)
