"""Films of the first successes and the first failures of each task and split."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import groupby, islice
from pathlib import Path
from typing import Any

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.evaluation.policies import REFERENCE_POLICIES
from labutopia_lerobot.evaluation.result import film_of, film_of_expert
from labutopia_lerobot.evaluation.rollout import Episode, Pairing, play
from labutopia_lerobot.runtime.video import write_video
from labutopia_lerobot.setting import IMAGE_SIZE
from labutopia_lerobot.sim.classic_renderer import NoOpenGLError
from labutopia_lerobot.sim.renderers import require_renderer
from labutopia_lerobot.task import POLICY_UNREACHABLE, RUNNING

_CAMERA = "front"
_EXPERT = "expert"


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
        for _, group in groupby(episodes, key=lambda episode: episode.pairing)
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
    env = _env(episode.pairing)
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
    if not row.success and row.policy != _EXPERT:
        setting = episode.pairing.setting.without_pictures()  # it looks at no pictures
        expert = Pairing(setting, _EXPERT, REFERENCE_POLICIES[_EXPERT])
        film(play(expert, row.seed), film_of_expert(file))


def _env(pairing: Pairing) -> LabEnv:
    size: dict[str, Any] = {"width": IMAGE_SIZE, "height": IMAGE_SIZE}
    return LabEnv(replace(pairing.setting, obs="pixels", cameras=(_CAMERA,), **size))
