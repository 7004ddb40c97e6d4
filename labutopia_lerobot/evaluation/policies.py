"""Players of an episode: reference policies, one policy per step, and recorded actions."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.env import LabEnv, Observation
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.condition import EXPERT, RANDOM, STILL
from labutopia_lerobot.robots import load_robot
from labutopia_lerobot.world import CONTROL_HZ

Action = NDArray[np.float32]
"""Absolute targets: joint angles [rad] and the gripper opening [m], shape (elements,)."""


class PolicyUnreachable(Exception):  # noqa: N818  (an outcome of an episode, not a mistake)
    """Nobody answers for a policy any more: the episode is over, and the next one may be played."""


class PolicyServerError(UserError):
    """A server that cannot be used, or whose policy raised; the message has its own words."""


class Policy(Protocol):
    """Plays one episode after another.

    What it does depends on the observations and the seed of the episode alone. It may have a
    `failure` (what it could not do, or None) and a `device` (of torch), which rows then record.
    """

    def start(self, env: LabEnv, seed: int) -> None:
        """Begin an episode of an environment that has just been reset with this seed.

        Of a policy per step, every one begins in the moment in which its step does.
        """
        ...

    def act(self, observation: Observation) -> Action:
        """Return the next action.

        Raises:
            PolicyUnreachable: If the policy runs elsewhere and cannot be asked.
            Exception: Anything else is a bug, which stops the evaluation.
        """
        ...


PolicyMaker = Callable[[], Policy]
"""Makes a policy in a worker process; can be pickled and hashed."""


class ExpertPolicy:
    """The scripted expert of the task; it looks at the world, not at the observation.

    Args:
        step: The step whose skills it plays, or None for all that the episode is about.
    """

    def __init__(self, step: str | None = None) -> None:
        self._step = step

    def start(self, env: LabEnv, seed: int) -> None:
        """Begin with the first skill."""
        steps = {step.name: step.skills for step in env.workcell.task.steps}
        self._expert = env.workcell.expert(None if self._step is None else steps[self._step])
        self._expert.start()

    def act(self, observation: Observation) -> Action:
        """Return the expert's next action."""
        return self._expert.act()

    @property
    def failure(self) -> str | None:
        """The phase that it could not finish in this episode, or None."""
        return self._expert.failure


@dataclass(frozen=True)
class ExpertOfStep:
    """Makes the expert of one step, which knows nothing of the others.

    Attributes:
        step: Name of the step.
    """

    step: str

    def __call__(self) -> ExpertPolicy:
        """Make the policy."""
        return ExpertPolicy(self.step)


class StillPolicy:
    """Repeats the command that is in force after the reset."""

    def start(self, env: LabEnv, seed: int) -> None:
        """Remember the command in force."""
        self._command = env.workcell.simulation.command.astype(np.float32)

    def act(self, observation: Observation) -> Action:
        """Return that command."""
        return self._command.copy()


class RandomPolicy:
    """Wanders over the whole action box, each element at its greatest speed.

    Each element heads for a target that is uniform over its range, and draws the next on arrival:
    the random waypoint model (Johnson and Maltz 1996), one element at a time. A walk of independent
    steps would hardly leave the start in the time of an episode.
    """

    def start(self, env: LabEnv, seed: int) -> None:
        """Begin at the command in force, with a generator of this episode's own."""
        self._rng = np.random.default_rng(seed)
        robot = load_robot(env.setting.robot)
        self._low, self._high = np.array(robot.lower), np.array(robot.upper)
        self._reach = np.array(robot.speed) / CONTROL_HZ
        self._command = env.workcell.simulation.command.copy()
        self._target = self._rng.uniform(self._low, self._high)

    def act(self, observation: Observation) -> Action:
        """Return the next action on the way."""
        change = np.clip(self._target - self._command, -self._reach, self._reach)
        self._command = self._command + change
        arrived = self._command == self._target
        fresh = self._rng.uniform(self._low, self._high)
        self._target = np.where(arrived, fresh, self._target)
        return self._command.astype(np.float32)


REFERENCE_POLICIES: dict[str, PolicyMaker] = {
    EXPERT: ExpertPolicy,
    RANDOM: RandomPolicy,
    STILL: StillPolicy,
}


def reference_of_step(policy: str, step: str) -> PolicyMaker:
    """Return what makes a reference policy for one step; all but the expert are as ever."""
    return ExpertOfStep(step) if policy == EXPERT else REFERENCE_POLICIES[policy]


@dataclass(frozen=True)
class StagedPolicyMaker:
    """Makes a policy per step.

    Attributes:
        makers: Pairs of a step and what makes its policy, in the order of the steps.
    """

    makers: tuple[tuple[str, PolicyMaker], ...]

    def __call__(self) -> Policy:
        """Make them all."""
        return StagedPolicy({step: make() for step, make in self.makers})


class StagedPolicy:
    """Lets the policy of the present step play.

    Args:
        policies: Step -> its policy.
    """

    def __init__(self, policies: Mapping[str, Policy]) -> None:
        self._policies = policies

    def start(self, env: LabEnv, seed: int) -> None:
        """Begin an episode, with the policy of its first step."""
        self._env, self._seed = env, seed
        self._step: str | None = None

    def act(self, observation: Observation) -> Action:
        """Return the next action, of another policy than before where a step has been done.

        Raises:
            Exception: Whatever that policy raises.
        """
        step = self._env.workcell.progress.step
        if step is not None and step.name != self._step:
            self._step = step.name
            self._playing = self._policies[step.name]
            self._playing.start(self._env, self._seed)
        return self._playing.act(observation)

    @property
    def failure(self) -> str | None:
        """Reason why the policy could not act, or None."""
        failure: str | None = getattr(self._playing, "failure", None)
        return failure

    @property
    def device(self) -> str | None:
        """Device of torch that the policies run on, or None."""
        device: str | None = getattr(self._playing, "device", None)
        return device


@dataclass(frozen=True)
class RecordedActions:
    """Makes a policy that plays actions again, whatever it observes.

    Attributes:
        content: The actions, as float32 one after the other.
        elements: Numbers of an action.
    """

    content: bytes
    elements: int

    def __call__(self) -> "RecordedPolicy":
        """Make the policy."""
        actions = np.frombuffer(self.content, np.dtype("<f4")).reshape(-1, self.elements)
        return RecordedPolicy(actions)


class RecordedPolicy:
    """Plays actions again, and is not there any more when they are all played.

    Args:
        actions: Shape (steps, elements).
    """

    def __init__(self, actions: NDArray[np.float32]) -> None:
        self._actions = actions

    def start(self, env: LabEnv, seed: int) -> None:
        """Begin with the first action."""
        self._left = iter(self._actions)

    def act(self, observation: Observation) -> Action:
        """Return the next action.

        Raises:
            PolicyUnreachable: If there is none left.
        """
        action: Action | None = next(self._left, None)
        if action is None:
            raise PolicyUnreachable("all stored actions are played")
        return action.copy()
