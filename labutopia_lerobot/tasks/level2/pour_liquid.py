"""Pour liquid: pick a beaker up, pour it into another, set it down (paper, level 2).

Ported from: config/level2_PourLiquid.yaml, tasks/pickpour_task.py,
controllers/pickpour_controller.py.
"""

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.places import WhereItStood
from labutopia_lerobot.predicates import struck, upright
from labutopia_lerobot.scenes.views import WIDE_VESSEL_VIEW
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import actions, failures


def pour_liquid() -> Task:
    """Return the task."""
    return pour_from(glassware("beaker", "250 ml"))


def pour_from(vessel: Vessel) -> Task:
    """Return the task with a vessel, which level 3 varies."""
    target = glassware("beaker", "800 ml", "target_beaker")
    home, within = WhereItStood(vessel), 0.04  # ours: as clean_beaker
    return Task(
        instruction=(
            "Lift the small beaker by 20 cm or more, pour it into the large one and put it back "
            "where it stood."
        ),
        paraphrases=(
            "Raise the beaker by 20 cm, empty it into the big beaker and put it back in its place.",
            "Lift the small beaker high, empty it into the large one, put it back in its place.",
        ),
        # Original: the same ranges, which are the paper's 15 cm x 15 cm.
        start={
            vessel: OnBench(x=(0.22, 0.37), y=(0.0, 0.15)),
            target: OnBench(x=(0.17, 0.32), y=(-0.35, -0.20)),
        },
        steps=(
            actions.pick(vessel, also=(upright(vessel, within_deg=10),)),  # original: 30 deg
            actions.pour(vessel, target),
            actions.put_back(vessel, home, within=within),
        ),
        goal=actions.left_standing(vessel, home, within=within),
        contents={vessel: Filling(ml=100)},  # ours: a good third of what it holds
        never={
            **failures.handling(vessel, spill=0.05, into=target),
            "struck": struck(target),
        },
        # The original's 1000 steps at 60 Hz have no setting down; ours: twice the expert's median.
        time_limit_s=38.0,
        view=WIDE_VESSEL_VIEW,
    )
