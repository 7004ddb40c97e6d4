"""`labutopia-bench`: how fast it runs on this machine."""

import json
import sys
from functools import partial

from rich.console import Console
from rich.table import Table

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.doing import doing
from labutopia_lerobot.cli.grammar import OptionParser
from labutopia_lerobot.cli.setting_flags import add_setting_flags, setting_of_flags
from labutopia_lerobot.cli.speed import RIGID, all_tasks, measure
from labutopia_lerobot.registry import require_task

_TARGETS = {  # on two cores without a GPU
    "no_camera_fps": 1500,
    "no_camera_fps_all_cores": 2800,
    "rigid_2cam_fps": 90,
    "rigid_2cam_fps_all_cores": 160,
    "liquid_2cam_fps": 46,
    "liquid_2cam_fps_all_cores": 80,
    "liquid_solver_real_time": 3.5,
    "record_3cam_fps": 60,
}


@clear_errors
def main() -> None:
    """Measure and print, as a table or as one JSON object."""
    parser = OptionParser(prog="labutopia-bench", description=__doc__)
    parser.add_argument("tasks", nargs="*", help="tasks for demonstrations per hour; default all")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument(
        "--seconds", type=float, default=10.0, help="length of a measurement [s] (default: 10)"
    )
    parser.add_argument(
        "--episodes", type=int, default=20, help="demonstrations per measurement (default: 20)"
    )
    add_setting_flags(parser, but=("obs", "cameras", "split", "axes", "liquid"))
    arguments = parser.parse_args()
    for task in arguments.tasks:
        require_task(task, arguments.tasks_dir)
    base = setting_of_flags(arguments, RIGID)
    tasks = arguments.tasks or all_tasks()
    watcher = partial(doing, Console(stderr=True))
    figures = measure(base, tasks, arguments.seconds, arguments.episodes, watcher)
    if arguments.json:
        sys.stdout.write(json.dumps(figures) + "\n")
        return
    table = Table(title=f"{figures['cores']} cores, {figures['renderer']}")
    table.add_column("figure")
    table.add_column("here", justify="right")
    table.add_column("target on two cores", justify="right")
    for name, value in figures.items():
        if name.endswith(("fps", "_cores", "real_time")):
            table.add_row(name, str(value), str(_TARGETS.get(name, "-")))
    for task, rate in figures["demos_per_hour"].items():
        table.add_row(f"demonstrations per hour, {task}", str(rate), "-")
    Console().print(table)


if __name__ == "__main__":
    main()
