"""`python scripts/plot_results.py`: docs/results/successes.png, every task's successes on state."""

import numpy as np
from matplotlib import pyplot as plt
from PIL import Image

from labutopia_lerobot.evaluation.reporting.table import Rate
from make_results import PAGE, measured

PICTURE = PAGE.parent / "results" / "successes.png"
COLOURS = {"act": "#1f6f8b", "mlp": "#e08e45", "diffusion": "#8a5a9e"}
"""Of each policy, in the order in which they stand above each other."""


def main() -> None:
    """Draw a line per task and condition, a dot and its interval per policy."""
    table = measured("results_cpu").by_task()
    places = {name: table.head.index(name) for name in COLOURS}
    lines = [
        (
            f"{task}, {played}" if played != "id" else str(task),
            dict(zip(table.head, line, strict=True)),
        )
        for line in table.lines
        for task, played in [line[:2]]
        if any(isinstance(line[place], Rate) for place in places.values())
    ]
    figure, axes = plt.subplots(figsize=(8, 0.27 * len(lines) + 0.8))
    rows = np.arange(len(lines))
    for shift, (policy, colour) in enumerate(COLOURS.items()):
        rates = [(row, of[policy]) for row, (_, of) in enumerate(lines)]
        known = [(row, rate) for row, rate in rates if isinstance(rate, Rate)]
        y = [row + 0.22 * (shift - 1) for row, _ in known]
        axes.hlines(
            y,
            [100 * rate.interval[0] for _, rate in known],
            [100 * rate.interval[1] for _, rate in known],
            color=colour,
            alpha=0.45,
            linewidth=2.5,
        )
        axes.plot([rate.percent for _, rate in known], y, "o", color=colour, ms=4.5, label=policy)
    axes.set(xlim=(-2, 102), ylim=(len(lines) - 0.4, -0.6), xlabel="successes of 120 episodes [%]")
    axes.set_yticks(rows, [name for name, _ in lines], fontsize=8)
    axes.grid(axis="x", color="#dddddd")
    axes.set_axisbelow(True)
    axes.spines[["top", "right", "left"]].set_visible(False)
    axes.tick_params(axis="y", length=0)
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, 1.05), ncols=3, frameon=False)
    figure.savefig(PICTURE, dpi=110, bbox_inches="tight")
    Image.open(PICTURE).convert("RGB").quantize(64).save(PICTURE, optimize=True)


if __name__ == "__main__":
    main()
