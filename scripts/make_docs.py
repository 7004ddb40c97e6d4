"""`python scripts/make_docs.py`: the gallery, and the tables of tasks, starts and failures.

The numbers are the expert's rows in `eval/results`, which `scripts/expert_rows.py` keeps there.
"""

import argparse
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

import expert_rows
from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.evaluation.row import Row
from labutopia_lerobot.evaluation.statistics import summarise
from labutopia_lerobot.layout import Inside
from labutopia_lerobot.registry import is_beyond_paper, task_files
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import Setting

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
BEGIN, END = "<!-- tasks -->", "<!-- end of tasks -->"


Rows = Mapping[str, Sequence[Row]]
"""Task id -> the expert's rows."""


@clear_errors
def main() -> None:
    """Write everything."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", type=Path, nargs="?", default=expert_rows.RESULTS)
    parser.add_argument("--tables", action="store_true", help="leave the pictures as they are")
    arguments = parser.parse_args()
    write_tables(expert_rows.read(arguments.results))
    if not arguments.tables:
        write_gallery()


def write_tables(rows: dict[str, list[Row]]) -> None:
    """Write the table of tasks in the README, where things start and how experts fail."""
    readme = (ROOT / "README.md").read_text()
    before, _, rest = readme.partition(BEGIN)
    _, _, after = rest.partition(END)
    table = "\n".join(task_table(rows))
    (ROOT / "README.md").write_text(f"{before}{BEGIN}\n{table}\n{END}{after}")
    (DOCS / "starts.md").write_text("\n".join(start_table()) + "\n")
    (DOCS / "failures.md").write_text("\n".join(failure_table(rows)) + "\n")


def write_gallery() -> None:
    """Write the pictures and the page that shows them."""
    gallery = [
        "# Gallery",
        "",
        "The expert with seed 0: start and end, from the three cameras.",
        "",
    ]
    for task_id in task_files():
        picture = DOCS / "gallery" / f"{task_id.replace('/', '-')}.png"
        picture.parent.mkdir(parents=True, exist_ok=True)
        Image.fromarray(start_and_end(task_id)).quantize(256).save(picture, optimize=True)
        task = canonical_task(Setting(task_id))
        gallery += [f"## {task_id}", "", task.instruction, ""]
        gallery += [f"![{task_id}](gallery/{picture.name})", ""]
    Image.fromarray(pouring()).quantize(256).save(DOCS / "gallery" / "pouring.png", optimize=True)
    (DOCS / "gallery.md").write_text("\n".join(gallery))


def pouring() -> NDArray[np.uint8]:
    """Return pictures of a pour when a third is in the target, all cameras side by side."""
    env = LabEnv(Setting("level1/pour", width=384, height=384))
    env.reset(seed=1)
    expert = env.expert()
    expert.start()
    while True:
        observation, *_ = env.step(expert.act())
        liquid = env.workcell.world.liquid
        if liquid is not None and liquid.poured > liquid.total / 3:
            return np.hstack(list(observation["pixels"].values()))


def start_and_end(task_id: str) -> NDArray[np.uint8]:
    """Return the first picture above the last, all cameras side by side."""
    env = LabEnv(Setting(task_id, obs="state"))  # draws two moments only
    env.reset(seed=0)
    first = _all_cameras(env)
    expert = env.expert()
    expert.start()
    over = False
    while not over:
        _, _, terminated, truncated, _ = env.step(expert.act())
        over = terminated or truncated
    last = _all_cameras(env)
    env.close()
    return np.vstack([first, last])


def _all_cameras(env: LabEnv) -> NDArray[np.uint8]:
    """Return what the cameras see now, side by side."""
    return np.hstack(list(env.workcell.pictures(env.setting.cameras).values()))


def task_table(rows: Rows) -> list[str]:
    """Return the table of tasks in Markdown."""
    lines = [
        "| task | instruction | expert | 95 % | mean time |",
        "| --- | --- | --- | --- | --- |",
    ]
    beyond = False
    for task_id, played in rows.items():
        if is_beyond_paper(task_id) and not beyond:
            beyond = True
            lines.append("| *beyond the paper* | | | | |")
        (line,) = summarise(played)
        low, high = line.wilson95
        seconds = line.mean_seconds_to_success
        cells = [
            f"`{task_id}`",
            canonical_task(Setting(task_id)).instruction,
            f"{line.successes}/{line.n}",
            f"{100 * low:.0f} to {100 * high:.0f} %",
            "-" if seconds is None else f"{seconds:.1f} s",
        ]
        lines.append(f"| {' | '.join(cells)} |")
    return lines


def start_table() -> list[str]:
    """Return where everything starts, in Markdown."""
    lines = [
        "# Where things start",
        "",
        "Uniform over these ranges, world frame; the robot stands at x = -0.4 m and looks along",
        "x. What stands free is spread over the paper's 15 cm x 15 cm and turned by any yaw.",
        "Narrower: instruments stand where the original's do, over its ranges, and turn by a few",
        "degrees only, since further round the arm could not take their handles and buttons.",
        "",
        "| task | thing | x [m] | y [m] | yaw [deg] |",
        "| --- | --- | --- | --- | --- |",
    ]
    for task_id in task_files():
        for piece, region in canonical_task(Setting(task_id)).start.items():
            if isinstance(region, Inside):
                lines.append(f"| `{task_id}` | {piece.name} | in {region.holder.name} | | any |")
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
        "Outcomes of the episodes behind the README's table; why episodes failed, and which phase",
        "the expert could not finish; how many starts were drawn anew because the expert could not",
        "bring about from them what the task begins with, such as a beaker in the hand.",
        "",
        "| task | episodes | outcomes | causes | expert | starts drawn anew |",
        "| --- | --- | --- | --- | --- | --- |",
    ]
    for task_id, played in rows.items():
        (line,) = summarise(played)
        stuck = Counter(row.expert_failure for row in played if row.expert_failure is not None)
        cells = [f"`{task_id}`", str(line.n)]
        cells += [_counted(line.outcomes), _counted(line.causes), _counted(stuck)]
        anew = [row.prelude_failures for row in played if row.prelude_failures is not None]
        cells.append(str(sum(anew)) if anew else "not recorded")
        lines.append(f"| {' | '.join(cells)} |")
    return lines


def _counted(counts: Mapping[str, int]) -> str:
    return ", ".join(f"{name} {count}" for name, count in counts.items())


if __name__ == "__main__":
    main()
