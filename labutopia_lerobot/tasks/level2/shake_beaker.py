"""Shake beaker: pick a beaker up and tilt it left and right, three times (paper, level 2).

Ported from: config/level2_ShakeBeaker.yaml, tasks/shake_task.py,
controllers/shakebeaker_controller.py.
"""

from labutopia_lerobot.labware.glassware import beaker
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.places import OverBench
from labutopia_lerobot.predicates import (
    falling,
    gripped,
    knocked_over,
    lifted,
    near,
    spilled,
    steady,
    tilted_left,
    tilted_right,
    upright,
)
from labutopia_lerobot.skills.pick import Pick
from labutopia_lerobot.skills.shake import Shake
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Substep, Task


def shake_beaker() -> Task:
    """Return the task."""
    vessel = beaker("beaker", "150 ml")
    # Original: (0.25, 0, 1.0) in the world. The paper's "initial position above the workspace".
    start = OverBench("middle of the workspace", ahead=0.65, height=0.25)
    left = tilted_left(vessel, beyond_deg=15)  # ours: the paper has no number
    right = tilted_right(vessel, beyond_deg=15)
    in_hand = (gripped(vessel), lifted(vessel, by=0.05))  # original: z > z0 + 0.05
    high = lifted(vessel, by=0.20)  # paper: "exceeding 20 cm"
    at_start = (
        near(vessel, start, within=0.05),
        high,
        upright(vessel, within_deg=5),  # ours: a third of a tilt
    )
    return Task(
        instruction="Pick up the beaker and shake it from side to side three times.",
        paraphrases=(
            "Lift the beaker off the bench, tilt it left and right three times and hold it still.",
            "Take the beaker and mix its contents with three swings to the left and to the right.",
        ),
        # Original: y -0.05 to 0.05; ours the paper's 15 cm x 15 cm.
        start={vessel: OnBench(x=(0.19, 0.34), y=(-0.075, 0.075))},
        expert=(Pick(vessel, lift=0.25), Shake(vessel, at=start)),
        substeps=(
            Substep("gripped", (gripped(vessel),)),
            Substep("lifted", (gripped(vessel), high)),
            Substep("at_start", at_start),
            Substep("shaken", in_hand, via=(left, right) * 3, keeping=in_hand),
            Substep("returned", at_start),
        ),
        goal=(
            *at_start,
            gripped(vessel),
            steady(vessel, below=0.02),  # paper: "stabilized"; ours: at rest
        ),
        contents={vessel: Filling(ml=60)},  # ours: half of what it holds
        never={
            "knocked_over": knocked_over(vessel, beyond_deg=30),
            "spilled": spilled(vessel, share=0.01),  # paper: "without spilling"; the number is ours
            "dropped": falling(vessel, faster_than=0.5),  # free fall over 13 mm
        },
        time_limit_s=2000 / 60,  # original: 2000 steps at 60 Hz
    )
