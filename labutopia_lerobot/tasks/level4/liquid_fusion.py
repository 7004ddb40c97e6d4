"""Liquid fusion: pour three liquids into one vessel and heat them (paper, level 4, Table 5).

The paper has no description of it. Ported from: config/level4_LiquidMixing.yaml,
tasks/LiquidMixing_task.py, controllers/LiquidMixing_controller.py.
"""

import math

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.labware.instruments.heater import Heater
from labutopia_lerobot.layout import Inside, OnBench
from labutopia_lerobot.places import OnTop, WhereItStood
from labutopia_lerobot.predicates import (
    fingers_clear_of,
    near,
    standing_on,
    steady,
    struck,
    switched_on,
)
from labutopia_lerobot.scenes.views import WIDEST_VESSEL_VIEW
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Step, Task
from labutopia_lerobot.tasks import actions, failures

YAW = (-math.radians(10), math.radians(10))  # ours: as heat_beaker


def liquid_fusion() -> Task:
    """Return the task."""
    heater, mixture = Heater("heater"), glassware("beaker", "800 ml", "large_beaker")
    plate = OnTop(heater)
    blue, green, pink = sources = tuple(
        glassware("beaker", "150 ml", f"{color}_beaker") for color in ("blue", "green", "pink")
    )
    within = 0.04  # as clean_beaker, "to its original position"

    def add(vessel: Vessel, first: int) -> tuple[Step, ...]:
        """Return the three steps of one liquid, numbered from `first`."""
        home = WhereItStood(vessel)
        return failures.sparing(
            (other for other in sources if other is not vessel),
            actions.pick(vessel, by=actions.OFF_THE_BENCH).named(f"{first}_pick"),
            actions.pour(vessel, mixture).named(f"{first + 1}_pour"),
            actions.put_back(vessel, home, within=within).named(f"{first + 2}_place"),
        )

    return Task(
        instruction=(
            "Pour the blue, the green and the pink liquid, in this order, into the large beaker on "
            "the hot plate, put each beaker back where it stood, and switch the hot plate on."
        ),
        # Original: always the same places. Ours: a row in which the hand, 0.2 m wide, comes to each
        # beaker from behind on the left and passes the next one.
        start={
            blue: OnBench(x=(0.08, 0.12), y=(-0.14, -0.10)),
            green: OnBench(x=(0.24, 0.28), y=(0.00, 0.04)),
            pink: OnBench(x=(0.32, 0.36), y=(0.23, 0.27)),
            heater: OnBench(x=(0.16, 0.24), y=(-0.42, -0.36), yaw=YAW),
            # Original: "beaker placed on the heating device platform".
            mixture: Inside(heater, (0.0, 0.0, heater.top_height)),
        },
        steps=(
            *add(blue, 1),
            *add(green, 4),
            *add(pink, 7),
            *failures.sparing(sources, actions.press(heater.button, hold=0.3).named("10_press")),
        ),
        goal=(
            switched_on(heater.switch),
            fingers_clear_of(heater.button, by=0.05),  # ours: as heat_beaker
            near(mixture, plate, within=0.05),  # as heat_beaker
            standing_on(mixture, plate),
            steady(mixture, below=0.02),  # ours: at rest
            *(
                fact
                for vessel in sources
                for fact in actions.left_standing(vessel, WhereItStood(vessel), within=within)
            ),
        ),
        contents={  # ours: three that mix in any ratio, a good third of what each beaker holds
            blue: Filling(60, "water"),
            green: Filling(60, "ethanol"),
            pink: Filling(60, "ethylene glycol"),
        },
        never={
            **failures.of_any(
                *(failures.handling(vessel, spill=0.05, into=mixture) for vessel in sources)
            ),
            "mixture_struck": struck(mixture, but_for=frozenset({heater.name})),
        },
        time_limit_s=6000 / 60,  # original: 6000 steps at 60 Hz
        view=WIDEST_VESSEL_VIEW,
    )
