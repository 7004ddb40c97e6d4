"""`labutopia-render DATASET OUT --width 512`: a dataset drawn anew, with other cameras or sizes.

The episodes stay what they are: each is played again from its seed and commands, without its
expert.
"""

import argparse
from dataclasses import fields
from pathlib import Path

from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.grammar import OptionParser
from labutopia_lerobot.cli.recording_bars import RecordingBars
from labutopia_lerobot.cli.setting_flags import add_own_files, add_setting_flags
from labutopia_lerobot.datasets.description import read_info
from labutopia_lerobot.datasets.rendering import render
from labutopia_lerobot.setting import Setting

_DRAWING = ("cameras", "extras", "width", "height", "renderer")
"""Fields of `Setting` on which pictures depend and, but for forces, nothing else."""


@clear_errors
def main() -> None:
    """Render what the command line names."""
    parser = OptionParser(
        prog="labutopia-render",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("dataset", type=Path, help="folder that labutopia-record made")
    parser.add_argument("out", type=Path, help="folder of the new dataset")
    parser.add_argument(
        "--tasks-dir", metavar="DIR", help="a folder of tasks of your own, whose files you trust"
    )
    add_setting_flags(parser, but=[o.name for o in fields(Setting) if o.name not in _DRAWING])
    add_own_files(parser)
    arguments = parser.parse_args()
    chosen = {name: getattr(arguments, name) for name in _DRAWING}
    episodes = read_info(arguments.dataset)["total_episodes"]
    console = Console(stderr=True, highlight=False, soft_wrap=True)
    with RecordingBars(episodes, console) as bars:
        render(arguments.dataset, arguments.out, bars, arguments.tasks_dir, **chosen)
    console.print(f"Rendered {episodes} episodes into {arguments.out}", markup=False)


if __name__ == "__main__":
    main()
