"""`python scripts/make_docs.py RESULTS`: the gallery, and the table of tasks in the README.

RESULTS is a folder with results of `eval/run.py level=N policy=expert`.
"""

import argparse
import json
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.evaluation.result import RESULT
from labutopia_lerobot.layout import Inside
from labutopia_lerobot.registry import is_beyond_paper, task_files
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import Setting

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
BEGIN, END = "<!-- tasks -->", "<!-- end of tasks -->"


def main() -> None:
    """Write everything."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", type=Path)
    results = parser.parse_args().results
    summaries = {}
    for file in sorted(results.rglob(RESULT)):
        content = json.loads(file.read_text())
        summaries |= {line["task"]: line for line in content["summary"]}
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
    readme = (ROOT / "README.md").read_text()
    before, _, rest = readme.partition(BEGIN)
    _, _, after = rest.partition(END)
    table = "\n".join(task_table(summaries))
    (ROOT / "README.md").write_text(f"{before}{BEGIN}\n{table}\n{END}{after}")
    (DOCS / "starts.md").write_text("\n".join(start_table()) + "\n")
    (DOCS / "failures.md").write_text("\n".join(failure_table(summaries)) + "\n")


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
    env = LabEnv(Setting(task_id))
    observation, _ = env.reset(seed=0)
    first = np.hstack(list(observation["pixels"].values()))
    expert = env.expert()
    expert.start()
    over = False
    while not over:
        observation, _, terminated, truncated, _ = env.step(expert.act())
        over = terminated or truncated
    env.close()
    return np.vstack([first, np.hstack(list(observation["pixels"].values()))])


def task_table(summaries: dict[str, dict[str, Any]]) -> list[str]:
    """Return the table of tasks in Markdown."""
    lines = [
        "| task | instruction | expert | 95 % | mean time |",
        "| --- | --- | --- | --- | --- |",
    ]
    beyond = False
    for task_id in task_files():
        if is_beyond_paper(task_id) and not beyond:
            beyond = True
            lines.append("| *beyond the paper* | | | | |")
        line, instruction = summaries.get(task_id), canonical_task(Setting(task_id)).instruction
        cells = ["not measured", "", ""]
        if line is not None:
            low, high = line["wilson95"]
            cells = [
                f"{line['successes']}/{line['n']}",
                f"{100 * low:.0f} to {100 * high:.0f} %",
                f"{line['mean_seconds_to_success']:.1f} s",
            ]
        lines.append(f"| `{task_id}` | {instruction} | " + " | ".join(cells) + " |")
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
            x, y = (f"{low:.2f} to {high:.2f}" for low, high in (region.x, region.y))
            low, high = np.degrees(region.yaw)
            cells = (f"`{task_id}`", piece.name, x, y, f"{low:.0f} to {high:.0f}")
            lines.append(f"| {' | '.join(cells)} |")
    return lines


def failure_table(summaries: dict[str, dict[str, Any]]) -> list[str]:
    """Return the experts' failures by cause, in Markdown."""
    lines = ["# How experts fail", "", "Outcomes of the episodes behind the README's table.", ""]
    lines += ["| task | episodes | outcomes |", "| --- | --- | --- |"]
    for task_id, line in summaries.items():
        outcomes = ", ".join(f"{name} {count}" for name, count in Counter(line["outcomes"]).items())
        lines.append(f"| `{task_id}` | {line['n']} | {outcomes} |")
    return lines


if __name__ == "__main__":
    main()
