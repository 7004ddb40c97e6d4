"""Spin centrifuge: shut the lid, start the centrifuge, let it run, and stop it.

Beyond the paper. It does not start with an open lid, and its lid is locked while it turns.
"""

import math

from labutopia_lerobot.labware.instruments.separating.centrifuge import Centrifuge
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.predicates import (
    closed,
    faster,
    fingers_clear_of,
    lasted,
    less_open,
    opened,
    reads,
)
from labutopia_lerobot.scenes.views import CENTRIFUGE_VIEW
from labutopia_lerobot.skills import PushLid, WaitUntilReads
from labutopia_lerobot.task import Step, Substep, Task
from labutopia_lerobot.tasks import actions

_RPM, _WITHIN = 1000.0, 50.0
"""What its speed is set to, and how near it must be [rpm]; ours."""
_SECONDS = 5.0
"""How long it is to run at that speed [s]; ours."""
_OPEN = math.radians(30.0)
"""How far its lid is open [rad]; ours: as far as the default robot reaches over it."""
_SLAMMED = 2.0
"""Speed of the lid that is not smooth [rad/s]; ours: its bolt alone draws it shut at 1.2 rad/s."""


def spin_centrifuge() -> Task:
    """Return the task."""
    centrifuge = Centrifuge("centrifuge", set_to=_RPM, minutes=10.0, lid_open=_OPEN)
    lid, drive = centrifuge.lid, centrifuge.drive
    shut = (closed(lid), reads(centrifuge.lock, low=1.0, high=1.0))
    running = reads(drive, low=_RPM - _WITHIN, high=_RPM + _WITHIN)
    still = reads(drive, low=0.0, high=0.0)
    start, stop = (
        actions.press(button, hold=0.3).named(name)
        for button, name in ((centrifuge.start, "start"), (centrifuge.stop, "stop"))
    )
    return Task(
        instruction=(
            "Shut the lid of the centrifuge, press the green button, let it run at full speed for "
            "five seconds and press the red button."
        ),
        paraphrases=(
            "Close the centrifuge and start it; stop it once it has run at 1000 rpm for 5 s.",
            "Push the lid shut, start with the green button, wait 5 s at speed, stop with the red.",
        ),
        start={
            centrifuge: OnBench((0.28, 0.32), (0.14, 0.22), (-math.radians(35), -math.radians(25)))
        },
        steps=(
            Step(
                "shut",
                (PushLid(lid, centrifuge.lid_thickness),),
                (Substep("shut", shut, (opened(lid, to=0.5 * _OPEN), less_open(lid, than=0.1))),),
                (lid,),
            ),
            Step(
                "spin",
                (
                    *start.skills,
                    WaitUntilReads(drive, _RPM - _WITHIN, _RPM + _WITHIN, _SECONDS + 0.3),
                ),
                (
                    *start.substeps,
                    Substep("at_speed", (*shut, running)),
                    Substep("spun", (*shut, running), count=lasted(running, needed=_SECONDS)),
                ),
                start.touches,
            ),
            Step(
                "stop",
                (*stop.skills, WaitUntilReads(drive, 0.0, 0.0, 0.0)),
                (*stop.substeps, Substep("at_rest", (*shut, still))),
                stop.touches,
            ),
        ),
        goal=(*shut, still, fingers_clear_of(centrifuge.stop, by=0.05)),
        never={"slammed": faster(lid, than=_SLAMMED)},
        time_limit_s=60.0,  # ours
        view=CENTRIFUGE_VIEW,
    )
