"""Where a checkpoint lies, and which files it must have."""

from pathlib import Path

from labutopia_lerobot.evaluation.harmless import (
    ADAPTER,
    CONFIG,
    POSTPROCESSOR,
    PREPROCESSOR,
    CheckpointError,
)
from labutopia_lerobot.evaluation.hub import download
from labutopia_lerobot.evaluation.json_object import read_json_object
from labutopia_lerobot.runtime.shipped import shipped

WEIGHTS = "model.safetensors"
ADAPTER_WEIGHTS = "adapter_model.safetensors"

_PICKLES = {".bin", ".ckpt", ".pkl", ".pt", ".pth"}
_INNER = tuple(
    f"{outer}{name}"
    for outer in ("", "checkpoints/last/")
    for name in ("pretrained_model_ema", "pretrained_model")
)
"""What `lerobot-train` saves below its `output_dir`; where it averaged the weights over the
training (`--ema.enable=true`), it evaluates the average itself, and so do we."""


def find_checkpoint(
    path: str,
    policy: str | None,
    task_id: str,
    obs: str | None,
    step: str | None = None,
    one_of_several: bool = False,
) -> Path:
    """Return the folder of the checkpoint for a task or step, with links such as `last` followed.

    Args:
        path: A `pretrained_model` folder, an `output_dir` of `lerobot-train`, a folder that holds
            either of them per task, such as `level1/pick`, or per step of it, such as
            `level4/clean_beaker/3_place` or, of one task, `3_place`, or a Hub id, which is
            downloaded.
        policy: LeRobot's name of the policy, for what is said if there is none.
        task_id: The task.
        obs: `pixels` or `state`, likewise.
        step: Its step, or None for the whole task.
        one_of_several: Whether other steps are played by other policies, so that what `path` holds
            itself is none of them.

    Raises:
        CheckpointError: If there is none.
    """
    place = task_id if step is None else f"{task_id}/{step}"
    folders = [Path(path) / place, *([] if step is None else [Path(path) / step])]
    for folder in folders if one_of_several else [*folders, Path(path)]:
        for inner in ("", *_INNER):
            if (folder / inner / CONFIG).is_file():
                return (folder / inner).resolve()
    downloaded = None if one_of_several or Path(path).exists() else download(path)
    if downloaded is not None:
        return downloaded.resolve()
    raise CheckpointError(_nothing_there(Path(path), policy, task_id, obs, step, one_of_several))


def _nothing_there(
    path: Path,
    policy: str | None,
    task_id: str,
    obs: str | None,
    step: str | None,
    one_of_several: bool,
) -> str:
    """Return that a place holds no checkpoint, with the commands that make one."""
    place, named, only = task_id, task_id, ""
    if step is not None:
        place, named, only = f"{task_id}/{step}", f"{task_id}-{step}", f" step={step}"
    wanted = [CONFIG, "checkpoints/last/pretrained_model", place]
    looked = place if one_of_several else f"{', '.join(wanted[:-1])} nor {wanted[-1]}"
    recorded, recipe = (" obs=state", "train_state") if obs == "state" else ("", "train")
    file = shipped("policies") / str(policy) / f"{recipe}.json"
    settings = f"--config_path={file}" if file.is_file() else f"--policy.type={policy or 'act'}"
    return (
        f"No checkpoint for {task_id}{only} at policy.path={path}, which holds no {looked}. "
        "Make one:\n"
        f"  labutopia-record task={task_id}{only}{recorded}\n"
        f"  lerobot-train {settings} --dataset.repo_id=local/{named.rpartition('/')[2]} "
        f"--dataset.root=outputs/datasets/{named} --output_dir={path / place}"
    )


def checkpoint_files(folder: Path) -> tuple[str, ...]:
    """Return the names of the files that decide what the policy of a folder does.

    Raises:
        CheckpointError: If one of them is missing.
    """
    if (folder / ADAPTER).is_file():
        return _require(folder, CONFIG, ADAPTER, ADAPTER_WEIGHTS, PREPROCESSOR, POSTPROCESSOR)
    return _require(folder, CONFIG, WEIGHTS, PREPROCESSOR, POSTPROCESSOR)


def adapted(folder: Path) -> Path | None:
    """Return the folder of the policy that a LoRA adapter adapts, or None if it is no adapter.

    Raises:
        CheckpointError: If that policy cannot be had, or lacks a file.
    """
    if not (folder / ADAPTER).is_file():
        return None
    adapter = read_json_object(folder / ADAPTER, CheckpointError)
    named, revision = adapter.get("base_model_name_or_path"), adapter.get("revision")
    if not isinstance(named, str) or not named:
        raise CheckpointError(
            f"{folder / ADAPTER} does not tell which policy it adapts (base_model_name_or_path)"
        )
    base: Path | None = Path(named)
    if not Path(named).is_dir():
        base = download(f"{named}@{revision}" if revision else named)
    if base is None:
        raise CheckpointError(
            f"{folder} adapts the policy in {named}, which is not there. Put it there, or name "
            f"another folder as base_model_name_or_path in {folder / ADAPTER}"
        )
    _require(base, CONFIG, WEIGHTS)
    return base.resolve()


def _require(folder: Path, *names: str) -> tuple[str, ...]:
    missing = [name for name in names if not (folder / name).is_file()]
    if not missing:
        return names
    pickles = sorted(file.name for file in folder.iterdir() if file.suffix in _PICKLES)
    pickled = (
        f" It holds {', '.join(pickles)}, but pickles can run any code: save the policy with "
        "LeRobot's save_pretrained"
        if pickles
        else " It must be whole, as lerobot-train saves it"
    )
    raise CheckpointError(f"{folder} lacks {', '.join(missing)}.{pickled}")
