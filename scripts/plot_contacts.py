"""`python scripts/plot_contacts.py`: docs/contacts.md and its plot, how deep knocks sink in."""

import os
import time
from pathlib import Path

import mujoco
import numpy as np
from matplotlib import pyplot as plt
from numpy.typing import NDArray
from PIL import Image

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.robots.panda import PANDA
from labutopia_lerobot.scenes.laboratory import LABORATORY
from labutopia_lerobot.scenes.views import VESSEL_VIEW
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.world.model import PHYSICS_HZ, SOLREF

DOCS = Path(__file__).parents[1] / "docs"
RATES = (300, 600, 900, 1200)
"""Physics steps per second that are compared."""

SPEEDS = (0.1, 0.25, 0.5, 0.75, 1.0)
"""Speeds at which the beaker meets the bench [m/s]."""

PHASES = 12
"""Knocks per speed: each begins another part of a physics step above the bench."""


def main() -> None:
    """Measure, and write the page and its plot."""
    figure, axes = plt.subplots(figsize=(4.5, 3.2))
    rows, cheapest = [], step_time(PHYSICS_HZ)
    for rate in RATES:
        model = compile_scene(
            [glassware("beaker", "250 ml", "beaker")], PANDA, LABORATORY, VESSEL_VIEW
        ).model
        hasten(model, rate)
        depths = [max(sunk(model, speed, phase) for phase in range(PHASES)) for speed in SPEEDS]
        axes.plot(SPEEDS, np.multiply(depths, 1e3), "o-", label=f"{rate} steps/s")
        cells = " | ".join(f"{depth * 1e3:.2f}" for depth in depths)
        rows.append(f"| {rate} | {cells} | {step_time(rate) / cheapest:.1f} |")
    axes.axvline(0.25, color="grey", linestyle="--")
    axes.axhline(1.0, color="grey", linestyle=":")
    axes.set(xlabel="speed of the beaker [m/s]", ylabel="depth in the bench [mm]")
    axes.legend(title="dashed: glass breaks")
    picture = DOCS / "contacts.png"
    figure.savefig(picture, dpi=110, bbox_inches="tight")
    Image.open(picture).convert("RGB").quantize(64).save(picture, optimize=True)
    speeds = " | ".join(f"{speed:g} m/s" for speed in SPEEDS)
    head = f"| steps/s | {speeds} | physics takes |\n|{' --- |' * (len(SPEEDS) + 2)}"
    page = (DOCS / "contacts.md").read_text()
    before, _, rest = page.partition("<!-- knocks -->")
    after = rest.partition("<!-- end -->")[2]
    table = "\n".join((head, *rows))
    page = f"{before}<!-- knocks -->\n{table}\n<!-- end -->{after}"
    (DOCS / "contacts.md").write_text(page)
    print(table, f"{os.cpu_count()} cores, MuJoCo {mujoco.__version__}", sep="\n")  # noqa: T201


def sunk(model: mujoco.MjModel, speed: float, phase: int) -> float:
    """Return how deep an empty beaker sinks into the bench when it meets it upright.

    Args:
        model: A room with a bench, and the beaker.
        speed: Of the beaker [m/s], downwards.
        phase: How far above the bench it starts, in PHASES-ths of what it moves in a step.

    Returns:
        Greatest depth within 0.2 s [m].
    """
    data, period = mujoco.MjData(model), model.opt.timestep
    free = data.joint("beaker_free")
    height = LABORATORY.bench.height + (1 + phase / PHASES) * speed * period
    free.qpos = np.array([0.5, 0.0, height, 1.0, 0.0, 0.0, 0.0])
    free.qvel[2] = -speed
    mujoco.mj_forward(model, data)
    body, deepest = model.body("beaker").id, 0.0
    while data.time < 0.2:
        mujoco.mj_step(model, data)
        bodies = model.geom_bodyid[data.contact.geom]
        own: NDArray[np.float64] = data.contact.dist[(bodies == body).any(axis=1)]
        deepest = min(deepest, float(own.min(initial=0.0)))
    return -deepest


def hasten(model: mujoco.MjModel, rate: int) -> None:
    """Step a model at another rate, with contacts stiffer by as much."""
    model.opt.timestep = 1.0 / rate
    ordinary = model.geom_solref[:, 0] == SOLREF[0]
    model.geom_solref[ordinary, 0] *= PHYSICS_HZ / rate


def step_time(rate: int) -> float:
    """Return the processor time that a simulated second of `level2/transport_beaker` takes [s]."""
    env = LabEnv(Setting("level2/transport_beaker", obs="state", liquid="off"))
    env.reset(seed=0)
    model, data = env.workcell.simulation.scene.model, env.workcell.simulation.data
    hasten(model, rate)
    times = []
    for _ in range(5):
        began = time.process_time()
        for _ in range(rate):
            mujoco.mj_step(model, data)
        times.append(time.process_time() - began)
    env.close()
    return min(times)


if __name__ == "__main__":
    main()
