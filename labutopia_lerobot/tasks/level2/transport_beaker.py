"""Transport beaker: pick a beaker up and set it down on a plate (paper, level 2).

Ported from: config/level2_TransportBeaker.yaml, tasks/place_task.py,
controllers/pickplace_controller.py.
"""

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.target_plate import TargetPlate
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.places import OnTop
from labutopia_lerobot.predicates import struck
from labutopia_lerobot.scenes.views import WIDE_VESSEL_VIEW
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import actions, failures


def transport_beaker() -> Task:
    """Return the task."""
    return transport_to(TargetPlate("target_plate"))


def transport_to(plate: TargetPlate) -> Task:
    """Return the task with a plate, which level 3 varies."""
    vessel = glassware("beaker", "250 ml")
    within = 0.04  # original: 0.05, where the base overhangs
    return Task(
        instruction="Lift the beaker by 20 cm or more and move it onto the target plate.",
        paraphrases=(
            "Pick up the beaker, raise it by 20 cm and set it down on the white plate.",
            "Carry the beaker, 20 cm above the bench, to the plate and leave it standing there.",
        ),
        # Original: the same ranges (the plate's 3 cm less in x), the paper's 15 cm x 15 cm.
        start={
            vessel: OnBench(x=(0.19, 0.34), y=(0.10, 0.25)),
            plate: OnBench(x=(0.18, 0.33), y=(-0.33, -0.18)),
        },
        steps=(actions.pick(vessel), actions.place(vessel, OnTop(plate), within=within)),
        goal=actions.left_standing(vessel, OnTop(plate), within=within),
        contents={vessel: Filling(ml=100)},  # ours: a good third of what it holds
        never={
            **failures.handling(vessel, spill=0.01),  # ours, as in Shake
            "struck": struck(plate, but_for=frozenset({vessel.name})),
        },
        time_limit_s=2000 / 60,  # original: 2000 steps at 60 Hz
        view=WIDE_VESSEL_VIEW,
    )
