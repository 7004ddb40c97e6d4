"""Vortex tube: mix the liquid in a tube by pressing its foot into the cup of a vortex mixer.

Beyond the paper.
"""

import math

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.mixing.vortex_mixer import VortexMixer
from labutopia_lerobot.labware.instruments.support.tube_rack import TubeRack
from labutopia_lerobot.layout import Inside, OnBench
from labutopia_lerobot.predicates import (
    gripped,
    lasted,
    liquid_moving,
    reads,
    released,
    seated,
    steady,
    upright,
    withdrawn,
)
from labutopia_lerobot.scenes.views import WIDE_VESSEL_VIEW
from labutopia_lerobot.skills import Insert, PressInto
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Step, Substep, Task
from labutopia_lerobot.tasks import actions, failures

_RPM, _SLOWEST = 1500.0, 1200.0
"""What the knob of the mixer is set to, and from where on it mixes [rpm]; ours."""
_SECONDS = 3.0
"""How long it is to mix without a break [s]; ours."""
_OPENING = 4
"""Which opening of the rack the tube stands in, of those towards the robot."""


def vortex_tube() -> Task:
    """Return the task."""
    mixer, rack = VortexMixer("mixer", set_to=_RPM), TubeRack("rack")
    tube = glassware("test_tube", "16 x 160 mm", "tube")
    opening = rack.places[_OPENING]
    mixing = (
        gripped(tube),
        seated(tube, mixer.cup, within=0.008),  # ours: half the tube's width
        reads(mixer.drive, low=_SLOWEST, high=3000.0),
        liquid_moving(tube, above=0.08),  # ours: twice what it trembles by at rest
    )
    back = (
        seated(tube, opening, within=0.004),  # ours: what a tube may lean in its opening
        upright(tube, within_deg=6),
        released(tube),
    )
    return Task(
        instruction=(
            "Take the tube from the rack, press its foot into the cup of the vortex mixer for "
            "three seconds and put it back."
        ),
        paraphrases=(
            "Vortex the test tube for 3 s: push it down on the mixer, then return it to the rack.",
            "Mix what is in the tube on the vortex mixer for three seconds; put the tube back.",
        ),
        start={
            mixer: OnBench((0.30, 0.38), (-0.20, -0.10), (-math.radians(15), math.radians(15))),
            rack: OnBench((0.20, 0.30), (0.12, 0.22), (-math.radians(15), math.radians(15))),
            tube: Inside(rack, at=opening.at),
        },
        steps=(
            actions.pick(tube, by=actions.OFF_THE_BENCH, lift=0.16, support=rack.name),
            Step(
                "mix",
                (PressInto(tube, mixer.cup, mixer.drive, _SLOWEST, _SECONDS + 0.5),),
                (
                    Substep("running", mixing[:3]),
                    Substep("mixed", mixing, count=lasted(*mixing, needed=_SECONDS)),
                ),
                (tube, mixer.sprung_cup),
            ),
            Step(
                "place",
                (Insert(tube, opening),),
                (
                    Substep("placed", back[:2]),
                    Substep("released", back),
                    Substep("retracted", (*back, withdrawn(tube, by=0.05))),
                ),
                (tube,),
            ),
        ),
        goal=(*back, withdrawn(tube, by=0.05), steady(tube, below=0.02)),
        contents={tube: Filling(ml=6)},  # ours: a quarter of what it holds
        never=failures.handling(tube, spill=0.02),
        needs_liquid=True,
        time_limit_s=60.0,  # ours
        view=WIDE_VESSEL_VIEW,
    )
