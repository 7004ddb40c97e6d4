"""Finding a checkpoint, here or on the Hugging Face Hub, and the files that it must have."""

import re
import shlex
from pathlib import Path

from huggingface_hub import snapshot_download
from huggingface_hub.errors import (
    GatedRepoError,
    HfHubHTTPError,
    LocalEntryNotFoundError,
    OfflineModeIsEnabled,
    RepositoryNotFoundError,
    RevisionNotFoundError,
)

from labutopia_lerobot.errors import did_you_mean
from labutopia_lerobot.evaluation.checkpoint_security import (
    ADAPTER,
    CONFIG,
    POSTPROCESSOR,
    PREPROCESSOR,
    CheckpointError,
)
from labutopia_lerobot.foreign_files import read_json_object
from labutopia_lerobot.runtime.shipped import shipped

WEIGHTS = "model.safetensors"
ADAPTER_WEIGHTS = "adapter_model.safetensors"

_PICKLES = {".bin", ".ckpt", ".pkl", ".pt", ".pth"}
_INNER = tuple(
    f"{outer}{name}"
    for outer in ("", "checkpoints/last/")
    for name in ("pretrained_model_ema", "pretrained_model")
)
"""Folders that `lerobot-train` saves in its `output_dir`; where it averaged the weights over the
training (`--ema.enable=true`), it evaluates the average itself, and so do we."""


_EPOCHS = dict.fromkeys(("act", "diffusion"), " --epochs 200")
"""Policy -> how long the paper trains it ("Training Details"); of others the recipe says it."""


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
    place, named, only, cut = task_id, task_id, "", ""
    if step is not None:
        place, named, only = f"{task_id}/{step}", f"{task_id}-{step}", f" step={step}"
        cut = f"labutopia-cut outputs/datasets/{task_id} --step={step}\n  "
    wanted = [CONFIG, "checkpoints/last/pretrained_model", place]
    looked = place if one_of_several else f"{', '.join(wanted[:-1])} nor {wanted[-1]}"
    kind = policy or "act"
    recipes = shipped("policies") / kind
    on_pictures, on_states = recipes / "train.json", recipes / "train_state.json"
    state = obs == "state" or (on_states.is_file() and not on_pictures.is_file())
    recorded = " obs=state" if state else ""
    other = "" if not path.is_file() else "a file"
    other = "a dataset" if (path / "meta" / "info.json").is_file() else other
    below = Path("outputs/train") / kind if other else path
    dataset, out = f"outputs/datasets/{named}", shlex.quote(str(below / place))
    if (on_states if state else on_pictures).is_file():
        epochs = "" if state else _EPOCHS.get(kind, "")
        training = f"$(labutopia-recipe {kind} {dataset}{epochs} --out {out})"
    else:
        training = (
            f"lerobot-train --policy.type={kind} --policy.push_to_hub=false "
            f"--dataset.repo_id=local/{named.rpartition('/')[2]} "
            f"--dataset.root={dataset} --output_dir={out}"
        )
    lacks = f"is {other}" if other else f"holds no {looked}"
    if not path.exists():
        lacks = "does not exist"
    near = _near(path)
    meant = f"{near.strip()} Or m" if near else "M"
    return (
        f"No checkpoint for {task_id}{only} at policy.path={path}, which {lacks}. "
        f"{meant}ake one:\n  labutopia-record task={task_id}{recorded}\n  {cut}{training}"
    )


def _near(path: Path) -> str:
    """Return a question to the nearest of the folders beside where a path ends, or nothing."""
    missing = next((each for each in (path, *path.parents) if each.parent.is_dir()), path)
    if path.exists() or not missing.parent.is_dir():
        return ""
    return did_you_mean(missing.name, [each.name for each in missing.parent.iterdir()], cutoff=0.7)


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
            f"{folder / ADAPTER} does not name the policy that it adapts (base_model_name_or_path)"
        )
    base: Path | None = Path(named)
    if not Path(named).is_dir():
        of_hub = folder.parent.name == "snapshots"  # the user named a Hub id
        base = download(f"{named}@{revision}" if revision else named, ask=of_hub)
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


_ID = re.compile(r"(?P<repo>[\w.-]+/[\w.-]+)(@(?P<revision>[\w./-]+))?")
"""`org/name`, or `org/name@revision` with a branch, tag or commit."""

_WANTED = ["*.json", "*.safetensors"]
"""Pickles are not even downloaded."""


def download(hub_id: str, ask: bool = True) -> Path | None:
    """Return the folder of a checkpoint of the Hub, downloaded if it is not in the cache.

    Args:
        hub_id: `org/name` or `org/name@revision`.
        ask: Whether the Hub may be asked; only what the user names is asked for.

    Returns:
        The folder, or None if `hub_id` is none.

    Raises:
        CheckpointError: If it cannot be had; the message says why.
    """
    named = _ID.fullmatch(hub_id)
    if named is None or hub_id.startswith("."):
        return None
    try:
        return Path(
            snapshot_download(
                named["repo"],
                revision=named["revision"],
                allow_patterns=_WANTED,
                local_files_only=not ask,
            )
        )
    except GatedRepoError:
        reason = "its owner wants you to agree to terms: open its page, then run `hf auth login`"
    except (RepositoryNotFoundError, RevisionNotFoundError):
        reason = "the Hub has no such model or revision, or it is private (`hf auth login`)"
    except (LocalEntryNotFoundError, OfflineModeIsEnabled, HfHubHTTPError, OSError) as error:
        why = (
            f"the Hub cannot be reached ({type(error).__name__}) and"
            if ask
            else "nobody but a file of the checkpoint names it, and"
        )
        reason = (
            f"{why} it is not in the cache. On a machine with a network, if you trust it: "
            f"hf download {named['repo']}"
        )
    raise CheckpointError(
        f"policy.path={hub_id} is no folder here, and as a Hub id it cannot be had: {reason}"
    )
