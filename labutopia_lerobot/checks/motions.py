"""Checks that the expert moves as a real arm can, at every physics step."""

import numpy as np

from labutopia_lerobot.checks.playing import expert, play
from labutopia_lerobot.checks.require import require
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.robots.hand_kinematics import HandKinematics
from labutopia_lerobot.robots.robot import Robot
from labutopia_lerobot.world import FloatArray
from labutopia_lerobot.world.model import PHYSICS_HZ

_MOTION = 0.9
"""Share of each limit of speed, acceleration and jerk that an expert may use."""
_TORQUE = 0.6
"""Share of the joints' torques that an expert may use."""


def the_expert_moves_as_a_real_arm_can(env: LabEnv) -> None:
    """It leaves a tenth of every limit of motion, and two fifths of the torques."""
    _require_moderate(env, seeds=range(100, 101))


def the_expert_does_so_in_ten_episodes(env: LabEnv) -> None:
    """Wherever things stand."""
    _require_moderate(env, seeds=range(110, 120))


def motion_and_torque(env: LabEnv, seed: int) -> tuple[dict[str, float], dict[str, float]]:
    """Play the expert's episode; return the greatest shares of the limits that it reached, by name.

    Returns:
        Of the limits of the set-points' motion, and of the limits of the joints' torques.
    """
    played, scene = play(env, expert, seed), env.workcell.simulation.scene
    robot, model = scene.robot, scene.model
    servos = [model.actuator(joint.name).id for joint in robot.joints]
    reached = np.abs(played.torques).max(axis=0) / model.actuator_forcerange[servos, 1]
    motion = _motion(played.set_points, robot, HandKinematics(model, robot))
    return motion, dict(zip((joint.name for joint in robot.joints), reached, strict=True))


def _motion(points: FloatArray, robot: Robot, hand: HandKinematics) -> dict[str, float]:
    """Return the greatest shares of the limits that set-points reach, shape (steps, elements)."""
    limits = {"speed": robot.speed, "acceleration": robot.acceleration, "jerk": robot.jerk}
    shares = {}
    for order, (kind, limit) in enumerate(limits.items(), start=1):
        greatest = np.abs(np.diff(points, n=order, axis=0)).max(axis=0) * PHYSICS_HZ**order
        for element, share in zip(robot.elements, greatest / limit, strict=True):
            shares[f"{kind} of {element.name}"] = float(share)
    joints = points[:, robot.roles.joints]
    steps = zip(joints[:-1], np.diff(joints, axis=0), strict=True)
    fastest = max(float(np.linalg.norm(hand.jacobian(at) @ step)) for at, step in steps)
    return shares | {"speed of the hand": fastest * PHYSICS_HZ / robot.hand_speed}


def _require_moderate(env: LabEnv, seeds: range) -> None:
    for seed in seeds:
        motion, torque = motion_and_torque(env, seed)
        for name, share in motion.items():
            require(share < _MOTION, f"seed {seed}: {share:.0%} of the greatest {name}")
        for name, share in torque.items():
            require(share < _TORQUE, f"seed {seed}: {share:.0%} of the torque of {name}")


CHECKS = (the_expert_moves_as_a_real_arm_can, the_expert_does_so_in_ten_episodes)
