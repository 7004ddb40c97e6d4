"""Reading a plan: a mistake in a file is reported by its place in it."""

from pathlib import Path

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.foreign_files import checked, parse_json, read_text
from labutopia_lerobot.scenes.finishes import FLOOR_FINISHES, WALL_FINISHES
from labutopia_lerobot.scenes.plan import Plan
from labutopia_lerobot.substances.substance import substance

SMALLEST, LARGEST = 1.0, 100.0
"""Lengths that a room may have [m]: the hundred rooms have 3 to 14.5 m."""

MOST_PARTS = 500
"""Walls, openings, pieces or ware of a room at most."""


class PlanError(UserError, ValueError):
    """A room that cannot be; the message names what is wrong and where."""


def read_plan(path: Path) -> Plan:
    """Return the plan in a file; `proof.faults` says whether it can be furnished so.

    Raises:
        PlanError: If it cannot be read, is no plan, or names what does not exist.
    """
    return plan_from(read_text(path, PlanError), str(path))


def plan_from(text: str, source: str) -> Plan:
    """Return the plan that a text describes.

    Args:
        text: JSON, as `text_of` writes it.
        source: Where it is from, for messages.

    Raises:
        PlanError: If it is no plan, or names what does not exist.
    """
    plan: Plan = checked(Plan, parse_json(text, source, PlanError), source, PlanError)
    _check_sizes(plan, source)
    _check_names(plan, source)
    return plan


def _check_sizes(plan: Plan, source: str) -> None:
    for size in plan.size:
        if not SMALLEST <= size <= LARGEST:
            raise PlanError(
                f"{source}: a size of {size:g} m; rooms have {SMALLEST:g} to {LARGEST:g} m"
            )
    for name in ("walls", "openings", "pieces", "work_places", "ware"):
        parts = getattr(plan, name)
        if len(parts) > MOST_PARTS:
            raise PlanError(f"{source}: {len(parts)} {name}; a room has at most {MOST_PARTS}")
        for place, part in enumerate(parts):
            for value in vars(part).values():
                for number in value if isinstance(value, tuple) else (value,):
                    if isinstance(number, float) and not abs(number) <= LARGEST:
                        raise PlanError(
                            f"{source}, {name}[{place}]: {number:g} is no length in a room, which "
                            f"has at most {LARGEST:g} m"
                        )


def _check_names(plan: Plan, source: str) -> None:
    from labutopia_lerobot.labware.instrument_catalogue import catalogue, instrument  # here: mujoco

    for look, finishes in (("floor", FLOOR_FINISHES), ("wall", WALL_FINISHES)):
        if (name := getattr(plan, look)) not in finishes:
            raise PlanError(f"{source}: {look} '{name}' is unknown. Choose: {', '.join(finishes)}")
    known: set[str] = set()
    for place, piece in enumerate(plan.pieces):
        where = f"{source}, pieces[{place}]"
        if piece.kind not in catalogue():
            try:
                instrument(piece.kind)
            except UserError as error:
                raise PlanError(f"{where}: {error}") from error
        if piece.name in known:
            raise PlanError(f"{where}: the name '{piece.name}' is taken; give it another")
        if piece.on is not None and piece.on not in known:
            raise PlanError(
                f"{where}: '{piece.name}' stands on '{piece.on}', which is no piece before it"
            )
        known.add(piece.name)
    _check_ware(plan, known, source)
    benches = {piece.name for piece in plan.pieces if piece.kind == "work_bench"}
    for number, work in enumerate(plan.work_places):
        if work.bench not in benches:
            raise PlanError(
                f"{source}, work_places[{number}]: '{work.bench}' is no work bench of this room; "
                f"it has: {', '.join(sorted(benches)) or 'none'}"
            )
    if not any(opening.kind == "door" for opening in plan.openings[:1]):
        raise PlanError(f"{source}: the first of openings must be the door by which one enters")


def _check_ware(plan: Plan, known: set[str], source: str) -> None:
    from labutopia_lerobot.scenes.space.ware_room import closure_of, made  # here: mujoco

    pieces = set(known)
    for place, ware in enumerate(plan.ware):
        where = f"{source}, ware[{place}]"
        try:
            made(ware.kind, ware.size)
            if ware.closed:
                closure_of(ware.kind, ware.size)
            if ware.contents:
                substance(ware.contents)
        except UserError as error:
            raise PlanError(f"{where}: {error}") from error
        if ware.name in known:
            raise PlanError(f"{where}: the name '{ware.name}' is taken; give it another")
        if ware.on not in pieces:
            raise PlanError(f"{where}: '{ware.name}' stands on '{ware.on}', which is no piece")
        if not 0.0 <= ware.level <= 0.9:
            raise PlanError(f"{where}: a level of {ware.level:g}; what a vessel holds has 0 to 0.9")
        known.add(ware.name)
