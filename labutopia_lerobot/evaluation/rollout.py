"""Playing one episode, and playing it again in front of a camera."""

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import groupby, islice
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.chemistry.kept_answers import reasoner_label
from labutopia_lerobot.env import Info, LabEnv
from labutopia_lerobot.evaluation.condition import EXPERT, Condition
from labutopia_lerobot.evaluation.failure_causes import cause_of
from labutopia_lerobot.evaluation.jobs import EvaluationJob
from labutopia_lerobot.evaluation.journey import Journey
from labutopia_lerobot.evaluation.policies import (
    REFERENCE_POLICIES,
    Policy,
    PolicyUnreachable,
)
from labutopia_lerobot.evaluation.precision import Precision
from labutopia_lerobot.evaluation.result_folder import film_of, film_of_expert
from labutopia_lerobot.evaluation.rows import Row
from labutopia_lerobot.runtime.video import write_video
from labutopia_lerobot.runtime.workers import in_processes
from labutopia_lerobot.scenario.task_function import located_in_play
from labutopia_lerobot.scenes import room_label
from labutopia_lerobot.setting import IMAGE_SIZE, Setting
from labutopia_lerobot.sim.classic_renderer import NoOpenGLError
from labutopia_lerobot.sim.renderers import renderer_name, require_renderer
from labutopia_lerobot.sim.workcell import Workcell
from labutopia_lerobot.task import POLICY_UNREACHABLE, RUNNING
from labutopia_lerobot.world import CONTROL_HZ


@dataclass(frozen=True)
class Episode:
    """A played episode.

    Attributes:
        job: The played episode.
        row: What became of it.
        actions: Everything that the policy commanded, shape (steps, elements).
    """

    job: EvaluationJob
    row: Row
    actions: NDArray[np.float32]


def evaluate(
    jobs: Sequence[EvaluationJob],
    seeds: Sequence[int],
    workers: int,
    known: Collection[Episode] = (),
    enough: Callable[[Condition], bool] = lambda condition: False,
) -> Iterator[Episode]:
    """Yield every episode as it is finished; what is in them does not depend on the workers.

    Args:
        jobs: What to play.
        seeds: Which episodes of each.
        workers: Number of processes.
        known: Episodes that an earlier run played; they are not yielded.
        enough: Whether a condition needs no more episodes; asked before each of them.

    Raises:
        Exception: Whatever was raised in a worker; a bug is not a failed episode.
    """
    played = {(episode.job, episode.row.seed) for episode in known}
    unplayed = (
        (job, seed)
        for job in jobs
        for seed in seeds
        if (job, seed) not in played and not enough(job.condition)
    )
    yield from in_processes(play, unplayed, workers)


def in_order(episodes: Sequence[Episode], jobs: Sequence[EvaluationJob]) -> list[Episode]:
    """Return episodes in the order of the jobs, and then of the seeds."""
    return sorted(episodes, key=lambda episode: (jobs.index(episode.job), episode.row.seed))


def play(job: EvaluationJob, seed: int) -> Episode:
    """Play the episode of a seed.

    Raises:
        Exception: Whatever a policy or a task raises, with a note that names the episode: a bug is
            not a failed episode, and a mistake in a task of the user's names its line. Only a
            policy elsewhere that cannot be asked any more ends it.
    """
    setting = job.setting
    try:
        with located_in_play(setting.task, setting.tasks_dir):
            return _play(job, seed)
    except Exception as error:
        error.add_note(
            f"In the episode of {setting.task}, split {setting.split}, seed {seed}, played by "
            f"{job.policy}, {job.play}"
        )
        raise


def _play(job: EvaluationJob, seed: int) -> Episode:
    env, policy = _prepare(job)
    observation, info = env.reset(seed=seed)
    policy.start(env, seed)
    actions: list[NDArray[np.float32]] = []
    precision = Precision(env.workcell.task, env.workcell.world)
    task, world = env.workcell.task, env.workcell.world
    journey = Journey(env.workcell.steps, world) if task.drives else None
    over = False
    while not over:
        try:
            action = policy.act(observation)
        except PolicyUnreachable:
            info = info | {"outcome": POLICY_UNREACHABLE}
            break
        actions.append(action)
        observation, _, terminated, truncated, info = env.step(action)
        precision.note(info["substeps"])
        if journey is not None:
            journey.note()
        over = terminated or truncated
    row = _row(job, seed, len(actions), info, env.workcell)
    row = replace(
        row,
        **precision.columns,
        driving=None if journey is None else journey.columns(success=row.success),
        expert_failure=getattr(policy, "failure", None),
        cause=cause_of(row),
        device=getattr(policy, "device", None),
        renderer=_policy_renderer(job.setting),
    )
    elements = env.workcell.simulation.command.size
    commanded = np.array(actions, dtype=np.float32).reshape(len(actions), elements)
    return Episode(job, row, commanded)


def _policy_renderer(setting: Setting) -> str | None:
    return renderer_name(setting.renderer) if setting.obs == "pixels" else None


@lru_cache(maxsize=1)
def _prepare(job: EvaluationJob) -> tuple[LabEnv, Policy]:
    """Compile the scene and load the policy once per process, not once per episode."""
    return LabEnv(job.setting), job.make_policy()


def _row(job: EvaluationJob, seed: int, steps: int, info: Info, workcell: Workcell) -> Row:
    setting = job.setting
    latched = {name: _time(time) for name, time in info["substeps"].items()}
    return Row(
        task=setting.task,
        split=setting.split,
        axes=list(setting.axes),
        drawn=info["drawn"],
        policy=job.policy,
        play=job.play,
        obs=setting.obs,
        robot=setting.robot,
        room=room_label(setting.room),
        step=setting.step,
        after=info.get("after"),
        seed=seed,
        success=info["is_success"],
        ever_success=info["ever_success"],
        outcome=info["outcome"],
        steps=steps,
        seconds=round(steps / CONTROL_HZ, 3),
        substeps={m.name: latched[m.name] for step in workcell.steps for m in step.substeps},
        step_times={step.name: latched[step.substeps[-1].name] for step in workcell.steps},
        facts=info["facts"],
        history={
            name: {"first": _time(fact.first), "last": _time(fact.last), "times": fact.times}
            for name, fact in workcell.progress.history.items()
        },
        liquid=job.condition.liquid,
        particles=setting.particles,
        reasoner=reasoner_label(setting.reasoner),
        odometry=setting.odometry,
        ml_total=_millilitres(info.get("ml_total")),
        ml_poured=_millilitres(info.get("ml_poured")),
        ml_retained=_millilitres(info.get("ml_retained")),
        ml_spilled=_millilitres(info.get("ml_spilled")),
        ml_clinging=_millilitres(info.get("ml_clinging")),
        ml_in_flight=_millilitres(info.get("ml_in_flight")),
        clipped_actions=info["clipped_actions"],
        nonfinite_actions=info["nonfinite_actions"],
        setup_failures=info["setup_failures"],
        readings={n: _finite(value) for n, value in info["readings"].items()},
        solutions={
            vessel: {name: _finite(value) for name, value in numbers.items()}
            for vessel, numbers in info.get("solutions", {}).items()
        },
        unreacted=list(info.get("unreacted", ())),
    )


def _time(seconds: float | None) -> float | None:
    return None if seconds is None or np.isinf(seconds) else round(float(seconds), 3)


def _finite(value: float | None) -> float | None:
    return float(value) if value is not None and np.isfinite(value) else None


def _millilitres(volume: float | None) -> float | None:
    return None if volume is None else round(volume, 3)


_CAMERA = "front"


def require_camera(renderer: str) -> None:
    """Make sure, before hours of playing, that films can be drawn by a kind of renderer.

    Raises:
        NoFilamentError: If it is Filament, and there is no Vulkan.
        NoOpenGLError: If it is the classic one, and there is no OpenGL.
    """
    try:
        require_renderer(renderer)
    except NoOpenGLError as error:
        raise NoOpenGLError(f"{error}\nvideos=0 films nothing and needs no OpenGL.") from None


def choose(episodes: Sequence[Episode], count: int, folder: Path) -> list[tuple[Episode, Path]]:
    """Return which episodes to film, with the files to write.

    Args:
        episodes: Every episode, in order.
        count: How many successes and how many failures of each task and split.
        folder: Folder of the result.
    """
    return [
        (episode, film_of(folder, episode.row))
        for _, group in groupby(episodes, key=lambda episode: episode.job)
        for played in [list(group)]
        for success in (True, False)
        for episode in islice((e for e in played if e.row.success == success), count)
    ]


def film(episode: Episode, file: Path) -> None:
    """Play the actions of an episode again, in front of a camera; of a failure the expert's too.

    The policy is not asked, so that filming can change nothing of what it sees, and only the
    episodes that are shown are drawn.

    Raises:
        RuntimeError: If the same actions end otherwise than before.
    """
    row = episode.row
    env = _env(episode.job)
    observation, info = env.reset(seed=row.seed)
    frames = [observation["pixels"][_CAMERA]]
    for action in episode.actions:
        observation, *_, info = env.step(action)
        frames.append(observation["pixels"][_CAMERA])
    env.close()
    # Where nobody answered any more, the actions end before the episode does.
    if info["outcome"] != (RUNNING if row.outcome == POLICY_UNREACHABLE else row.outcome):
        raise RuntimeError(
            f"{row.task}, seed {row.seed}: the same actions ended in {info['outcome']} while "
            f"being filmed, and in {row.outcome} before"
        )
    write_video(file, frames)
    if not row.success and row.policy != EXPERT:
        setting = episode.job.setting.without_pictures()  # it looks at no pictures
        expert = EvaluationJob(setting, EXPERT, REFERENCE_POLICIES[EXPERT])
        film(play(expert, row.seed), film_of_expert(file))


def _env(job: EvaluationJob) -> LabEnv:
    size: dict[str, Any] = {"width": IMAGE_SIZE, "height": IMAGE_SIZE}
    return LabEnv(replace(job.setting, obs="pixels", cameras=(_CAMERA,), **size))
