"""Heat beaker: set a beaker on a hot plate and switch it on (paper, level 2, "Heater Beaker").

Ported from: config/level2_HeatLiquid.yaml, tasks/placepress_task.py,
controllers/placepress_controller.py.
"""

import math

from labutopia_lerobot.labware.glassware import beaker
from labutopia_lerobot.labware.heater import Heater
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.places import OnTop
from labutopia_lerobot.predicates import (
    collided,
    falling,
    fingered,
    fingers_clear_of,
    gripped,
    knocked_over,
    lifted,
    near,
    pressed,
    pushed,
    released,
    spilled,
    standing_on,
    steady,
    switched_on,
)
from labutopia_lerobot.skills.pick import Pick
from labutopia_lerobot.skills.place import Place
from labutopia_lerobot.skills.press import Press
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Substep, Task
from labutopia_lerobot.views import WIDE_VESSEL_VIEW


def heat_beaker() -> Task:
    """Return the task."""
    vessel, heater = beaker("beaker", "150 ml"), Heater("heater")
    plate, button = OnTop(heater), heater.button
    on_plate = near(vessel, plate, within=0.05)  # original; further out the base would overhang
    standing = standing_on(vessel, plate)  # paper: "remain upright"
    return Task(
        instruction="Put the beaker on the hot plate and switch the heating on.",
        paraphrases=(
            "Place the beaker on the heater, then press its button.",
            "Heat the beaker: set it on the hot plate and turn that on with the button.",
        ),
        start={
            # Original: these x and y for both, which are the paper's 15 cm x 15 cm; no yaw.
            vessel: OnBench(x=(0.13, 0.28), y=(0.05, 0.20)),
            heater: OnBench((0.13, 0.28), (-0.30, -0.15), (-math.radians(10), math.radians(10))),
        },
        expert=(Pick(vessel, lift=0.25), Place(vessel, on=plate), Press(button, hold=0.3)),
        substeps=(
            Substep("gripped", (gripped(vessel),)),
            Substep("lifted", (gripped(vessel), lifted(vessel, by=0.20))),  # paper: "20 cm"
            Substep("placed", (on_plate, standing, released(vessel))),
            # Paper: "with sufficient force over a specified distance"; ours: 2 N until it clicks.
            Substep("pressed", (fingered(button), pressed(button), pushed(button, with_force=2.0))),
        ),
        goal=(
            switched_on(heater.switch),  # paper: "activate the heating process"
            on_plate,
            standing,
            released(vessel),
            steady(vessel, below=0.02),  # ours: at rest
            fingers_clear_of(button, by=0.05),  # ours: the finger is gone
        ),
        contents={vessel: Filling(ml=60)},  # ours: half of what it holds
        never={
            "knocked_over": knocked_over(vessel, beyond_deg=30),
            "spilled": spilled(vessel, share=0.01),  # paper: "without spilling"; the number is ours
            "dropped": falling(vessel, faster_than=0.5),  # free fall over 13 mm
            "collided": collided(heater, sparing=button),
        },
        time_limit_s=2500 / 60,  # original: 2500 steps at 60 Hz
        view=WIDE_VESSEL_VIEW,
    )
