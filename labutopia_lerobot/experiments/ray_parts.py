"""Parts of an experiment on the machines of a Ray cluster, which share the folder of it.

What a part needs is done before it; all others run at the same time, as the cores of the machines
allow. When a machine is lost, its part goes on elsewhere from what is in the folder.
"""

import json
import os
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.experiments.child_process import EndedChild, run_child
from labutopia_lerobot.experiments.parts.experiment_part import ExperimentPart, log_of
from labutopia_lerobot.runtime import provenance
from labutopia_lerobot.runtime.claim import differences
from labutopia_lerobot.runtime.ray_cluster import RayError, joined_cluster

type _Run = Callable[
    [ExperimentPart, dict[str, Any], Callable[[float], None]], tuple[EndedChild, str]
]

_LOOK_S = 1.0
"""Time between two looks at a part [s]."""


@contextmanager
def ray_launcher(parts: Sequence[ExperimentPart]) -> Iterator[tuple[_Run, Callable[[], None]]]:
    """Join a cluster, or start one of this machine.

    Args:
        parts: Parts that will be run there.

    Yields:
        A function that runs the program of a part with these inputs, which watches it, and returns
        how it ended, and where; and a function that ends those that run.

    Raises:
        RayError: If there is no cluster, or none of its machines has the cores of a part.
    """
    with joined_cluster() as ray:
        _require_cores(ray, parts)
        stopped = threading.Event()

        def run(
            part: ExperimentPart, inputs: dict[str, Any], watch: Callable[[float], None]
        ) -> tuple[EndedChild, str]:
            claim = {"num_cpus": part.cores, "num_gpus": part.gpus}
            remote = ray.remote(max_retries=-1, **claim)(_run_there)
            there = remote.remote(part, inputs, Path.cwd())
            while not ray.wait([there], timeout=_LOOK_S)[0]:
                watch(part.progress())
                if stopped.is_set():
                    ray.cancel(there, force=True)
                    raise KeyboardInterrupt
            try:
                ended: tuple[EndedChild, str] = ray.get(there)
            except ray.exceptions.RayTaskError as error:
                raise error.cause if isinstance(error.cause, UserError) else error from None
            return ended

        yield run, stopped.set


def _require_cores(ray: Any, parts: Sequence[ExperimentPart]) -> None:
    machines = [node["Resources"] for node in ray.nodes() if node["Alive"]]
    for part in parts:
        if not any(
            machine.get("CPU", 0) >= part.cores and machine.get("GPU", 0) >= part.gpus
            for machine in machines
        ):
            raise RayError(
                f"launcher=ray: no machine of the cluster has {part.cores} cores and {part.gpus} "
                f"GPUs, as '{part.name}' needs. Take fewer workers=, or add a machine"
            )


def _run_there(
    part: ExperimentPart, expected: dict[str, Any], folder: Path
) -> tuple[EndedChild, str]:
    """Run a part on whatever machine this is.

    Raises:
        RayError: If the machine does not see the folder, or has other code or versions.
    """
    name = os.uname().nodename
    if not folder.is_dir() or not (folder / part.out).is_dir():
        raise RayError(
            f"The machine {name} does not see {folder / part.out}: launcher=ray needs an out= that "
            "all machines share, at the same place"
        )
    os.chdir(folder)
    there = json.loads(json.dumps(part.inputs()))
    different = differences({"inputs": there}, {"inputs": expected})
    if different:
        raise RayError(
            f"The machine {name} would make something else:\n"
            + "\n".join(different)
            + "\nInstall the same there"
        )
    part.prepare()
    ended = run_child(part.command(), log_of(part), part.progress, lambda share: None)
    return ended, provenance.machine()
