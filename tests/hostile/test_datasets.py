"""Datasets that somebody made to do harm, or that are damaged: every program refuses them."""

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from hostile.programs import run

type Damage = Callable[[Path], object]

INFO, RECORDING, STATISTICS = "meta/info.json", "meta/labutopia.json", "meta/stats.json"
PROGRAMS = {
    "verify": ("dataset",),
    "replay": ("dataset",),
    "render": ("dataset", "rendered"),
    "publish": ("dataset", "--repo-id", "me/it", "--dry-run"),
}
OWNED = "import pathlib; pathlib.Path('owned').write_text('')\ndef {}(): ...\n"


def info(**changes: Any) -> Damage:
    """Change entries of the description."""
    return lambda root: edit(root / INFO, lambda reported: reported | changes)


def feature(name: str, **changes: Any) -> Damage:
    """Change what is said of a feature."""

    def change(reported: dict[str, Any]) -> dict[str, Any]:
        reported["features"][name] = reported["features"].get(name, {}) | changes
        return reported

    return lambda root: edit(root / INFO, change)


def edit(file: Path, change: Callable[[Any], Any]) -> None:
    """Change what a JSON file holds."""
    file.write_text(json.dumps(change(json.loads(file.read_text()))))


def text(name: str, content: str) -> Damage:
    """Write something else into a file."""
    return lambda root: (root / name).write_text(content)


def column(name: str, value: object, kind: pa.DataType | None = None) -> Damage:
    """Change a column of the table of episodes, in every row."""

    def change(root: Path) -> None:
        file = next((root / "meta/episodes").glob("*/*.parquet"))
        table = pq.read_table(file)
        number = table.column_names.index(name)
        values = pa.array([value] * table.num_rows, type=kind)
        pq.write_table(table.set_column(number, name, values), file)

    return change


def setting(**changes: Any) -> Damage:
    """Change the setting that the episodes are said to be recorded in."""

    def change(root: Path) -> None:
        file = next((root / "meta/episodes").glob("*/*.parquet"))
        stored = json.loads(pq.read_table(file)["labutopia/setting"][0].as_py())
        column("labutopia/setting", json.dumps(stored | changes))(root)

    return change


def frames(name: str, values: Callable[[int], pa.Array]) -> Damage:
    """Replace a column of the table of frames."""

    def change(root: Path) -> None:
        file = next((root / "data").glob("*/*.parquet"))
        table = pq.read_table(file)
        replaced = table.drop_columns([name]).append_column(name, values(table.num_rows))
        pq.write_table(replaced, file)

    return change


def fifo(name: str) -> Damage:
    """Put a pipe that nobody writes into in the place of a file."""

    def change(root: Path) -> None:
        (root / name).unlink()
        os.mkfifo(root / name)

    return change


def link(name: str) -> Damage:
    """Put a link to a file elsewhere in the place of a file."""

    def change(root: Path) -> None:
        secret = root.parent / "secret"
        secret.write_bytes((root / name).read_bytes())
        (root / name).unlink()
        (root / name).symlink_to(secret)

    return change


DAMAGED: dict[str, Damage] = {
    "info is a list": text(INFO, "[]"),
    "info is empty": text(INFO, ""),
    "info is no text": lambda root: (root / INFO).write_bytes(b"\xff\xfe"),
    "info is nested without end": text(INFO, "[" * 100_000),
    "info is a pipe": fifo(INFO),
    "info is a link": link(INFO),
    "a feature without a type": feature("action", dtype=None),
    "a feature of the type 5": feature("action", dtype=5),
    "a feature of the shape x": feature("action", shape="x"),
    "a feature without end": feature("action", shape=[10**12]),
    "a feature that is a path": feature("../../owned", dtype="video", shape=[4, 4, 3]),
    "a camera that is a path": feature("observation.images.a/../../../o", dtype="video", shape=[4]),
    "no frames per second": info(fps=0),
    "x frames per second": info(fps="x"),
    "a million episodes": info(total_episodes=10**6),
    "no number of episodes": info(total_episodes=None),
    "statistics are null": text(STATISTICS, '{"action": null}'),
    "statistics are words": text(STATISTICS, '{"action": {"mean": ["x"]}}'),
    "the recording is a list": text(RECORDING, "[1]"),
    "the recording has no options": text(RECORDING, "{}"),
    "a length of -5": column("length", -5),
    "a length of x": column("length", "x"),
    "a huge length": column("length", 2**40),
    "a seed of -1": column("labutopia/seed", -1),
    "a seed of 1.5": column("labutopia/seed", 1.5),
    "a seed of x": column("labutopia/seed", "x"),
    "tasks are a number": column("tasks", 5),
    "an outcome is a number": column("labutopia/outcome", 5),
    "the setting is no JSON": column("labutopia/setting", "{"),
    "the setting is a list": column("labutopia/setting", "[]"),
    "observed is 5": setting(obs=5),
    "a width of x": setting(width="x"),
    "too many particles": setting(particles=10**9),
    "a room elsewhere": setting(room="../../x"),
    "a task of a number": setting(task=7),
    "actions are missing": frames("action", lambda n: pa.array([None] * n)),
    "commands of 7 elements": frames(
        "commanded_action", lambda n: pa.array([[0.0] * 7] * n, pa.list_(pa.float32()))
    ),
    "commands are words": frames("commanded_action", lambda n: pa.array(["x"] * n)),
    "states are ragged": frames(
        "observation.state",
        lambda n: pa.array([[0.0] * (1 + i % 3) for i in range(n)], pa.list_(pa.float32())),
    ),
    "an index without end": frames("index", lambda n: pa.array([2**62] * n)),
    "the table of tasks is no table": text("meta/tasks.parquet", "no table"),
}


@pytest.mark.parametrize("damage", DAMAGED.values(), ids=DAMAGED)
@pytest.mark.parametrize(
    "program", ["verify", *(pytest.param(n, marks=pytest.mark.slow) for n in list(PROGRAMS)[1:])]
)
def test_a_damaged_dataset_is_refused(
    damage: Damage, program: str, dataset: Path, tmp_path: Path
) -> None:
    damage(dataset)
    ended = run(program, *PROGRAMS[program], folder=tmp_path)
    assert ended.harmless, ended
    assert "Traceback" not in ended.output, ended
    assert "intact" not in ended.output, ended
    if program in ("verify", "publish"):
        assert ended.refused, ended


@pytest.mark.parametrize("program", PROGRAMS)
@pytest.mark.parametrize("reported", ["setting", "recording"])
def test_a_dataset_runs_no_python(
    reported: str, program: str, dataset: Path, tmp_path: Path
) -> None:
    task = dataset / "tasks/level1/pwn.py"
    task.parent.mkdir(parents=True)
    task.write_text(OWNED.format("pwn"))
    places = {"tasks_dir": "dataset/tasks", "task": "level1/pwn"}
    if reported == "setting":
        setting(**places)(dataset)
    edit(dataset / RECORDING, lambda said: said | {"config": said["config"] | places})
    ended = run(program, *PROGRAMS[program], folder=tmp_path)
    assert not (tmp_path / "owned").exists()
    if reported == "recording" and program in ("verify", "replay"):
        return  # these go by the episodes
    assert "--tasks-dir" in ended.output or "tasks_dir" in ended.output, ended
    assert "intact" not in ended.output


@pytest.mark.parametrize("program", ["verify", "replay"])
def test_own_tasks_run_where_the_user_names_them(
    program: str, dataset: Path, tmp_path: Path
) -> None:
    own = tmp_path / "mine/level1/press_it.py"
    own.parent.mkdir(parents=True)
    own.write_text(
        "from labutopia_lerobot.tasks.level1.press import press\n\n\ndef press_it():\n"
        "    return press()\n"
    )
    setting(task="level1/press_it")(dataset)
    ended = run(program, "dataset", "--tasks-dir", "mine", folder=tmp_path, limit_s=60)
    # Another name draws another scene; but it was found and played.
    assert "episode 0" in ended.output, ended
    assert "Not checked" not in ended.output, ended


@pytest.mark.parametrize(
    "name", ["meta/extra.json", "data/chunk-000/file-001.parquet", "meta/labutopia.json"]
)
def test_what_a_link_leads_to_is_not_sent(name: str, dataset: Path, tmp_path: Path) -> None:
    secret = tmp_path / "secret.json"
    secret.write_text('{"token": "secret"}')
    (dataset / name).unlink(missing_ok=True)
    (dataset / name).symlink_to(secret)
    ended = run("publish", *PROGRAMS["publish"], folder=tmp_path, limit_s=60)
    assert ended.harmless, ended
    assert f"  {name}\n" not in ended.output or ended.refused, ended


def test_a_damaged_film_is_a_fault(pictured: Path, tmp_path: Path) -> None:
    next(pictured.glob("videos/*/*/*.mp4")).write_bytes(b"\0" * 1000)
    assert run("verify", "dataset", folder=tmp_path).found_faults


@pytest.mark.parametrize("place", ["/dataset/nowhere", "dataset/meta/info.json/x", "x" * 300])
def test_a_place_that_cannot_be_is_reported_in_a_line(
    place: str, dataset: Path, tmp_path: Path
) -> None:
    for program in PROGRAMS:
        arguments = (place, *PROGRAMS[program][1:])
        assert run(program, *arguments, folder=tmp_path).refused


def test_no_connection_goes_unnoticed(tmp_path: Path) -> None:
    ended = run("evaluate", "task=level1/press", "policy.path=me/nothing", folder=tmp_path)
    assert ended.connections
