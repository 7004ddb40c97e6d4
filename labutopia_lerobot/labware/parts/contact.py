"""How labware touches: friction, and how hard contacts are."""

FRICTION = (0.4, 0.005, 0.0001)
"""Sliding, torsional [m], rolling [m]. The first is the kinetic friction of glass on glass (Serway,
"Physics for Scientists and Engineers", table of friction coefficients). MuJoCo takes the larger
value of two geoms, so that a rougher bench or a rubber pad decides for itself."""

SOLREF = (0.008, 1.0)
"""Time constant [s] and damping ratio of contacts: critically damped, and as stiff as two physics
steps of 1/300 s allow (MuJoCo, "Solver parameters")."""

SOLIMP = (0.95, 0.99, 0.0005, 0.5, 2.0)
"""Contacts are hard within half a millimetre. Measured: an 8 mm ball is stopped by the walls up to
1.2 m/s at 300 steps per second, and goes through some of them at 1.5 m/s."""
