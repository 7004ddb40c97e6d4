"""Fetch reagent: a bottle out of a cupboard with a door, to the plate on another bench.

Beyond the paper: its "Open Door" and "transport container between areas" in one.
"""

from dataclasses import replace

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.storage.reagent_cupboard import ReagentCupboard
from labutopia_lerobot.labware.instruments.target_plate import TargetPlate
from labutopia_lerobot.layout import Inside, OnDeepBench, OnSomeBench
from labutopia_lerobot.places import OnShelf, OnTop, OverBench
from labutopia_lerobot.predicates import gripped, halted, near, touching
from labutopia_lerobot.scenes.views import DRIVING_VIEW
from labutopia_lerobot.skills import BackOff, Carry, Face, Pick
from labutopia_lerobot.task import Step, Substep, Task
from labutopia_lerobot.tasks import actions, driving, failures
from labutopia_lerobot.tasks.level1.open_door import HASTY
from labutopia_lerobot.tasks.level4.drying_beakers import YAW, open_wide

PLACE = (-0.10, -0.13)  # ours: on the shelf, as in drying_beakers in the right half
OUT = OverBench("before the cupboard", ahead=0.45, left=-0.02, height=0.42)


def fetch_reagent() -> Task:
    """Return the task."""
    bottle = glassware("reagent_bottle_amber", "100 ml", "bottle")
    cupboard, plate = ReagentCupboard("cupboard"), TargetPlate("target_plate")
    door, within = cupboard.door, 0.04  # as in transport_between_areas
    swing = open_wide(door)
    swing = replace(swing, skills=(BackOff(to_open=True), *swing.skills))
    on_shelf = OnShelf("place on the shelf", cupboard.shelf, *PLACE)
    out = BackOff(bottle, past=door)
    held, height = gripped(bottle), cupboard.shelf_height
    take = Step(
        "take",
        (
            BackOff(),  # the hand gets round the open door
            Face(cupboard),
            Pick(bottle, lift=0.05, support=None, hover=0.02),
            Carry(bottle, (OUT,)),
        ),
        (
            Substep("gripped", (held,)),
            # Ours: the box is 0.4 m deep.
            Substep("out", (held, ~near(bottle, on_shelf, within=0.30))),
        ),
        (bottle,),
    )
    return Task(
        instruction=(
            "Drive to the cupboard, face it, open its door wide, take the brown bottle from the "
            "shelf, carry it to the target plate, face the plate, and set the bottle down on it."
        ),
        paraphrases=(
            "Facing the cupboard, open it wide and fetch the bottle out of it; then, facing the "
            "white plate on the other bench, stand it there.",
            "Turn to the cupboard, get the brown reagent bottle from behind its door, which is to "
            "stand wide open, bring it across the laboratory, turn to the plate and set it down.",
        ),
        start={
            cupboard: OnDeepBench(ahead=(0.865, 0.890), left=(0.045, 0.085), yaw=(-YAW, YAW)),
            bottle: Inside(cupboard, (*PLACE, height)),
            plate: OnSomeBench(),
        },
        drives=True,
        steps=(
            driving.navigate(cupboard).named("1_navigate"),
            driving.face(cupboard).named("2_face"),
            driving.docked(swing, cupboard).named("3_open"),
            take.named("4_take"),
            driving.navigate(plate, carrying=bottle, first=out).named("5_navigate"),
            driving.face(plate, carrying=bottle).named("6_face"),
            driving.place(bottle, OnTop(plate), at=plate, within=within).named("7_place"),
        ),
        goal=(
            *actions.left_standing(bottle, OnTop(plate), within=within),
            halted(than=driving.HALTED),
        ),
        never={
            **failures.handling(bottle, spill=None),
            **failures.slamming(door, faster_than=HASTY),
            **driving.collisions(bottle, cupboard.shelf, plate),
            "struck": touching(bottle, cupboard, door, door.handle),
        },
        time_limit_s=240.0,  # ours: three times what the expert needs in the largest rooms
        view=DRIVING_VIEW,
    )
