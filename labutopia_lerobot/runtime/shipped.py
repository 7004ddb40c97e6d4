"""Files that come with the package: configurations of the evaluator, recipes for training."""

from pathlib import Path

_PACKAGE = Path(__file__).parents[1]


def shipped(folder: str) -> Path:
    """Return a folder of files that come with the package.

    Args:
        folder: `configs` or `policies`. A wheel holds them inside the package; in a checkout they
            lie beside it.
    """
    inside = _PACKAGE / folder
    return inside if inside.is_dir() else _PACKAGE.parent / folder
