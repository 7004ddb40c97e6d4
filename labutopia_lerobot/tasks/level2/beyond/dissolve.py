"""Dissolve: stir the crystals on the bottom of a beaker until all is clear.

Beyond the paper, whose laboratory has no chemistry in its vessels.
"""

from labutopia_lerobot.chemistry.crystals import Crystals
from labutopia_lerobot.chemistry.inventory import Solute
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.glass.glass_rod import GlassRod
from labutopia_lerobot.labware.instruments.test_tube_rack import TestTubeRack
from labutopia_lerobot.layout import Inside, OnBench
from labutopia_lerobot.predicates import dissolved, gripped, immersed, steady, upright
from labutopia_lerobot.scenario import Draw
from labutopia_lerobot.scenes.views import DISSOLVING_VIEW
from labutopia_lerobot.skills import Stir
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Step, Substep, Task
from labutopia_lerobot.tasks import actions, failures
from labutopia_lerobot.tasks.variety import start_temperature

_WATER_ML = 60.0
"""As `level2/stir_glassrod` [ml]."""
_ACID = Solute("sulfuric acid", 1e-3)
"""In the water [mol/l]; ours, as in the laboratory: else a little copper falls out as hydroxide."""
_GRAIN_MM = 0.7
"""Diameter of the grains [mm]; ours, coarse salt: at rest none of the four is gone in 160 s."""
_TURN_S = 1.0
"""How long the expert takes for a turn [s]; ours: twice as fast as where nothing is to dissolve."""


def dissolve(draw: Draw) -> Task:
    """Return the task that an episode has drawn."""
    salt = draw.choice(
        "substance",
        train=("copper(II) sulfate pentahydrate", "sodium chloride"),
        test=("cobalt(II) nitrate", "potassium chloride"),
        shifted=True,
    )
    grams = draw.choice("mass", train=(2.0, 1.0, 3.0), test=(1.5, 2.5), shifted=True)
    rod, rack, vessel = GlassRod("glass_rod"), TestTubeRack("rack"), glassware("beaker", "150 ml")
    filling = Filling(
        _WATER_ML,
        celsius=start_temperature(draw),
        dissolved=(_ACID,),
        crystals=(Crystals(salt, grams, _GRAIN_MM),),
    )
    clear = dissolved(vessel)
    inside = (gripped(rod), immersed(rod, vessel, filling_ml=filling.ml))
    return Task(
        instruction=f"Take the glass rod out of the rack, stir the {salt} in the beaker until it "
        "has dissolved, and lift the rod straight out.",
        paraphrases=(
            f"Dissolve the crystals of {salt}: stir with the glass rod until nothing is left on "
            "the bottom, then lift it out.",
            f"Stir until the {salt} in the beaker has gone and all is clear; take the rod out.",
        ),
        start={
            vessel: OnBench(x=(0.166, 0.316), y=(-0.389, -0.239)),  # as `level2/stir_glassrod`
            rack: OnBench(x=(0.209, 0.359), y=(0.233, 0.383)),
            rod: Inside(rack, at=rack.middle),
        },
        steps=(
            actions.pick(rod, lift=0.23, support=rack.name),
            Step(
                "stir",
                (Stir(rod, vessel, turns=60.0, turn_s=_TURN_S, until=clear),),
                (
                    Substep("inserted", inside),
                    Substep("dissolved", (clear,)),
                    Substep("withdrawn", actions.held_over(rod, vessel)),
                ),
                (rod,),
            ),
        ),
        goal=(
            clear,
            *actions.held_over(rod, vessel),
            upright(rod, within_deg=10),
            steady(rod, below=0.05),  # as `level2/stir_glassrod`
        ),
        contents={vessel: filling},
        never=failures.stirring(rod, vessel, rack),
        needs_liquid=True,
        time_limit_s=75.0,  # ours
        view=DISSOLVING_VIEW,
    )
