"""`labutopia-chem COMPOUND...`: what happens when compounds meet, and what one sees.

A compound is a name, formula, synonym or CAS number, and behind a colon how much of it, if not
--volume of --concentration: "hydrochloric acid: 0.2M 50ml", "zinc: 0.5g", "water: 1mol".
`labutopia-chem list [WORD]` and `labutopia-chem show NAME` are about the compounds themselves.
`labutopia-chem ask TASK --out FILE.json` keeps a language model's answers for reasoner=FILE.json.
"""

import argparse
import json
import sys
from collections.abc import Mapping

from rich.console import Console

from labutopia_lerobot.chemistry import Conditions, Outcome, react
from labutopia_lerobot.chemistry.network import WATER
from labutopia_lerobot.chemistry.output import amounts_form, paper_form
from labutopia_lerobot.cli.chem_ask import add_ask
from labutopia_lerobot.cli.chem_compounds import add_list, add_show
from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.grammar import ABOUT, OptionParser
from labutopia_lerobot.cli.quantities import concentration, portion, temperature, volume
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.foreign_files import printable

_COMMANDS = {"list": add_list, "show": add_show, "ask": add_ask}
_TRUTH = {"true": True, "false": False}
_WORTH_SAYING = 1e-3
"""Share of the largest amount from which on a summary names a species; ours."""
_TRACE = 1e-8
"""The same of the water: five times what it gives of ions by itself at pH 7."""


class ChemistryOptionError(UserError, ValueError):
    """An option that says nothing that can be; the message says what can."""


@clear_errors
def main() -> None:
    """Do what the command line names."""
    words = sys.argv[1:]
    if words and words[0] in _COMMANDS:
        parser: argparse.ArgumentParser = OptionParser(prog="labutopia-chem")
        commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
        for add in _COMMANDS.values():
            add(commands)
        arguments = parser.parse_args()
        arguments.run(arguments)
        return
    _react(_parser().parse_args())


def _parser() -> argparse.ArgumentParser:
    parser = OptionParser(
        prog="labutopia-chem",
        description=__doc__,
        epilog=ABOUT,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add = parser.add_argument
    add("compounds", nargs="+", metavar="COMPOUND", help="what is poured together")
    add("--concentration", default="0.1M", help="of each solution (default: 0.1M)")
    add("--volume", default="100ml", help="of each solution (default: 100ml)")
    add("--temperature", default="25C", help="before it meets, such as 25C or 298K (default: 25C)")
    add("--solvent", default="water", help="what the compounds are dissolved in (default: water)")
    add("--open-system", default="true", metavar="true|false", help="whether gas leaves")
    add("--catalysts", nargs="+", default=[], help="compounds that come out unchanged")
    add("--ph", help="what a buffer keeps the mixture at (default: worked out)")
    add("--json", action="store_true", help="print the paper's JSON, and nothing else")
    add("--amounts", action="store_true", help="with --json: also amounts, heat, pH, in SI units")
    add("--reasoner", default="rules", help="rules, or llm: a language model (default: rules)")
    add("--model", help="of llm: what its server calls it (default: LABUTOPIA_MODEL)")
    add("--base-url", metavar="URL", help="of llm: its address (default: LABUTOPIA_MODEL_URL)")
    add("--timeout", default="60", metavar="S", help="of llm: given up after [s] (default: 60)")
    add("--cached-only", action="store_true", help="of llm: use kept answers, ask nobody")
    return parser


def _react(arguments: argparse.Namespace) -> None:
    conditions = Conditions(
        solvent=arguments.solvent,
        temperature=temperature(arguments.temperature),
        concentration=concentration(arguments.concentration),
        open_system=_truth("open_system", arguments.open_system),
        catalysts=tuple(arguments.catalysts),
        ph=None if arguments.ph is None else _number("ph", arguments.ph),
    )
    each = volume(arguments.volume)
    portions = [portion(text, each, conditions.concentration) for text in arguments.compounds]
    if arguments.reasoner == "llm":
        from labutopia_lerobot.chemistry.language_model import LanguageModel  # here: takes a second

        model = LanguageModel.of_environment(
            arguments.model,
            arguments.base_url,
            _number("timeout", arguments.timeout),
            arguments.cached_only,
        )
        outcome = react(portions, conditions, "llm", model)
    else:
        outcome = react(portions, conditions, arguments.reasoner)
    out, err = (Console(stderr=e, highlight=False, soft_wrap=True) for e in (False, True))
    if not arguments.json:
        _summarise(outcome, conditions, out)
        return
    content = paper_form(outcome)
    if arguments.amounts:
        content |= {"amounts": amounts_form(outcome)}
    out.print(json.dumps(content, indent=2, ensure_ascii=False), markup=False)
    if outcome.note:
        err.print(f"Note: {printable(outcome.note)}", markup=False)


def _summarise(outcome: Outcome, conditions: Conditions, out: Console) -> None:
    """Print an outcome for a person to read."""

    def line(text: str) -> None:
        out.print(printable(text), markup=False)

    for reaction in outcome.reactions:
        line(f"{reaction.reaction_type}: {reaction.stoichiometry}")
        for product in reaction.expected_products:
            much = f", {product.qualitative_yield} yield" if product.qualitative_yield else ""
            line(f"  {product.compound_name} ({product.chemical_formula}, {product.phase}){much}")
        if reaction.observable_changes:
            line(f"  One sees: {'; '.join(reaction.observable_changes)}")
        line(f"  {reaction.rationale} (confidence {reaction.confidence_score:.2g})")
    if not outcome.reactions:
        line("Nothing reacts.")
    amounts = outcome.amounts
    change = amounts.temperature - conditions.temperature
    ph = "" if amounts.ph is None else f"pH {amounts.ph:.2f}, "
    line(
        f"{ph}{amounts.temperature - 273.15:.1f} C ({change:+.1f} C), "
        f"{amounts.volume * 1e6:.4g} ml of liquid"
    )
    line(f"It holds: {_contents(amounts.after)}")
    if outcome.note:
        line(f"Note: {outcome.note}")


def _contents(amounts: Mapping[str, float]) -> str:
    """Return what is in a mixture beside water, the most first; gas has left it."""
    held = {key: mol for key, mol in amounts.items() if key != WATER and not key.endswith("(g)")}
    least = max(_WORTH_SAYING * max(held.values(), default=0.0), _TRACE * amounts.get(WATER, 0.0))
    rounded = {key: float(f"{1e3 * mol:.3g}") for key, mol in held.items() if mol > least}
    most = sorted(rounded, key=lambda key: (-rounded[key], key))
    listed = [f"{key.removesuffix('(aq)')} {rounded[key]:g} mmol" for key in most]
    return ", ".join(listed) or "nothing but water"


def _truth(name: str, text: str) -> bool:
    if text.lower() not in _TRUTH:
        raise ChemistryOptionError(f"{name}={text} is neither true nor false")
    return _TRUTH[text.lower()]


def _number(name: str, text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise ChemistryOptionError(f"{name}={text} is no number") from None


if __name__ == "__main__":
    main()
