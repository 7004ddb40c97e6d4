"""Sending a repository to the Hub: one commit, so that readers see all of it or nothing.

Large files go first, each by itself, and those that have arrived are not sent again: an interrupted
run goes on when it is repeated.
"""

import hashlib
from contextlib import suppress
from pathlib import Path

from huggingface_hub import CommitOperationAdd, CommitOperationDelete, HfApi
from huggingface_hub.errors import HFValidationError, RevisionNotFoundError
from huggingface_hub.hf_api import RepoSibling
from huggingface_hub.utils._validators import validate_repo_id
from huggingface_hub.utils.sha import git_hash

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.hub.hub_errors import explain_errors
from labutopia_lerobot.hub.repository import Repository
from labutopia_lerobot.runtime.provenance import sha256

_OF_THE_HUB = ".gitattributes"
"""File that the Hub itself puts into a new repository."""


class RepoIdError(UserError):
    """A name that no repository can have; the message says why."""


class OccupiedRepositoryError(UserError):
    """A repository that holds something else, or shows it to everybody."""


def require_repo_id(repo_id: str) -> None:
    """Make sure that a repository can have this name.

    Raises:
        RepoIdError: If it cannot.
    """
    try:
        validate_repo_id(repo_id)
    except HFValidationError as error:
        raise RepoIdError(f"--repo-id {repo_id} is no name of the Hub: {error}") from None
    if repo_id.count("/") != 1:
        raise RepoIdError(f"--repo-id {repo_id} must have one slash, such as me/labutopia-pick")


def publish(repository: Repository, repo_id: str, *, private: bool, replace: bool) -> str:
    """Send a repository, and return the address of the commit.

    Args:
        repository: The folder to send.
        repo_id: Owner and name.
        private: Whether only its owner sees it.
        replace: Whether anything else that lies there is to give way.

    Raises:
        RepoIdError: If the name is impossible.
        OccupiedRepositoryError: If something else lies there, or everybody sees it.
        HubError: If the Hub refuses or cannot be reached.
    """
    require_repo_id(repo_id)
    with explain_errors(repo_id):
        api = HfApi(token=True, library_name="labutopia_lerobot")
        api.create_repo(repo_id, repo_type=repository.kind, private=private, exist_ok=True)
        look = api.dataset_info if repository.kind == "dataset" else api.model_info
        there = look(repo_id, files_metadata=True)
        if private and not there.private:
            raise OccupiedRepositoryError(
                f"{repo_id} is there already, and everybody sees it: make it private in its "
                "settings, or choose another --repo-id"
            )
        lying = {file.rfilename: file for file in there.siblings or ()}
        leftovers = sorted(lying.keys() - repository.files.keys() - {_OF_THE_HUB})
        if not replace:
            _refuse_other(repository, repo_id, lying, leftovers)
        commit = api.create_commit(
            repo_id,
            [
                *(CommitOperationDelete(path) for path in leftovers),
                *(CommitOperationAdd(path, file) for path, file in repository.files.items()),
            ],
            commit_message="Published with labutopia-publish",
            repo_type=repository.kind,
            parent_commit=there.sha,
        )
        if repository.tag is not None:
            with suppress(RevisionNotFoundError):
                api.delete_tag(repo_id, tag=repository.tag, repo_type=repository.kind)
            api.create_tag(
                repo_id, tag=repository.tag, revision=commit.oid, repo_type=repository.kind
            )
    return commit.commit_url


def _refuse_other(
    repository: Repository, repo_id: str, lying: dict[str, RepoSibling], leftovers: list[str]
) -> None:
    """Refuse a repository that holds what this one does not.

    What an interrupted run of the same command has left is no reason.
    """
    other = leftovers + [
        path
        for path, content in repository.files.items()
        if path in lying and not _is(lying[path], content)
    ]
    if other:
        more = f" and {len(other) - 5} more" if len(other) > 5 else ""
        raise OccupiedRepositoryError(
            f"{repo_id} is taken: it holds {', '.join(other[:5])}{more} of something else. Choose "
            "another --repo-id, or give --replace to put this in its place"
        )


def _is(file: RepoSibling, content: Path | bytes) -> bool:
    """Return whether a file of the Hub has this content, by their hashes."""
    if file.lfs is None:
        data = content if isinstance(content, bytes) else content.read_bytes()
        return file.blob_id == git_hash(data)
    known = hashlib.sha256(content).hexdigest() if isinstance(content, bytes) else sha256(content)
    return file.lfs.sha256 == known
