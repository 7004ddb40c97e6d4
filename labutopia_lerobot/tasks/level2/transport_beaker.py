"""Transport beaker: pick a beaker up and set it down on a plate (paper, level 2).

Ported from: config/level2_TransportBeaker.yaml, tasks/place_task.py,
controllers/pickplace_controller.py.
"""

from labutopia_lerobot.labware.glassware import beaker
from labutopia_lerobot.labware.target_plate import TargetPlate
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.places import OnTop
from labutopia_lerobot.predicates import (
    falling,
    gripped,
    knocked_over,
    lifted,
    near,
    released,
    spilled,
    standing_on,
    steady,
    struck,
    withdrawn,
)
from labutopia_lerobot.skills.pick import Pick
from labutopia_lerobot.skills.place import Place
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Substep, Task
from labutopia_lerobot.views import WIDE_VESSEL_VIEW


def transport_beaker() -> Task:
    """Return the task."""
    vessel, plate = beaker("beaker"), TargetPlate("target_plate")
    target = OnTop(plate)
    at_target = near(vessel, target, within=0.04)  # original: 0.05, where the base overhangs
    high = lifted(vessel, by=0.20)  # paper: "exceeding 20 cm"
    return Task(
        instruction="Move the beaker onto the target plate.",
        paraphrases=(
            "Pick up the beaker and set it down on the white plate.",
            "Carry the beaker over to the plate and leave it standing there.",
        ),
        # Original: the same ranges (the plate's 3 cm less in x), the paper's 15 cm x 15 cm.
        start={
            vessel: OnBench(x=(0.19, 0.34), y=(0.10, 0.25)),
            plate: OnBench(x=(0.18, 0.33), y=(-0.33, -0.18)),
        },
        expert=(Pick(vessel, lift=0.25), Place(vessel, on=target)),
        substeps=(
            Substep("gripped", (gripped(vessel),)),
            Substep("lifted", (gripped(vessel), high)),
            Substep("carried", (at_target, gripped(vessel))),
            Substep("placed", (at_target, standing_on(vessel, target))),
            Substep("released", (released(vessel),)),
        ),
        goal=(
            at_target,
            standing_on(vessel, target),  # paper: "remain upright"
            released(vessel),
            withdrawn(vessel, by=0.05),  # original: gripper 0.05 m away
            steady(vessel, below=0.02),  # paper: "stable"; ours: at rest
        ),
        contents={vessel: Filling(ml=100)},  # ours: a good third of what it holds
        never={
            "knocked_over": knocked_over(vessel, beyond_deg=30),
            "spilled": spilled(vessel, share=0.01),  # ours, as in Shake
            "dropped": falling(vessel, faster_than=0.5),  # free fall over 13 mm
            "collided": struck(plate, but_for=frozenset({vessel.name})),
        },
        time_limit_s=2000 / 60,  # original: 2000 steps at 60 Hz
        view=WIDE_VESSEL_VIEW,
    )
