"""Pictures of particles: the surface around them, its colours, and how MuJoCo draws it."""
