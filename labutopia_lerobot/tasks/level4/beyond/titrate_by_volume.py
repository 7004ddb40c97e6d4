"""Titrate by volume: run a burette to a mark, shut it, take the flask away (beyond the paper)."""

import math

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.handling.burette_stand import BuretteStand
from labutopia_lerobot.layout import Inside, OnBench
from labutopia_lerobot.places import OverBench
from labutopia_lerobot.predicates import (
    Transfer,
    closed,
    fingers_clear_of,
    given,
    gripped,
    near,
    opened,
    received,
    released,
    spilled,
    standing_on,
    steady,
    touching,
    withdrawn,
)
from labutopia_lerobot.scenario import Draw
from labutopia_lerobot.scenes.views import BURETTE_VIEW
from labutopia_lerobot.skills import Pick, Place, RunOut
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Step, Substep, Task
from labutopia_lerobot.tasks import failures

WITHIN_ML = 0.2
"""How near to the mark [ml]; ours: two lines of the scale."""
_TRAIN, _TEST = (4.0, 5.0, 6.0), (4.5, 5.5)
"""Marks that are asked for [ml]; ours: some seconds of an open stopcock."""


def titrate_by_volume(draw: Draw) -> Task:
    """Return the task that an episode has drawn."""
    ml = draw.choice("volume", train=_TRAIN, test=_TEST, shifted=True)
    stand, flask = BuretteStand("stand"), glassware("erlenmeyer_narrow", "100 ml", "flask")
    burette, wing = stand.burette, stand.stopcock
    enough = received(burette, flask, low_ml=ml - WITHIN_ML, high_ml=ml + WITHIN_ML)
    before = OverBench("before the stand", ahead=0.55, left=0.10, height=0.05)
    aside = OverBench("the bench", ahead=0.55, left=0.25)
    away = ~near(flask, stand.under, within=0.10)
    there = (standing_on(flask, aside), away)
    return Task(
        instruction=f"Run {ml:g} ml from the burette into the flask, shut it, and set the flask "
        "on the bench beside the stand.",
        paraphrases=(
            f"Add {ml:g} ml from the burette to the flask, within 0.2 ml; then take the flask off "
            "the stand and put it on the bench.",
            f"Let the burette run to the mark of {ml:g} ml, close it and move the flask from the "
            "stand to the bench.",
        ),
        start={
            # The wing faces the hand.
            stand: OnBench((0.28, 0.36), (-0.12, 0.06), (-math.radians(145), -math.radians(125))),
            flask: Inside(stand, at=stand.under.at),
        },
        steps=(
            Step(
                "run",
                (RunOut(wing, burette.processes[0], ml=ml - 0.02),),
                (
                    Substep("opened", (opened(wing, to=math.radians(30)),)),
                    Substep("run", (enough,)),
                    Substep("shut", (closed(wing), enough)),
                    Substep("let_go", (closed(wing), fingers_clear_of(wing, by=0.05))),
                ),
                (wing,),
                transfers=(Transfer(burette, flask),),
            ),
            Step(
                "take_away",
                (Pick(flask, lift=0.015, support=stand.name), Place(flask, aside, through=before)),
                (
                    Substep("gripped", (gripped(flask),)),
                    Substep("lifted", (gripped(flask), ~touching(flask, stand))),
                    Substep("set_down", there),
                    Substep("released", (*there, released(flask))),
                ),
                (flask,),
                transfers=(Transfer(burette, flask),),
            ),
        ),
        goal=(
            enough,
            closed(wing),
            *there,
            released(flask),
            withdrawn(flask, by=0.05),
            steady(flask, below=0.02),  # as in `actions.left_standing`
        ),
        contents={burette: Filling(ml=40), flask: Filling(ml=20)},
        never={
            **failures.handling(flask, spill=0.01),
            "overshot": given(burette, flask, more_than_ml=ml + WITHIN_ML),
            "missed": spilled(burette, share=0.0),
        },
        needs_liquid=True,
        time_limit_s=60.0,  # ours
        view=BURETTE_VIEW,
    )
