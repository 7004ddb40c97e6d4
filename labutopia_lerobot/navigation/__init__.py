"""Driving in a room: a map of it, a path through it, and the velocities that follow that.

As in the paper (section "Navigation Trajectory Auto-collection" and appendix "Navigation Details"):
an occupancy map, A* over it, key waypoints, a robot that follows them. Free of mujoco.
"""
