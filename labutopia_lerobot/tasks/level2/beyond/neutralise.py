"""Neutralise: pour a base into an acid until its indicator turns, and no further.

Beyond the paper, whose laboratory has no chemistry in its vessels.
"""

from labutopia_lerobot.chemistry.inventory import Solute
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.places import WhereItStood
from labutopia_lerobot.predicates import colour_turned, more_basic, ph_between, struck
from labutopia_lerobot.scenario import Draw
from labutopia_lerobot.scenes.views import WIDE_VESSEL_VIEW
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import actions, failures
from labutopia_lerobot.tasks.variety import start_temperature

_ACID_ML, _BASE_ML = 100.0, 130.0
"""What the beakers hold [ml]; ours: what turns the strongest acid leaves a quarter of the base."""
_BASE = 0.12
"""Sodium hydroxide [mol/l]; ours."""
_ACIDS = ("acetic acid", "propanoic acid", "butanoic acid")
"""Ours: of one strength, pKa 4.76 to 4.87, so that the indicator turns at the same share."""
_INDICATOR = Solute("bromothymol blue", 1.2e-4)
"""Ours: some drops of a 0.1 % solution."""
_LOW, _HIGH, _OVER = 5.8, 7.0, 7.6
"""Between which pH it is green, and from where on blue: bromothymol blue turns from 6.0 to 7.6
(Harris, Quantitative Chemical Analysis, acid-base indicators); the lower limits are ours, where
`chemistry.colour` says green."""
_SHARE = 0.975
"""Share of the acid that the expert neutralises: it is green from 95 % on, up to 99 % and a pH of
6.74 with acetic acid, to 98.6 % and 6.7 with the weakest."""
_WITHIN = 0.05
"""How near to where it stood the beaker is to be put back [m]; ours, as `pour_to_mass`."""


def neutralise(draw: Draw) -> Task:
    """Return the task that an episode has drawn."""
    molar = draw.choice("concentration", train=(0.10, 0.08, 0.12), test=(0.09, 0.11), shifted=True)
    acid, celsius = _ACIDS[0], start_temperature(draw)
    if draw.varies("substance"):
        acid = draw.choice("substance", train=_ACIDS[:2], test=_ACIDS[2:])
    source = glassware("beaker", "250 ml", "base_beaker")
    wrong = glassware("erlenmeyer_narrow", "100 ml", "acid_flask")
    target = glassware("beaker", "800 ml", "yellow_beaker")
    back, base = WhereItStood(source), Solute("sodium hydroxide", _BASE)
    needed = _SHARE * _ACID_ML * molar / _BASE
    return Task(
        instruction=(
            "Pour base from the small beaker into the yellow acid until it turns green and stays "
            "so, and put the small beaker back. It must not turn blue."
        ),
        paraphrases=(
            "Neutralise the yellow acid in the large beaker: add base from the small one until the "
            "indicator is green, not blue, and return the small beaker.",
            "Add what is in the small beaker to the yellow solution until that is green, then put "
            "the small beaker back where it stood.",
        ),
        start={
            source: OnBench(x=(0.29, 0.36), y=(0.12, 0.22)),
            target: OnBench(x=(0.20, 0.30), y=(-0.34, -0.26)),
            wrong: OnBench(x=(0.13, 0.19), y=(-0.08, -0.02)),
        },
        steps=(
            actions.pick(source, by=actions.OFF_THE_BENCH),
            actions.pour_until_it_turns(source, target, to="green", about_ml=needed, within_ml=1.2),
            actions.place(source, back, within=_WITHIN),
        ),
        goal=(
            colour_turned(target, to="green"),
            ph_between(target, low=_LOW, high=_HIGH),
            *actions.left_standing(source, back, within=_WITHIN),
        ),
        contents={
            source: Filling(_BASE_ML, celsius=celsius, dissolved=(base,)),
            target: Filling(_ACID_ML, celsius=celsius, dissolved=(Solute(acid, molar), _INDICATOR)),
            # As clear as the base, and no base.
            wrong: Filling(40.0, celsius=celsius, dissolved=(Solute("hydrochloric acid", 0.1),)),
        },
        never={
            **failures.handling(source, spill=0.02, into=target),
            "struck": struck(target),
            "overshot": more_basic(target, than=_OVER),
        },
        needs_liquid=True,
        time_limit_s=90.0,  # ours
        view=WIDE_VESSEL_VIEW,
    )
