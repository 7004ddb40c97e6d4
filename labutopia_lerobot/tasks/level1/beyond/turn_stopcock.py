"""Turn stopcock: let a burette run into a flask, and shut it in time (beyond the paper)."""

import math

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.handling.burette_stand import BuretteStand
from labutopia_lerobot.layout import Inside, OnBench
from labutopia_lerobot.predicates import (
    Transfer,
    closed,
    fingers_clear_of,
    given,
    opened,
    received,
    spilled,
    struck,
)
from labutopia_lerobot.scenes.views import BURETTE_VIEW
from labutopia_lerobot.skills import RunOut
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Step, Substep, Task

LEAST_ML, MOST_ML = 5.0, 10.0
"""How much may run; ours: a stopcock that is open lets 1.5 ml through in a second."""


def turn_stopcock() -> Task:
    """Return the task."""
    stand, flask = BuretteStand("stand"), glassware("erlenmeyer_narrow", "100 ml", "flask")
    burette, wing = stand.burette, stand.stopcock
    enough = received(burette, flask, low_ml=LEAST_ML, high_ml=MOST_ML)
    clear = fingers_clear_of(wing, by=0.05)  # as of a knob
    return Task(
        instruction="Open the burette, let 5 to 10 ml run into the flask, and shut it again.",
        paraphrases=(
            "Turn the stopcock of the burette until 5 to 10 ml have run out, then turn it back.",
            "Run between 5 and 10 ml from the burette into the flask; close the stopcock and let "
            "go of it.",
        ),
        start={
            # The wing faces the robot.
            stand: OnBench((0.28, 0.36), (-0.12, 0.06), (-math.radians(145), -math.radians(125))),
            flask: Inside(stand, at=stand.under.at),
        },
        steps=(
            Step(
                "run",
                (RunOut(wing, burette.processes[0], ml=0.5 * (LEAST_ML + MOST_ML)),),
                (
                    Substep("opened", (opened(wing, to=math.radians(30)),)),
                    Substep("run", (enough,)),
                    Substep("shut", (closed(wing), enough)),
                    Substep("released", (closed(wing), clear)),
                ),
                (wing,),
                transfers=(Transfer(burette, flask),),
            ),
        ),
        goal=(enough, closed(wing), clear),
        contents={burette: Filling(ml=40)},
        never={
            "overshot": given(burette, flask, more_than_ml=MOST_ML),
            "spilled": spilled(burette, share=0.0),
            "struck": struck(flask, but_for=frozenset({stand.name})),
        },
        needs_liquid=True,
        time_limit_s=40.0,  # ours
        view=BURETTE_VIEW,
    )
