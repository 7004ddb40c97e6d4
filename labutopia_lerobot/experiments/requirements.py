"""What must hold before anything is done: inputs that stand, a GPU, room on the disk, memory."""

import shutil
from collections.abc import Sequence
from pathlib import Path

from labutopia_lerobot.datasets.disk_space import NoSpaceError, size_text
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.checkpoint_security import CheckpointError
from labutopia_lerobot.experiments.part_record import DONE, PartRecord, PartRecords
from labutopia_lerobot.experiments.parts.experiment_part import ExperimentPart
from labutopia_lerobot.experiments.parts.recording_part import RecordingPart
from labutopia_lerobot.experiments.rates import Cost
from labutopia_lerobot.runtime.claim import differences
from labutopia_lerobot.runtime.memory import free_memory_bytes

LEAST_MEMORY_BYTES = 1_000_000_000
"""What a recording takes at its peak (docs/datasets.md, "What it costs") [bytes]."""

_SHOWN = 6
"""Differences of a part that are shown; the first ones say enough."""


class OutdatedPartsError(UserError):
    """Parts that other inputs made; the message says which inputs, and the ways out."""


class NoGpuError(UserError):
    """Parts that need a GPU on a machine without; the message says what can be done here."""


class NoMemoryError(UserError):
    """Too little memory for the largest part; the message says what it takes."""


def stands(part: ExperimentPart, records: PartRecords) -> bool:
    """Return whether a part is done with the inputs of now, and what it made is as it made it."""
    record = records.of(part)
    if record is None or record.state != DONE or not _needs_are_there(part) or not part.finished():
        return False
    return not _differing(part, record) and part.digest() == record.digest


def outdated(part: ExperimentPart, records: PartRecords) -> str:
    """Return how a part that is there, whole or not, differs from what would be made now.

    Args:
        part: The part.
        records: Records of the experiment.

    Returns:
        A few lines, or nothing where it is not there, or can be gone on with.
    """
    record = records.of(part)
    if not _needs_are_there(part):
        return ""
    if record is not None:
        differing = _differing(part, record)
        if not differing and record.state == DONE and part.finished():
            changed = part.digest() != record.digest
            return f"  {part.place} is not what was made any more" if changed else ""
        return "\n".join(differing[:_SHOWN])
    if isinstance(part, RecordingPart) and part.finished():
        return "\n".join(part.foreign()[:_SHOWN])
    if part.place.is_dir() and any(part.place.iterdir()):
        return f"  {part.place} holds something that this experiment has not made"
    return ""


def require_not_outdated(parts: Sequence[ExperimentPart], records: PartRecords) -> None:
    """Make sure that nothing in the folder was made from other inputs.

    Raises:
        OutdatedPartsError: If something was.
    """
    found = {part.name: why for part in parts if (why := outdated(part, records))}
    if found:
        listed = "\n".join(f"{name}:\n{why}" for name, why in found.items())
        raise OutdatedPartsError(
            f"{len(found)} parts were made from other inputs, as by another build or recipe:\n"
            f"{listed}\nChoose another out=, go back to those inputs, or delete these parts and "
            "make them anew with again=true"
        )


def require_gpu(parts: Sequence[ExperimentPart]) -> None:
    """Make sure that there is a GPU, if parts are to run on one.

    Raises:
        NoGpuError: If there is none that torch can use.
    """
    needing = [part.name for part in parts if part.gpus]
    if not needing:
        return
    import torch  # here: it takes seconds

    if not torch.cuda.is_available():
        raise NoGpuError(
            f"device=cuda: {len(needing)} parts need a GPU, such as '{needing[0]}', and torch can "
            "use none here. Take device=cpu, which also evaluates what was trained elsewhere, or "
            "train elsewhere with kit=KIT"
        )


def require_room(out: Path, cost: Cost) -> None:
    """Make sure that disk and memory are large enough.

    Raises:
        NoSpaceError: If there is too little room on the disk.
        NoMemoryError: If there is too little memory.
    """
    folder = next(path for path in (out, *out.absolute().parents) if path.exists())
    free = shutil.disk_usage(folder).free
    if cost.stored_bytes > free:
        raise NoSpaceError(
            f"The experiment takes about {size_text(cost.stored_bytes)}, but {folder} has "
            f"{size_text(free)} free. Make room, choose another out=, or ask for fewer "
            "demonstrations=, tasks or only="
        )
    memory = free_memory_bytes()
    needed = max(cost.memory_bytes, LEAST_MEMORY_BYTES)
    if needed > memory:
        raise NoMemoryError(
            f"One of the parts needs {size_text(needed)} of memory, and {size_text(memory)} are "
            "free. End other programs, or take fewer workers= or a smaller batch_size="
        )


def _needs_are_there(part: ExperimentPart) -> bool:
    """Return whether what decides a part can be looked at."""
    if not all(need.finished() for need in part.needs):
        return False
    try:
        part.inputs()
    except CheckpointError:  # of a step at which none was kept
        return False
    return True


def _differing(part: ExperimentPart, record: PartRecord) -> list[str]:
    return differences({"inputs": record.inputs}, {"inputs": part.inputs()})
