"""Shake: tilt a beaker that is in the hand left and right, three times (paper, level 1, "Shake").

Ported from: config/level1_shake.yaml, tasks/shake_task.py, controllers/shake_controller.py.
"""

from labutopia_lerobot.labware.glassware import beaker
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.places import OverBench
from labutopia_lerobot.predicates import (
    falling,
    gripped,
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


def shake() -> Task:
    """Return the task."""
    vessel = beaker("beaker", "150 ml")
    # Original: (0.25, 0, 1.0) in the world. The paper's "initial position above the workspace".
    start = OverBench("middle of the workspace", ahead=0.65, height=0.25)
    left = tilted_left(vessel, beyond_deg=15)  # ours: the paper has no number
    right = tilted_right(vessel, beyond_deg=15)
    in_hand = (gripped(vessel), lifted(vessel, by=0.05))  # original: z > z0 + 0.05
    at_start = (
        near(vessel, start, within=0.05),
        lifted(vessel, by=0.20),
        upright(vessel, within_deg=5),  # ours: a third of a tilt
    )
    return Task(
        instruction="Shake the beaker in the gripper from side to side three times.",
        paraphrases=(
            "Tip the beaker you are holding left and right three times, then hold it upright.",
            "Tilt the beaker to the left and to the right, three times, to mix what is in it.",
        ),
        # Original: the same range, which is the paper's 15 cm x 15 cm.
        start={vessel: OnBench(x=(0.19, 0.34), y=(-0.075, 0.075))},
        prelude=(Pick(vessel, lift=0.25),),
        expert=(Shake(vessel, at=start),),
        substeps=(
            Substep("at_start", at_start),
            Substep("shaken", in_hand, via=(left, right) * 3, keeping=in_hand),
            Substep("returned", at_start),
        ),
        goal=(
            *at_start,
            gripped(vessel),
            steady(vessel, below=0.02),  # paper: "maintaining stability"; ours: at rest
        ),
        contents={vessel: Filling(ml=60)},  # ours: half of what it holds
        never={
            "spilled": spilled(vessel, share=0.01),  # paper: "without spilling"; the number is ours
            "dropped": falling(vessel, faster_than=0.5),  # free fall over 13 mm
        },
        time_limit_s=2000 / 60,  # original: 2000 steps at 60 Hz
    )
