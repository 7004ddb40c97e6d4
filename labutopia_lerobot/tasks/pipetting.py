"""Pipetting: what the tasks with a piston pipette share."""

import math
from collections.abc import Mapping

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.labware.instruments.handling.piston_pipette import PistonPipette
from labutopia_lerobot.labware.instruments.support.pipette_stand import PipetteStand
from labutopia_lerobot.labware.piece import Piece
from labutopia_lerobot.layout import Inside, OnBench, Start
from labutopia_lerobot.predicates import (
    Predicate,
    Transfer,
    in_hand,
    knocked_over,
    received,
    spilled,
    struck,
    tip_above,
    tip_in,
    touching,
)
from labutopia_lerobot.skills import Aspirate, Dispense, TakePipette
from labutopia_lerobot.task import Step, Substep

LEAST_ML, MOST_ML = 0.98, 1.02
"""1 ml within 2 %; ours: three times what ISO 8655-2 allows such a pipette, from memory, for liquid
that comes in particles of a hundredth of it."""
FILLED_ML = 10.0
"""What the source holds [ml]; ours: ten strokes, so that a particle is 0.01 ml."""
_STRIKES = 2.0
"""Force from which on a tip or a hand strikes a beaker [N]; ours: a tip may brush it."""


class PipetteBench:
    """A pipette on its stand beside a beaker with water.

    Attributes:
        stand: The stand.
        pipette: What hangs on its first hook.
        source: The beaker.
    """

    def __init__(self) -> None:
        self.stand, self.pipette = PipetteStand("stand"), PistonPipette("pipette")
        self.source = glassware("beaker_low", "50 ml", "source")

    @property
    def start(self) -> Mapping[Piece, Start]:
        """Where they stand: the pipette hangs where the hand comes comfortably."""
        yaw = (math.radians(125), math.radians(145))
        return {
            self.stand: OnBench((0.30, 0.36), (0.18, 0.25), yaw),
            self.pipette: Inside(self.stand, at=self.stand.hanging(self.pipette), yaw=0.0),
            self.source: OnBench(x=(0.11, 0.21), y=(-0.08, 0.00)),
        }

    @staticmethod
    def empty_place() -> OnBench:
        """Return where an empty beaker stands, to the right of the source."""
        return OnBench(x=(0.11, 0.21), y=(-0.22, -0.14))

    @property
    def taking(self) -> TakePipette:
        return TakePipette(self.pipette, self.stand, self.stand.carousel)

    @property
    def aspirating(self) -> Aspirate:
        return Aspirate(self.pipette, self.source)

    def take(self) -> Step:
        """Take the pipette from its hook."""
        held = in_hand(self.pipette)
        return Step(
            "take",
            (self.taking,),
            (
                Substep("gripped", (held,)),
                Substep("unhooked", (held, ~touching(self.pipette, self.stand.carousel))),
            ),
            (self.pipette, *self.pipette.grips),
        )

    def aspirate(self) -> Step:
        """Draw up 1 ml."""
        return Step(
            "aspirate",
            (self.aspirating,),
            (
                Substep("dipped", (tip_in(self.pipette, self.source),)),
                Substep("drawn", (self._drawn,)),
                Substep("lifted_out", self.full()),
            ),
            (self.pipette, *self.pipette.grips),
            transfers=(Transfer(self.source, self.pipette),),
        )

    def dispense(self, target: Vessel) -> Step:
        """Give it out into a vessel."""
        return Step(
            "dispense",
            (Dispense(self.pipette, target),),
            (
                Substep("given", (self._given(target),)),
                Substep("lifted_clear", self.delivered(target)),
            ),
            (self.pipette, *self.pipette.grips),
            transfers=(Transfer(self.source, self.pipette), Transfer(self.source, target)),
        )

    def full(self) -> tuple[Predicate, ...]:
        """Return what holds when 1 ml has been drawn up."""
        return (
            self._drawn,
            in_hand(self.pipette),
            tip_above(self.pipette, self.source, by=0.02),
        )

    def delivered(self, target: Vessel) -> tuple[Predicate, ...]:
        """Return what holds when it has been given out."""
        return (
            self._given(target),
            in_hand(self.pipette),
            tip_above(self.pipette, target, by=0.02),
        )

    def never(self, *targets: Vessel) -> dict[str, Predicate]:
        """Return what must not happen."""
        vessels = (self.source, *targets)
        over = knocked_over(self.source, beyond_deg=30)
        for target in targets:
            over |= knocked_over(target, beyond_deg=30)
        return {
            "knocked_over": over,
            "spilled": spilled(self.source, share=0.0),
            "struck": struck(*vessels, force=_STRIKES),
        }

    @property
    def _drawn(self) -> Predicate:
        return received(self.source, self.pipette, low_ml=LEAST_ML, high_ml=MOST_ML)

    def _given(self, target: Vessel) -> Predicate:
        return received(self.source, target, low_ml=LEAST_ML, high_ml=MOST_ML)
