"""`labutopia-scene list`: instruments (furniture included), glassware, families and rooms."""

import argparse
import json

from rich.console import Console


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
    found = everything()
    if arguments.json:
        console.print(json.dumps(found, indent=2), markup=False)
        return
    for what, names in found.items():
        console.print(f"{len(names)} {what}: {', '.join(names)}", markup=False)


def everything() -> dict[str, list[str]]:
    """Return sorted names by what they are; glassware as `kind size`."""
    from labutopia_lerobot.labware import catalogue  # here: they bring mujoco
    from labutopia_lerobot.labware.glass import catalogue as glass
    from labutopia_lerobot.scenes.families import families
    from labutopia_lerobot.scenes.plans import plan_names

    ware = [f"{kind} {size}" for kind, series in glass.catalogue().items() for size in series.sizes]
    return {
        "instruments": sorted(catalogue.catalogue()),
        "glassware": sorted(ware),
        "families": sorted(families()),
        "rooms": sorted(plan_names()),
    }
