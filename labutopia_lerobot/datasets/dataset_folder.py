"""The folder of a dataset that a user names: is there one at all?"""

from collections.abc import Sequence
from itertools import islice
from pathlib import Path

from labutopia_lerobot.errors import UserError

INFO = "meta/info.json"
_LISTED = 5


class NoDatasetError(UserError):
    """A folder without a dataset; the message names those in it, or says how to make one."""


def dataset_folder(text: str) -> Path:
    """Return the folder of a dataset, whole or damaged, that an argument names.

    Raises:
        NoDatasetError: If nothing of a dataset is there.
    """
    require_dataset(Path(text), ("meta", "data", ".recording"))
    return Path(text)


def require_dataset(folder: Path, parts: Sequence[str]) -> None:
    """Make sure that a folder has one of some parts of a dataset.

    Raises:
        NoDatasetError: If it has none.
    """
    if any((folder / part).exists() for part in parts):
        return
    places = ("*/", "*/*/", "*/*/*/")
    files = (file for place in places for file in sorted(folder.glob(place + INFO)))
    datasets = [str(file.parents[1]) for file in islice(files, _LISTED)]
    cure = "Make one: labutopia-record level1/pick"
    if datasets:
        cure = f"In it are: {', '.join(datasets)}"
    raise NoDatasetError(f"{folder} is no LeRobotDataset ({folder / INFO} is not there). {cure}")
