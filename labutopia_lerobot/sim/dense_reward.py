"""How far an episode has come: what `reward=dense` is the growth of.

It is ours, for reinforcement learning, and not the benchmark's: success is judged without it.

An episode of n substeps has n + 1 stages, the last of which is to hold the goal. Each is worth the
same; within the present one, what counts is how near the world has come to the facts that are
awaited. So rewards of an episode add up to how far it came, 1 at most, and to 1 less what it
began with for a success. Going to and fro earns nothing, as each step back costs what the step
forth gave (potentials: Ng, Harada and Russell, "Policy invariance under reward transformations",
ICML 1999).
"""

import math

from labutopia_lerobot.predicates import Predicate
from labutopia_lerobot.progress import Progress
from labutopia_lerobot.task import SUCCESS
from labutopia_lerobot.world import World

_NEAR = 0.9
"""Part of a stage that nearness is worth; the rest comes when it is done (ours)."""
_SCALES = {"mm": 100.0, "deg": 30.0, "ml": 20.0}
"""Unit -> amount by which a fact is missed that counts as near by 1/e (ours)."""


def advance(progress: Progress, world: World) -> float:
    """Return how far an episode has come, from 0 to 1; only a success has come to 1."""
    if progress.outcome == SUCCESS:
        return 1.0
    latched, stages = progress.done_part
    awaited = progress.awaited
    near = sum(_nearness(fact, world) for fact in awaited) / len(awaited) if awaited else 0.0
    counted = progress.counting
    if counted is not None:  # of what must add up, that is half of the stage
        near = (near + min(progress.counted / counted.needed, 1.0)) / 2
    return (latched + _NEAR * near) / (stages + 1)


def _nearness(fact: Predicate, world: World) -> float:
    """Return how near the world has come to a fact, from 0 to 1."""
    if fact.holds(world):
        return 1.0
    known = fact.nearness(world)
    if known is not None:
        return _NEAR * known
    missed = fact.errors(world)
    if not missed or not all(unit in _SCALES for unit in missed):
        return 0.0
    return _NEAR * math.exp(-sum(abs(amount) / _SCALES[unit] for unit, amount in missed.items()))
