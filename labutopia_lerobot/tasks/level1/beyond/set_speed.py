"""Set speed: turn a stirrer's knob until it runs at the speed that is asked for (beyond the paper).

None of the paper's tasks reads an instrument.
"""

import math

from labutopia_lerobot.labware.instruments.mixing.overhead_stirrer import OverheadStirrer
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.predicates import fingers_clear_of, reads
from labutopia_lerobot.scenario import Draw
from labutopia_lerobot.scenes.views import KNOB_VIEW
from labutopia_lerobot.skills import TurnKnob
from labutopia_lerobot.task import Step, Substep, Task

_WITHIN = 50.0
"""How far the speed may be off [rpm]; ours: 7.5 degrees of the knob."""
_TRAIN, _TEST = (600, 400, 800, 1000), (500, 700, 900)
"""Speeds that are asked for [rpm]; ours: within reach of one or two grips."""
YAW = (-math.radians(40), -math.radians(20))
"""How the stirrer is turned [rad]; ours. Its front looks to the robot's left: of a hand that points
straight ahead joint 5 is at its end, of one that points to the right no joint comes near its."""


def set_speed(draw: Draw) -> Task:
    """Return the task that an episode has drawn."""
    rpm = draw.choice("speed", train=_TRAIN, test=_TEST, shifted=True)
    stirrer = OverheadStirrer("stirrer")
    knob = stirrer.speed
    low, high = rpm - _WITHIN, rpm + _WITHIN
    clear = fingers_clear_of(knob, by=0.05)
    return Task(
        instruction=f"Turn the knob of the stirrer until it turns at {rpm} rpm, and let go of it.",
        paraphrases=(
            f"Set the overhead stirrer to {rpm} revolutions per minute and take your hand away.",
            f"Make the display of the stirrer read {rpm} rpm by its knob, then leave it.",
        ),
        start={
            stirrer: OnBench((0.50, 0.58), (0.02, 0.14), YAW),
        },
        steps=(
            Step(
                "turn",
                (TurnKnob(knob, to=rpm / 2000.0 * knob.widest),),
                (
                    Substep("set", (reads(stirrer.scale, low=low, high=high),)),
                    Substep("released", (clear,)),
                    Substep("running", (reads(stirrer.drive, low=low, high=high),)),
                ),
                (knob,),
            ),
        ),
        goal=(reads(stirrer.drive, low=low, high=high), clear),
        never={},
        time_limit_s=35.0,  # ours: twice the longest of the expert, 17 s in 15 episodes
        view=KNOB_VIEW,
    )
