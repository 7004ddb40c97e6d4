"""The runner of experiments, with small programs of its own: what stands is left, the rest done."""

import os
import signal
import subprocess
import sys
import textwrap
import time
from dataclasses import dataclass, replace
from io import StringIO
from pathlib import Path

import pytest
from rich.console import Console

from labutopia_lerobot.cli.experiment import parse as parse_experiment
from labutopia_lerobot.experiments import runner
from labutopia_lerobot.experiments.child_process import last_words, run_child
from labutopia_lerobot.experiments.measured import missing_table
from labutopia_lerobot.experiments.part_record import PartRecords
from labutopia_lerobot.experiments.parts.experiment_part import digest_of, log_of
from labutopia_lerobot.experiments.parts.recording_part import VerificationPart
from labutopia_lerobot.experiments.planning import parts_of
from labutopia_lerobot.experiments.requirements import (
    OutdatedPartsError,
    outdated,
    require_not_outdated,
)
from labutopia_lerobot.experiments.runner import do_parts

ROOT = Path(__file__).parents[2]


@dataclass(frozen=True)
class Written:
    """A part that writes a word, and one more line into a diary every time that it runs."""

    out: Path
    name: str
    source: str = "a"
    word: str = "word"
    needs: tuple["Written", ...] = ()
    program: str = ""

    rate_key = "write"
    size = volume = 1.0
    peak_bytes = 0

    @property
    def place(self) -> Path:
        return self.out / self.name

    def check(self) -> None: ...

    def prepare(self) -> None: ...

    def inputs(self):
        return {"source": self.source, "needed": [need.digest() for need in self.needs]}

    def command(self):
        text = self.program or (
            f"import pathlib; p = pathlib.Path({str(self.place)!r}); p.mkdir(exist_ok=True);"
            f"(p / 'word').write_text({self.word!r});"
            f"(p.parent / 'diary').open('a').write('{self.name} ')"
        )
        return [sys.executable, "-c", text]

    def progress(self) -> float:
        return float(self.finished())

    def finished(self) -> bool:
        return (self.place / "word").exists()

    def digest(self) -> str:
        return digest_of({"word": self.place / "word"})


def done(*parts: Written, again: bool = False) -> dict[str, str]:
    out = parts[0].out
    out.mkdir(exist_ok=True)
    log = Console(file=StringIO())
    return do_parts(parts, PartRecords(out), again, log, lambda: None)


def diary(folder: Path) -> list[str]:
    return (folder / "diary").read_text().split()


def test_what_stands_is_not_done_again(tmp_path):
    first = Written(tmp_path, "first")
    second = Written(tmp_path, "second", needs=(first,))
    assert done(first, second) == {}
    assert done(first, second) == {}
    assert diary(tmp_path) == ["first", "second"]


def test_other_inputs_are_refused_and_made_anew_only_when_asked(tmp_path):
    first = Written(tmp_path, "first")
    done(first)
    changed = replace(first, source="b", word="other")
    with pytest.raises(OutdatedPartsError, match=r"first:\n  inputs.source: 'a' there, 'b' here"):
        require_not_outdated([changed], PartRecords(tmp_path))
    assert "again=true" in done(changed)["first"]
    assert diary(tmp_path) == ["first"]
    assert done(changed, again=True) == {}
    assert (tmp_path / "first" / "word").read_text() == "other"


def test_what_was_edited_behind_its_back_is_noticed(tmp_path):
    first = Written(tmp_path, "first")
    done(first)
    (first.place / "word").write_text("forged")
    with pytest.raises(OutdatedPartsError, match="is not what was made any more"):
        require_not_outdated([first], PartRecords(tmp_path))


def test_a_folder_that_nobody_here_has_made_is_not_touched(tmp_path):
    first = Written(tmp_path, "first")
    first.place.mkdir()
    (first.place / "treasure").write_text("mine")
    assert "has not made" in done(first)["first"]
    assert (first.place / "treasure").exists()


def test_the_same_outcome_of_other_inputs_leaves_what_follows_standing(tmp_path):
    first = Written(tmp_path, "first")
    second = Written(tmp_path, "second", needs=(first,))
    done(first, second)
    same, other = replace(first, source="b"), replace(first, source="c", word="new")
    done(same, replace(second, needs=(same,)), again=True)
    assert diary(tmp_path) == ["first", "second", "first"]
    done(other, replace(second, needs=(other,)), again=True)
    assert diary(tmp_path) == ["first", "second", "first", "first", "second"]


def test_what_fails_stops_only_what_needs_it_and_says_why(tmp_path):
    bad = Written(tmp_path, "bad", program="raise SystemExit('Error: no flask')")
    beyond = Written(tmp_path, "beyond", needs=(bad,))
    good = Written(tmp_path, "good")
    missing = done(bad, beyond, good)
    assert missing["beyond"] == "needs bad"
    assert "Error: no flask" in missing["bad"]
    assert str(log_of(bad)) in missing["bad"]
    assert diary(tmp_path) == ["good"]
    assert missing_table(missing).lines[0][0] == "bad"
    assert done(replace(bad, program=""), beyond, good) == {}


def test_a_program_that_makes_nothing_has_failed(tmp_path):
    idle = Written(tmp_path, "idle", program="print('done, I think')")
    assert "done, I think" in done(idle)["idle"]


def test_a_part_whose_record_was_lost_to_a_kill_is_not_done_again(tmp_path):
    first = Written(tmp_path, "first")
    done(first)
    records = PartRecords(tmp_path)
    kept = records.of(first)
    records.keep(first, replace(kept, state="begun", digest=""))
    assert done(first) == {}
    assert diary(tmp_path) == ["first"]
    assert records.of(first).state == "done"


def test_a_program_ends_with_the_one_that_watches_it(tmp_path):
    """Killed without a chance to do anything, the watcher leaves no training behind."""
    text = f"""
        import sys, time
        from pathlib import Path
        from labutopia_lerobot.experiments.child_process import run_child
        child = "import os, time; print(os.getpid(), flush=True); time.sleep(60)"
        nothing = lambda *_: 0.0
        run_child([sys.executable, "-c", child], Path({str(tmp_path / "log")!r}), nothing, nothing)
    """
    watcher = subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(text)], env=os.environ | {"PYTHONPATH": str(ROOT)}
    )
    for _ in range(600):
        said = (tmp_path / "log").read_text() if (tmp_path / "log").exists() else ""
        if said.strip():
            break
        time.sleep(0.1)
    watcher.send_signal(signal.SIGKILL)
    watcher.wait()
    for _ in range(100):
        if not Path(f"/proc/{said.strip()}").exists():
            return
        time.sleep(0.1)
    pytest.fail("it goes on alone")


def test_what_a_program_took_is_measured(tmp_path):
    text = "import time; block = bytearray(200_000_000); time.sleep(1.5); print('Error: x'); 1 / 0"
    shares = iter([0.0, 0.2, 0.6])
    log = tmp_path / "logs" / "log"
    ended = run_child([sys.executable, "-c", text], log, lambda: next(shares, 0.8), lambda _: None)
    assert ended.status == 1
    assert ended.memory_bytes > 200_000_000
    assert ended.done_before == 0.0
    assert 0.0 <= ended.startup_s < ended.seconds
    assert last_words(log).startswith("Error: x")


def test_what_is_left_to_a_kit_is_not_taken_from_what_other_inputs_have_made(tmp_path, monkeypatch):
    for name in ("fill_kit", "fetch_wheels"):
        monkeypatch.setattr(runner, name, lambda *args: None)
    first, records = Written(tmp_path, "first"), PartRecords(tmp_path)
    done(first)
    changed = replace(first, source="b", word="other")
    runner._leave_to(tmp_path / "kit", [changed], records)
    assert not changed.finished()  # nothing that could be taken for what comes back
    assert outdated(changed, records) == ""


def test_a_verification_is_judged_by_its_last_line_whatever_an_earlier_one_said(tmp_path):
    words = ["level1/press", "obs=state", "policy=mlp", f"out={tmp_path}"]
    parts = parts_of(parse_experiment(words))
    (verification,) = (part for part in parts if isinstance(part, VerificationPart))
    failed = "Error: no space left\non the disk\n"
    verdict = "Verifying it ...\n0:00\nDATASET is intact: 2 episodes, 40 frames, 0 cameras\n\n"
    verification.place.parent.mkdir(parents=True)
    for log, finished in [(failed, False), (failed + verdict, True), (verdict + failed, False)]:
        verification.place.write_text(log)
        assert verification.finished() is finished
