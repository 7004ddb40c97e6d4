"""Reactions that a language model infers, checked; the rules' where it fails.

The model is asked with the paper's prompt. An answer that breaks a rule of `answer` is sent back
once with what is wrong. A good answer is kept by a hash of all that it depends on, so that the same
question asks nobody again.
"""

import hashlib
import json
import os
import tempfile
import time
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path

from labutopia_lerobot.chemistry.answer import AnswerError, read_answer
from labutopia_lerobot.chemistry.engine import react
from labutopia_lerobot.chemistry.model_server import ModelServer, ModelServerError
from labutopia_lerobot.chemistry.output import PAPER_SCHEMA
from labutopia_lerobot.chemistry.prompt import prompt
from labutopia_lerobot.chemistry.reaction import Conditions, Outcome, Reactant, Reaction
from labutopia_lerobot.chemistry.refusals import ChemistryError
from labutopia_lerobot.foreign_files import printable
from labutopia_lerobot.kernel import user_cache

ADDRESS, MODEL, KEY = "LABUTOPIA_MODEL_URL", "LABUTOPIA_MODEL", "LABUTOPIA_MODEL_KEY"
"""Names in the environment. Keys of other services are not read: they are not for this address."""

_REPEATED = 10_000
"""Characters of a refused answer that are sent back."""


class ModelOptionError(ChemistryError):
    """A model is wanted, but not said which or where; the message says how to say it."""


@dataclass(frozen=True)
class LanguageModel:
    """A model and how to ask it.

    Attributes:
        model: What its server calls it, such as `gpt-4o` (the paper's).
        base_url: Address of the server, such as `http://127.0.0.1:8000/v1`; it may be None where
            only kept answers are read.
        key: Key for this server; None for none.
        timeout_s: After how long a question is given up, its repair included [s].
        cache: Folder of kept answers; None for the user's.
        cached_only: Whether nobody is asked: a replay must not.

    Raises:
        ModelOptionError: If no model is named, or no address where one is needed, or the time is
            none.
        ModelServerError: If the address is none.
    """

    model: str
    base_url: str | None = None
    key: str | None = field(default=None, repr=False)
    timeout_s: float = 60.0
    cache: Path | None = None
    cached_only: bool = False

    def __post_init__(self) -> None:
        if not self.model.strip():
            raise ModelOptionError(f"Name the model: model=NAME, or {MODEL} in the environment")
        if self.base_url is None and not self.cached_only:
            raise ModelOptionError(
                "Say where the model is asked: base_url=http://HOST:PORT/v1, or "
                f"{ADDRESS} in the environment"
            )
        if not 0.0 < self.timeout_s < float("inf"):
            raise ModelOptionError(f"timeout={self.timeout_s:g} is impossible: more than 0 s")
        if not self._is_kept_only:
            self._server()  # an address that is none is no failure of the model

    @classmethod
    def of_environment(
        cls,
        model: str | None = None,
        base_url: str | None = None,
        timeout_s: float = 60.0,
        cached_only: bool = False,
    ) -> "LanguageModel":
        """Return what the arguments say, and the environment where they say nothing.

        With `HF_HUB_OFFLINE` set, only kept answers are read.

        Raises:
            ModelOptionError: As the class does.
        """
        from huggingface_hub import constants

        return cls(
            model=model or os.environ.get(MODEL, ""),
            base_url=base_url or os.environ.get(ADDRESS),
            key=os.environ.get(KEY),
            timeout_s=timeout_s,
            cached_only=cached_only or constants.is_offline_mode(),
        )

    def infer(self, portions: Sequence[Reactant], conditions: Conditions) -> Outcome:
        """Return the reactions that the model infers, with the amounts of the rules.

        A model knows no amounts, heat or pH. Where it does not answer, or only with what is
        refused, the whole outcome is the rules'; the note says why.

        Raises:
            ChemistryError: As `react.react` does. Whatever the model does raises nothing.
        """
        outcome = react(portions, conditions)
        try:
            reactions = self.reactions(portions, conditions)
        except (AnswerError, ModelServerError) as failed:
            note = f"By the rules, as {printable(self.model)} failed: {failed}"
            return replace(outcome, note=_joined(outcome.note, note))
        note = f"Reactions by {printable(self.model)}; amounts, heat and pH by the rules"
        amounts = replace(outcome.amounts, extents={})  # they are of the rules' reactions
        return Outcome(reactions, amounts, _joined(outcome.note, note))

    def _server(self) -> ModelServer:
        return ModelServer(self.base_url or "", self.model, self.key)

    @property
    def _is_kept_only(self) -> bool:
        return self.cached_only or self.base_url is None

    def reactions(
        self, portions: Sequence[Reactant], conditions: Conditions
    ) -> tuple[Reaction, ...]:
        """Return the reactions of a good answer, kept or new.

        Raises:
            AnswerError: If it gives none.
            ModelServerError: If it does not answer, or nobody is to be asked.
        """
        server = None if self._is_kept_only else self._server()
        messages = prompt(portions, conditions)
        kept = self._file(messages)
        # A file that somebody has damaged counts as none.
        with suppress(OSError, ValueError):
            return read_answer(kept.read_text(encoding="utf-8"), portions, conditions)
        if server is None:
            raise ModelServerError(
                "no answer is kept, and nobody is asked (cached_only or HF_HUB_OFFLINE)"
            )
        deadline = time.monotonic() + self.timeout_s
        said = server.ask(messages, PAPER_SCHEMA, self.timeout_s)
        try:
            reactions = read_answer(said, portions, conditions)
        except AnswerError as wrong:
            repair = f"This is refused: {wrong}. Return the corrected JSON only."
            messages += [
                {"role": "assistant", "content": said[:_REPEATED]},
                {"role": "user", "content": repair},
            ]
            left_s = deadline - time.monotonic()
            if left_s <= 0.0:
                raise
            said = server.ask(messages, PAPER_SCHEMA, left_s)
            reactions = read_answer(said, portions, conditions)
        _keep(kept, said)
        return reactions

    def _file(self, messages: Sequence[dict[str, str]]) -> Path:
        """Return where the answer to a question is kept; the address makes no other question."""
        question = json.dumps([self.model, messages, PAPER_SCHEMA], sort_keys=True)
        folder = self.cache or user_cache() / "chemistry"
        return folder / f"{hashlib.sha256(question.encode()).hexdigest()}.json"


def _keep(file: Path, said: str) -> None:
    """Write a file at once: a process that is killed leaves none, or the whole of it."""
    with suppress(OSError):  # nothing can be written there: the next question asks again
        file.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.NamedTemporaryFile(
            "w", dir=file.parent, suffix=".part", delete=False, encoding="utf-8"
        ) as part:
            part.write(said)
        os.replace(part.name, file)


def _joined(*notes: str) -> str:
    return ". ".join(note for note in notes if note)
