"""Clean beaker: rinse one beaker with what is in another (paper, level 4, "Clean Beaker").

Ported from: config/level4_CleanBeaker.yaml, tasks/cleanbeaker_task.py,
controllers/cleanbeaker_controller.py.
"""

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.places import OverBench, WhereItStood
from labutopia_lerobot.predicates import struck
from labutopia_lerobot.scenes.views import WIDEST_VESSEL_VIEW
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import actions, failures


def clean_beaker() -> Task:
    """Return the task."""
    full, dirty = (
        glassware("beaker", "250 ml", "full_beaker"),
        glassware("beaker", "250 ml", "dirty_beaker"),
    )
    waste = glassware("beaker", "800 ml", "waste_beaker")
    # Paper: "to its original position", "at its initial location"; original: within 0.04 m.
    home, dirty_home, within = WhereItStood(full), WhereItStood(dirty), 0.04
    middle = OverBench("middle of the workspace", ahead=0.65, height=0.25)
    rinsed = 0.70  # ours: of the 80 % that must have arrived before, seven eighths
    return Task(
        instruction=(
            "Rinse the dirty beaker: pour the full beaker into it and put that back, then pick the "
            "dirty beaker up, shake it three times, pour it into the large beaker and put it back."
        ),
        # Original: x 0.20 to 0.25, y 0.20 to 0.25 and -0.10 to -0.05; a fixed third vessel. Ours:
        # the hand that comes to the dirty beaker passes the full one.
        start={
            full: OnBench(x=(0.29, 0.36), y=(0.16, 0.24)),
            dirty: OnBench(x=(0.13, 0.20), y=(-0.11, -0.03)),
            waste: OnBench(x=(0.18, 0.30), y=(-0.36, -0.28)),
        },
        steps=(
            *failures.sparing(
                (dirty,),
                actions.pick(full, by=actions.OFF_THE_BENCH).named("1_pick"),
                actions.pour(full, dirty).named("2_pour"),
                actions.put_back(full, home, within=within).named("3_place"),
            ),
            *failures.sparing(
                (full,),
                actions.pick(dirty, by=actions.OFF_THE_BENCH).named("4_pick"),
                actions.shake(dirty, middle).named("5_shake"),
                actions.pour(dirty, waste, share=rinsed, of=full).named("6_pour"),
                actions.put_back(dirty, dirty_home, within=within).named("7_place"),
            ),
        ),
        goal=(
            *actions.left_standing(full, home, within=within),
            *actions.left_standing(dirty, dirty_home, within=within),
        ),
        contents={full: Filling(ml=80)},  # ours: a quarter of what a beaker holds
        never={
            **failures.of_any(
                failures.handling(full, spill=0.05, into=dirty),
                failures.handling(dirty, spill=0.05, into=waste),
            ),
            "waste_struck": struck(waste),
        },
        time_limit_s=4000 / 60,  # original: 4000 steps at 60 Hz
        view=WIDEST_VESSEL_VIEW,
    )
