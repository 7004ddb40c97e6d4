"""A Ray cluster: the one at `RAY_ADDRESS`, or one of this machine."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from labutopia_lerobot.errors import UserError


class RayError(UserError):
    """Ray is not there, or a machine of its cluster cannot be used; the message says why."""


@contextmanager
def joined_cluster() -> Iterator[Any]:
    """Join the cluster at `RAY_ADDRESS`, or start one of this machine.

    Yields:
        The module `ray`.

    Raises:
        RayError: If Ray is not installed, or no cluster answers.
    """
    try:
        import ray
    except ImportError:
        raise RayError("launcher=ray needs Ray: pip install 'lerobot_env_labutopia[ray]'") from None
    os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")  # Ray would report to its makers
    try:
        context: Any = ray.init(log_to_driver=False, ignore_reinit_error=True)
    except (ConnectionError, ValueError) as error:
        raise RayError(
            f"launcher=ray: no cluster at RAY_ADDRESS={os.environ.get('RAY_ADDRESS')}: {error}"
        ) from None
    try:
        yield ray
    finally:
        context.disconnect()
