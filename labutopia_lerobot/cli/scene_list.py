"""`labutopia-scene list`: instruments (furniture included), glassware, families and rooms."""

import argparse
import json
import re
import textwrap

from rich.console import Console

_WIDTH = 100
"""Columns of a line at most."""
_UNBROKEN = "\N{NO-BREAK SPACE}"
"""Keeps an amount and its unit together."""


def add_list(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the command `list`; `run` of what it parses does it."""
    parser = commands.add_parser(
        "list",
        help="list instruments, glassware, families and rooms",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--json", action="store_true", help="as JSON: four sorted lists")
    parser.set_defaults(run=_run)


def _run(arguments: argparse.Namespace) -> None:
    """Print what there is."""
    console = Console(highlight=False, soft_wrap=True)
    listing = everything()
    if arguments.json:
        console.print(json.dumps(listing, indent=2), markup=False)
        return
    width = min(console.width, _WIDTH)
    for what, names in listing.items():
        console.print(f"{len(names)} {what}:", markup=False)
        for line in _lines(what, names):
            wrapped = textwrap.fill(
                line, width, initial_indent="  ", subsequent_indent="    ", break_on_hyphens=False
            )
            console.print(wrapped.replace(_UNBROKEN, " "), markup=False)


def _lines(what: str, names: list[str]) -> list[str]:
    """Return names as paragraphs: sizes by their kind of glass, rooms by their family."""
    apart = {"glassware": " ", "rooms": "_"}.get(what)
    if apart is None:
        return [", ".join(names)]
    groups: dict[str, list[str]] = {}
    for name in names:
        kind = name.partition(apart)[0] if apart == " " else name.rpartition(apart)[0]
        groups.setdefault(kind, []).append(name)
    if what == "rooms":
        return [", ".join(group) for group in groups.values()]
    return [
        f"{kind}: {', '.join(_unbroken(name.partition(apart)[2]) for name in group)}"
        for kind, group in groups.items()
    ]


def _unbroken(size: str) -> str:
    return size.replace(" ", _UNBROKEN)


def _by_number(name: str) -> list[tuple[bool, float, str]]:
    """Return what sorts `organic_10` behind `organic_9`."""
    parts = re.findall(r"\d+(?:\.\d+)?|[^\d]+", name)
    return [(part[0].isdigit(), float(part) if part[0].isdigit() else 0.0, part) for part in parts]


def everything() -> dict[str, list[str]]:
    """Return sorted names by what they are; glassware as `kind size`."""
    from labutopia_lerobot.labware import instrument_catalogue  # here: they bring mujoco
    from labutopia_lerobot.labware.glass import catalogue as ware_catalogue
    from labutopia_lerobot.scenes.families import families
    from labutopia_lerobot.scenes.plans import plan_names

    ware = [
        f"{kind} {size}"
        for kind, series in ware_catalogue.catalogue().items()
        for size in series.sizes
    ]
    return {
        "instruments": sorted(instrument_catalogue.catalogue()),
        "glassware": sorted(ware, key=_by_number),
        "families": sorted(families()),
        "rooms": sorted(plan_names(), key=_by_number),
    }
