"""What a language model has answered about the solutions of tasks, kept in a file.

Who plays asks nobody: a model that is slow, lies or has changed stops no episode, and one file
gives one episode. `labutopia-chem ask` writes the file. A model knows no amounts: so it decides
which solids, gases, and products of redox and listed reactions form. How far they do, acids, bases
and complexes are the rules', and a product that the rules do not know does not form.

Rows and datasets call a file `MODEL@HASH`, as they call a room `STEM@HASH`. Such a name is known in
a process once it has read the file.
"""

import hashlib
import json
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import cache, cached_property
from itertools import combinations_with_replacement
from pathlib import Path

from labutopia_lerobot.chemistry.answer import require_possible
from labutopia_lerobot.chemistry.equation import Composition, composition, read_equation
from labutopia_lerobot.chemistry.formula import parse
from labutopia_lerobot.chemistry.names import resolve
from labutopia_lerobot.chemistry.network import network
from labutopia_lerobot.chemistry.reaction import Conditions, Reactant, Reaction
from labutopia_lerobot.chemistry.refusals import ChemistryError
from labutopia_lerobot.foreign_files import checked, parse_json, printable

_RULES = "rules"
"""As `setting.RULES`, which stands above."""

_SUFFIX = ".json"
_read: dict[str, "KeptAnswers"] = {}


class KeptAnswersError(ChemistryError):
    """A reasoner that cannot be; the message says what to choose or to ask."""


@dataclass(frozen=True)
class KeptAnswer:
    """What a model says of compounds that are poured together.

    Attributes:
        compounds: Their names, sorted.
        reactions: Those that it infers.
        failed: Why it has given no good answer, so that the rules say what reacts; else nothing.
    """

    compounds: tuple[str, ...]
    reactions: tuple[Reaction, ...] = ()
    failed: str = ""


@dataclass(frozen=True)
class KeptAnswers:
    """The answers of one model.

    Attributes:
        model: What its server calls it.
        answers: To each question that has been asked.
    """

    model: str
    answers: tuple[KeptAnswer, ...] = ()

    @cached_property
    def by_question(self) -> Mapping[tuple[str, ...], KeptAnswer]:
        """The answers by the names of the compounds."""
        return {answer.compounds: answer for answer in self.answers}

    def unanswered(self, vessels: Iterable[Collection[str]]) -> list[tuple[str, ...]]:
        """Return which questions about some vessels have not been asked.

        Args:
            vessels: Names of the compounds that each holds beside water.
        """
        return [one for one in questions(vessels) if one not in self.by_question]

    def require_of(self, model: str, file: Path) -> None:
        """Make sure that the answers are of a model, as one file holds those of one.

        Raises:
            KeptAnswersError: If they are of another.
        """
        if self.model != model:
            raise KeptAnswersError(
                f"{file} holds answers of {printable(self.model)}, not of {printable(model)}. "
                "Choose another --out"
            )

    def may_form(
        self, vessels: Iterable[Collection[str]]
    ) -> tuple[frozenset[Composition] | None, tuple[str, ...]]:
        """Return what may form of what some vessels hold, and what is to be said of that.

        Args:
            vessels: Names of the compounds that each holds beside water.

        Returns:
            Atoms and charge of each product, None for whatever the rules say; and, in words, why
            it is the rules, or which products they do not know.
        """
        asked = questions(vessels)
        answers = [
            self.by_question.get(one, KeptAnswer(one, (), "it was not asked")) for one in asked
        ]
        model = printable(self.model)
        for one in answers:
            if one.failed:
                about = " and ".join(one.compounds)
                return None, (f"By the rules, as {model} failed on {about}: {one.failed}",)
        reactions = [reaction for one in answers for reaction in one.reactions]
        sides = [read_equation(each.stoichiometry).right for each in reactions]
        products = frozenset(composition(term.formula) for side in sides for term in side)
        # Salts that stay in solution are ions to the rules, whatever they are called.
        seen = {
            p.chemical_formula for r in reactions for p in r.expected_products if p.phase != "aq"
        }
        strange = sorted(text for text in seen if composition(parse(text)) not in _known())
        return products, tuple(
            f"{model} has {text} form, of which the rules know nothing" for text in strange
        )


def questions(vessels: Iterable[Collection[str]]) -> list[tuple[str, ...]]:
    """Return what one must know of vessels that may be poured together, two at a time.

    Args:
        vessels: Names of the compounds that each holds beside water.

    Returns:
        The names of the compounds that can meet, each list sorted and once. One compound alone is
        no question: what of it dissolves, and comes back, is the rules'.
    """
    held = sorted({tuple(sorted(set(compounds))) for compounds in vessels})
    both = (tuple(sorted({*a, *b})) for a, b in combinations_with_replacement(held, 2))
    return sorted({compounds for compounds in both if len(compounds) > 1})


def asked_of(compounds: Sequence[str]) -> tuple[list[Reactant], Conditions]:
    """Return a question as a model is asked it: 100 ml of 0.1 mol/l each, as in the paper."""
    return [Reactant(name) for name in compounds], Conditions()


def reasoner_label(reasoner: str) -> str:
    """Return what rows and datasets call a reasoner: `rules`, or model and hash of a file.

    Raises:
        KeptAnswersError: If it is a file that cannot be read or holds no answers.
    """
    return _label(reasoner) if reasoner.endswith(_SUFFIX) else reasoner


def load_answers(reasoner: str) -> KeptAnswers | None:
    """Return the answers that decide what reacts; None for the rules.

    Args:
        reasoner: `rules`, a file of answers, or its label once it has been read.

    Raises:
        KeptAnswersError: If it is none of them, or the file cannot be read or holds no answers.
    """
    if reasoner == _RULES:
        return None
    answers = _read.get(reasoner_label(reasoner))
    if answers is not None:
        return answers
    if "@" in reasoner:
        raise KeptAnswersError(
            f"reasoner={reasoner} is a file of answers of somebody's own: name it, with "
            "--reasoner FILE.json where a dataset is played"
        )
    raise KeptAnswersError(
        f"reasoner={reasoner!r} is unknown. Choose {_RULES}, or FILE.json of a language model's "
        "answers: labutopia-chem ask TASK --out FILE.json"
    )


def write(answers: KeptAnswers, file: Path) -> None:
    """Write answers to a file: a process that is killed leaves it as it was, or the whole of it.

    Raises:
        KeptAnswersError: If nothing can be written there.
    """
    part = file.with_name(f"{file.name}.part")
    try:
        part.write_text(json.dumps(asdict(answers), indent=1, ensure_ascii=False), encoding="utf-8")
        part.replace(file)
    except OSError as error:
        raise KeptAnswersError(f"{file} cannot be written: {error}") from None


def read(file: Path) -> KeptAnswers:
    """Return the answers of a file: checked, as if the model had given them just now.

    Raises:
        KeptAnswersError: If it cannot be read or holds no answers.
    """
    try:
        return _answers(file.read_bytes(), str(file))
    except OSError as error:
        raise KeptAnswersError(f"reasoner={file} cannot be read: {error}") from None


def _answers(content: bytes, source: str) -> KeptAnswers:
    try:
        said = parse_json(content.decode(), source, KeptAnswersError)
        answers: KeptAnswers = checked(KeptAnswers, said, source, KeptAnswersError)
        for one in answers.answers:
            require_possible(one.reactions, *asked_of([resolve(n).name for n in one.compounds]))
    except (UnicodeDecodeError, ChemistryError) as error:
        raise KeptAnswersError(f"reasoner={source} holds no answers: {error}") from None
    return answers


@cache  # once: the file may change while a program runs
def _label(file: str) -> str:
    try:
        content = Path(file).read_bytes()
    except OSError as error:
        raise KeptAnswersError(f"reasoner={file} cannot be read: {error}") from None
    answers = _answers(content, file)
    label = f"{printable(answers.model)}@{hashlib.sha256(content).hexdigest()[:8]}"
    _read[label] = answers
    return label


@cache
def _known() -> frozenset[Composition]:
    """Return the atoms and charge of all that the rules know."""
    return frozenset(composition(one.composition) for one in network().species.values())
