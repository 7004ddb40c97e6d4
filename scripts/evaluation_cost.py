"""Cost of an evaluation by its parts: its episodes without a policy, and the policy alone.

    python scripts/evaluation_cost.py task=level1/pick policy.path=outputs/demo/train episodes=50

takes the options of `eval/run.py` for one task and one split, and prints one JSON object: wall time
[s] of the evaluation by one worker, of the simulation and of the policy, and the first over the sum
of the others. On a machine that does nothing else, it is to be below 1.3 for a policy on states.

The evaluation is what a user waits for, from its options to the result file: a worker starts,
imports torch, compiles the scene and loads the weights. The parts are measured in a worker of their
own behind all that: resets and steps with the actions that were played, one after the other; and
the policy with its processors, between steps as in an evaluation, where the simulation has taken
its place in the processor's caches. The more episodes, the less the start-up matters.
"""

import json
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.evaluate import parse
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.evaluation.config import EvaluationConfig
from labutopia_lerobot.evaluation.jobs import EvaluationJob, make_jobs
from labutopia_lerobot.evaluation.result_folder import ResultFolder
from labutopia_lerobot.evaluation.run import run
from labutopia_lerobot.runtime.workers import in_processes

Played = tuple[int, NDArray[np.float32]]
"""Seed and actions, shape (steps, elements), of an episode."""


@clear_errors
def main() -> None:
    """Measure what the command line asks for."""
    config = parse([*sys.argv[1:], "workers=1", "videos=0"])
    sys.stdout.write(json.dumps(evaluation_cost(config)) + "\n")


def evaluation_cost(config: EvaluationConfig) -> dict[str, Any]:
    """Evaluate, then measure the parts; the result itself is thrown away."""
    (job,) = make_jobs(config)
    with tempfile.TemporaryDirectory() as folder:
        config.out = folder
        start = time.perf_counter()
        run(config, Console(quiet=True))
        whole = time.perf_counter() - start
        result = ResultFolder(Path(folder))
        seeds = [row.seed for row in result.rows]
        played = list(zip(seeds, result.actions(), strict=True))
    ((simulation, policy),) = in_processes(parts, [(job, played)], 1)
    return {
        "episodes": len(played),
        "steps": sum(len(actions) for _, actions in played),
        "evaluation_s": round(whole, 2),
        "simulation_s": round(simulation, 2),
        "policy_s": round(policy, 2),
        "evaluation_over_parts": round(whole / (simulation + policy), 3),
    }


def parts(job: EvaluationJob, played: Sequence[Played]) -> tuple[float, float]:
    """Return how long the simulation and the policy take for the same episodes [s]."""
    env, policy = LabEnv(job.setting), job.make_policy()
    simulation = deciding = 0.0
    for seed, actions in played:
        start = time.perf_counter()
        env.reset(seed=seed)
        for action in actions:
            env.step(action)
        simulation += time.perf_counter() - start
        observation, _ = env.reset(seed=seed)
        policy.start(env, seed)
        for action in actions:
            start = time.perf_counter()
            policy.act(observation)
            deciding += time.perf_counter() - start
            observation, *_ = env.step(action)
    env.close()
    return simulation, deciding


if __name__ == "__main__":
    main()
