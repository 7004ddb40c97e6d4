"""Plans as files: `organic_0.json` in this folder is the room `organic_0`; how they are read."""

from labutopia_lerobot.scenes.plans.plan_files import PlanError, plan_from, read_plan
from labutopia_lerobot.scenes.plans.shipped_plans import (
    UnknownPlanError,
    find_plan,
    load_plan,
    plan_names,
)
from labutopia_lerobot.scenes.plans.writing import text_of

__all__ = [
    "PlanError",
    "UnknownPlanError",
    "find_plan",
    "load_plan",
    "plan_from",
    "plan_names",
    "read_plan",
    "text_of",
]
