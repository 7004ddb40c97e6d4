"""Open, transport, pour: three jobs in the order that the instruction says (original, level 4).

In the original's code, not in the paper. Ported from: config/level4_OpenTransportPour.yaml,
tasks/opentransportpour_task.py, controllers/opentransportpour_controller.py.
"""

import math
from dataclasses import replace
from itertools import permutations

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.muffle_furnace import MuffleFurnace
from labutopia_lerobot.labware.instruments.target_plate import PORCELAIN, TargetPlate
from labutopia_lerobot.labware.parts.colors import COLORS
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.places import OnTop, OverBench
from labutopia_lerobot.predicates import clear_of, faster, opened, struck
from labutopia_lerobot.scenario import Draw
from labutopia_lerobot.scenes.views import FURNACE_VIEW
from labutopia_lerobot.skills import Go
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import actions, failures
from labutopia_lerobot.tasks.level1.open_door import BEGUN, HASTY

JOBS = {
    "open": "open the door of the muffle furnace",
    "transport": "move the beaker onto the red plate",
    "pour": "pour the flask into the large beaker and set it down on the blue plate",
}
"""Name of an action -> its words in the instruction."""
ORDERS = [", ".join(order) for order in permutations(JOBS)]
OPEN_TO = math.radians(30)  # original


def open_transport_pour(draw: Draw) -> Task:
    """Return the task that an episode has drawn."""
    order = draw.choice("order", train=ORDERS).split(", ")  # original: shuffled
    first, second, third = (JOBS[job] for job in order)
    furnace, vessel, flask = (
        MuffleFurnace("furnace", set_to=None),
        glassware("beaker", "250 ml"),
        glassware("conical_flask", "300 ml", "flask"),
    )
    target, door = glassware("beaker", "800 ml", "large_beaker"), furnace.door
    red = TargetPlate("red_plate", color=PORCELAIN, glaze=COLORS["red"])
    blue = TargetPlate("blue_plate", color=PORCELAIN, glaze=COLORS["blue"])
    plates, within = frozenset({red.name, blue.name}), 0.04  # as transport_beaker
    # Ours: from the handle the elbow would meet the open door on the straight way to the flask.
    back = Go((OverBench("middle of the bench", ahead=0.40, height=0.35),), heading=0.0)
    pick_flask = actions.pick(flask, by=actions.OFF_THE_BENCH).named("pour_pick")
    steps = {
        "open": failures.sparing(
            (vessel, flask),
            actions.open_by_handle(door, to=OPEN_TO, begun=BEGUN, pull=math.radians(33)).named(
                "open"
            ),
            but_for=plates,
        ),
        "transport": failures.sparing(
            (flask,),
            actions.pick(vessel, by=actions.OFF_THE_BENCH).named("transport_pick"),
            actions.place(vessel, OnTop(red), within=within).named("transport_place"),
            but_for=plates,
        ),
        "pour": failures.sparing(
            (vessel,),
            replace(pick_flask, skills=(back, *pick_flask.skills)),
            actions.pour(flask, target).named("pour"),
            # Over the lip of the large beaker.
            actions.place(flask, OnTop(blue), within=within, hover=0.20).named("pour_place"),
            but_for=plates,
        ),
    }
    return Task(
        instruction=f"First {first}, then {second}, and at last {third}.",
        # Original: each within 5 mm of one place. Ours: beaker and red plate on the left, clear of
        # the door that swings towards the robot, what is poured on the right.
        start={
            furnace: OnBench(x=(0.76, 0.80), y=(0.32, 0.36), yaw=(0.0, 0.0)),
            vessel: OnBench(x=(0.00, 0.04), y=(0.36, 0.40)),
            red: OnBench(x=(-0.02, 0.02), y=(0.58, 0.62)),
            flask: OnBench(x=(0.02, 0.06), y=(-0.26, -0.22)),
            target: OnBench(x=(0.18, 0.22), y=(-0.43, -0.39)),
            blue: OnBench(x=(-0.06, -0.02), y=(-0.48, -0.44)),
        },
        steps=tuple(step for job in order for step in steps[job]),
        goal=(
            opened(door, to=OPEN_TO),
            ~faster(door, than=math.radians(2)),  # ours: at rest, as open_door
            clear_of(door.handle, by=0.04),  # as open_door
            *actions.left_standing(vessel, OnTop(red), within=within),
            *actions.left_standing(flask, OnTop(blue), within=within),
        ),
        contents={vessel: Filling(ml=100), flask: Filling(ml=100)},  # ours: a third of each
        never={
            **failures.of_any(
                failures.handling(vessel, spill=0.01),  # as transport_beaker
                failures.handling(flask, spill=0.05, into=target),
            ),
            **failures.slamming(door, faster_than=HASTY),
            "target_struck": struck(target),
            "red_plate_struck": struck(red, but_for=frozenset({vessel.name})),
            "blue_plate_struck": struck(blue, but_for=frozenset({flask.name})),
        },
        time_limit_s=4000 / 60,  # original: 4000 steps at 60 Hz
        view=FURNACE_VIEW,
    )
