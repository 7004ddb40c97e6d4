"""A phase that cannot be played says which it is, what is wrong and the cure."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from adversary import begun
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.skills.skill import Phase, PhaseError, waited
from labutopia_lerobot.world import World


@dataclass(frozen=True)
class Do:
    """One phase, of which parts may be wrong."""

    parts: dict[str, Any]

    def phases(self, world: World) -> Iterator[Phase]:
        here = world.gripper
        yield Phase(**{"name": "push", "target": lambda w: here, "opening": 0.0, **self.parts})


def begin(env: LabEnv, parts: dict[str, Any]) -> NDArray[np.float32]:
    """Return the first action of an expert that plays the phase."""
    expert = env.workcell.expert((Do(parts),))
    expert.start()
    return expert.act()


@pytest.fixture(scope="module")
def env():
    return begun("level1/pick")


@pytest.mark.parametrize(
    ("parts", "message"),
    [
        ({"target": lambda w: np.zeros(3)}, "do/push: its target returned ndarray, not a Pose"),
        ({"opening": 0.2}, "do/push: its opening is 0.2 m, but the pads are from 0 to 0.08 m"),
        ({"opening": -0.01}, "do/push: its opening is -0.01 m"),
        ({"done": lambda w: True}, r"Phase 'push': its done must be .* of \(world, target, sec"),
        ({"target": np.zeros(3)}, r"Phase 'push': its target must be a function of \(world\)"),
    ],
)
def test_a_wrong_part_of_a_phase_is_named(env, parts, message):
    with pytest.raises(PhaseError, match=message):
        begin(env, {"done": waited(1.0), **parts})


def test_the_same_phase_without_a_mistake_is_played(env):
    assert begin(env, {"done": waited(1.0), "opening": 0.08}).shape == (8,)
