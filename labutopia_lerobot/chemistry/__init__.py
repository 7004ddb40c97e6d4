"""A chemical engine: substances, what happens when they meet, and what one would see.

It imports neither mujoco nor torch. Paper: "Chemical Process Modeling" and its appendix ("Database
of Chemical Substances", "Process Reasoning Pipeline").
"""

from labutopia_lerobot.chemistry.reaction import Amounts, Conditions, Outcome, Reactant, Reaction
from labutopia_lerobot.chemistry.reasoning import react

__all__ = ["Amounts", "Conditions", "Outcome", "Reactant", "Reaction", "react"]
