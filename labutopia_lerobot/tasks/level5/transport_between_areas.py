"""Transport container between areas (paper, level 5): drive, pick, drive elsewhere, place.

The paper names the task and says no more; steps, distances, heading and lift are ours.
"""

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.target_plate import TargetPlate
from labutopia_lerobot.layout import OnSomeBench
from labutopia_lerobot.places import OnTop
from labutopia_lerobot.predicates import halted
from labutopia_lerobot.scenes.views import DRIVING_VIEW
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import actions, driving, failures


def transport_between_areas() -> Task:
    """Return the task."""
    beaker, plate = glassware("beaker", "250 ml"), TargetPlate("target_plate")
    within = 0.04  # as in level 2, "Transport Beaker"
    return Task(
        instruction=(
            "Drive to the beaker, face it, pick it up, carry it to the target plate without "
            "spilling, face the plate, and set the beaker down on it."
        ),
        paraphrases=(
            "Fetch the beaker from its bench and stand it on the plate on the other bench; face "
            "what you take, and the plate as you come to it.",
            "Turn to the beaker, bring it across the laboratory, and turn to the white plate to "
            "stand it there; spill nothing on the way.",
        ),
        start={beaker: OnSomeBench(), plate: OnSomeBench()},
        drives=True,
        steps=(
            driving.navigate(beaker).named("1_navigate"),
            driving.face(beaker).named("2_face"),
            driving.pick(beaker).named("3_pick"),
            driving.navigate(plate, carrying=beaker).named("4_navigate"),
            driving.face(plate, carrying=beaker).named("5_face"),
            driving.place(beaker, OnTop(plate), at=plate, within=within).named("6_place"),
        ),
        goal=(
            *actions.left_standing(beaker, OnTop(plate), within=within),
            halted(than=driving.HALTED),
        ),
        contents={beaker: Filling(ml=100)},  # as in level 2: a good third of what it holds
        never={
            **failures.handling(beaker, spill=0.01),  # paper: "no collisions, drops"; level 2's
            **driving.collisions(beaker, plate),
        },
        time_limit_s=200.0,  # ours: three times what the expert needs in the largest rooms
        view=DRIVING_VIEW,
    )
