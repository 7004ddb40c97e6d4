"""The runner: what is missing is done, what stands is left, what fails stops nothing else."""

import shutil
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from pathlib import Path

from rich.console import Console

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.reporting.table import TextTable
from labutopia_lerobot.experiments.child_process import EndedChild, last_words
from labutopia_lerobot.experiments.experiment import Experiment
from labutopia_lerobot.experiments.part_launcher import HERE, PartLauncher, launcher
from labutopia_lerobot.experiments.part_record import BEGUN, DONE, FAILED, PartRecord, PartRecords
from labutopia_lerobot.experiments.parts.evaluation_part import EvaluationPart
from labutopia_lerobot.experiments.parts.experiment_part import ExperimentPart, log_of
from labutopia_lerobot.experiments.parts.training_part import TrainingPart
from labutopia_lerobot.experiments.planning import check, parts_of
from labutopia_lerobot.experiments.rates import Cost, Rates, cost_of, price_list
from labutopia_lerobot.experiments.requirements import (
    outdated,
    require_gpu,
    require_not_outdated,
    require_room,
    stands,
)
from labutopia_lerobot.experiments.running_bars import RunningBars
from labutopia_lerobot.experiments.training_kit import fetch_wheels, fill_kit, require_no_trainings
from labutopia_lerobot.experiments.warm_up import FOLDER, warm_up
from labutopia_lerobot.runtime import provenance
from labutopia_lerobot.runtime.claim import locked


class OccupiedExperimentError(UserError):
    """The folder of an experiment that another process uses."""


class FailedWarmUpError(UserError):
    """What does not even work in small; the message names a part, its reason stands above it."""


def run_experiment(
    experiment: Experiment, console: Console, report: Callable[[Sequence[ExperimentPart]], None]
) -> dict[str, str]:
    """Do what is missing of an experiment.

    Args:
        experiment: The experiment.
        console: Where cost and progress are printed; it knows whether it is a terminal.
        report: Called with all parts after every evaluation, and at the end.

    Returns:
        Name of every part that is not done -> why.

    Raises:
        UserError: If something is wrong; nothing has been done then.
        KeyboardInterrupt: If it is asked to end; the same command goes on.
    """
    parts = parts_of(experiment)
    check(parts)
    if experiment.kit:
        require_no_trainings(experiment.kit)
    if experiment.plan:
        _announce(parts, PartRecords(experiment.out), console)
        return {}
    with locked(experiment.out, "out", OccupiedExperimentError):
        records = PartRecords(experiment.out)
        if not experiment.again:
            require_not_outdated(parts, records)
        elsewhere = [part for part in parts if experiment.kit and isinstance(part, TrainingPart)]
        if experiment.kit:
            parts = list(dict.fromkeys(need for part in elsewhere for need in part.needs))
        pending = [part for part in parts if not stands(part, records)]
        if experiment.launcher == "local":  # Ray's machines may have one
            require_gpu(pending)
        small = warm_up(pending, _rates(experiment.out), experiment.out)
        if experiment.warm_up and small:
            console.print(f"Measuring rates in small, {len(small)} parts", markup=False)
            tried = PartRecords(experiment.out / FOLDER)
            failed = do_parts(small, tried, True, console, lambda: None)
            if failed:
                raise FailedWarmUpError(
                    f"{len(failed)} of {len(small)} parts fail in small already, such as '"
                    f"{next(iter(failed))}'. Mend the experiment, or leave this out: warm_up=false"
                )
        cost = _announce(parts, records, console)
        require_room(experiment.out, cost)
        try:
            with launcher(experiment.launcher, parts) as launched:
                again, evaluated = experiment.again, partial(report, parts)
                missing = do_parts(parts, records, again, console, evaluated, launched)
        finally:
            report(parts)
        if experiment.kit:
            ready = [part for part in elsewhere if not _lacking(part, missing)]
            _leave_to(experiment.kit, ready, records)
    return missing


def _leave_to(kit: Path, trainings: Sequence[TrainingPart], records: PartRecords) -> None:
    """Fill a kit, and note that its trainings are begun: they are adopted when they come back."""
    left = [training for training in trainings if not stands(training, records)]
    fill_kit(left, kit)
    fetch_wheels(kit / "wheels")
    for training in left:
        _cleared(training, records, True)  # what comes back is not what other inputs had made
        records.keep(training, _begun(training))


def _announce(parts: Sequence[ExperimentPart], records: PartRecords, console: Console) -> Cost:
    """Print what is there, what is to be done and what it costs."""
    rates = _rates(records.out)
    pending = [part for part in parts if not stands(part, records)]
    console.print(TextTable(price_list(parts, pending, rates)))
    return cost_of(pending, rates)


def do_parts(
    parts: Sequence[ExperimentPart],
    records: PartRecords,
    again: bool,
    console: Console,
    evaluated: Callable[[], None],
    launched: PartLauncher = HERE,
) -> dict[str, str]:
    """Do parts in their order, but those that stand and those that need what is missing.

    Args:
        parts: The parts; what one needs stands before it.
        records: Their records.
        again: Whether what other inputs made is deleted and made anew.
        console: Where progress is printed.
        evaluated: Called after every evaluation.
        launched: What runs their programs.

    Returns:
        Name of every part that is not done -> why.
    """
    missing: dict[str, str] = {}
    pending = [part for part in parts if not stands(part, records)]
    settled: dict[str, Future[None]] = {}
    one = threading.Lock()  # for what is printed and reported

    def settle(part: ExperimentPart, index: int) -> None:
        for need in part.needs:
            if need.name in settled:
                settled[need.name].result()
        lacking = _lacking(part, missing)
        if not lacking and stands(part, records):  # or not, once what it needs is made anew
            return
        reason = f"needs {lacking[0]}" if lacking else _cleared(part, records, again)
        behind = [each for each in parts[index + 1 :] if each in pending]

        def watch(share: float, left_s: float | None) -> None:
            with one:
                bars.shown(part, share, None if launched.together else left_s)

        reason = reason or _do_one(part, behind, records, launched, watch)
        with one:
            bars.ended(part)
            if reason:
                missing[part.name] = reason
                console.print(f"Not done: {part.name}: {reason}", markup=False, soft_wrap=True)
            elif isinstance(part, EvaluationPart):
                evaluated()

    with RunningBars(len(pending), console) as bars, _threads(parts, launched) as submit:
        for index, part in enumerate(parts):
            settled[part.name] = submit(settle, part, index)
        for done in settled.values():
            done.result()
    return missing


@contextmanager
def _threads(
    parts: Sequence[ExperimentPart], launched: PartLauncher
) -> Iterator[Callable[..., "Future[None]"]]:
    """Yield what does parts: at once, each waiting for what it needs, or one after the other."""
    if not launched.together:
        yield _done_now
        return
    threads = ThreadPoolExecutor(max(len(parts), 1))
    try:
        yield threads.submit
    finally:  # at the end all have ended
        launched.stop()
        threads.shutdown(cancel_futures=True)


def _done_now[**Arguments](
    function: Callable[Arguments, None], *args: Arguments.args, **kwargs: Arguments.kwargs
) -> "Future[None]":
    function(*args, **kwargs)
    done: Future[None] = Future()
    done.set_result(None)
    return done


def _lacking(part: ExperimentPart, missing: Mapping[str, str]) -> list[str]:
    return [need.name for need in part.needs if need.name in missing]


def _cleared(part: ExperimentPart, records: PartRecords, again: bool) -> str:
    """Delete what other inputs made, if that may be; return why not."""
    why = outdated(part, records)
    if why and not again:
        return f"made from other inputs before (again=true makes it anew):\n{why}"
    if why:
        if part.place.is_dir():
            shutil.rmtree(part.place)
        log_of(part).unlink(missing_ok=True)
        records.drop(part)
    return ""


def _do_one(
    part: ExperimentPart,
    behind: Sequence[ExperimentPart],
    records: PartRecords,
    launched: PartLauncher,
    watch: Callable[[float, float | None], None],
) -> str:
    """Do a part, or go on with what a killed one has left; return why it failed."""
    try:
        begun = _begun(part)
        if part.finished():  # a kill came between its end and its record, or it is from a kit
            if isinstance(part, TrainingPart) and (why := part.made_otherwise()):
                return why
            records.keep(part, replace(begun, state=DONE, digest=part.digest()))
            return ""
        records.keep(part, begun)
        log = log_of(part)
        written = log.stat().st_size if log.exists() else 0
        rates = _rates(records.out)
        left = cost_of(behind, rates)

        def look(share: float) -> None:
            own = rates.seconds(part, 1.0 - share)
            known = own is not None and "seconds" not in left.unknown
            watch(share, (own or 0.0) + left.seconds if known else None)

        ended, machine = launched.run(part, begun.inputs, look)
        begun = replace(begun, machine=machine)
        if ended.status or not part.finished():
            reason = f"{last_words(log, written)} (log: {log})"
            records.keep(part, replace(begun, state=FAILED, reason=reason))
            return reason
        records.keep(part, _done(part, begun, ended))
    except UserError as error:
        return str(error)
    return ""


def _begun(part: ExperimentPart) -> PartRecord:
    return PartRecord(part.name, part.rate_key, BEGUN, part.inputs(), machine=provenance.machine())


def _done(part: ExperimentPart, begun: PartRecord, ended: EndedChild) -> PartRecord:
    share = 1.0 - ended.done_before
    files = [part.place] if part.place.is_file() else part.place.rglob("*")
    return replace(
        begun,
        state=DONE,
        digest=part.digest(),
        size=share * part.size,
        volume=part.volume,
        seconds=ended.seconds,
        startup_s=ended.startup_s,
        stored_bytes=sum(file.lstat().st_size for file in files if file.is_file()),
        memory_bytes=ended.memory_bytes,
    )


def _rates(out: Path) -> Rates:
    """Return the rates that parts of an experiment, and its warm-up, have measured here."""
    folders = (out, out / FOLDER, out.parent if out.name == FOLDER else out)
    records = [each for folder in dict.fromkeys(folders) for each in PartRecords(folder).all()]
    return Rates.of(records, provenance.machine())
