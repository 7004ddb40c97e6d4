"""Contact parameters of labware."""

FRICTION = (0.4, 0.005, 0.0001)
"""Sliding, torsional [m], rolling [m]. The first is the kinetic friction of glass on glass (Serway,
"Physics for Scientists and Engineers", table of friction coefficients). MuJoCo takes the larger
value of two geoms, so that a rougher bench or a rubber pad decides for itself."""
