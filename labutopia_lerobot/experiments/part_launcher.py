"""Launchers of parts: one after the other on this machine, or all over a Ray cluster."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from labutopia_lerobot.experiments.child_process import EndedChild, run_child
from labutopia_lerobot.experiments.parts.experiment_part import ExperimentPart, log_of
from labutopia_lerobot.runtime import provenance

type Run = Callable[
    [ExperimentPart, dict[str, Any], Callable[[float], None]], tuple[EndedChild, str]
]
"""Runs the program of a part, watched, from these inputs; returns how it ended, and where."""

LAUNCHERS = ("local", "ray")


@dataclass(frozen=True)
class PartLauncher:
    """Runs programs of parts.

    Attributes:
        run: Runs one, and waits for it.
        together: Whether it may be asked for several at a time.
        stop: Ends those that run, where their own end does not.
    """

    run: Run
    together: bool = False
    stop: Callable[[], None] = lambda: None


def _run_here(
    part: ExperimentPart, inputs: dict[str, Any], watch: Callable[[float], None]
) -> tuple[EndedChild, str]:
    part.prepare()
    return run_child(part.command(), log_of(part), part.progress, watch), provenance.machine()


HERE = PartLauncher(_run_here)


@contextmanager
def launcher(name: str, parts: Sequence[ExperimentPart]) -> Iterator[PartLauncher]:
    """Start a launcher, and end it again.

    Args:
        name: One of `LAUNCHERS`.
        parts: What it is for.

    Raises:
        UserError: If it cannot be started, or no machine of it suffices for a part.
    """
    if name == "ray":
        from labutopia_lerobot.experiments.ray_parts import ray_launcher  # needs the extra `ray`

        with ray_launcher(parts) as (run, stop):
            yield PartLauncher(run, together=True, stop=stop)
        return
    yield HERE
