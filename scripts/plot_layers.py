"""`python scripts/plot_layers.py`: docs/gallery/layers.png, a layer until it is stirred.

Water is laid on copper sulfate drop by drop, as along a glass rod; then something turns in the
beaker, as a bar on a magnetic stirrer does. Each picture is what the front camera sees of it, 256
pixels wide.
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

PICTURE = Path(__file__).parents[1] / "docs" / "gallery" / "layers.png"
SIZE, CUT = 1080, 256
"""Edge of a picture, and of what is cut out of it around the beaker [pixels]."""

BELOW = Filling(100.0, dissolved=(Solute("copper(II) sulfate", 0.2),))
ABOVE = Filling(100.0)
DROPS = 8
"""Particles that are laid on in a control step: 1.6 ml."""
STIRRER = 20.0
"""How fast the stirrer turns, some 200 rpm [rad/s]."""
WAITED, STIRRED = 4.0, 5.0
"""How long it rests, and how long it is stirred [s]."""


def main() -> None:
    """Lay water on the solution, stir, and write the picture."""
    pictures = list(film())
    Image.fromarray(np.hstack(pictures)).quantize(200, dither=Image.Dither.NONE).save(
        PICTURE, optimize=True
    )


def film() -> Iterator[NDArray[np.uint8]]:
    """Yield the solution, the layer on it, the same some seconds later, and all of it stirred."""
    setting = Setting("level1/pour", width=SIZE, height=SIZE)
    task = canonical_task(setting)
    vessel, target = task.start
    scenario = Scenario(replace(task, contents={vessel: ABOVE, target: BELOW}), Variation())
    workcell = Workcell(scenario, setting)
    workcell.begin(scenario, np.random.default_rng(1))
    simulation = workcell.simulation
    liquid, handling = simulation.liquid, simulation.apparatus.liquid
    assert liquid is not None
    assert handling is not None
    body = simulation.scene.model.body(target.name).id
    seen = np.argwhere(workcell.segmentation("front") == body).mean(axis=0)
    top, left = (int(np.clip(at - CUT / 2, 0, SIZE - CUT)) for at in seen)

    def picture() -> NDArray[np.uint8]:
        cut: NDArray[np.uint8] = workcell.color("front")[top : top + CUT, left : left + CUT]
        return cut

    yield picture()
    middle, rng = simulation.data.xpos[body].copy(), np.random.default_rng(0)
    poured = np.flatnonzero(liquid.origins == liquid.names.index(vessel.name))
    for now in np.split(poured, range(DROPS, len(poured), DROPS)):
        held = liquid.accounted == liquid.names.index(target.name)
        surface = np.quantile(liquid.positions[held, 2], 0.98) + liquid.spacing
        around = rng.uniform(-0.022, 0.022, (len(now), 2))
        liquid.positions[now] = np.column_stack([middle[:2] + around, np.full(len(now), surface)])
        liquid.velocities[now] = 0.0
        simulation.step(simulation.command)
    yield picture()
    for _ in range(round(30 * WAITED)):
        simulation.step(simulation.command)
    yield picture()
    for _ in range(round(30 * STIRRED)):
        handling.stir(middle + np.array([0.0, 0.0, 0.01]), STIRRER, 0.02, 1 / 30)
        simulation.step(simulation.command)
    yield picture()
    workcell.close()


if __name__ == "__main__":
    main()
