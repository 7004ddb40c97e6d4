"""Checkpoints on the Hugging Face Hub: downloaded whole, and then checked as any folder is."""

import re
from pathlib import Path

from huggingface_hub import snapshot_download
from huggingface_hub.errors import (
    GatedRepoError,
    HfHubHTTPError,
    LocalEntryNotFoundError,
    OfflineModeIsEnabled,
    RepositoryNotFoundError,
    RevisionNotFoundError,
)

from labutopia_lerobot.evaluation.harmless import CheckpointError

_ID = re.compile(r"(?P<repo>[\w.-]+/[\w.-]+)(@(?P<revision>[\w./-]+))?")
"""`org/name`, or `org/name@revision` with a branch, tag or commit."""

_WANTED = ["*.json", "*.safetensors"]
"""Pickles are not even downloaded."""


def download(hub_id: str) -> Path | None:
    """Return the folder of a checkpoint of the Hub, downloaded if it is not in the cache.

    Args:
        hub_id: `org/name` or `org/name@revision`.

    Returns:
        The folder, or None if `hub_id` is none.

    Raises:
        CheckpointError: If it cannot be had; the message says why.
    """
    named = _ID.fullmatch(hub_id)
    if named is None or hub_id.startswith("."):
        return None
    try:
        return Path(
            snapshot_download(named["repo"], revision=named["revision"], allow_patterns=_WANTED)
        )
    except GatedRepoError:
        reason = "its owner wants you to agree to terms: open its page, then run `hf auth login`"
    except (RepositoryNotFoundError, RevisionNotFoundError):
        reason = "the Hub has no such model or revision, or it is private (`hf auth login`)"
    except (LocalEntryNotFoundError, OfflineModeIsEnabled, HfHubHTTPError, OSError) as error:
        reason = (
            f"the Hub cannot be reached ({type(error).__name__}) and it is not in the cache. On a "
            f"machine with a network: hf download {named['repo']}"
        )
    raise CheckpointError(
        f"policy.path={hub_id} is no folder here, and as a Hub id it cannot be had: {reason}"
    )
