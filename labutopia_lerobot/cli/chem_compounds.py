"""`labutopia-chem list` and `show`: the compounds that the engine knows."""

import argparse
import json

from rich.console import Console

from labutopia_lerobot.chemistry.chem_db import record
from labutopia_lerobot.chemistry.compound import Compound, substances
from labutopia_lerobot.chemistry.names import resolve


def add_list(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the command `list`; `run` of what it parses does it."""
    parser = commands.add_parser("list", help="list compounds, or those that have a word")
    parser.add_argument("word", nargs="?", default="", help="part of a name, formula or class")
    parser.add_argument("--json", action="store_true", help="as JSON: the paper's records")
    parser.set_defaults(run=_list)


def add_show(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the command `show`; `run` of what it parses does it."""
    parser = commands.add_parser("show", help="show what is known of a compound")
    parser.add_argument("name", help="name, formula, synonym, CAS number or id")
    parser.add_argument("--json", action="store_true", help="as JSON: the paper's record")
    parser.set_defaults(run=_show)


def _list(arguments: argparse.Namespace) -> None:
    word = arguments.word.casefold()
    chosen = [one for one in substances().values() if any(word in text for text in _texts(one))]
    console = Console(highlight=False, soft_wrap=True)
    if arguments.json:
        _print_json(console, [record(one) for one in chosen])
        return
    for one in sorted(chosen, key=lambda one: one.name.casefold()):
        console.print(f"{one.name}, {one.formula}", markup=False)
    console.print(f"{len(chosen)} of {len(substances())} compounds", markup=False)


def _texts(one: Compound) -> tuple[str, ...]:
    """Return what a word is looked for in."""
    texts = (one.name, one.formula, one.id, *one.synonyms, *one.reactivity)
    return tuple(text.casefold() for text in texts)


def _show(arguments: argparse.Namespace) -> None:
    compound = resolve(arguments.name)
    console = Console(highlight=False, soft_wrap=True)
    if arguments.json:
        _print_json(console, record(compound))
        return
    steps = ", ".join(f"{step.pka:g}" for step in compound.acidity)
    lines = {key.replace("_", " "): value for key, value in record(compound).items()}
    lines |= {
        "id": compound.id,
        "CAS": compound.cas,
        "also": ", ".join(compound.synonyms),
        "class": ", ".join(compound.reactivity),
        "pKa": steps,
        "hazards": ", ".join(compound.ghs),
    }
    for name, value in lines.items():
        console.print(f"{name + ':':<19}{value or '-'}", markup=False)


def _print_json(console: Console, content: object) -> None:
    console.print(json.dumps(content, indent=2, ensure_ascii=False), markup=False)
