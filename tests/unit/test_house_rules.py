"""The rules of the house, read from the sources: imports point down, files are short."""

import ast
import re
import subprocess
from collections import Counter
from collections.abc import Iterator
from graphlib import TopologicalSorter
from pathlib import Path

ROOT = Path(__file__).parents[2]
PACKAGE = ROOT / "labutopia_lerobot"
SOURCES = sorted(PACKAGE.rglob("*.py"))

LAYERS = (
    "errors foreign_files kernel registry world",
    "chemistry",
    "substances places navigation",
    "processes",
    "labware robots scenes",
    "layout setting pictures",
    "predicates",
    "skills",
    "task progress",
    "tasks scenario",
    "liquids",
    "sim",
    "export",
    "features env vector gymnasium_ids",
    "checks",
    "runtime",
    "evaluation datasets devices lerobot_plugin behaviour_cloning",
    "hub experiments web",
    "cli",
)
"""Rooms from the ground up: one may import what stands on its own line or above it, here."""

HEIGHT = {room: height for height, line in enumerate(LAYERS) for room in line.split()}

MUJOCO = {"processes", "labware", "robots", "scenes", "liquids", "sim", "export"}
LEROBOT = {"behaviour_cloning", "datasets", "devices", "evaluation", "lerobot_plugin"}


def room(path: Path) -> str:
    return path.relative_to(PACKAGE).parts[0].removesuffix(".py")


def imported(body: list[ast.stmt]) -> Iterator[str]:
    """Yield what is imported when a module is; not what is when a function is called, or typed."""
    for node in body:
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield node.module or ""
        elif isinstance(node, ast.If | ast.Try) and "TYPE_CHECKING" not in ast.dump(node):
            yield from imported(node.body)
            yield from imported(node.orelse)
            for handler in getattr(node, "handlers", ()):
                yield from imported(handler.body)


def imports_of(path: Path) -> list[str]:
    return list(imported(ast.parse(path.read_text()).body))


def called(path: Path) -> str:
    return ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")


MODULES = {called(path) for path in SOURCES}


def modules() -> list[Path]:
    return [path for path in SOURCES if path != PACKAGE / "__init__.py"]


def test_every_room_has_its_place():
    assert {room(path) for path in modules()} == set(HEIGHT)


def test_imports_point_down():
    upward = {}
    for path in modules():
        names = [name.split(".") for name in imports_of(path)]
        rooms = [parts[1] for parts in names if parts[0] == "labutopia_lerobot" and len(parts) > 1]
        higher = [other for other in rooms if HEIGHT[other] > HEIGHT[room(path)]]
        if higher:
            upward[str(path.relative_to(PACKAGE))] = higher
    assert not upward


def test_no_modules_import_each_other_in_a_circle():
    """Not even for types, or when a function is called."""
    graph = {}
    for path in SOURCES:
        named = set()
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.ImportFrom) and node.module:
                whole = [f"{node.module}.{alias.name}" for alias in node.names]
                named |= {name if name in MODULES else node.module for name in whole}
        graph[called(path)] = (named & MODULES) - {called(path)}
    TopologicalSorter(graph).prepare()


def test_only_bodies_and_their_physics_import_mujoco():
    who = {
        room(path) for path in modules() if any(n.startswith("mujoco") for n in imports_of(path))
    }
    assert who <= MUJOCO


def test_only_datasets_evaluation_and_the_plugin_import_lerobot_or_torch():
    who = {
        room(path)
        for path in modules()
        if any(name.split(".")[0] in ("lerobot", "torch") for name in imports_of(path))
    }
    assert who <= LEROBOT


def test_nothing_prints():
    for path in modules():
        calls = (
            node for node in ast.walk(ast.parse(path.read_text())) if isinstance(node, ast.Call)
        )
        assert "print" not in {ast.unparse(call.func) for call in calls}, path


def test_files_are_short():
    long = {
        str(path.relative_to(ROOT)): count
        for path in SOURCES
        if (count := len(path.read_text().splitlines())) > 400
    }
    assert not long


def test_no_two_classes_have_one_name():
    classes = Counter(
        node.name
        for path in SOURCES
        for node in ast.walk(ast.parse(path.read_text()))
        if isinstance(node, ast.ClassDef)
    )
    assert [name for name, count in classes.items() if count > 1] == []


def test_no_two_modules_have_one_name():
    """Except where the name is not ours to choose.

    `tasks/levelN/`: the path is the task's id, and a skill may be called as a task is. `cli/`: the
    program's name, whose library module may have it too. `scenes/families/`: the kind of
    laboratory, which may be called as its instrument is. `hub/envhub/env.py`: LeRobot's EnvHub
    runs a file of that name.
    """
    exempt = (r"tasks/level\d/", r"cli/", r"scenes/families/", r"hub/envhub/env\.py$")
    named = Counter(
        path.stem
        for path in SOURCES
        if not any(re.match(rule, str(path.relative_to(PACKAGE))) for rule in exempt)
    )
    del named["__init__"]
    assert [name for name, count in named.items() if count > 1] == []


def test_the_evaluation_lists_all_its_modules():
    for init in (PACKAGE / "evaluation").rglob("__init__.py"):
        reported = ast.get_docstring(ast.parse(init.read_text())) or ""
        listed = re.findall(r"[\w]+", reported)
        for path in init.parent.glob("*.py"):
            assert path == init or path.stem in listed, path


def test_the_root_holds_what_a_task_or_a_user_names():
    files = {path.stem for path in PACKAGE.glob("*.py")} - {"__init__"}
    assert len(files) <= 15, sorted(files)


def test_no_file_that_git_ignores_is_tracked():
    tracked = subprocess.run(
        ["git", "ls-files", "--cached", "--ignored", "--exclude-standard"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert not tracked.stdout.split()


def test_what_is_written_for_those_who_work_here_exists():
    guide = (ROOT / "AGENTS.md").read_text()
    assert (ROOT / "CLAUDE.md").read_text() == guide
    assert len(guide.splitlines()) <= 60
    named = {word for span in re.findall(r"`([^`\n]+)`", guide) for word in span.split()}
    paths = {word for word in named if re.fullmatch(r"[\w./-]*(/|\.py|\.md)", word)}
    places = [ROOT, PACKAGE, *PACKAGE.iterdir(), ROOT / "tests", ROOT / "scripts", ROOT / "docs"]
    example = {"name.py", "name_model.py", "tasks/levelN/name.py"}
    lost = {path for path in paths - example if not any((p / path).exists() for p in places)}
    assert not lost


def test_docstrings_and_names_use_the_words_of_the_field():
    dialect = re.compile(r"\b(?i:tell|tells|told|spelt|whoever|berth)\b|(: |\"\"\")What (is|was)\b")
    used = {
        f"{path.relative_to(ROOT)}:{number}: {line.strip()}"
        for path in SOURCES
        for number, line in enumerate(path.read_text().replace("_", " ").splitlines(), 1)
        if dialect.search(line)
    }
    assert not used, "\n".join(sorted(used))
