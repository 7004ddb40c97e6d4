"""Shared by every test."""

import pytest

import labutopia_lerobot  # noqa: F401  (first of all: it chooses MuJoCo's OpenGL backend)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Keep together what shares fixtures: the tests of a file, and in the suite those of a task."""
    for item in items:
        parameters = getattr(item, "callspec", None)
        task = parameters.params.get("env") if parameters is not None else None
        group = task if isinstance(task, str) else str(item.path)
        item.add_marker(pytest.mark.xdist_group(group))
