"""`python scripts/plot_liquids.py`: docs/liquids.md and its plots, liquids against references."""

import json
import multiprocessing
import os
import time
from collections.abc import Sequence
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib import pyplot as plt
from matplotlib.figure import Figure
from PIL import Image

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.liquids.liquid import Liquid
from labutopia_lerobot.liquids.solver.flow import LIQUID_HZ
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.substances.substance import DYES
from liquid_experiments import FRONTS, collapse, filled, move_to, surface, swirl
from run_over import run_over, tilt_to_barrier

DOCS = Path(__file__).parents[1] / "docs"
PICTURES = DOCS / "liquids"
SEEDS = 3
"""Number of measurements of every fill height."""

type Texts = dict[str, str]


def main() -> None:
    """Measure everything, and write the page and its plots."""
    mpl.rcParams.update({"axes.grid": True, "grid.alpha": 0.3, "font.size": 9})
    PICTURES.mkdir(exist_ok=True)
    texts = {"cores": str(os.cpu_count()), "hertz": str(LIQUID_HZ)}
    for measure in (heights, levels, runs_over, dam_break, viscosity, scaling, leaks):
        texts |= measure()
    page = (DOCS / "liquids.md").read_text()
    for name, text in texts.items():
        before, _, rest = page.partition(f"<!-- {name} -->")
        _, _, after = rest.partition("<!-- end -->")
        page = f"{before}<!-- {name} -->{text}<!-- end -->{after}"
    (DOCS / "liquids.md").write_text(page)


def heights() -> Texts:
    """Compare where liquids stand with the volume of the cavity below."""
    cases = (
        ("beaker, 250 ml", glassware("beaker", "250 ml", "glass"), (50, 100, 150, 200)),
        (
            "conical flask, 300 ml",
            glassware("conical_flask", "300 ml", "glass"),
            (50, 100, 200, 300),
        ),
        (
            "graduated cylinder, 250 ml",
            glassware("measuring_cylinder", "250 ml", "glass"),
            (25, 50, 100, 200),
        ),
    )
    figure, axes = plt.subplots(figsize=(4.5, 3.2))
    rows = []
    for name, vessel, volumes in cases:
        bottom = vessel.profile.bottom
        fine = np.linspace(0, volumes[-1], 60)
        right = [vessel.profile.fill_height(ml * 1e-6) - bottom for ml in fine]
        (line,) = axes.plot(fine, np.multiply(right, 1e3), label=name)
        for ml in volumes:
            measured = [at_rest(vessel, ml, seed) for seed in range(SEEDS)]
            height, left = np.mean(measured, axis=0)
            error = height / (vessel.profile.fill_height(ml * 1e-6) - bottom) - 1
            rows.append(f"| {name} | {ml} | {error:+.1%} | {left * 1e3:.0f} |")
            axes.plot(ml, height * 1e3, "o", color=line.get_color())
    axes.set(xlabel="volume [ml]", ylabel="height over the bottom [mm]")
    axes.legend(title="lines: from the volume")
    save(figure, "heights")
    return {"heights": table("vessel | ml | error of height | speed [mm/s]", rows)}


def at_rest(vessel: Vessel, ml: float, seed: int) -> tuple[float, float]:
    """Return how high liquid stands over the bottom [m], and the speed left in it [m/s]."""
    _, _, liquid = filled(vessel, Filling(ml), seed=seed)
    for _ in range(liquid.hertz):
        liquid.step()
    return surface(liquid)[0] - vessel.profile.bottom, speed(liquid)


def levels() -> Texts:
    """Tilt vessels slowly, and compare the slope of the surface with the horizon."""
    figure, axes = plt.subplots(figsize=(4.5, 2.6))
    worst = []
    for vessel, name in (
        (glassware("beaker", "250 ml", "glass"), "beaker"),
        (glassware("conical_flask", "300 ml", "glass"), "conical flask"),
    ):
        model, data, liquid = filled(vessel, Filling(100.0), height=0.1)
        tilts, slopes = [], []
        for step in range(4 * LIQUID_HZ):
            tilt = np.radians(30.0) * min(1.0, step / (3 * LIQUID_HZ))
            move_to(model, data, (0, 0, 0.1), tilt)
            liquid.step()
            if step % (LIQUID_HZ // 10) == 0:
                tilts.append(np.degrees(tilt))
                slopes.append(np.degrees(surface(liquid)[1]))
        worst.append(f"{max(slopes):.1f} degrees in the {name}")
        axes.plot(tilts, slopes, ".", label=name)
    axes.plot([0, 30], [0, 30], color="gray", label="turning with the vessel")
    axes.set(xlabel="tilt of the vessel [degrees]", ylabel="slope [degrees]")
    axes.legend()
    save(figure, "levels")
    return {"levels": " and ".join(worst)}


def runs_over() -> Texts:
    """Tilt filled vessels until they run over."""
    rows = []
    for name, vessel, ml in (
        ("beaker, 250 ml", glassware("beaker", "250 ml", "glass"), 100),
        ("conical flask, 300 ml", glassware("conical_flask", "300 ml", "glass"), 200),
        ("graduated cylinder, 250 ml", glassware("measuring_cylinder", "250 ml", "glass"), 100),
    ):
        right = np.degrees(tilt_to_barrier(vessel.profile, ml * 1e-6))
        for count in (1000, 2000):
            measured = [run_over(vessel, ml, count, seed) for seed in range(SEEDS)]
            late, above = np.mean(measured, axis=0)
            rows.append(
                f"| {name} | {ml} | {count:,} | {right:.1f} | {np.degrees(late):+.1f} "
                f"| {above * 1e3:.1f} |"
            )
    head = "vessel | ml | particles | should at [degrees] | late by [degrees] | stands above [mm]"
    return {"runs_over": table(head, rows)}


def dam_break() -> Texts:
    """Let a column of water collapse, and follow its front."""
    figure, axes = plt.subplots(figsize=(4.5, 3.2))
    axes.plot(*FRONTS.T, "ko", markersize=4, label="Martin and Moyce (1952)")
    errors = []
    for across in (8, 12, 16):
        times, fronts, count = collapse(across)
        error = abs(np.interp(FRONTS[:, 0], times, fronts) / FRONTS[:, 1] - 1).max()
        errors.append(f"{error:.0%} with {count:,} particles")
        axes.plot(times, fronts, label=f"{count:,} particles")
    axes.set(xlabel="time [sqrt(a / 2g)]", ylabel="front [a]", xlim=(0, 3.3), ylim=(0.9, 4.5))
    axes.legend()
    save(figure, "dam_break")
    return {"dam_break": ", ".join(errors)}


def viscosity() -> Texts:
    """Let swirls die away, each beside the Stokes flow of its viscosity."""
    figure, axes = plt.subplots(figsize=(4.5, 2.8))
    rows = []
    for substance in DYES:
        seconds, spins, rate, stokes = swirl(substance)
        (line,) = axes.semilogy(seconds, spins / spins[0], label=substance)
        axes.plot(seconds, np.exp(-stokes * (seconds - seconds[0])), ":", color=line.get_color())
        rows.append(f"| {substance} | {rate:.2f} | {stokes:.2f} |")
    axes.set(xlabel="time [s]", ylabel="angular momentum", ylim=(5e-3, 1.2))
    axes.legend(title="dotted: Stokes flow")
    save(figure, "viscosity")
    return {"viscosity": table("substance | rate | Stokes", rows)}


def scaling() -> Texts:
    """Measure time and memory for 100 ml in a beaker at rest, each number in its own process."""
    counts = (500, 1000, 2000, 4000, 8000)
    with multiprocessing.get_context("spawn").Pool(1, maxtasksperchild=1) as pool:
        measured = pool.map(cost, counts, chunksize=1)
    _, milliseconds, megabytes, _ = zip(*measured, strict=True)
    figure, axes = plt.subplots(1, 2, figsize=(6.4, 2.6), layout="constrained")
    for part, numbers, unit in zip(axes, (milliseconds, megabytes), ("ms", "MB"), strict=True):
        part.plot(counts, numbers, "o-")
        part.plot([0, counts[-1]], [0, counts[-1] * numbers[-1] / counts[-1]], ":", color="gray")
        what = "time per step" if unit == "ms" else "memory"
        part.set(xlabel="particles", ylabel=f"{what} [{unit}]", xlim=0, ylim=0)
    save(figure, "scaling")
    rows = [
        f"| {count:,} | {hertz} | {step:.2f} | {1e3 / hertz / step:.1f} | {used:.1f} | {left:.0f} |"
        for count, (hertz, step, used, left) in zip(counts, measured, strict=True)
    ]
    return {
        "scaling": table(
            "particles | steps per s | ms per step | times real time | MB | speed [mm/s]", rows
        )
    }


def cost(count: int) -> tuple[int, float, float, float]:
    """Return steps per second, time of one [ms], most memory [MB], and the speed left [mm/s]."""
    filled(glassware("beaker", "250 ml", "glass"), Filling(100.0), 1)  # so that all is loaded
    Path("/proc/self/clear_refs").write_text("5")  # the peak counts from here on (proc(5))
    before = memory("VmRSS")
    _, _, liquid = filled(glassware("beaker", "250 ml", "glass"), Filling(100.0), count)
    taken = []
    for _ in range(LIQUID_HZ):
        start = time.perf_counter()
        liquid.step()
        taken.append(time.perf_counter() - start)
    step = float(np.median(taken)) * 1e3
    return liquid.hertz, step, memory("VmHWM") - before, speed(liquid) * 1e3


def memory(entry: str) -> float:
    """Return an entry of this process's status [MB]."""
    _, rest = Path("/proc/self/status").read_text().split(f"{entry}:")
    return int(rest.split()[0]) / 1e3


def leaks() -> Texts:
    """Read what scripts/leak_rate.py has found."""
    file = PICTURES / "leak_rate.json"
    if not file.exists():
        return {"leaks": "Not measured."}
    measured = json.loads(file.read_text())
    text = "{crossings} crossings and {lost_particles} lost in {particle_steps:,} particle steps "
    text += "({episodes:,} episodes of 10 s); {left_through_the_mouth:,} left through the mouth. "
    text += "The solver diverged in {diverged} episodes."
    return {"leaks": text.format(**measured)}


def speed(liquid: Liquid) -> float:
    """Return the root mean square speed [m/s]."""
    return float(np.sqrt((liquid.velocities**2).sum(axis=1).mean()))


def table(head: str, rows: Sequence[str]) -> str:
    """Return a table in Markdown, apart from the markers around it."""
    rule = " | ".join("---" for _ in head.split("|"))
    return "\n".join(["\n", f"| {head} |", f"| {rule} |", *rows, "\n"])


def save(figure: Figure, name: str) -> None:
    """Write a plot as a small PNG."""
    file = PICTURES / f"{name}.png"
    figure.savefig(file, dpi=110, bbox_inches="tight")
    plt.close(figure)
    Image.open(file).convert("RGB").quantize(64).save(file, optimize=True)


if __name__ == "__main__":
    main()
