"""`python scripts/plot_liquids.py`: docs/liquids.md and its plots, liquids against references."""

import json
import multiprocessing
import os
import time
from collections.abc import Sequence
from pathlib import Path

import matplotlib as mpl
import mujoco
import numpy as np
from matplotlib import pyplot as plt
from matplotlib.figure import Figure
from numpy.typing import NDArray
from PIL import Image
from scipy.special import j1, jn_zeros

from labutopia_lerobot.labware.glassware import beaker, erlenmeyer_flask, graduated_cylinder
from labutopia_lerobot.labware.vessel import Vessel
from labutopia_lerobot.liquids.filling import Filling
from labutopia_lerobot.liquids.liquid import Liquid
from labutopia_lerobot.liquids.solver import LIQUID_HZ
from labutopia_lerobot.liquids.substance import SUBSTANCES

DOCS = Path(__file__).parents[1] / "docs"
PICTURES = DOCS / "liquids"
SEED = 0
GRAVITY = 9.81
COLUMN = 2.25 * 0.0254
"""Width a of the column of water in the experiment [m]; it is 2 a high."""
FRONTS = np.array(
    [
        (0.41, 1.11), (0.84, 1.22), (1.19, 1.44), (1.43, 1.67), (1.63, 1.89), (1.83, 2.11),
        (1.98, 2.33), (2.20, 2.56), (2.32, 2.78), (2.51, 3.00), (2.65, 3.22), (2.83, 3.44),
        (2.98, 3.67), (3.11, 3.89),
    ]
)  # fmt: skip
"""Time in sqrt(a / 2 g) and front in a: Martin and Moyce (1952), Phil. Trans. R. Soc. A 244,
312-324, table 2 (n^2 = 2, a = 2.25 inches)."""

type Texts = dict[str, str]


def main() -> None:
    """Measure everything, and write the page and its plots."""
    mpl.rcParams.update({"axes.grid": True, "grid.alpha": 0.3, "font.size": 9})
    PICTURES.mkdir(exist_ok=True)
    texts = {"cores": str(os.cpu_count()), "hertz": str(LIQUID_HZ)}
    for measure in (heights, levels, dam_break, viscosity, scaling, leaks):
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
        ("beaker, 250 ml", beaker("glass"), (50, 100, 150, 200)),
        ("conical flask, 300 ml", erlenmeyer_flask("glass"), (50, 100, 200, 300)),
        ("graduated cylinder, 250 ml", graduated_cylinder("glass"), (25, 50, 100, 200)),
    )
    figure, axes = plt.subplots(figsize=(4.5, 3.2))
    rows = []
    for name, vessel, volumes in cases:
        bottom = vessel.profile.bottom
        fine = np.linspace(0, volumes[-1], 60)
        right = [vessel.profile.fill_height(ml * 1e-6) - bottom for ml in fine]
        (line,) = axes.plot(fine, np.multiply(right, 1e3), label=name)
        for ml in volumes:
            _, _, liquid = filled(vessel, Filling(ml))
            for _ in range(LIQUID_HZ):
                liquid.step()
            height = surface(liquid)[0] - bottom
            off = height / (vessel.profile.fill_height(ml * 1e-6) - bottom) - 1
            rows.append(f"| {name} | {ml} | {off:+.1%} | {speed(liquid) * 1e3:.0f} |")
            axes.plot(ml, height * 1e3, "o", color=line.get_color())
    axes.set(xlabel="volume [ml]", ylabel="height over the bottom [mm]")
    axes.legend(title="lines: from the volume")
    save(figure, "heights")
    return {"heights": table("vessel | ml | height off by | speed [mm/s]", rows)}


def levels() -> Texts:
    """Tilt vessels slowly, and compare the slope of the surface with the horizon."""
    figure, axes = plt.subplots(figsize=(4.5, 2.6))
    worst = []
    for vessel, name in ((beaker("glass"), "beaker"), (erlenmeyer_flask("glass"), "conical flask")):
        model, data, liquid = filled(vessel, Filling(100.0), height=0.1)
        tilts, slopes = [], []
        for step in range(4 * LIQUID_HZ):
            tilt = np.radians(30.0) * min(1.0, step / (3 * LIQUID_HZ))
            data.qpos[3:] = np.cos(tilt / 2), 0, np.sin(tilt / 2), 0
            mujoco.mj_kinematics(model, data)
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


def dam_break() -> Texts:
    """Let a column of water collapse, and follow its front."""
    figure, axes = plt.subplots(figsize=(4.5, 3.2))
    axes.plot(*FRONTS.T, "ko", markersize=4, label="Martin and Moyce (1952)")
    off = []
    for across in (8, 12, 16):
        times, fronts, count = collapse(across)
        error = abs(np.interp(FRONTS[:, 0], times, fronts) / FRONTS[:, 1] - 1).max()
        off.append(f"{error:.0%} with {count:,} particles")
        axes.plot(times, fronts, label=f"{count:,} particles")
    axes.set(xlabel="time [sqrt(a / 2g)]", ylabel="front [a]", xlim=(0, 3.3), ylim=(0.9, 4.5))
    axes.legend()
    save(figure, "dam_break")
    return {"dam_break": ", ".join(off)}


def collapse(across: int) -> tuple[NDArray[np.float64], NDArray[np.float64], int]:
    """Return times and places of the front in the paper's units, and the number of particles."""
    deep = across // 2
    spacing = COLUMN / across
    side = deep * spacing / 2
    walls = [
        ((-0.05, 0, 0.1), (0.05, 0.3, 0.2)),
        ((0, side + 0.05, 0.1), (0.6, 0.05, 0.2)),
        ((0, -side - 0.05, 0.1), (0.6, 0.05, 0.2)),
    ]
    model, data = world(walls=walls)
    places = np.moveaxis(np.indices((across, deep, 2 * across)), 0, -1).reshape(-1, 3) + 0.5
    places = places * spacing - (0, side, 0)
    places += np.random.default_rng(SEED).uniform(-0.05, 0.05, places.shape) * spacing
    liquid = Liquid(model, data, [], Filling(len(places) * spacing**3 * 1e6), len(places))
    liquid.release(places, np.zeros_like(places))
    fronts = [1.0]
    times = np.arange(0.0, 0.2, 1.0 / LIQUID_HZ)
    for _ in times[1:]:
        liquid.step()
        foremost = np.sort(liquid.positions[:, 0])[-deep:].mean()
        fronts.append((foremost + spacing / 2) / COLUMN)
    return times * np.sqrt(2 * GRAVITY / COLUMN), np.array(fronts), len(places)


def viscosity() -> Texts:
    """Let a swirl die away in an upright cylinder of glass.

    Unsteady Stokes flow v = J1(j11 r / R) sin(pi z / 2 H) exp(-rate t) sticks to the wall and the
    bottom and has a free surface; rate = nu ((j11 / R)^2 + (pi / 2 H)^2).
    """
    figure, axes = plt.subplots(figsize=(4.5, 2.8))
    rows, vessel, ml = [], beaker("glass", "150 ml"), 60.0
    radius = vessel.profile.inner_radius(0.02)
    depth = ml * 1e-6 / (np.pi * radius**2)
    squares = (jn_zeros(1, 1)[0] / radius) ** 2 + (np.pi / (2 * depth)) ** 2
    for substance in SUBSTANCES.values():
        _, _, liquid = filled(vessel, Filling(ml, substance.name))
        x, y, z = liquid.positions.T
        distance = np.hypot(x, y)
        shape = j1(jn_zeros(1, 1)[0] * distance / radius) / distance
        shape *= np.sin(np.pi * (z - vessel.profile.bottom) / (2 * depth))
        liquid.velocities[:] = 0.2 * shape[:, None] * np.column_stack([-y, x, 0 * x])
        seconds, spins = np.arange(1, round(0.4 * LIQUID_HZ)) / LIQUID_HZ, []
        for _ in seconds:
            liquid.step()
            spins.append(abs(np.cross(liquid.positions, liquid.velocities)[:, 2].mean()))
        early = seconds < 0.2
        rate = -float(np.polyfit(seconds[early], np.log(spins)[early], 1)[0])
        theory = substance.kinematic_viscosity * squares
        (line,) = axes.semilogy(seconds, np.divide(spins, spins[0]), label=substance.name)
        axes.plot(seconds, np.exp(-theory * (seconds - seconds[0])), ":", color=line.get_color())
        rows.append(f"| {substance.name} | {rate:.2f} | {theory:.2f} |")
    axes.set(xlabel="time [s]", ylabel="angular momentum", ylim=(5e-3, 1.2))
    axes.legend(title="dotted: Stokes flow")
    save(figure, "viscosity")
    return {"viscosity": table("substance | rate | Stokes", rows)}


def scaling() -> Texts:
    """Measure time and memory for 100 ml in a beaker at rest, each number in its own process."""
    counts = (500, 1000, 2000, 4000, 8000)
    with multiprocessing.get_context("spawn").Pool(1, maxtasksperchild=1) as pool:
        found = pool.map(cost, counts, chunksize=1)
    _, milliseconds, megabytes, _ = zip(*found, strict=True)
    figure, axes = plt.subplots(1, 2, figsize=(6.4, 2.6), layout="constrained")
    for part, numbers, unit in zip(axes, (milliseconds, megabytes), ("ms", "MB"), strict=True):
        part.plot(counts, numbers, "o-")
        part.plot([0, counts[-1]], [0, counts[-1] * numbers[-1] / counts[-1]], ":", color="gray")
        what = "time per step" if unit == "ms" else "memory"
        part.set(xlabel="particles", ylabel=f"{what} [{unit}]", xlim=0, ylim=0)
    save(figure, "scaling")
    rows = [
        f"| {count:,} | {hertz} | {step:.2f} | {1e3 / hertz / step:.1f} | {used:.1f} | {left:.0f} |"
        for count, (hertz, step, used, left) in zip(counts, found, strict=True)
    ]
    return {
        "scaling": table(
            "particles | steps per s | ms per step | times real time | MB | speed [mm/s]", rows
        )
    }


def cost(count: int) -> tuple[int, float, float, float]:
    """Return steps per second, time of one [ms], most memory [MB], and the speed left [mm/s]."""
    filled(beaker("glass"), Filling(100.0), 1)  # so that all is loaded
    Path("/proc/self/clear_refs").write_text("5")  # the peak counts from here on (proc(5))
    before = memory("VmRSS")
    _, _, liquid = filled(beaker("glass"), Filling(100.0), count)
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
    found = json.loads(file.read_text())
    text = "{crossings} crossings and {lost_particles} lost in {particle_steps:,} particle steps "
    text += "({episodes:,} episodes of 10 s); {left_through_the_mouth:,} left through the mouth. "
    text += "The solver diverged in {diverged} episodes, which ended there."
    return {"leaks": text.format(**found)}


def world(
    *vessels: Vessel, walls: Sequence[tuple[object, object]] = ()
) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Compile a bench with vessels and boxes (position and half lengths [m])."""
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=(5, 5, 0.1))
    for position, size in walls:
        spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, pos=position, size=size)
    for vessel in vessels:
        vessel.add_to(spec, spec.worldbody).add_freejoint()
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    return model, data


def filled(
    vessel: Vessel, filling: Filling, count: int = 1000, height: float = 0.0
) -> tuple[mujoco.MjModel, mujoco.MjData, Liquid]:
    """Return a vessel that stands at a height [m], with liquid at rest in it."""
    model, data = world(vessel)
    data.qpos[2] = height
    mujoco.mj_kinematics(model, data)
    liquid = Liquid(model, data, [vessel], filling, count)
    liquid.fill({vessel: filling}, np.random.default_rng(SEED))
    return model, data, liquid


def speed(liquid: Liquid) -> float:
    """Return the root mean square speed [m/s]."""
    return float(np.sqrt((liquid.velocities**2).sum(axis=1).mean()))


def surface(liquid: Liquid) -> tuple[float, float]:
    """Fit a plane to the highest particle of every cell; return its height [m] and slope [rad]."""
    spacing = liquid.volume ** (1 / 3)
    positions = liquid.positions[np.argsort(liquid.positions[:, 2])]
    cells = np.floor(positions[:, :2] / (1.5 * spacing)).astype(int)
    highest = positions[list({tuple(cell): index for index, cell in enumerate(cells)}.values())]
    # Cells that hang over the wall catch no surface.
    highest = highest[highest[:, 2] > np.median(highest[:, 2]) - 1.5 * spacing]
    plane, *_ = np.linalg.lstsq(np.insert(highest[:, :2], 2, 1.0, axis=1), highest[:, 2])
    return float(highest[:, 2].mean() + spacing / 2), float(np.arctan(np.hypot(*plane[:2])))


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
