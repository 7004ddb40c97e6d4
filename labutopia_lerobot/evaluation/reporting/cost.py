"""What a wanted precision costs, as a table."""

from labutopia_lerobot.evaluation.reporting.table import Table
from labutopia_lerobot.evaluation.uncertainty.planning import anytime_episodes_for, episodes_for

_RATES = (0.5, 0.7, 0.8, 0.9, 0.95, 0.99)
"""Rates of success; of 10 % it takes as many episodes as of 90 %."""


def cost_table(half_width: float, settings: int) -> Table:
    """Return how many episodes an interval of a half width takes, by the rate of success.

    Args:
        half_width: Half of the width of the 95 % interval, such as 0.05.
        settings: Number of tasks and splits that are played.

    Raises:
        PrecisionError: If no interval of a rate can be that narrow.
    """
    lines = []
    for rate in _RATES:
        fixed, anytime = episodes_for(half_width, rate), anytime_episodes_for(half_width, rate)
        shared = f"{100 * rate:g} %" + (f" or {100 * (1 - rate):g} %" if rate != 0.5 else "")
        lines.append((shared, fixed, anytime, fixed * settings, anytime * settings))
    head = ("Successes", "episodes=", "until=", "episodes= in all", "until= in all")
    note = (
        "episodes=: a number fixed beforehand (Wilson interval); 50 % is safe whatever the rate. "
        f"until={half_width:g}: stops by itself, and pays for looking at every episode. In all: "
        f"over {settings} tasks and splits."
    )
    title = f"Episodes for a success rate to plus or minus {100 * half_width:g} points (95 %)"
    return Table(title, head, tuple(lines), note)
