"""Conventions of every MuJoCo model: its rate, how hard contacts are, groups of elements."""

PHYSICS_HZ = 300
"""Physics rate: ten steps per control period.

Measured on an arm lifting a 0.2 kg flask by friction: at 1/150 s the grasp creeps and the flask
buzzes on the bench, at 1/300 s neither does, at 1/600 s nothing improves but the price doubles.
"""

SOLREF = (0.008, 1.0)
"""Time constant [s] and damping ratio of contacts: critically damped, and as stiff as two physics
steps of 1/300 s allow (MuJoCo, "Solver parameters")."""

SOLIMP = (0.95, 0.99, 0.0005, 0.5, 2.0)
"""Contacts are hard within half a millimetre. Measured: an 8 mm ball is stopped by the walls up to
1.2 m/s at 300 steps per second, and goes through some of them at 1.5 m/s."""

BEYOND_GROUP = 1
"""Geoms that are drawn, but not in pictures of the fixed cameras, which cannot see them."""
VISUAL_GROUP = 2
"""Geoms that are drawn."""
COLLISION_GROUP = 3
"""Geoms that touch; MuJoCo's viewer and renderer hide them by default."""
HULL_GROUP = 4
"""Simplified hulls that only the motion planner looks at."""
SKIN_GROUP = 5
"""Skins of liquids, to be switched off in `MjvOption.skingroup`: MuJoCo would bend them."""
