"""Pour liquid: pick a beaker up, pour it into another, set it down (paper, level 2).

Ported from: config/level2_PourLiquid.yaml, tasks/pickpour_task.py,
controllers/pickpour_controller.py.
"""

from labutopia_lerobot.labware.glassware import beaker
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.places import OverBench
from labutopia_lerobot.predicates import (
    falling,
    gripped,
    knocked_over,
    lifted,
    lip_over,
    poured,
    released,
    spilled,
    standing_on,
    steady,
    struck,
    upright,
    withdrawn,
)
from labutopia_lerobot.skills.pick import Pick
from labutopia_lerobot.skills.place import Place
from labutopia_lerobot.skills.pour import Pour
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Substep, Task
from labutopia_lerobot.views import WIDE_VESSEL_VIEW


def pour_liquid() -> Task:
    """Return the task."""
    vessel, target = beaker("beaker"), beaker("target_beaker", "800 ml")
    bench = OverBench("middle of the start region", ahead=0.695, left=0.075)
    level = upright(vessel, within_deg=10)  # original: 30 deg
    high = lifted(vessel, by=0.20)  # paper: "exceeding 20 cm"
    return Task(
        instruction="Pour the small beaker into the large one and set it down on the bench.",
        paraphrases=(
            "Pick up the beaker, empty it into the big beaker and put it back on the bench.",
            "Transfer the contents of the 250 ml beaker to the 800 ml beaker, then put it down.",
        ),
        # Original: the same ranges, which are the paper's 15 cm x 15 cm.
        start={
            vessel: OnBench(x=(0.22, 0.37), y=(0.0, 0.15)),
            target: OnBench(x=(0.17, 0.32), y=(-0.35, -0.20)),
        },
        expert=(Pick(vessel, lift=0.25), Pour(vessel, into=target), Place(vessel, on=bench)),
        substeps=(
            Substep("gripped", (gripped(vessel),)),
            Substep("lifted", (gripped(vessel), high, level)),
            # Ours: the volume. Original: a tilt of 50 deg.
            Substep("poured", (poured(vessel, target, share=0.80),)),
            Substep("righted", (gripped(vessel), level)),
            Substep("released", (standing_on(vessel, bench), released(vessel))),
        ),
        goal=(
            standing_on(vessel, bench),  # paper: "returned to an upright state and released"
            released(vessel),
            withdrawn(vessel, by=0.05),  # original, TransportBeaker: gripper 0.05 m away
            steady(vessel, below=0.02),  # paper: "stable"; ours: at rest
        ),
        contents={vessel: Filling(ml=100)},  # ours: a good third of what it holds
        never={
            "knocked_over": knocked_over(vessel, beyond_deg=30),
            "spilled": spilled(vessel, share=0.05, unless=lip_over(vessel, target)),  # ours
            "dropped": falling(vessel, faster_than=0.5),  # free fall over 13 mm
            "collided": struck(target),
        },
        # The original's 1000 steps at 60 Hz have no setting down; ours: twice the expert's median.
        time_limit_s=34.0,
        view=WIDE_VESSEL_VIEW,
    )
