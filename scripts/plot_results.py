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
    every = [dict(zip(table.head, line, strict=True)) for line in table.lines]
    lines = [of for of in every if any(isinstance(of[policy], Rate) for policy in COLOURS)]
    names = [f"{of['Task']}, {of['Condition']}".replace(", id", "") for of in lines]
    figure, axes = plt.subplots(figsize=(8, 0.27 * len(lines) + 0.8))
    for place, (policy, colour) in enumerate(COLOURS.items()):
        rates = [(row, of[policy]) for row, of in enumerate(lines)]
        known = [(row, rate) for row, rate in rates if isinstance(rate, Rate)]
        y = [row + 0.22 * (place - 1) for row, _ in known]
        low, high = (100 * np.array([rate.interval[end] for _, rate in known]) for end in (0, 1))
        axes.hlines(y, low, high, color=colour, alpha=0.45, linewidth=2.5)
        axes.plot([rate.percent for _, rate in known], y, "o", color=colour, ms=4.5, label=policy)
    axes.set(xlim=(-2, 102), ylim=(len(lines) - 0.4, -0.6), xlabel="successes of 120 episodes [%]")
    axes.set_yticks(range(len(lines)), names, fontsize=8)
    axes.grid(axis="x", color="#dddddd")
    axes.set_axisbelow(True)
    axes.spines[["top", "right", "left"]].set_visible(False)
    axes.tick_params(axis="y", length=0)
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, 1.05), ncols=3, frameon=False)
    figure.savefig(PICTURE, dpi=110, bbox_inches="tight")
    Image.open(PICTURE).convert("RGB").quantize(64).save(PICTURE, optimize=True)


if __name__ == "__main__":
    main()
