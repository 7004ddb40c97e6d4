"""`python scripts/plot_chemistry.py`: docs/gallery/chemistry.png, what a camera sees of reactions.

The robot pours, as in `level1/pour`: barium chloride into copper sulfate, whose precipitate is
white in a solution that stays blue; and a base into an acid with bromothymol blue, which turns from
yellow to green.
"""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from labutopia_lerobot.chemistry.inventory import Solute
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.scenario.scenario import Scenario
from labutopia_lerobot.scenario.variation import Variation
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.sim.workcell import Workcell
from labutopia_lerobot.substances.filling import Filling

PICTURE = Path(__file__).parents[1] / "docs" / "gallery" / "chemistry.png"
SIZE, CUT = 768, 256
"""Edge of a picture, and of what is cut out of it around the target [pixels]."""

POURS = (
    (
        Filling(100.0, dissolved=(Solute("barium chloride", 0.1),)),
        Filling(150.0, dissolved=(Solute("copper(II) sulfate", 0.15),)),
    ),
    (
        Filling(100.0, dissolved=(Solute("sodium hydroxide", 0.0975),)),
        Filling(
            150.0, dissolved=(Solute("acetic acid", 0.0667), Solute("bromothymol blue", 1.2e-4))
        ),
    ),
)
"""What is in the hand, and what stands on the bench."""

MOMENTS = (0.0, 3.9, 4.5, 20.0)
"""When pictures are taken [s]."""


def main() -> None:
    """Pour, and write the picture."""
    rows = [np.hstack(list(film(*pour))) for pour in POURS]
    picture = Image.fromarray(np.vstack(rows))
    # 200 colours, without dithering: smooth surfaces stay smooth, and the file small.
    picture.quantize(200, dither=Image.Dither.NONE).save(PICTURE, optimize=True)


def film(poured: Filling, into: Filling) -> Iterator[NDArray[np.uint8]]:
    """Yield what the front camera sees of the target at the moments of a pour."""
    setting = Setting("level1/pour", width=SIZE, height=SIZE)
    task = canonical_task(setting)
    vessel, target = task.start
    scenario = Scenario(replace(task, contents={vessel: poured, target: into}), Variation())
    workcell = Workcell(scenario, setting)
    workcell.begin(scenario, np.random.default_rng(1))
    body = workcell.simulation.scene.model.body(target.name).id
    seen = np.argwhere(workcell.segmentation("front") == body).mean(axis=0)
    top, left = (int(np.clip(at - CUT / 2, 0, SIZE - CUT)) for at in seen - (20, 0))
    expert = workcell.expert()
    expert.start()
    for moment in MOMENTS:
        while workcell.world.time < moment:
            workcell.simulation.step(workcell.filter(expert.act(), workcell.simulation.commands))
        picture = workcell.color("front")
        yield picture[top : top + CUT, left : left + CUT]
    workcell.close()


if __name__ == "__main__":
    main()
