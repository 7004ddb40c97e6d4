import json
import subprocess
import sys
from pathlib import Path

import av
import pytest

from labutopia_lerobot.cli.evaluate import main

from .conftest import Program, Saver


@pytest.mark.parametrize(
    ("overrides", "names"),
    [
        (["episods=3"], ["'episods=3'", "episodes=", "policy.path"]),
        (["policy=actt"], ["actt", "expert", "smolvla"]),
        (["policy=expert", "task=level1/pik"], ["Did you mean 'level1/pick'"]),
        (["=3"], ["'=3' is no option", "policy.path"]),
        (["policy=vqbet"], ["vqbet is unknown", "policy=lerobot policy.path=..."]),
        ([], ["Name a policy", "a checkpoint, policy.path=", "expert"]),
        (["policy=lerobot", "task=level1/pick"], ["policy.path"]),
        (["policy=remote", "task=level1/pick"], ["policy.address"]),
        (["policy=expert", "episodes=many"], ["many", "episodes"]),
        (["policy=expert", "--multirun"], ["'--multirun' is no option"]),
        (["policy=expert", "task=level1/pick", "out=/proc/x", "videos=0"], ["out=/proc/x cannot"]),
        (["policy=expert", "level=9"], ["Levels with tasks: 1"]),
        (["policy=expert", "task=level1/pick", "split=odd"], ["train, id, ood"]),
        (["policy=expert", "task=level1/pick", "episodes=0"], ["at least 1"]),
        (["policy=still", "task=level1/pick", "policy.path=x"], ["policy=still", "policy.path"]),
        (
            ["policy=act", "task=level1/pick", "policy.path=x"],
            [
                "policy.path=x",
                "$(labutopia-recipe act outputs/datasets/level1/pick --epochs 200 "
                "--out x/level1/pick)",
            ],
        ),
    ],
)
def test_a_mistake_is_reported_in_one_message_and_leaves_nothing(
    overrides: list[str],
    names: list[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "argv", ["labutopia-eval", *overrides])
    with pytest.raises(SystemExit, match="2"):
        main()
    reported = capsys.readouterr().err
    for name in names:
        assert name in reported
    assert not list(tmp_path.iterdir())


def test_evaluating_the_expert_imports_no_torch() -> None:
    program = "import sys, labutopia_lerobot.evaluation.run; assert 'torch' not in sys.modules"
    subprocess.run([sys.executable, "-c", program], check=True)


@pytest.mark.slow
def test_a_result_holds_rows_summary_provenance_and_films(
    evaluate_program: Program, tmp_path: Path
) -> None:
    done = evaluate_program(
        *("level=1", "task=pick", "policy=expert", "episodes=2", "videos=1", "out=out"),
        *("workers=1", "width=96", "height=96"),
    )
    assert done.returncode == 0, done.stderr
    assert "2/2" in done.stdout
    assert "Playing 2/2, " in done.stderr
    assert "level1/pick id: 2/2 succeeded, 100 %" in done.stderr
    result = json.loads((tmp_path / "out" / "result.json").read_text())
    kept = (tmp_path / "out" / "rows.jsonl").read_text().splitlines()
    assert [json.loads(line) for line in kept] == result["rows"]
    assert [row["seed"] for row in result["rows"]] == [100_000, 100_001]
    row = result["rows"][0]
    assert row["play"] == "single"
    assert row["seconds"] == pytest.approx(row["steps"] / 30, abs=1e-3)
    assert 0 < row["substeps"]["gripped"] < row["substeps"]["lifted"] < row["seconds"]
    assert {"task", "split", "policy", "success", "ever_success", "outcome", "facts"} <= set(row)
    assert {"ml_poured", "ml_spilled"} <= set(row)
    (summary,) = result["summary"]
    assert (summary["n"], summary["successes"], summary["rate"]) == (2, 2, 1.0)
    assert summary["wilson95"] == pytest.approx([0.3424, 1.0], abs=1e-4)
    assert summary["substep_rates"] == {"gripped": 1.0, "lifted": 1.0}
    provenance = result["provenance"]
    assert {"commit", "versions", "renderer", "machine", "config"} <= set(provenance)
    assert provenance["renderer"] is None
    assert provenance["config"]["policy"]["name"] == "expert"
    (film,) = (tmp_path / "out" / "videos").iterdir()
    assert film.name == "level1-pick_id_seed100000_success.mp4"
    with av.open(str(film)) as video:
        assert sum(1 for _ in video.decode(video=0)) == row["steps"] + 1

    again = evaluate_program("task=level1/pick", "policy=expert", "out=out")
    assert again.returncode == 2
    assert "already holds a result" in again.stderr
    assert "config.episodes: 2 there, 100 here" in " ".join(again.stderr.split())


@pytest.mark.slow
def test_a_policy_of_pictures_is_played_and_the_renderer_is_named(
    evaluate_program: Program, save_checkpoint: Saver, tmp_path: Path
) -> None:
    output_dir = save_checkpoint(cameras=("front",)).parents[2]
    arguments = [f"policy.path={output_dir}", "policy.device=cpu", "out=out", "videos=0"]
    done = evaluate_program("task=level1/pick", "policy=act", "episodes=1", *arguments)
    assert done.returncode == 0, done.stderr
    result = json.loads((tmp_path / "out" / "result.json").read_text())
    assert result["rows"][0]["obs"] == "pixels"
    assert result["provenance"]["renderer"]


@pytest.mark.slow
def test_a_mistake_of_the_users_in_a_worker_stops_the_run_in_one_place(
    evaluate_program: Program, tmp_path: Path
) -> None:
    folder = tmp_path / "tasks" / "level1"
    folder.mkdir(parents=True)
    (folder / "moody.py").write_text(
        "from dataclasses import replace\n"
        "from labutopia_lerobot.predicates import Predicate\n"
        "from labutopia_lerobot.tasks.level1.pick import pick\n\n"
        "def explode(world):\n    raise ZeroDivisionError('a bug in a predicate')\n\n"
        "def moody():\n"
        "    return replace(pick(), goal=(Predicate('moody', explode),))\n"
    )
    done = evaluate_program(
        "task=level1/moody", "tasks_dir=tasks", "policy=still", "videos=0", "episodes=4"
    )
    assert done.returncode == 2
    assert "moody.py, line 6: ZeroDivisionError: a bug in a predicate" in done.stderr
    assert "Traceback" not in done.stderr
    assert "In the episode of level1/moody, split id, seed 1000" in done.stderr
    assert "What was finished before is intact. Go on: python " in done.stderr
    assert not list(tmp_path.glob("outputs/**/result.json"))


@pytest.mark.slow
def test_level_4_is_reported_step_by_step_on_one_screen(
    evaluate_program: Program, tmp_path: Path
) -> None:
    options = ["level=4", "play=both", "policy=expert", "episodes=1", "liquid=off"]
    done = evaluate_program(*options, "videos=0")
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    assert len(lines) <= 30
    assert max(map(len, lines[:-1])) <= 80
    assert sum(line.startswith(("S ", "A ")) for line in lines) == 6
    assert "press" in done.stdout
