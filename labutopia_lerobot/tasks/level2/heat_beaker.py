"""Heat beaker: set a beaker on a hot plate and switch it on (paper, level 2, "Heater Beaker").

Ported from: config/level2_HeatLiquid.yaml, tasks/placepress_task.py,
controllers/placepress_controller.py.
"""

import math

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.heater import Heater
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.places import OnTop
from labutopia_lerobot.predicates import (
    fingers_clear_of,
    near,
    released,
    standing_on,
    steady,
    switched_on,
)
from labutopia_lerobot.scenes.views import WIDE_VESSEL_VIEW
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import actions, failures

YAW = (-math.radians(10), math.radians(10))  # ours: as far as the button stays within easy reach


def heat_beaker() -> Task:
    """Return the task."""
    return heat_on(Heater("heater"))


def heat_on(heater: Heater) -> Task:
    """Return the task with a heater, which level 3 varies."""
    vessel = glassware("beaker", "150 ml")
    plate, button = OnTop(heater), heater.button
    within = 0.05  # original; further out the base would overhang
    return Task(
        instruction=(
            "Lift the beaker by 20 cm or more, put it on the hot plate and switch the heating on."
        ),
        paraphrases=(
            "Raise the beaker by 20 cm, place it on the heater, then press its button.",
            "Heat the beaker: carry it high, set it on the hot plate and turn that on.",
        ),
        start={
            # Original: these x and y for both, which are the paper's 15 cm x 15 cm; no yaw.
            vessel: OnBench(x=(0.13, 0.28), y=(0.05, 0.20)),
            heater: OnBench((0.13, 0.28), (-0.30, -0.15), YAW),
        },
        steps=(
            actions.pick(vessel),
            actions.place(vessel, plate, within=within),
            actions.press(button, hold=0.3),
        ),
        goal=(
            switched_on(heater.switch),  # paper: "activate the heating process"
            near(vessel, plate, within=within),
            standing_on(vessel, plate),  # paper: "remain upright"
            released(vessel),
            steady(vessel, below=0.02),  # ours: at rest
            fingers_clear_of(button, by=0.05),  # ours: the finger is gone
        ),
        contents={vessel: Filling(ml=60)},  # ours: a good quarter of what it holds
        never=failures.handling(vessel, spill=0.01),
        time_limit_s=2500 / 60,  # original: 2500 steps at 60 Hz
        view=WIDE_VESSEL_VIEW,
    )
