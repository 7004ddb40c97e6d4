"""Conventions of every MuJoCo model here: its rate, and the groups of its elements."""

PHYSICS_HZ = 300
"""Physics rate: ten steps per control period.

Measured on an arm lifting a 0.2 kg flask by friction: at 1/150 s the grasp creeps and the flask
buzzes on the bench, at 1/300 s neither does, at 1/600 s nothing improves but the price doubles.
"""

VISUAL_GROUP = 2
"""Geoms that are drawn."""
COLLISION_GROUP = 3
"""Geoms that touch; MuJoCo's viewer and renderer hide them by default."""
HULL_GROUP = 4
"""Simplified hulls that only the motion planner looks at."""
SKIN_GROUP = 5
"""Skins of liquids, to be switched off in `MjvOption.skingroup`: MuJoCo would bend them."""
