"""Attacks on pipettes, and odd ways to work them that are right."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import chain

import pytest

from attacks.arm import Actions, Arm
from attacks.plays import SEEDS, UNFINISHED, Play, begun, outcome, skilled, skilled_until, slow
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.skills import Aspirate, Dispense
from labutopia_lerobot.skills.pipette_in_hand import Held, bodies
from labutopia_lerobot.skills.skill import Phase, arrived
from labutopia_lerobot.world import World

SHAKEN_OFF = {"broken", "spilled", "displaced", "struck", *UNFINISHED}


def drawing(env: LabEnv) -> Aspirate:
    """Return the skill that draws up."""
    (skill,) = (skill for skill in env.workcell.task.skills if isinstance(skill, Aspirate))
    return skill


def giving(env: LabEnv) -> Dispense:
    """Return the skill that gives out."""
    (skill,) = (skill for skill in env.workcell.task.skills if isinstance(skill, Dispense))
    return skill


def beyond_the_first_stop(env: LabEnv) -> Actions:
    """Press to the second stop before it is dipped: 1.5 ml."""
    yield from skilled(env, replace(drawing(env), further=0.49))


def too_little(env: LabEnv) -> Actions:
    """Press by nine tenths."""
    yield from skilled(env, replace(drawing(env), further=-0.1))


def above_the_liquid(env: LabEnv) -> Actions:
    """Do all of it in the air of the beaker."""
    yield from skilled(env, replace(drawing(env), gap=0.030))


def stay_in_the_beaker(env: LabEnv) -> Actions:
    """Draw up, and leave the tip where it is."""
    yield from skilled_until(env, "aspirate/lift out", drawing(env))


def let_go_of_it(env: LabEnv) -> Actions:
    """Draw up, lift out, and open the hand."""
    yield from skilled_until(env, "aspirate/hold", drawing(env))
    yield from Arm(env).stay(1.0, 0.08)


def back_into_the_source(env: LabEnv) -> Actions:
    """Give it back to where it came from."""
    source = next(piece for piece in env.workcell.task.start if piece.name == "source")
    yield from skilled(env, replace(giving(env), vessel=source))


def onto_the_bench(env: LabEnv) -> Actions:
    """Press where the hand is, over no vessel."""
    yield from chain(Arm(env).go(Arm(env).pose.moved(x=-0.06)), Arm(env).stay(1.0, 0.034))


def only_wet_the_tip(env: LabEnv) -> Actions:
    """Lower it into the empty beaker, and lift it again."""
    yield from skilled_until(env, "dispense/press", giving(env))
    yield from Arm(env).go(Arm(env).pose.moved(z=0.08))


@dataclass(frozen=True)
class PressInTheLiquid:
    """Press with the tip in the liquid, which blows bubbles, and release."""

    skill: Aspirate

    def phases(self, world: World) -> Iterator[Phase]:
        pipette, vessel = self.skill.pipette, self.skill.vessel
        held = Held(pipette, bodies(pipette) | {vessel.name})
        deep = held.tip_over(world, vessel, self.skill.gap - vessel.height)
        over, there = held.tip_over(world, vessel, 0.04), arrived(within=0.004)
        shut = world.commanded_opening
        yield Phase("over", over, shut, there, held.touches, pipette)
        yield Phase("dip", deep, shut, there, held.touches, pipette, speed=0.06)
        yield from held.press(world, "press", deep, 1.005 * pipette.stroke)
        yield from held.release(world, deep)
        rest = world.commanded_opening
        yield Phase("wait", deep, rest, lambda *when: when[2] > 0.8, held.touches, pipette)
        yield Phase("out", over, rest, there, held.touches, pipette, speed=0.06)


def press_in_the_liquid(env: LabEnv) -> Actions:
    yield from skilled(env, PressInTheLiquid(drawing(env)))


def close_over_the_beaker(env: LabEnv) -> Actions:
    """Give it out from above the mouth."""
    yield from skilled(env, replace(giving(env), depth=-0.01))


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize(
    ("task", "play", "outcomes"),
    [
        ("level1/aspirate", beyond_the_first_stop, UNFINISHED),
        slow("level1/aspirate", too_little, UNFINISHED),
        slow("level1/aspirate", above_the_liquid, UNFINISHED),
        slow("level1/aspirate", stay_in_the_beaker, UNFINISHED),
        slow("level1/aspirate", let_go_of_it, SHAKEN_OFF),
        slow("level1/dispense", back_into_the_source, UNFINISHED),
        ("level1/dispense", onto_the_bench, {"spilled"}),
        slow("level1/dispense", only_wet_the_tip, UNFINISHED),
    ],
    ids=lambda value: getattr(value, "__name__", None),
)
def test_none_of_it_counts(task: str, play: Play, outcomes: set[str], seed: int):
    assert outcome(begun(task, "on"), play, seed)["outcome"] in outcomes


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize(
    ("task", "play"),
    [
        slow("level1/aspirate", press_in_the_liquid),
        slow("level1/dispense", close_over_the_beaker),
    ],
    ids=lambda value: getattr(value, "__name__", None),
)
def test_it_counts_though_it_looks_odd(task: str, play: Play, seed: int):
    assert outcome(begun(task, "on"), play, seed)["outcome"] == "success"
