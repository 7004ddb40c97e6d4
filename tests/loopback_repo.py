"""Repositories of the Hub on loopback: files, commits, branches and tags, kept in memory."""

import hashlib
from dataclasses import dataclass, field
from typing import Any


class Refusal(Exception):  # noqa: N818
    def __init__(self, status: int, code: str = "", message: str = "no") -> None:
        self.status, self.code, self.message = status, code, message


@dataclass
class File:
    data: bytes
    large: bool

    @property
    def sha256(self) -> str:
        return hashlib.sha256(self.data).hexdigest()

    @property
    def git(self) -> str:
        return hashlib.sha1(b"blob %d\0" % len(self.data) + self.data).hexdigest()

    @property
    def hash(self) -> str:
        return self.sha256 if self.large else self.git

    def entry(self, path: str) -> dict[str, Any]:
        lfs = {"oid": self.sha256, "size": len(self.data), "pointerSize": 130}
        more = {"lfs": lfs} if self.large else {}
        return {"type": "file", "oid": self.git, "size": len(self.data), "path": path, **more}

    def sibling(self, path: str) -> dict[str, Any]:
        lfs = {"sha256": self.sha256, "size": len(self.data), "pointerSize": 130}
        more = {"lfs": lfs} if self.large else {}
        return {"rfilename": path, "size": len(self.data), "blobId": self.git, **more}


@dataclass
class Repo:
    private: bool
    commits: dict[str, dict[str, File]] = field(default_factory=dict)
    refs: dict[str, str] = field(default_factory=dict)
    tags: dict[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.commit({".gitattributes": File(b"*.mp4 filter=lfs\n", False)})

    def commit(self, files: dict[str, File]) -> str:
        commit = hashlib.sha1(str(len(self.commits)).encode()).hexdigest()
        self.commits[commit] = files
        self.refs["main"] = commit
        return commit

    def find(self, revision: str) -> str:
        commit = {**self.refs, **self.tags}.get(revision, revision)
        if commit not in self.commits:
            raise Refusal(404, "RevisionNotFound")
        return commit

    @property
    def files(self) -> dict[str, File]:
        return self.commits[self.refs["main"]]
