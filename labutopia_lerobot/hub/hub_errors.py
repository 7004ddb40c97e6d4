"""Why the Hub did not do what it was asked, and what to do about it."""

from collections.abc import Iterator
from contextlib import contextmanager

import httpx
from huggingface_hub import constants
from huggingface_hub.errors import HfHubHTTPError, LocalTokenNotFoundError, OfflineModeIsEnabled

from labutopia_lerobot.errors import UserError

_AGAIN = "Repeat the command: what has arrived is not sent again"


class HubError(UserError):
    """The Hub refuses, or cannot be reached; the message says why and what to do."""


@contextmanager
def explain_errors(repo_id: str) -> Iterator[None]:
    """Report what goes wrong between here and the Hub in one message.

    Args:
        repo_id: The repository that is sent to.

    Raises:
        HubError: If the Hub refuses or cannot be reached.
    """
    try:
        yield
    # An upload that fails is a RuntimeError of huggingface_hub; what it is of stands behind it.
    except (LocalTokenNotFoundError, OfflineModeIsEnabled, httpx.HTTPError, RuntimeError) as error:
        raise HubError(_message_of(_origin(error), repo_id)) from error


def _origin(error: BaseException) -> BaseException:
    while isinstance(error, RuntimeError) and error.__cause__ is not None:
        error = error.__cause__
    return error


def _message_of(error: BaseException, repo_id: str) -> str:
    if isinstance(error, LocalTokenNotFoundError):
        return "No token of the Hub on this machine. Log in: hf auth login; or set HF_TOKEN"
    if isinstance(error, OfflineModeIsEnabled):
        return "HF_HUB_OFFLINE=1 keeps everything off the network: take it away to publish"
    if not isinstance(error, HfHubHTTPError):
        return f"{constants.ENDPOINT} does not answer ({error or type(error).__name__}). {_AGAIN}"
    status = error.response.status_code
    return f"{_meaning(status, repo_id)}\nThe Hub's own words ({status}): {_words(error)}"


def _words(error: HfHubHTTPError) -> str:
    return error.server_message or " ".join(str(error).split())


def _meaning(status: int, repo_id: str) -> str:
    owner = repo_id.partition("/")[0]
    if status == httpx.codes.UNAUTHORIZED:
        return "The Hub does not accept the token on this machine. Log in again: hf auth login"
    if status == httpx.codes.FORBIDDEN:
        return (
            f"The token may not write to {repo_id}: it must have the permission to write, and "
            f"belong to {owner} or one of its members. Make such a token, or choose another "
            "--repo-id"
        )
    if status in (httpx.codes.CONFLICT, httpx.codes.PRECONDITION_FAILED):
        return (
            f"The name {repo_id} is taken, or somebody else is changing it now. Choose another "
            "--repo-id, or wait"
        )
    if status == httpx.codes.TOO_MANY_REQUESTS:
        return f"The Hub wants fewer requests: wait some minutes. {_AGAIN}"
    if status >= httpx.codes.INTERNAL_SERVER_ERROR:
        return f"The Hub is in trouble of its own. {_AGAIN}"
    return f"The Hub refuses {repo_id}"
