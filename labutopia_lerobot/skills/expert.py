"""The expert: plays skills through the same numbers that a policy commands."""

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from labutopia_lerobot.navigation.path_planner import BlockedPlaceError, UnreachableGoalError
from labutopia_lerobot.navigation.route import Route
from labutopia_lerobot.robots.braking import longest_step
from labutopia_lerobot.skills.skill import Phase, PhaseError, Skill
from labutopia_lerobot.world import (
    ARM,
    BASE,
    CONTROL_HZ,
    HAND,
    LEFT_PAD,
    RIGHT_PAD,
    FloatArray,
    Pose,
    Thing,
    World,
)

_STEP_S = 1.0 / CONTROL_HZ
_ACCELERATION = 1.0
"""Greatest change of the gripper's velocity [m/s^2]; keeps a full beaker from slopping where it is
carried."""

_TURN_ACCELERATION = 5.0
"""Greatest change of the gripper's angular velocity [rad/s^2]."""


_TINY = 1e-6
"""Excess that an opening may have over the gripper's [m]: commands are in single precision."""


class Motion(Protocol):
    """Turns a wanted gripper pose and opening into commands, reactively."""

    def begin(self) -> None:
        """Begin anew: nothing that happened before counts."""
        ...

    def follow(
        self,
        target: Pose,
        opening: float,
        driving_b: FloatArray | None = None,
        *,
        touches: frozenset[str],
        holds: Thing | None,
    ) -> FloatArray:
        """Return the next command, shape (elements,): joint targets, opening, base velocities."""
        ...

    def kept_from(
        self, *, touches: frozenset[str], holds: Thing | None
    ) -> dict[tuple[str, str], float]:
        """Return what is kept apart and is near each other, with the distance [m]."""
        ...


class Expert:
    """A finite-state machine over the phases of a task's skills.

    Whatever plays a phase raises `PhaseError` if the phase asks for what no hand can do.

    Args:
        skills: What it does.
        world: Where.
        motion: What follows the hand's path with the arm.
        pace: How fast the hand moves, as a share of the speeds of the phases, which then have as
            much more time; a base drives as ever.

    Attributes:
        finished: Whether the last phase is done.
        unexpected: Control steps with a touch outside the phase's declared list, by the two names.
        label: "pick/lift" and so on, the phase in play.
        failure: What went wrong ("pick/lower not done after 6 s", or no way leads there), or None.
    """

    def __init__(
        self, skills: Sequence[Skill], world: World, motion: Motion, pace: float = 1.0
    ) -> None:
        self._skills = skills
        self._pace = pace
        self._world = world
        self._motion = motion

    def start(self) -> None:
        """Begin with the first phase, from the present world."""
        self.failure: str | None = None
        self.finished = False
        self.unexpected: Counter[tuple[str, str]] = Counter()
        self.label = ""
        here, opening = self._world.gripper, self._world.commanded_opening
        self._phase = Phase("rest", lambda world: here, opening, lambda *now: False)
        self._began = self._world.time
        self._motion.begin()
        self._remaining = self._play()
        self._reference = self._world.gripper
        self._carrier = self._world.mobile_base
        self._velocity: FloatArray = np.zeros(6)
        self._driven: list[Sequence[Route]] = []
        self._next_phase()

    def _play(self) -> Iterator[tuple[str, Phase]]:
        for skill in self._skills:
            for phase in skill.phases(self._world):
                yield f"{type(skill).__name__.lower()}/{phase.name}", phase

    def _next_phase(self) -> bool:
        """Begin the next phase; return whether there is more to do."""
        try:
            label, phase = next(self._remaining, (None, None))
        except (BlockedPlaceError, UnreachableGoalError) as error:  # where the base has come to
            self.failure = str(error)
            return True
        if label is None or phase is None:
            return False
        self.label, self._phase, self._began = label, phase, self._world.time
        self._driven.append(phase.routes)
        widest = self._world.robot.max_opening
        if not -_TINY <= phase.opening <= widest + _TINY:
            raise PhaseError(
                f"{label}: its opening is {phase.opening:g} m, but the pads are from 0 to "
                f"{widest:g} m apart"
            )
        return True

    def _target(self) -> Pose:
        """Return where the present phase wants the gripper now."""
        target = self._phase.target(self._world)
        if not isinstance(target, Pose):
            raise PhaseError(
                f"{self.label}: its target returned {type(target).__name__}, not a Pose, such as "
                "hand_at(world, point_w) or Pose(position_w, rotation_w)"
            )
        return target

    @property
    def routes(self) -> tuple[Route, ...]:
        """Every route that was planned so far, in order."""
        return tuple(route for routes in self._driven for route in routes)

    @property
    def shortfall(self) -> str:
        """Distance of the hand from the target of the present phase, and what may be in its way."""
        target, gripper, phase = self._target(), self._world.gripper, self._phase
        degrees = np.degrees(gripper.angle_to(target))
        near = self._motion.kept_from(touches=phase.touches, holds=phase.holds)
        kept = "".join(
            f"; {mover} kept from {other}, {1e3 * gap:.0f} mm away"
            for (mover, other), gap in near.items()
        )
        cure = " (`touches` of a phase lists what hand and load may touch)"
        listed = cure if any(mover != ARM for mover, _ in near) else ""
        away = f"{1e3 * gripper.distance_to(target):.0f} mm and {degrees:.0f} deg"
        return f"{away} from the target of {self.label}{kept}{listed}"

    def act(self) -> NDArray[np.float32]:
        """Return the next action, shape (elements,): joint targets [rad] and opening [m].

        After the last phase, or after a failure, the last target is kept.
        """
        self._count_unexpected_touches()
        target = self._target()
        elapsed, allowed = self._world.time - self._began, self._phase.timeout_s / self._pace
        late = elapsed > allowed
        given_up = late and self._phase.may_fail
        done = given_up or self._phase.done(self._world, target, elapsed)
        if self.failure is None and done:
            self.finished = not self._next_phase()
            target = self._target()
        elif self.failure is None and late:
            self.failure = f"{self.label} not done after {allowed:g} s"
        self._ride()
        self._reference = self._towards(target)
        phase = self._phase
        driving = None if phase.drive is None or self.finished else phase.drive(self._world)
        command = self._motion.follow(
            self._reference, phase.opening, driving, touches=phase.touches, holds=phase.holds
        )
        return command.astype(np.float32)

    def _count_unexpected_touches(self) -> None:
        """Count touches of the arm, the hand and its load with what the phase does not list."""
        robot, body = {ARM, BASE, HAND, LEFT_PAD, RIGHT_PAD}, {ARM, BASE}
        allowed = dict.fromkeys(body, robot)
        allowed |= dict.fromkeys(robot - body, robot | self._phase.touches)
        if self._phase.holds is not None:
            allowed[self._phase.holds.name] = (robot - body) | self._phase.touches
        for mover, others in allowed.items():
            for other in self._world.touched_by(mover) - others:
                self.unexpected[mover, other] += 1

    def _ride(self) -> None:
        """Carry the reference along with the base, on which the arm stands."""
        base, before = self._world.mobile_base, self._carrier
        if base is not None and before is not None:
            moved = base @ before.inverse()
            self._reference = moved @ self._reference
            turned = moved.rotation_w
            self._velocity = np.concatenate(
                [turned @ self._velocity[:3], turned @ self._velocity[3:]]
            )
        self._carrier = base

    def _towards(self, target: Pose) -> Pose:
        """Move the reference towards the target within the phase's speeds, in a straight line.

        It speeds up, turns aside and comes to rest with bounded accelerations, also where the
        target jumps or moves.
        """
        turn = Rotation.from_matrix(target.rotation_w @ self._reference.rotation_w.T).as_rotvec()
        way = np.concatenate([target.position_w - self._reference.position_w, turn])
        speed, turn_speed = self._pace * self._phase.speed, self._pace * self._phase.turn_speed
        duration = max(_shares(way, speed, turn_speed), 1e-9)
        full = way / duration  # the velocity that is as fast as the phase allows
        growth = _STEP_S**2 / max(_shares(full, _ACCELERATION, _TURN_ACCELERATION), 1e-9)
        step = float(longest_step(np.array(duration), np.array(growth)))
        change = min(step / _STEP_S, 1.0) * full - self._velocity
        excess = _shares(change, _ACCELERATION * _STEP_S, _TURN_ACCELERATION * _STEP_S)
        self._velocity = self._velocity + change / max(excess, 1.0)
        moved = self._velocity * _STEP_S
        return Pose(
            self._reference.position_w + moved[:3],
            Rotation.from_rotvec(moved[3:]).as_matrix() @ self._reference.rotation_w,
        )


def _shares(motion: FloatArray, linear: float, angular: float) -> float:
    """Return a motion (along, then about the axes, shape (6,)) in units of what is allowed."""
    return float(max(np.linalg.norm(motion[:3]) / linear, np.linalg.norm(motion[3:]) / angular))
