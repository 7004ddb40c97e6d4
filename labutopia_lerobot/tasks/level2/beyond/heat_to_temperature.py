"""Heat to temperature: bring water to a temperature on a hot plate, and take it off in time.

Beyond the paper, whose "Heater Beaker" ends when the hot plate is on.
"""

import math
from dataclasses import replace

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.heater import Heater
from labutopia_lerobot.layout import Inside, OnBench
from labutopia_lerobot.places import OverBench
from labutopia_lerobot.predicates import hotter, temperature_between
from labutopia_lerobot.scenario import Draw
from labutopia_lerobot.scenes.views import WIDE_VESSEL_VIEW
from labutopia_lerobot.skills import WaitUntilDue
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Step, Substep, Task
from labutopia_lerobot.tasks import actions, failures

WITHIN = 2.0
"""How near to the temperature [K]; ours."""
YAW = (-math.radians(10), math.radians(10))  # ours: as far as the button stays within easy reach


def heat_to_temperature(draw: Draw) -> Task:
    """Return the task that an episode has drawn."""
    # Ours: the plate is up to 230 C hot by then, and the beaker not above 50.
    wanted = draw.choice("target", train=(30, 29, 31, 32), test=(28, 33), shifted=True)
    ml = draw.uniform("volume", train=(28.0, 34.0), test=[(24.0, 27.0), (36.0, 40.0)], shifted=True)
    cold = draw.uniform("start", train=(20.0, 23.0), test=[(17.0, 19.5)], shifted=True)
    vessel = glassware("beaker", "150 ml")
    heater = Heater("heater", probe_in=vessel.name)
    aside, within = OverBench("the bench beside", ahead=0.62, left=0.16), 0.20
    low, high = wanted - WITHIN, wanted + WITHIN
    warm = temperature_between(vessel, low_c=low, high_c=high)
    # The hand takes 5 s to the beaker, whose glass, hotter than the water, warms it for 13 s more.
    wait = WaitUntilDue(heater.probe, wanted, ahead_s=16.0, at_most_s=180.0)
    take_off = actions.pick(vessel, by=0.12, lift=0.12, support=heater.name)
    set_down = actions.place(vessel, aside, within=within)
    switchable = (vessel, heater.button)  # it may be switched off at any time
    return Task(
        instruction=(
            f"Switch the hot plate on, heat the water in the beaker to {wanted} degrees, and set "
            "the beaker on the bench."
        ),
        paraphrases=(
            f"Warm the water to {wanted} degrees C on the hot plate, then take it off.",
            f"Turn the heater on and put the beaker on the bench when its water has {wanted} C.",
        ),
        start={
            heater: OnBench((0.20, 0.28), (-0.20, -0.12), YAW),
            vessel: Inside(heater, at=(0.0, 0.0, heater.top_height)),
        },
        steps=(
            actions.press(heater.button, hold=0.3),
            replace(take_off, skills=(wait, *take_off.skills), touches=switchable),
            replace(set_down, touches=switchable),
            Step("rest", (), (Substep("warm", (warm,)),), switchable),
        ),
        goal=(warm, *actions.left_standing(vessel, aside, within=within)),
        contents={vessel: Filling(ml, celsius=cold)},
        never={
            **failures.handling(vessel, spill=0.01),
            **failures.burning(),
            "overheated": hotter(vessel, than_c=high),
        },
        needs_liquid=True,
        time_limit_s=180.0,  # ours: nearly twice the longest of the expert in 20 episodes
        view=WIDE_VESSEL_VIEW,
    )
