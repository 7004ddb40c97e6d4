"""`python scripts/make_docs.py`: the gallery, and the tables of tasks, starts and failures.

The numbers are the expert's rows in `eval/results`, which `scripts/expert_rows.py` keeps there.
"""

import argparse
import math
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

import expert_rows
from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.evaluation.rows import Row, summarise
from labutopia_lerobot.layout import Inside, OfTheRoom, OnBench
from labutopia_lerobot.registry import is_beyond_paper, task_files
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import Setting, UnknownOptionError

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
BEGIN, END = "<!-- tasks -->", "<!-- end of tasks -->"
_SHORT = 3
"""Steps of a task whose pictures at the start and at the end say enough, unless one drives."""
_COLUMNS = 5
"""Most pictures in a row of steps."""


Rows = Mapping[str, Sequence[Row]]
"""Task id -> the expert's rows."""


@clear_errors
def main() -> None:
    """Write everything."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", type=Path, nargs="?", default=expert_rows.RESULTS)
    parser.add_argument("--tables", action="store_true", help="leave the pictures as they are")
    parser.add_argument("--only", metavar="TASK", nargs="+", help="of which tasks to make pictures")
    arguments = parser.parse_args()
    folder = arguments.results
    shifted = expert_rows.read(folder, expert_rows.OOD)
    write_tables(expert_rows.read(folder), shifted, expert_rows.commits(folder))
    write_gallery([] if arguments.tables else arguments.only or [*task_files()])


def write_tables(rows: Rows, shifted: Rows, commits: Mapping[str, str]) -> None:
    """Write the table of tasks, where things start and how experts fail."""
    page = DOCS / "tasks.md"
    before, _, rest = page.read_text().partition(BEGIN)
    _, _, after = rest.partition(END)
    table = "\n".join(task_table(rows, shifted, commits))
    page.write_text(f"{before}{BEGIN}\n{table}\n{END}{after}")
    (DOCS / "starts.md").write_text("\n".join(start_table()) + "\n")
    (DOCS / "failures.md").write_text("\n".join(failure_table(rows)) + "\n")


def write_gallery(drawn: Sequence[str]) -> None:
    """Write the page that shows the pictures, and the pictures of some tasks."""
    gallery = [
        "# Gallery",
        "",
        "[To the README](../README.md)",
        "",
        "The expert with seed 0: start and end, from the three cameras; of long tasks also the",
        "moments in which their steps are done, from the front.",
        "",
    ]
    for task_id in task_files():
        task, name = canonical_task(Setting(task_id)), task_id.replace("/", "-")
        gallery += [f"## {task_id}", "", task.instruction, "", f"![{task_id}](gallery/{name}.png)"]
        long = len(task.steps) > _SHORT or task.drives
        if long:
            gallery += ["", f"![{task_id}, step by step](gallery/{name}-steps.png)"]
        gallery += [""]
        if task_id in drawn:
            ends, steps = watched(task_id)
            save(ends, name)
            if long:
                save(steps, f"{name}-steps")
    (DOCS / "gallery.md").write_text("\n".join(gallery))


def save(picture: NDArray[np.uint8], name: str) -> None:
    """Write a picture of the gallery as a small PNG."""
    file = DOCS / "gallery" / f"{name}.png"
    file.parent.mkdir(parents=True, exist_ok=True)
    Image.fromarray(picture).quantize(256).save(file, optimize=True)


def watched(task_id: str) -> tuple[NDArray[np.uint8], NDArray[np.uint8]]:
    """Return the first picture above the last from all cameras, and one from the front per step."""
    env = LabEnv(Setting(task_id, obs="state"))  # draws a few moments only
    env.reset(seed=0)
    first, steps = _all_cameras(env), []
    cell, expert = env.workcell, env.expert()
    expert.start()
    over = False
    while not over:
        step = cell.progress.step
        _, _, terminated, truncated, _ = env.step(expert.act())
        over = terminated or truncated
        if step is not None and cell.progress.step is not step:
            steps.append(cell.pictures(("front",))["front"])
    last = _all_cameras(env)
    env.close()
    columns = math.ceil(len(steps) / math.ceil(len(steps) / _COLUMNS))
    steps += [np.full_like(steps[0], 255)] * (-len(steps) % columns)
    rows = (np.hstack(steps[i : i + columns]) for i in range(0, len(steps), columns))
    return np.vstack([first, last]), np.vstack(list(rows))


def _all_cameras(env: LabEnv) -> NDArray[np.uint8]:
    """Return what the cameras see now, side by side."""
    return np.hstack(list(env.workcell.pictures(env.setting.cameras).values()))


def task_table(rows: Rows, shifted: Rows, commits: Mapping[str, str]) -> list[str]:
    """Return the table of tasks in Markdown.

    Args:
        rows: The expert's.
        shifted: Its rows of split `ood`, of the tasks of which they were measured.
        commits: Task id -> by which they were played.
    """
    lines = [
        "| task | instruction | expert | 95 % | ood | mean time | commit |",
        "| --- | --- | --- | --- | --- | --- | --- |",
    ]
    beyond = False
    for task_id, played in rows.items():
        if is_beyond_paper(task_id) and not beyond:
            beyond = True
            lines.append("| *beyond the paper* | | | | | | |")
        (line,) = summarise(played)
        low, high = line.wilson95
        seconds = line.mean_seconds_to_success
        cells = [
            f"`{task_id}`",
            canonical_task(Setting(task_id)).instruction,
            f"{line.successes}/{line.n}",
            f"{100 * low:.0f} to {100 * high:.0f} %",
            _shifted(task_id, shifted),
            "-" if seconds is None else f"{seconds:.1f} s",
            commits[task_id],
        ]
        lines.append(f"| {' | '.join(cells)} |")
    return lines


def _shifted(task_id: str, rows: Rows) -> str:
    """Return the successes where the task's own axes are shifted; it may have none."""
    if task_id in rows:
        (line,) = summarise(rows[task_id])
        return f"{line.successes}/{line.n}"
    try:
        canonical_task(Setting(task_id, split="ood"))
    except UnknownOptionError:
        return "-"
    return "not measured"


def start_table() -> list[str]:
    """Return where everything starts, in Markdown."""
    lines = [
        "# Where things start",
        "",
        "[To the README](../README.md)",
        "",
        "Uniform over these ranges, world frame; the robot stands at x = -0.4 m and looks along",
        "x. In the paper's tasks of levels 1 to 3 what stands free is spread over its 15 cm x",
        "15 cm and turned by any yaw; beyond them over less where several things need room. Level",
        "4's vessels get 4 to 12 cm: several of them, and the hand that comes to one past the",
        "others, leave no more room. The paper's instruments stand where the original's do, over",
        "its ranges, and turn by a few degrees only, since further round the arm could not take",
        "their handles and buttons.",
        "At level 5 things stand on benches of a furnished room, each on another but for those of",
        "clear_bench, where a robot that docks reaches them; it starts 2 m or more from them,",
        "anywhere that it can drive.",
        "",
        "| task | thing | x [m] | y [m] | yaw [deg] |",
        "| --- | --- | --- | --- | --- |",
    ]
    for task_id in task_files():
        for piece, region in canonical_task(Setting(task_id)).start.items():
            if isinstance(region, Inside):
                lines.append(f"| `{task_id}` | {piece.name} | in {region.holder.name} | | any |")
                continue
            if not isinstance(region, OnBench):
                yaw = region.described
                where = (
                    "the room's own" if isinstance(region, OfTheRoom) else "on a bench of the room"
                )
                lines.append(f"| `{task_id}` | {piece.name} | {where} | | {yaw} |")
                continue
            x, y = (f"{metres(low)} to {metres(high)}" for low, high in (region.x, region.y))
            low, high = np.degrees(region.yaw)
            cells = (f"`{task_id}`", piece.name, x, y, f"{low:.0f} to {high:.0f}")
            lines.append(f"| {' | '.join(cells)} |")
    return lines


def metres(length: float) -> str:
    """Return a length [m] in centimetres' precision, or in millimetres' where it needs that."""
    text = f"{length:.3f}"
    return text.removesuffix("0")


def failure_table(rows: Rows) -> list[str]:
    """Return the experts' failures by cause, in Markdown."""
    lines = [
        "# How experts fail",
        "",
        "[To the README](../README.md)",
        "",
        "Outcomes of the episodes behind [the table of tasks](tasks.md); why episodes failed, and",
        "which phase the expert could not finish; how many starts were drawn anew because the",
        "expert could not bring about from them what the task begins with, such as a beaker in",
        "the hand.",
        "",
        "| task | episodes | outcomes | causes | expert | starts drawn anew |",
        "| --- | --- | --- | --- | --- | --- |",
    ]
    for task_id, played in rows.items():
        (line,) = summarise(played)
        stuck = Counter(row.expert_failure for row in played if row.expert_failure is not None)
        cells = [f"`{task_id}`", str(line.n)]
        cells += [_counted(line.outcomes), _counted(line.causes), _counted(stuck)]
        anew = [row.setup_failures for row in played if row.setup_failures is not None]
        cells.append(str(sum(anew)) if anew else "not recorded")
        lines.append(f"| {' | '.join(cells)} |")
    return lines


def _counted(counts: Mapping[str, int]) -> str:
    return ", ".join(f"{name} {count}" for name, count in counts.items())


if __name__ == "__main__":
    main()
