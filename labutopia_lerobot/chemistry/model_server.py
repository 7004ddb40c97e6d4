"""Asking a language model at any address that speaks OpenAI's protocol, within limits.

A server may be slow, broken or hostile. One question takes a limited time and brings a limited
number of bytes; nobody is sent to another address, and no key of the user's but the one for this
server leaves the machine.
"""

import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any
from urllib.parse import urlsplit

import httpx
from huggingface_hub import InferenceClient
from huggingface_hub.errors import InferenceTimeoutError

from labutopia_lerobot.chemistry.refusals import ChemistryError
from labutopia_lerobot.foreign_files import printable

LARGEST_ANSWER = 1_000_000
"""Bytes of an answer; one with twenty reactions has a fiftieth."""

_MOST_TOKENS = 8192
"""Tokens of an answer, those that a model thinks with included."""

_SHOWN = 200
"""Characters of a server's own words that a message repeats."""


class ModelServerError(ChemistryError):
    """The server cannot be reached, does not answer in time, or answers with something else."""


@dataclass(frozen=True)
class ModelServer:
    """Where a model is asked.

    Attributes:
        address: URL such as `http://127.0.0.1:8000/v1`.
        model: What the server calls the model.
        key: Sent as a bearer token; None for none.

    Raises:
        ModelServerError: If the address is none, or no model is named.
    """

    address: str
    model: str
    key: str | None = field(default=None, repr=False)

    def __post_init__(self) -> None:
        try:
            parts = urlsplit(self.address)
            usable = parts.scheme in ("http", "https") and bool(parts.hostname)
            _ = parts.port
        except ValueError:
            usable = False
        if not usable or "@" in parts.netloc:
            raise ModelServerError(
                f"base_url={printable(self.address)[:_SHOWN]} is no address of a model: "
                "http://HOST:PORT/v1 or https://..., without a user in it"
            )
        if not self.model.strip():
            raise ModelServerError("Name the model, as in model=Qwen/Qwen3-8B")

    def ask(
        self, messages: Sequence[dict[str, str]], schema: dict[str, Any], timeout_s: float
    ) -> str:
        """Return what the model says.

        Args:
            messages: The conversation, as the protocol has it: `role` and `content`.
            schema: JSON Schema that the answer is constrained to, where the server can do so.
            timeout_s: After how long the question is given up, whatever happens meanwhile [s].

        Raises:
            ModelServerError: If no answer comes in time, or it is none.
        """
        # In a thread: no timeout of a socket limits a name server, or headers that come byte by
        # byte. One that is given up ends when its connection is closed under it.
        answers: list[str | Exception] = []
        client = _LimitedClient(self, schema, timeout_s)

        def call() -> None:
            try:
                answers.append(client.answer(messages))
            except Exception as error:
                answers.append(error)

        thread = threading.Thread(target=call, daemon=True, name="language model")
        thread.start()
        thread.join(timeout_s)
        # Before it is closed: the closing itself makes the thread fail, with other words.
        answer = answers[0] if answers else TimeoutError()
        client.close()
        if isinstance(answer, str):
            return answer
        raise _meaning(answer, self.address, timeout_s) from None


class _LimitedClient(InferenceClient):
    """An `InferenceClient` that keeps the limits; one for each question.

    The client of `huggingface_hub` follows redirects, reads without limit, sends the token of the
    Hub to every address, and rewrites the protocol's `response_format` into one of its own.
    """

    def __init__(self, server: ModelServer, schema: dict[str, Any], timeout_s: float) -> None:
        # A key is given so that it does not look for the Hub's; `_inner_post` sends ours.
        super().__init__(base_url=server.address, api_key="unused", timeout=timeout_s)
        self._server, self._deadline = server, time.monotonic() + timeout_s
        self._format = {
            "type": "json_schema",
            "json_schema": {"name": "reactions", "strict": True, "schema": schema},
        }
        self._session = httpx.Client(follow_redirects=False, timeout=timeout_s)

    def close(self) -> None:
        """Close the connection, also one that another thread reads from."""
        self._session.close()

    def answer(self, messages: Sequence[dict[str, str]]) -> str:
        """Return the words of the model."""
        answer = self.chat_completion(
            list(messages),
            model=None,
            temperature=0.0,
            max_tokens=_MOST_TOKENS,
            extra_body={"model": self._server.model},
        )
        content = answer.choices[0].message.content
        if not isinstance(content, str):
            raise TypeError("no text")
        return content

    def _inner_post(self, request_parameters: Any, *, stream: bool = False) -> Any:
        """Send a request as `InferenceClient` does, within the limits."""
        key = self._server.key
        headers = {"Accept-Encoding": "identity"}
        with self._session.stream(
            "POST",
            request_parameters.url,
            json=request_parameters.json | {"response_format": self._format},
            headers=headers | ({"Authorization": f"Bearer {key}"} if key else {}),
        ) as response:
            content = self._read(response)
        if response.is_redirect:
            raise ModelServerError(
                f"{self._server.address} sends to another address, which is not followed"
            )
        if response.is_error:
            said = printable(content.decode(errors="replace"))[:_SHOWN]
            raise ModelServerError(f"{self._server.address} answers {response.status_code}: {said}")
        return content

    def _read(self, response: httpx.Response) -> bytes:
        content = bytearray()
        for part in response.iter_raw():
            content += part
            if len(content) > LARGEST_ANSWER:
                raise ModelServerError(
                    f"{self._server.address} answers with more than {LARGEST_ANSWER:,} bytes"
                )
            if time.monotonic() > self._deadline:
                raise TimeoutError
        return bytes(content)


def _meaning(error: Exception, address: str, timeout_s: float) -> ModelServerError:
    """Return what went wrong, in our words."""
    if isinstance(error, ModelServerError):
        return error
    if isinstance(error, TimeoutError | httpx.TimeoutException | InferenceTimeoutError):
        return ModelServerError(f"{address} gives no whole answer in {timeout_s:.3g} s")
    if isinstance(error, httpx.HTTPError | OSError):
        return ModelServerError(f"{address} cannot be reached: {printable(str(error))[:_SHOWN]}")
    return ModelServerError(f"{address} does not answer as the protocol has it")
