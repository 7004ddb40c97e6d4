"""`python scripts/make_vocabulary.py`: `docs/vocabulary.md`, all words that a task can be made of.

Everything is read from the package: nothing is listed here but the chapters.
"""

import importlib
import inspect
import math
import pkgutil
import re
from collections.abc import Iterator
from dataclasses import is_dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

from labutopia_lerobot import (
    layout,
    places,
    predicates,
    skills,
    substances,
    task,
    world,
)
from labutopia_lerobot.labware.glass.catalogue import closed, glassware, ware
from labutopia_lerobot.labware.glass.profile import Profile
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.labware.parts import form
from labutopia_lerobot.labware.parts.finish import FINISHES
from labutopia_lerobot.labware.parts.instrument import Equipment, Instrument
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.robots import ROBOTS
from labutopia_lerobot.scenes import starts_in_rooms
from labutopia_lerobot.skills import posture, skill
from labutopia_lerobot.substances import filling
from labutopia_lerobot.tasks import actions, failures
from piece_pictures import makers, needs_only_a_name, picture
from word_tables import (
    asks,
    attributes,
    cell,
    code,
    functions,
    members,
    pieces,
    summary,
    with_attributes,
)

DOCS = Path(__file__).parents[1] / "docs"
PAGE = DOCS / "vocabulary.md"
PICTURES = DOCS / "vocabulary"


def main() -> None:
    """Write the page and its pictures."""
    PAGE.write_text(page())
    PICTURES.mkdir(exist_ok=True)
    for file in PICTURES.glob("*.png"):
        file.unlink()
    for make in filter(needs_only_a_name, makers()):
        picture(make("thing")).save(PICTURES / f"{make.__name__}.png", optimize=True)


def page() -> str:
    """Return the page in Markdown."""
    chapters = list(_chapters())
    return "\n".join([*chapters, *_kinds("\n".join(chapters))]).rstrip() + "\n"


def _chapters() -> Iterator[str]:
    yield "# Vocabulary"
    yield ""
    yield "[To the README](../README.md)"
    yield ""
    yield "Made by `python scripts/make_vocabulary.py` from the package; do not edit. How a task"
    yield "is made: [tutorial.md](tutorial.md). Units are in brackets; else metres and radians,"
    yield "unless a name says others. Predicates, skills and pieces of your own may stand in your"
    yield "task file."
    yield ""
    yield from _chapter("Task, step, substep", "labutopia_lerobot.task")
    kinds = (predicates.Predicate, predicates.Count, predicates.Transfer)
    for kind in (task.Task, task.Step, task.Substep, *kinds):
        yield from with_attributes(kind)
    yield "`~fact` is the fact that a predicate does not hold."
    yield ""
    yield from _chapter("Pieces", "labutopia_lerobot", "the modules below of")
    yield from pieces()
    yield from _chapter("Glass and plastic ware", glassware.__module__)
    yield "[glassware.md](glassware.md) has every kind and size."
    yield ""
    yield from functions((glassware, closed, ware))
    yield from _chapter("Glass of your own", Vessel.__module__)
    yield from with_attributes(Vessel)
    yield from _from(Profile.__module__)
    yield from with_attributes(Profile)
    yield from _chapter("Instruments of your own", Equipment.__module__)
    yield from _instrument()
    yield from _from(form.__name__)
    for kind in _dataclasses(form, having="primitives"):
        yield from with_attributes(kind)
    yield f"Finishes of forms: {', '.join(f'`{name}`' for name in FINISHES)}."
    yield ""
    yield from _from(Seat.__module__)
    yield from with_attributes(Seat)
    yield from _chapter("Where pieces start", "labutopia_lerobot.layout")
    for module in (layout, starts_in_rooms):
        for kind in _dataclasses(module, having="sample"):
            yield from with_attributes(kind)
    yield from _chapter("What vessels hold", "labutopia_lerobot.substances.filling")
    yield from with_attributes(filling.Filling)
    yield from _chapter("Places", "labutopia_lerobot.places")
    for kind in _dataclasses(places, having="position_w"):
        yield from with_attributes(kind)
    yield from _chapter("Actions", "labutopia_lerobot.tasks.actions")
    yield from functions(f for f in vars(actions).values() if _defined_in(f, actions))
    yield from _chapter("Failures", "labutopia_lerobot.tasks.failures")
    yield from functions(f for f in vars(failures).values() if _defined_in(f, failures))
    yield from _chapter("Predicates", "labutopia_lerobot.predicates")
    facts = (getattr(predicates, name) for name in predicates.__all__)
    yield from functions(fact for fact in facts if not inspect.isclass(fact))
    yield from _chapter("Skills", "labutopia_lerobot.skills")
    for name in skills.__all__:
        yield from with_attributes(getattr(skills, name))
    yield from _chapter("For predicates of your own: the world", "labutopia_lerobot.world")
    for kind in (world.World, world.Pose, world.LiquidAccount, world.Manipulator):
        yield from members(kind)
    yield from _robots()
    yield from _chapter("For skills of your own: phases", "labutopia_lerobot.skills.skill")
    yield from members(skill.Skill)
    yield from with_attributes(skill.Phase)
    yield from functions(f for f in vars(skill).values() if _defined_in(f, skill))
    yield from _from("labutopia_lerobot.skills.posture")
    yield from functions(f for f in vars(posture).values() if _defined_in(f, posture))
    yield "`FROM_ABOVE` is the approach of a hand that points down."
    yield ""
    yield from _from("labutopia_lerobot.world")
    yield from with_attributes(world.Approach)


def _instrument() -> Iterator[str]:
    """Yield what an instrument of one's own says of itself, and what it may have."""
    helps = attributes(Equipment)
    yield f"### {Instrument.__name__}"
    yield ""
    yield "A frozen dataclass of these; its method `_forms` returns what stands still. Origin: the"
    yield "centre of its base, z up; its front faces -x: left is +y."
    yield ""
    yield "| argument | meaning |"
    yield "| --- | --- |"
    for name in inspect.get_annotations(Equipment):
        yield f"| {code(name)} | {cell(helps[name])} |"
    for name, member in vars(Equipment).items():
        if isinstance(member, property):
            yield f"| {code(name)} | {cell(summary(member))} |"
    yield ""


def _chapter(title: str, module: str, where: str = "") -> list[str]:
    return [f"## {title}", "", *_from(module, where)]


def _from(module: str, where: str = "") -> list[str]:
    """Return the line that says where the names behind it are imported from."""
    return [f"From {where}{' ' * bool(where)}`{module}`.", ""]


def _dataclasses(module: ModuleType, having: str) -> list[type]:
    """Return the dataclasses that a module defines and that have a method of this name."""
    members = vars(module).values()
    return [m for m in members if is_dataclass(m) and _defined_in(m, module) and hasattr(m, having)]


def _defined_in(member: Any, module: ModuleType) -> bool:
    public = not getattr(member, "__name__", "_").startswith("_")
    return (
        public
        and callable(member)
        and member.__module__ == module.__name__
        and (inspect.isfunction(member) or is_dataclass(member))
    )


def _robots() -> Iterator[str]:
    """Yield what `World.robot` says of every robot."""
    yield "What `world.robot` is, in millimetres and degrees (yaw is to the left, pitch down):"
    yield ""
    yield "| robot | pads open to | fingers beyond the frame | at vessels | at handles |"
    yield "| --- | --- | --- | --- | --- |"
    for robot in ROBOTS.values():
        lengths = (f"{1e3 * length:g} mm" for length in (robot.max_opening, robot.finger_reach))
        ways = (
            f"yaw {math.degrees(way.yaw):.0f}, pitch {math.degrees(way.pitch):.0f}"
            for way in (robot.vessel_approach, robot.handle_approach)
        )
        yield f"| {' | '.join([code(robot.name), *lengths, *ways])} |"
    yield ""


def _kinds(page: str) -> Iterator[str]:
    """Yield a table of the protocols that a page mentions: what is asked of a thing."""
    yield "## Kinds of things"
    yield ""
    yield "What predicates, skills and places ask of what they are given: types for annotations."
    yield "Whatever has what is asked for is one; nothing is inherited."
    yield ""
    yield "| kind | has | meaning |"
    yield "| --- | --- | --- |"
    for module, kind in _protocols(world, layout, places, predicates, skills, substances):
        if re.search(rf"\b{kind.__name__}\b", page) and f"### {kind.__name__}\n" not in page:
            name = f"{code(kind.__name__)}<br>from {code(module)}"
            yield f"| {name} | {', '.join(asks(kind).values())} | {cell(summary(kind))} |"
    yield ""


def _protocols(*rooms: ModuleType) -> Iterator[tuple[str, type]]:
    """Yield the protocols that modules, and those in packages, define, and where they come from."""
    for room in rooms:
        inside = pkgutil.iter_modules(getattr(room, "__path__", []), f"{room.__name__}.")
        for name in (room.__name__, *(module.name for module in inside)):
            for member in vars(importlib.import_module(name)).values():
                own = getattr(member, "__module__", None) == name
                if own and inspect.isclass(member) and getattr(member, "_is_protocol", False):
                    known = hasattr(room, member.__name__)  # the package hands it on
                    yield room.__name__ if known else name, member


if __name__ == "__main__":
    main()
