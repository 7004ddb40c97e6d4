"""Centrifuging: a pair of tubes goes into opposite bores, is spun, and comes back."""

import math
from collections.abc import Mapping
from dataclasses import replace

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.separating.clinical_centrifuge import ClinicalCentrifuge
from labutopia_lerobot.labware.instruments.support.tube_rack import TubeRack
from labutopia_lerobot.labware.piece import Piece
from labutopia_lerobot.layout import Inside, OnBench, Start
from labutopia_lerobot.predicates import (
    closed,
    gripped,
    held_by,
    lasted,
    lifted,
    opened,
    reads,
    released,
)
from labutopia_lerobot.skills import Insert, Pick, PushLid, WaitUntil, WaitUntilReads
from labutopia_lerobot.task import Step, Substep
from labutopia_lerobot.tasks import actions
from labutopia_lerobot.world import Approach

_RPM, _WITHIN = 2000.0, 50.0
"""What its speed is set to, and how near it must be [rpm]; ours."""
_SECONDS = 5.0
"""How long both are to be spun at that speed [s]; ours."""
_SEATED = 0.006
"""How far the foot of a tube may be from where it belongs [m]; ours: a cone leans in its hole."""
_OVER = Approach(yaw=math.radians(-30.0), pitch=math.radians(75.0))
"""How the hand points over bores and openings; ours: leaning back as the open lid does."""
_BEHIND = Approach(yaw=math.radians(-30.0), pitch=math.radians(90.0))
"""How it points behind the open lid; ours: straight down, so that it clears its edge."""


class CentrifugeBench:
    """An open centrifuge beside a rack with two tubes. Either of them may go first.

    Attributes:
        centrifuge: The centrifuge; its lid springs open where its lock lets it.
        rack: The rack.
        tubes: The tubes.
        racked: Facts: each of them is back in the rack.
        free: Facts: each of them is let go.
    """

    def __init__(self) -> None:
        shut = ClinicalCentrifuge("centrifuge", _RPM, minutes=10.0, lid_springs=True)
        self.centrifuge = replace(shut, lid_open=shut.lid.widest)
        self.rack = TubeRack("rack")
        self.tubes = tuple(
            glassware("centrifuge_tube", "15 ml", name) for name in ("first", "second")
        )
        self._bores = self.centrifuge.places[2], self.centrifuge.places[6]  # left and right
        self._openings = self.rack.places[1], self.rack.places[4]
        self._loaded = [held_by(tube, self.centrifuge, within=_SEATED) for tube in self.tubes]
        self.racked = [held_by(tube, self.rack, within=_SEATED) for tube in self.tubes]
        self.free = [released(tube) for tube in self.tubes]
        lid = self.centrifuge.lid
        self._shut = (closed(lid), reads(self.centrifuge.lock, low=1.0, high=1.0))

    @property
    def start(self) -> Mapping[Piece, Start]:
        """Where they stand: the hand gets to both bores below the open lid."""
        turned = (-math.radians(40), -math.radians(30))
        first, second = self.tubes
        return {
            self.centrifuge: OnBench((0.06, 0.10), (-0.10, -0.06), turned),
            self.rack: OnBench((0.10, 0.14), (0.28, 0.32), (-math.radians(10), math.radians(10))),
            first: Inside(self.rack, at=self._openings[0].at),
            second: Inside(self.rack, at=self._openings[1].at),
        }

    def load(self) -> tuple[Step, Step]:
        """Put both into opposite bores."""
        loaded, free = self._loaded, self.free
        one, other = (gripped(tube) & lifted(tube, by=0.10) for tube in self.tubes)
        one_loaded = (loaded[0] & free[0]) | (loaded[1] & free[1])
        raised, one_in = Substep("lifted", (one | other,)), Substep("one_loaded", (one_loaded,))
        both = Substep("both_loaded", (*loaded, *free))
        return (
            Step("load", self._moved_in(0), (raised, one_in), self.tubes),
            Step("load_other", self._moved_in(1), (both,), self.tubes),
        )

    def shut(self) -> Step:
        """Push the lid shut."""
        lid, thickness = self.centrifuge.lid, self.centrifuge.lid_thickness
        push = PushLid(lid, thickness, posture=_BEHIND, finger=0.012)
        return Step("shut", (push,), (Substep("shut", (*self._shut, *self._loaded)),), (lid,))

    def spin(self) -> Step:
        """Start it, and let it run at its speed."""
        low, high, drive = _RPM - _WITHIN, _RPM + _WITHIN, self.centrifuge.drive
        start = actions.press(self.centrifuge.start, hold=0.3).named("start")
        spun = (*self._shut, reads(drive, low=low, high=high), *self._loaded)
        counted = Substep("spun", spun, count=lasted(*spun, needed=_SECONDS))
        wait = WaitUntilReads(drive, low, high, _SECONDS + 0.3)
        return Step("spin", (*start.skills, wait), (*start.substeps, counted), start.touches)

    def stop(self) -> Step:
        """Stop it, and wait until it is at rest."""
        stop = actions.press(self.centrifuge.stop, hold=0.3).named("stop")
        still = reads(self.centrifuge.drive, low=0.0, high=0.0)
        at_rest = Substep("at_rest", (still,))
        skills = (*stop.skills, WaitUntil(still))
        return Step("stop", skills, (*stop.substeps, at_rest), stop.touches)

    def open(self) -> Step:
        """Press its latch: the lid springs open."""
        latch = actions.press(self.centrifuge.latch, hold=0.3).named("unlatch")
        lid = self.centrifuge.lid
        up = opened(lid, to=0.9 * lid.widest)
        skills = (*latch.skills, WaitUntil(up))
        return Step("open", skills, (*latch.substeps, Substep("open", (up,))), latch.touches)

    def unload(self) -> tuple[Step, Step]:
        """Put both back into the rack."""
        racked, free = self.racked, self.free
        one, other = (
            gripped(tube) & ~loaded for tube, loaded in zip(self.tubes, self._loaded, strict=True)
        )
        one_racked = (racked[0] & free[0]) | (racked[1] & free[1])
        one_out, one_back = Substep("one_out", (one | other,)), Substep("one_racked", (one_racked,))
        both = Substep("both_racked", (*racked, *free))
        return (
            Step("unload", self._moved_out(0), (one_out, one_back), self.tubes),
            Step("unload_other", self._moved_out(1), (both,), self.tubes),
        )

    def _moved_in(self, number: int) -> tuple[Pick, Insert]:
        tube, bore = self.tubes[number], self._bores[number]
        into = Insert(tube, bore, hover=0.10, bottom=0.0002, yaw=_OVER.yaw)
        return Pick(tube, 0.26, self.rack.name, approach=_OVER), into

    def _moved_out(self, number: int) -> tuple[Pick, Insert]:
        tube, opening = self.tubes[number], self._openings[number]
        into = Insert(tube, opening, hover=0.08, bottom=0.0002, yaw=_OVER.yaw)
        return Pick(tube, 0.20, self.centrifuge.rotor.name, approach=_OVER), into
