"""What `mkdocs` does beside `docs/`: pages of the repository, of every task, and of the reference.

MkDocs calls `on_config`, `on_files` and `on_page_markdown` by these names (MkDocs, "Hooks").
"""

import posixpath
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from mkdocs.structure.files import File, Files

from labutopia_lerobot.features import action_feature, observation_features
from labutopia_lerobot.registry import task_files
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import Setting

ROOT = Path(__file__).parents[1]
PAGES = {
    "README.md": "index.md",
    "CHANGELOG.md": "changelog.md",
    "CONTRIBUTING.md": "contributing.md",
    "AGENTS.md": "agents.md",
    "SECURITY.md": "security.md",
    "examples/README.md": "examples.md",
    "policies/README.md": "policies.md",
    **{
        f"policies/{each}/README.md": f"policies_{each}.md"
        for each in ("act", "diffusion", "pi0", "smolvla")
    },
}
"""File of the repository that is a page of the site -> the page."""
REFERENCE = (
    ("Environment", ("env", "vector", "setting", "gymnasium_ids", "sim.dense_reward")),
    ("Tasks", ("task", "progress", "layout", "places", "tasks.actions", "tasks.failures")),
    (
        "Predicates",
        tuple(f"predicates.{name}" for name in ("predicate", "vessels", "liquids", "placing")),
    ),
    ("Skills", ("skills.skill", "skills.pick", "skills.place", "skills.pour", "skills.expert")),
    ("World", ("world.world", "world.pose", "world.reading", "world.things")),
    ("Evaluation", ("evaluation.policies", "evaluation.rows", "evaluation.compare")),
    ("Chemistry", ("chemistry.engine", "chemistry.chem_db", "chemistry.names")),
)
"""Heading of a page of the reference, and its modules."""
_FILM = (
    '<video src="../gallery/films/{name}.mp4" width="480" height="270" autoplay loop muted '
    "playsinline controls></video>"
)
_LINK = re.compile(r"(?<!!)\[([^\]]+)\]\(([^)#\s]+)(#[^)\s]*)?\)")


def on_config(config: Any) -> Any:
    """Add to the navigation what is generated: a page per task and per part of the reference."""
    sections = {name: pages for section in config.nav for name, pages in section.items()}
    levels: dict[str, list[dict[str, str]]] = {}
    for task_id in task_files():
        level, name = task_id.split("/")
        page = {name: f"tasks/{level}-{name}.md"}
        levels.setdefault(level.replace("level", "Level "), []).append(page)
    sections["Tasks"] += [{level: pages} for level, pages in sorted(levels.items())]
    sections["Reference"][1:1] = [{name: f"reference/{name.lower()}.md"} for name, _ in REFERENCE]
    return config


def on_files(files: Files, config: Any) -> Files:
    """Add the pages that do not lie in `docs/`."""
    for path, text in {**_repository(), **_tasks(), **_reference()}.items():
        files.append(File.generated(config, path, content=text))
    return files


def on_page_markdown(markdown: str, page: Any, config: Any, files: Files) -> str:
    """Let links of a page lead to where their files are on the site, or be plain text."""
    source = next((old for old, new in PAGES.items() if new == page.file.src_uri), None)
    base = posixpath.dirname(source or f"docs/{page.file.src_uri}")

    def placed(match: "re.Match[str]") -> str:
        words, target, anchor = match[1], match[2], match[3] or ""
        if "://" in target:
            return match[0]
        path = posixpath.normpath(posixpath.join(base, target))
        new = PAGES.get(path) or (path.removeprefix("docs/") if path.startswith("docs/") else path)
        if files.get_file_from_path(new) is None:
            inside = (ROOT / path).exists()  # a file of the repository that is no page
            return words if inside else match[0]  # else a link that leads nowhere: it fails
        start = posixpath.dirname(page.file.src_uri) or "."
        return f"[{words}]({posixpath.relpath(new, start)}{anchor})"

    if page.file.src_uri == "tasks.md":  # its table leads to the page of each task
        markdown = re.sub(
            r"^\| `(level\d)/(\w+)` \|",
            r"| [`\1/\2`](tasks/\1-\2.md) |",
            markdown,
            flags=re.MULTILINE,
        )
    text = re.sub(r"^\[To the README\]\(\.\./README\.md\)\n\n?", "", markdown, flags=re.MULTILINE)
    return _LINK.sub(placed, text).replace("](docs/", "](")


def _repository() -> dict[str, str]:
    return {new: (ROOT / old).read_text() for old, new in PAGES.items() if (ROOT / old).is_file()}


def _tasks() -> dict[str, str]:
    """Return a page for every task."""
    return {
        f"tasks/{task_id.replace('/', '-')}.md": "\n".join(_task(task_id))
        for task_id in task_files()
    }


def _task(task_id: str) -> Iterator[str]:
    """Yield the lines of a task's page: picture, spaces, steps, facts, rate."""
    setting, name = Setting(task_id, obs="state"), task_id.replace("/", "-")
    task = canonical_task(setting)
    yield from (f"# {task_id}", "", task.instruction, "")
    yield from (_FILM.format(name=name), "")
    yield from (f"![The expert's start and end, from three cameras](../gallery/{name}.png)", "")
    rate = re.search(rf"^\| `{task_id}` \|.*$", _rates(), re.MULTILINE)
    if rate is not None:
        won, low_high, seconds, commit = (cell.strip() for cell in rate[0].split("|")[3:7])
        yield from (
            f"The expert succeeds in {won} ({low_high}), in {seconds}; commit {commit}.",
            "",
        )
    yield from ("```", f"labutopia-view {task_id} --web", f"labutopia-eval {task_id} policy=expert")
    yield from (
        "```",
        "",
        "## Observations and actions",
        "",
        "With `obs=state`; `obs=pixels` has the",
    )
    yield from ("cameras `front`, `top` and `wrist` instead of `environment_state`.", "")
    yield from ("| key | numbers |", "| --- | --- |")
    shown = {**observation_features(setting, lambda: task), "action": action_feature(setting)}
    for key, feature in shown.items():
        yield f"| `{key}` | {', '.join(f'`{each}`' for each in feature.names or ())} |"
    yield from ("", "## Steps", "", "| step | substep | when |", "| --- | --- | --- |")
    for step in task.steps:
        for substep in step.substeps:
            facts = "; ".join(fact.name for fact in substep.when) or "counted"
            yield f"| {step.name} | {substep.name} | {facts} |"
    yield from ("", "## Goal, held for two seconds", "")
    yield from (f"- {fact.name}" for fact in task.goal)
    yield from ("", "## What ends it", "")
    yield from (f"- `{outcome}`: {fact.name}" for outcome, fact in task.forbidden(None).items())
    yield from ("", f"At most {task.time_limit_s:g} s.", "")


def _rates() -> str:
    """Return the page with the table of the experts' rates."""
    return (ROOT / "docs" / "tasks.md").read_text()


def _reference() -> dict[str, str]:
    """Return the pages of the reference; mkdocstrings fills them from docstrings."""
    pages, listed = {}, ["# Reference", "", "From the docstrings.", ""]
    for heading, modules in REFERENCE:
        name = heading.lower()
        blocks = "\n\n".join(f"::: labutopia_lerobot.{module}" for module in modules)
        pages[f"reference/{name}.md"] = f"# {heading}\n\n{blocks}\n"
        listed.append(f"- [{heading}]({name}.md): {', '.join(f'`{each}`' for each in modules)}")
    return {**pages, "reference/index.md": "\n".join(listed)}
