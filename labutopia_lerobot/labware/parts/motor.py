"""A motor on a joint, and a bolt that a magnet holds: actuators that processes set by name."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.processes import Apparatus

_BOLT = 2000.0, 30.0, 120.0
"""Stiffness and damping of a bolted hinge, and the torque at which its bolt would yield [N m/rad,
N m s/rad, N m]; ours: 40 N at the edge of a lid lift it by 2.4 mm, and nothing by hand opens it."""


@dataclass(frozen=True)
class Motor:
    """A motor that drives a joint at a speed, as hard as it can at most; it brakes when it is off.

    Attributes:
        of: Name of the body that it moves.
        joint: Name of its hinge or slide.
        stall: Torque or force that it has at most [N m or N].
        gain: Torque or force per difference of speed [N m s/rad or N s/m].
    """

    of: str
    joint: str
    stall: float
    gain: float

    @property
    def name(self) -> str:
        """Name of its actuator, whose control is the speed [rad/s or m/s]."""
        return f"{self.of}_motor"

    def add_to(self, spec: mujoco.MjSpec) -> None:
        """Build its actuator into a spec that has the joint."""
        motor = spec.add_actuator(
            name=self.name,
            target=self.joint,
            trntype=mujoco.mjtTrn.mjTRN_JOINT,
            gaintype=mujoco.mjtGain.mjGAIN_FIXED,
            biastype=mujoco.mjtBias.mjBIAS_AFFINE,
            forcelimited=mujoco.mjtLimited.mjLIMITED_TRUE,
            forcerange=(-self.stall, self.stall),
        )
        motor.gainprm[0] = self.gain
        motor.biasprm[2] = -self.gain

    def command(self, apparatus: Apparatus, speed: float) -> None:
        """Drive at a speed [rad/s or m/s] until the next control period."""
        apparatus.data.ctrl[apparatus.model.actuator(self.name).id] = speed


@dataclass(frozen=True)
class Bolt:
    """A magnet's bolt that keeps a shut lid shut; without current it does nothing.

    Attributes:
        of: Name of the lid.
        joint: Name of its hinge; 0 is shut.
    """

    of: str
    joint: str

    @property
    def name(self) -> str:
        """Name of its actuator, whose control is 1 where it is bolted, else 0."""
        return f"{self.of}_bolt"

    def add_to(self, spec: mujoco.MjSpec) -> None:
        """Build its actuator into a spec that has the hinge."""
        stiffness, damping, most = _BOLT
        bolt = spec.add_actuator(
            name=self.name,
            target=self.joint,
            trntype=mujoco.mjtTrn.mjTRN_JOINT,
            gaintype=mujoco.mjtGain.mjGAIN_AFFINE,
            biastype=mujoco.mjtBias.mjBIAS_NONE,
            forcelimited=mujoco.mjtLimited.mjLIMITED_TRUE,
            forcerange=(-most, most),
        )
        bolt.gainprm[:3] = 0.0, -stiffness, -damping

    def command(self, apparatus: Apparatus, *, bolted: bool) -> None:
        """Bolt or release it."""
        apparatus.data.ctrl[apparatus.model.actuator(self.name).id] = float(bolted)
