"""One policy per step: each plays its own, and the next takes over when that is done.

That it is done, its milestones tell: the judge decides, no clock, as the original's only code for
it has it (version 0, level 4). Behind the last step the last policy plays on until the goal has
held.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from labutopia_lerobot.env import LabEnv, Observation
from labutopia_lerobot.evaluation.policies import Action, Policy, PolicyMaker


@dataclass(frozen=True)
class Staged:
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
        """What the policy that plays could not do, or None."""
        failure: str | None = getattr(self._playing, "failure", None)
        return failure

    @property
    def device(self) -> str | None:
        """Device of torch that the policies run on, or None."""
        device: str | None = getattr(self._playing, "device", None)
        return device
