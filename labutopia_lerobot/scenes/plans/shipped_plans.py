"""The rooms that are in the package."""

import difflib
from functools import cache
from pathlib import Path

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.scenes.plan import Plan
from labutopia_lerobot.scenes.plans.plan_files import read_plan

FOLDER = Path(__file__).parent
"""Folder of the plans, a file each."""


class UnknownPlanError(UserError, ValueError):
    """A room that is not in the package, and no file either."""


@cache
def plan_names() -> tuple[str, ...]:
    """Return the names of all rooms, in alphabetical order."""
    return tuple(sorted(file.stem for file in FOLDER.glob("*.json")))


@cache
def load_plan(name: str) -> Plan:
    """Return a room of the package.

    Raises:
        UnknownPlanError: If there is none of this name.
    """
    if name not in plan_names():
        near = difflib.get_close_matches(name, plan_names(), n=1, cutoff=0.5)
        hint = f" Did you mean '{near[0]}'?" if near else ""
        raise UnknownPlanError(
            f"Room '{name}' is unknown.{hint} `labutopia-scene list` names all {len(plan_names())}"
        )
    return read_plan(FOLDER / f"{name}.json")


def find_plan(name_or_file: str) -> Plan:
    """Return a room of the package by its name, or that of a file by its path.

    Raises:
        UnknownPlanError: If it is neither.
        PlanError: If the file is no plan.
    """
    if name_or_file.endswith(".json") or "/" in name_or_file:
        return read_plan(Path(name_or_file))
    return load_plan(name_or_file)
