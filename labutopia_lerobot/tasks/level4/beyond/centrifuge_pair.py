"""Centrifuge pair: two tubes into opposite bores, spin them, and put both back (beyond the paper).

The centrifuge starts with a shut lid only, trips where one tube has nothing opposite, and locks its
lid while it turns. Its latch, pressed at a standstill, lets the lid spring open.
"""

import math
from dataclasses import replace

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.separating.clinical_centrifuge import ClinicalCentrifuge
from labutopia_lerobot.labware.instruments.support.tube_rack import TubeRack
from labutopia_lerobot.layout import Inside, OnBench
from labutopia_lerobot.predicates import (
    closed,
    faster,
    gripped,
    held_by,
    lasted,
    lifted,
    opened,
    reads,
    released,
    steady,
    withdrawn,
)
from labutopia_lerobot.scenes.views import TUBES_VIEW
from labutopia_lerobot.skills import Insert, Pick, PushLid, WaitUntil, WaitUntilReads
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Step, Substep, Task
from labutopia_lerobot.tasks import actions, failures
from labutopia_lerobot.world import Approach

_RPM, _WITHIN = 2000.0, 50.0
"""What its speed is set to, and how near it must be [rpm]; ours."""
_SECONDS = 5.0
"""How long both are to be spun at that speed [s]; ours."""
_ML = 8.0
"""Water in each tube [ml]; ours: half of what it holds."""
_SEATED = 0.006
"""How far the foot of a tube may be from where it belongs [m]; ours: a cone leans in its hole."""
_SLAMMED = 2.0
"""Speed of the lid that is not smooth [rad/s]; ours: its spring lifts it at 1.2 rad/s."""
_OVER = Approach(yaw=math.radians(-30.0), pitch=math.radians(75.0))
"""How the hand points over bores and openings; ours: leaning back as the open lid does."""
_BEHIND = Approach(yaw=math.radians(-30.0), pitch=math.radians(90.0))
"""How it points behind the open lid; ours: straight down, so that it clears its edge."""


def centrifuge_pair() -> Task:
    """Return the task."""
    centrifuge = ClinicalCentrifuge("centrifuge", _RPM, minutes=10.0, lid_springs=True)
    wide = centrifuge.lid.widest
    centrifuge = replace(centrifuge, lid_open=wide)
    rack = TubeRack("rack")
    first, second = tubes = [
        glassware("centrifuge_tube", "15 ml", name) for name in ("first", "second")
    ]
    bores = centrifuge.places[2], centrifuge.places[6]  # on the left and on the right
    openings = rack.places[1], rack.places[4]
    lid, drive = centrifuge.lid, centrifuge.drive
    start, stop, latch = (
        actions.press(button, hold=0.3).named(name)
        for button, name in (
            (centrifuge.start, "start"),
            (centrifuge.stop, "stop"),
            (centrifuge.latch, "unlatch"),
        )
    )
    running = reads(drive, low=_RPM - _WITHIN, high=_RPM + _WITHIN)
    still = reads(drive, low=0.0, high=0.0)
    shut = (closed(lid), reads(centrifuge.lock, low=1.0, high=1.0))
    loaded = [held_by(tube, centrifuge, within=_SEATED) for tube in tubes]
    racked = [held_by(tube, rack, within=_SEATED) for tube in tubes]
    free = [released(tube) for tube in tubes]
    spun = (*shut, running, *loaded)
    # Which of the two goes first is nobody's business.
    raised = [gripped(tube) & lifted(tube, by=0.10) for tube in tubes]
    out = [gripped(tube) & ~fact for tube, fact in zip(tubes, loaded, strict=True)]
    one_loaded, one_racked = (
        (facts[0] & free[0]) | (facts[1] & free[1]) for facts in (loaded, racked)
    )

    def load(number: int) -> tuple[Pick, Insert]:
        tube, bore = tubes[number], bores[number]
        into = Insert(tube, bore, hover=0.10, bottom=0.0002, yaw=_OVER.yaw)
        return Pick(tube, 0.26, rack.name, approach=_OVER), into

    def unload(number: int) -> tuple[Pick, Insert]:
        tube, opening = tubes[number], openings[number]
        into = Insert(tube, opening, hover=0.08, bottom=0.0002, yaw=_OVER.yaw)
        return Pick(tube, 0.20, centrifuge.rotor.name, approach=_OVER), into

    return Task(
        instruction=(
            "Put both tubes from the rack into opposite bores of the centrifuge, shut its lid, "
            "spin them at full speed for five seconds, and put them back into the rack."
        ),
        paraphrases=(
            "Centrifuge the pair of tubes for 5 s at 2000 rpm, balanced; then return both to the "
            "rack.",
            "Load the two tubes opposite each other, close and start the centrifuge, stop it after "
            "5 s, open it and rack the tubes again.",
        ),
        start={
            centrifuge: OnBench(
                (0.06, 0.10), (-0.10, -0.06), (-math.radians(40), -math.radians(30))
            ),
            rack: OnBench((0.10, 0.14), (0.28, 0.32), (-math.radians(10), math.radians(10))),
            first: Inside(rack, at=openings[0].at),
            second: Inside(rack, at=openings[1].at),
        },
        steps=(
            Step(
                "load",
                load(0),
                (
                    Substep("lifted", (raised[0] | raised[1],)),
                    Substep("one_loaded", (one_loaded,)),
                ),
                (first, second),
            ),
            Step(
                "load_other",
                load(1),
                (Substep("both_loaded", (*loaded, *free)),),
                (first, second),
            ),
            Step(
                "shut",
                (PushLid(lid, centrifuge.lid_thickness, posture=_BEHIND, finger=0.012),),
                (Substep("shut", (*shut, *loaded)),),
                (lid,),
            ),
            Step(
                "spin",
                (
                    *start.skills,
                    WaitUntilReads(drive, _RPM - _WITHIN, _RPM + _WITHIN, _SECONDS + 0.3),
                ),
                (*start.substeps, Substep("spun", spun, count=lasted(*spun, needed=_SECONDS))),
                start.touches,
            ),
            Step(
                "stop",
                (*stop.skills, WaitUntil(still)),
                (*stop.substeps, Substep("at_rest", (still,))),
                stop.touches,
            ),
            Step(
                "open",
                (*latch.skills, WaitUntil(opened(lid, to=0.9 * wide))),
                (*latch.substeps, Substep("open", (opened(lid, to=0.9 * wide),))),
                latch.touches,
            ),
            Step(
                "unload",
                unload(0),
                (Substep("one_out", (out[0] | out[1],)), Substep("one_racked", (one_racked,))),
                (first, second),
            ),
            Step(
                "unload_other",
                unload(1),
                (Substep("both_racked", (*racked, *free)),),
                (first, second),
            ),
        ),
        goal=(
            *racked,
            *free,
            *(withdrawn(tube, by=0.05) for tube in tubes),
            *(steady(tube, below=0.02) for tube in tubes),
        ),
        contents={tube: Filling(ml=_ML) for tube in tubes},
        never={
            "slammed": faster(lid, than=_SLAMMED),
            **failures.of_any(*(failures.handling(tube, spill=0.02) for tube in tubes)),
        },
        time_limit_s=180.0,  # ours
        view=TUBES_VIEW,
    )
