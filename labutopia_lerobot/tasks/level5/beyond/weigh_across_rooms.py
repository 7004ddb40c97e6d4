"""Weigh across rooms: fetch a beaker and weigh it on the balance on another bench.

Beyond the paper: its "transport container between areas", to where something is read.
"""

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.weighing.precision_balance import PrecisionBalance
from labutopia_lerobot.layout import OnSomeBench
from labutopia_lerobot.predicates import halted, reads, settled
from labutopia_lerobot.scenes.views import DRIVING_VIEW
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import actions, driving, failures


def weigh_across_rooms() -> Task:
    """Return the task."""
    beaker, balance = glassware("beaker", "250 ml"), PrecisionBalance("balance")
    pan, grams = balance.pan.place, 1e3 * beaker.mass
    within = 0.05  # as in level 2, "Weigh Beaker"
    return Task(
        instruction=(
            "Drive to the beaker, face it, pick it up, carry it to the balance on the other bench, "
            "face the balance, and weigh the beaker: set it on the pan and let go."
        ),
        paraphrases=(
            "Fetch the beaker, drive to the balance with it and find out what it weighs; face "
            "what you take, and the balance as you come to it.",
            "Turn to the beaker, bring it across the laboratory, turn to the balance, and stand it "
            "on the pan until the reading settles.",
        ),
        start={beaker: OnSomeBench(), balance: OnSomeBench(instrument=True)},
        drives=True,
        steps=(
            driving.navigate(beaker).named("1_navigate"),
            driving.face(beaker).named("2_face"),
            driving.pick(beaker).named("3_pick"),
            driving.navigate(balance, carrying=beaker).named("4_navigate"),
            driving.face(balance, carrying=beaker).named("5_face"),
            driving.place(beaker, pan, at=balance, within=within).named("6_weigh"),
        ),
        goal=(
            # Ours, as in level 2: five times what such a balance trembles by.
            reads(balance.weighing, low=grams - 0.05, high=grams + 0.05),
            settled(balance.weighing),
            *actions.left_standing(beaker, pan, within=within),
            halted(than=driving.HALTED),
        ),
        never={
            **failures.handling(beaker, spill=None),
            **driving.collisions(beaker, balance.pan),
        },
        time_limit_s=200.0,  # ours: three times what the expert needs in the largest rooms
        view=DRIVING_VIEW,
    )
