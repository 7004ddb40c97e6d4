"""`python scripts/plot_results.py`: pictures of successes on state for docs/results.md.

`docs/results/successes.png` has every task, `curves.png` success over demonstrations.
"""

from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.figure import Figure
from PIL import Image

from labutopia_lerobot.evaluation.reporting.table import Rate
from make_results import PAGE, measured

FOLDER = PAGE.parent / "results"
COLOURS = {"act": "#1f6f8b", "mlp": "#e08e45", "diffusion": "#8a5a9e"}
"""Of each policy, in the order in which they stand above each other."""


def main() -> None:
    """Draw both pictures."""
    _save(successes(), FOLDER / "successes.png")
    _save(curves(), FOLDER / "curves.png")


def successes() -> Figure:
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
    return figure


def curves() -> Figure:
    """Draw success over demonstrations: a panel per task, a line and its intervals per policy."""
    drawn = {task: lines for task, lines in _by_demonstrations().items() if lines}
    figure, panels = plt.subplots(
        1, len(drawn), figsize=(3.2 * len(drawn), 3.0), sharey=True, squeeze=False
    )
    for axes, (task, lines) in zip(panels[0], drawn.items(), strict=True):
        counts = sorted({count for rates in lines.values() for count in rates})
        for policy, rates in lines.items():
            x, known = sorted(rates), [rates[count] for count in sorted(rates)]
            ends = (100 * np.array([rate.interval[end] for rate in known]) for end in (0, 1))
            axes.fill_between(x, *ends, color=COLOURS[policy], alpha=0.18, linewidth=0)
            percents = [rate.percent for rate in known]
            axes.plot(x, percents, "o-", color=COLOURS[policy], ms=4.5, label=policy)
        axes.set(xscale="log", ylim=(-3, 103), title=task, xlabel="demonstrations")
        axes.set_xticks(counts, [str(count) for count in counts])
        axes.minorticks_off()
        axes.grid(color="#dddddd")
        axes.spines[["top", "right"]].set_visible(False)
    panels[0][0].set_ylabel("successes of 120 episodes [%]")
    panels[0][0].legend(loc="lower right", frameon=False)
    return figure


def _by_demonstrations() -> dict[str, dict[str, dict[int, Rate]]]:
    """Return task -> policy -> demonstrations -> rate, of curves with two points or more."""
    kept, of = measured("results_cpu"), dict[str, dict[str, dict[int, Rate]]]()
    for each in kept.evaluations:
        rate = kept.rate(each)
        usual = each.at is None and not each.repeat and each.play == "single"
        if usual and each.demonstrations and each.shift.name == "id" and isinstance(rate, Rate):
            line = of.setdefault(each.task, {}).setdefault(each.label, {})
            line[each.demonstrations] = rate
    return {
        task: {policy: rates for policy, rates in lines.items() if len(rates) > 1}
        for task, lines in of.items()
    }


def _save(figure: Figure, picture: Path) -> None:
    figure.savefig(picture, dpi=110, bbox_inches="tight")
    Image.open(picture).convert("RGB").quantize(64).save(picture, optimize=True)


if __name__ == "__main__":
    main()
