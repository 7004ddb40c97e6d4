"""Who says what reacts: the rules, or a language model whose answer is checked."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal, get_args

from labutopia_lerobot.chemistry.engine import react as react_by_rules
from labutopia_lerobot.chemistry.reaction import Conditions, Outcome, Reactant
from labutopia_lerobot.chemistry.refusals import ChemistryError

if TYPE_CHECKING:
    from labutopia_lerobot.chemistry.language_model import LanguageModel

Reasoner = Literal["rules", "llm"]
"""`rules`: `chemistry.engine`. `llm`: `chemistry.language_model`, as in the paper."""


class UnknownReasonerError(ChemistryError):
    """There is no such reasoner; the message lists them."""


def react(
    portions: Sequence[str | Reactant],
    conditions: Conditions = Conditions(),  # noqa: B008 - frozen
    reasoner: Reasoner = "rules",
    model: "LanguageModel | None" = None,
) -> Outcome:
    """Return what happens when portions are poured together.

    Args:
        portions: At least one; a text is a portion with the defaults of `Reactant`.
        conditions: How it is done.
        reasoner: Who infers the reactions.
        model: Of `llm`: whom to ask; None for what the environment says.

    Raises:
        ChemistryError: Of its kinds in `chemistry.refusals`, as the rules raise them; or if there
            is no such reasoner or model.
    """
    if reasoner == "rules":
        return react_by_rules(portions, conditions)
    if reasoner != "llm":
        raise UnknownReasonerError(
            f"reasoner={reasoner} is unknown. Choose from: {', '.join(get_args(Reasoner))}"
        )
    # Here: it takes a second to import what asks.
    from labutopia_lerobot.chemistry.language_model import LanguageModel

    meant = [Reactant(one) if isinstance(one, str) else one for one in portions]
    return (model or LanguageModel.of_environment()).infer(meant, conditions)
