"""The Hub on loopback: the endpoints that huggingface_hub calls to publish and to read back.

Standard library only; nothing leaves the machine. Everything is kept in memory. `faults` makes it
refuse or hang up.
"""

import base64
import hashlib
import json
import re
import threading
from dataclasses import dataclass
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any
from urllib.parse import parse_qs, unquote, urlsplit

import yaml

from loopback_repo import File, Refusal, Repo

TOKEN = "hf_loopback"
LARGE = (".parquet", ".mp4", ".safetensors", ".jpg")
"""What the Hub keeps as LFS; everything else here is small."""


@dataclass
class Fault:
    """Answers the next requests that match with a status, or with None hangs up."""

    pattern: str
    status: int | None
    times: int = 1


class LoopbackHub(ThreadingHTTPServer):
    """Use it with `with`."""

    daemon_threads = True

    def __init__(self) -> None:
        super().__init__(("127.0.0.1", 0), Handler)
        self.endpoint = f"http://127.0.0.1:{self.server_address[1]}"
        self.repos: dict[tuple[str, str], Repo] = {}
        self.blobs: dict[str, bytes] = {}
        self.faults: list[Fault] = []
        self.requests: list[str] = []
        self.lock = threading.RLock()

    def environment(self, home: object) -> dict[str, str]:
        """Return what makes a program talk to this Hub, with its caches in a folder."""
        return {
            "HF_ENDPOINT": self.endpoint,
            "HF_TOKEN": TOKEN,
            "HF_HOME": str(home),
            "HF_LEROBOT_HOME": f"{home}/lerobot",
            "HF_HUB_OFFLINE": "0",
            "HF_HUB_DISABLE_XET": "1",
            "HF_HUB_DISABLE_TELEMETRY": "1",
        }

    def __enter__(self) -> "LoopbackHub":
        threading.Thread(target=self.serve_forever, daemon=True).start()
        return self

    def __exit__(self, *_: object) -> None:
        self.shutdown()
        self.server_close()

    def repo(self, kind: str, name: str) -> Repo:
        if (kind, name) not in self.repos:
            raise Refusal(404, "RepoNotFound", "Repository not found")
        return self.repos[kind, name]


_API = r"/api/(models|datasets)/([^/]+/[^/]+)"
_ROUTES = (
    ("POST", "/api/repos/create", "create"),
    ("POST", "/api/validate-yaml", "validate_card"),
    ("POST", rf"{_API}/preupload/.+", "preupload"),
    ("POST", rf"{_API}/commit/.+", "commit"),
    ("POST", rf"{_API}/tag/(.+)", "tag"),
    ("DELETE", rf"{_API}/tag/(.+)", "untag"),
    ("POST", rf"{_API}/paths-info/(.+)", "paths_info"),
    ("GET", rf"{_API}/refs", "refs"),
    ("GET", rf"{_API}/tree/([^/]+)(?:/(.*))?", "tree"),
    ("GET", rf"{_API}/revision/(.+)", "info"),
    ("GET", _API, "info"),
    ("POST", r"/(?:(datasets)/)?([^/]+/[^/]+)\.git/info/lfs/objects/batch", "lfs_batch"),
    ("PUT", r"/lfs/([0-9a-f]{64})", "lfs_put"),
    ("GET|HEAD", r"/(?:(datasets)/)?([^/]+/[^/]+)/resolve/([^/]+)/(.+)", "resolve"),
)


class Handler(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    server: LoopbackHub

    def _serve(self) -> None:
        path = urlsplit(self.path).path
        length = int(self.headers.get("Content-Length") or 0)
        self.body = self.rfile.read(length)
        request = f"{self.command} {path}"
        with self.server.lock:
            self.server.requests.append(request)
            for fault in self.server.faults:
                if fault.times and re.search(fault.pattern, request):
                    fault.times -= 1
                    if fault.status is None:
                        self.close_connection = True
                        return
                    self._json({"error": "as the test wants"}, fault.status)
                    return
            try:
                self._route(path)
            except Refusal as refusal:
                headers = {"X-Error-Code": refusal.code, "X-Error-Message": refusal.message}
                self._json({"error": refusal.message}, refusal.status, headers)

    do_GET = do_HEAD = do_POST = do_PUT = do_DELETE = _serve  # noqa: N815

    def log_message(self, format: str, *_: object) -> None:
        pass

    def _route(self, path: str) -> None:
        for method, pattern, name in _ROUTES:
            found = re.fullmatch(pattern, path)
            if found and self.command in method.split("|"):
                free = self.command in ("GET", "HEAD", "PUT") or name == "validate_card"
                if not free and self.headers.get("Authorization") != f"Bearer {TOKEN}":
                    raise Refusal(401, "", "Invalid username or password.")
                groups = (unquote(group) if group else "" for group in found.groups())
                getattr(self, name)(*groups)
                return
        raise Refusal(501, "", f"not served: {self.command} {path}")

    def _send(self, data: bytes, status: int, headers: dict[str, str]) -> None:
        self.send_response(status)
        for name, value in ({"Content-Length": str(len(data))} | headers).items():
            self.send_header(name, value)
        self.end_headers()
        if self.command != "HEAD":
            self.wfile.write(data)

    def _json(self, value: Any, status: int = 200, headers: dict[str, str] | None = None) -> None:
        more = {"Content-Type": "application/json"} | (headers or {})
        self._send(json.dumps(value).encode(), status, more)

    def create(self) -> None:
        asked = json.loads(self.body)
        key = (f"{asked.get('type', 'model')}s", f"{asked['organization']}/{asked['name']}")
        url = f"{self.server.endpoint}/{'' if key[0] == 'models' else 'datasets/'}{key[1]}"
        if key in self.server.repos:
            self._json({"error": "You already created this repo", "url": url}, 409)
            return
        self.server.repos[key] = Repo(private=asked.get("visibility") == "private")
        self._json({"url": url})

    def validate_card(self) -> None:
        head = re.match(r"---\n(.*?)\n---", json.loads(self.body)["content"], re.S)
        known = isinstance(yaml.safe_load(head[1]), dict) if head else False
        errors = [] if known else [{"message": "no metadata"}]
        self._json({"errors": errors, "warnings": []}, 400 if errors else 200)

    def info(self, kind: str, name: str, revision: str = "main") -> None:
        repo = self.server.repo(kind, name)
        commit = repo.find(revision)
        siblings = [file.sibling(path) for path, file in sorted(repo.commits[commit].items())]
        self._json(
            {"_id": "0", "id": name, "sha": commit, "private": repo.private, "siblings": siblings}
            | {"tags": [], "downloads": 0, "likes": 0}
        )

    def refs(self, kind: str, name: str) -> None:
        repo = self.server.repo(kind, name)
        reported = {"branches": (repo.refs, "heads"), "tags": (repo.tags, "tags")}
        self._json(
            {"converts": []}
            | {
                group: [
                    {"name": name, "ref": f"refs/{folder}/{name}", "targetCommit": commit}
                    for name, commit in refs.items()
                ]
                for group, (refs, folder) in reported.items()
            }
        )

    def tag(self, kind: str, name: str, revision: str) -> None:
        repo = self.server.repo(kind, name)
        repo.tags[json.loads(self.body)["tag"]] = repo.find(revision)
        self._json({})

    def untag(self, kind: str, name: str, tag: str) -> None:
        if self.server.repo(kind, name).tags.pop(tag, None) is None:
            raise Refusal(404, "RevisionNotFound")
        self._json({})

    def tree(self, kind: str, name: str, revision: str, folder: str = "") -> None:
        repo = self.server.repo(kind, name)
        prefix = f"{folder.rstrip('/')}/" if folder else ""
        files = repo.commits[repo.find(revision)]
        inside = {path: file for path, file in sorted(files.items()) if path.startswith(prefix)}
        if not inside:
            raise Refusal(404, "EntryNotFound")
        deep = parse_qs(urlsplit(self.path).query).get("recursive", [""])[0].lower() == "true"
        rows, folders = [], set()
        for path, file in inside.items():
            parts = path.removeprefix(prefix).split("/")
            depths = range(1, len(parts)) if deep else range(1, min(2, len(parts)))
            folders |= {prefix + "/".join(parts[:depth]) for depth in depths}
            rows += [file.entry(path)] if deep or len(parts) == 1 else []
        entries = [{"type": "directory", "oid": "0", "size": 0, "path": f} for f in sorted(folders)]
        self._json(rows + entries)

    def paths_info(self, kind: str, name: str, revision: str) -> None:
        repo = self.server.repo(kind, name)
        files = repo.commits[repo.find(revision)]
        json_body = "json" in self.headers.get("Content-Type", "")
        asked = json.loads(self.body) if json_body else parse_qs(self.body.decode())
        paths = asked.get("paths", [])
        rows = []
        for path in [paths] if isinstance(paths, str) else paths:
            if path in files:
                rows.append(files[path].entry(path))
            elif any(other.startswith(f"{path.rstrip('/')}/") for other in files):
                rows.append({"type": "directory", "oid": "0", "size": 0, "path": path})
        self._json(rows)

    def preupload(self, kind: str, name: str) -> None:
        there = self.server.repo(kind, name).files
        answer = []
        for asked in json.loads(self.body)["files"]:
            path = asked["path"]
            known = there[path].hash if path in there else None
            mode = "lfs" if path.endswith(LARGE) else "regular"
            answer.append({"path": path, "uploadMode": mode, "shouldIgnore": False, "oid": known})
        self._json({"files": answer})

    def lfs_batch(self, kind: str, name: str) -> None:
        objects = []
        for asked in json.loads(self.body)["objects"]:
            href = f"{self.server.endpoint}/lfs/{asked['oid']}"
            missing = asked["oid"] not in self.server.blobs
            more = {"actions": {"upload": {"href": href, "header": {}}}} if missing else {}
            objects.append({"oid": asked["oid"], "size": asked["size"], **more})
        self._json({"transfer": "basic", "objects": objects})

    def lfs_put(self, sha256: str) -> None:
        if hashlib.sha256(self.body).hexdigest() != sha256:
            raise Refusal(400, "", "not what was announced")
        self.server.blobs[sha256] = self.body
        self._json({})

    def commit(self, kind: str, name: str) -> None:
        repo = self.server.repo(kind, name)
        files = dict(repo.files)
        for line in self.body.splitlines():
            item = json.loads(line)
            value = item["value"]
            if item["key"] == "header" and value.get("parentCommit") != repo.refs["main"]:
                raise Refusal(412, "", "A commit has happened since")
            if item["key"] == "file":
                files[value["path"]] = File(base64.b64decode(value["content"]), False)
            elif item["key"] == "lfsFile":
                files[value["path"]] = File(self.server.blobs[value["oid"]], True)
            elif item["key"] == "deletedFile":
                del files[value["path"]]
        commit = repo.commit(files)
        url = f"{self.server.endpoint}/{'' if kind == 'models' else 'datasets/'}{name}"
        self._json({"success": True, "commitOid": commit, "commitUrl": f"{url}/commit/{commit}"})

    def resolve(self, kind: str, name: str, revision: str, path: str) -> None:
        repo = self.server.repo(kind or "models", name)
        commit = repo.find(revision)
        file = repo.commits[commit].get(path)
        if file is None:
            raise Refusal(404, "EntryNotFound")
        headers = {"X-Repo-Commit": commit, "ETag": f'"{file.hash}"', "Accept-Ranges": "bytes"}
        span = re.fullmatch(r"bytes=(\d+)-(\d*)", self.headers.get("Range", ""))
        if span and self.command == "GET":
            first, last = int(span[1]), min(int(span[2] or len(file.data)), len(file.data) - 1)
            headers["Content-Range"] = f"bytes {first}-{last}/{len(file.data)}"
            self._send(file.data[first : last + 1], 206, headers)
        else:
            self._send(file.data, 200, headers)
