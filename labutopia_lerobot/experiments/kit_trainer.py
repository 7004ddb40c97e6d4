"""`train.py` of a kit: trains what `kit.json` lists, with Python and LeRobot alone."""

import argparse
import json
import shutil
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

_LAST = Path("checkpoints", "last", "pretrained_model", "train_config.json")

_LOOK_S = 1.0
"""Time between two looks at the trainings [s]."""

_TAIL = 400
"""Bytes at the end of a log in which its last line stands."""


def main() -> None:
    """Train what the kit in this folder lists; exit with 1 if something is not finished."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("seconds", nargs="?", type=float, default=float("inf"))
    parser.add_argument("at_once", nargs="?", type=int, default=1)
    chosen = parser.parse_args()
    listed = json.loads(Path("kit.json").read_text())
    _train([each for each in listed if not _finished(each)], chosen.seconds, chosen.at_once)
    for each in listed:
        sys.stdout.write(f"{each['place']}: {_state(each)}\n")
    sys.exit(0 if all(map(_finished, listed)) else 1)


def _train(pending: Sequence[dict[str, Any]], seconds: float, at_once: int) -> None:
    """Run trainings until all have ended or the time is over."""
    until = time.monotonic() + seconds
    waiting = list(pending)
    running: list[subprocess.Popen[bytes]] = []
    while (waiting or running) and time.monotonic() < until:
        running = [child for child in running if child.poll() is None]
        while waiting and len(running) < at_once:
            running.append(_begin(waiting.pop(0)))
        time.sleep(_LOOK_S)
    for child in running:
        child.kill()  # what counts is the last checkpoint
        child.wait()


def _begin(training: dict[str, Any]) -> "subprocess.Popen[bytes]":
    """Begin a training, or go on with its last checkpoint."""
    place, log = Path(training["place"]), _log(training)
    log.parent.mkdir(parents=True, exist_ok=True)
    words = training["words"]
    if (place / _LAST).exists():
        words = [f"--config_path={place / _LAST}", "--resume=true"]
    else:
        shutil.rmtree(place, ignore_errors=True)
    program = [sys.executable, "-m", "lerobot.scripts.lerobot_train", *words]
    with log.open("ab") as said:
        return subprocess.Popen(program, stdin=subprocess.DEVNULL, stdout=said, stderr=said)


def _finished(training: dict[str, Any]) -> bool:
    """Return whether the last checkpoint, which LeRobot names when it is whole, has all steps."""
    last = (Path(training["place"]) / _LAST).resolve()
    return last.exists() and int(last.parents[1].name) >= training["steps"]


def _state(training: dict[str, Any]) -> str:
    if _finished(training):
        return "finished"
    log = _log(training)
    said = log.read_bytes()[-_TAIL:].decode(errors="replace") if log.exists() else ""
    lines = said.replace("\r", "\n").strip().split("\n")
    return f"not finished: {lines[-1] or 'not begun'}"


def _log(training: dict[str, Any]) -> Path:
    return Path("logs", training["place"].replace("/", " ") + ".log")


if __name__ == "__main__":
    main()
