"""A multilayer perceptron that clones behaviour, as a policy of LeRobot: `--policy.type=mlp`.

LeRobot finds a policy by the names of its modules: `configuration_mlp`, `modeling_mlp` and
`processor_mlp` (lerobot/policies/factory.py). Importing this registers the first; torch comes with
the others.
"""

from labutopia_lerobot.behaviour_cloning.configuration_mlp import MLPConfig

__all__ = ["MLPConfig"]
