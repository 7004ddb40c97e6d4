"""Centrifuge pair: two tubes into opposite bores, spin them, and put both back (beyond the paper).

The centrifuge starts with a shut lid only, trips where one tube has nothing opposite, and locks its
lid while it turns. Its latch, pressed at a standstill, lets the lid spring open.
"""

from labutopia_lerobot.predicates import faster, steady, withdrawn
from labutopia_lerobot.scenes.views import TUBES_VIEW
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import failures
from labutopia_lerobot.tasks.centrifuging import CentrifugeBench

_ML = 8.0
"""Water in each tube [ml]; ours: half of what it holds."""
_SLAMMED = 2.0
"""Speed of the lid that is not smooth [rad/s]; ours: its spring lifts it at 1.2 rad/s."""


def centrifuge_pair() -> Task:
    """Return the task."""
    bench = CentrifugeBench()
    tubes = bench.tubes
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
        start=bench.start,
        steps=(
            *bench.load(),
            bench.shut(),
            bench.spin(),
            bench.stop(),
            bench.open(),
            *bench.unload(),
        ),
        goal=(
            *bench.racked,
            *bench.free,
            *(withdrawn(tube, by=0.05) for tube in tubes),
            *(steady(tube, below=0.02) for tube in tubes),
        ),
        contents={tube: Filling(ml=_ML) for tube in tubes},
        never={
            "slammed": faster(bench.centrifuge.lid, than=_SLAMMED),
            **failures.of_any(*(failures.handling(tube, spill=0.02) for tube in tubes)),
        },
        time_limit_s=180.0,  # ours
        view=TUBES_VIEW,
    )
