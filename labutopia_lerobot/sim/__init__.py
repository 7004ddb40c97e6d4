"""The simulation proper: compiling a scene, stepping, rendering, inverse kinematics."""
