"""Results of an experiment: tables, curves, and what is not measured."""

import shutil
from dataclasses import replace

from labutopia_lerobot.cli.experiment import parse
from labutopia_lerobot.evaluation.load_results import load_results
from labutopia_lerobot.evaluation.reporting.charts import curve
from labutopia_lerobot.evaluation.reporting.page import page
from labutopia_lerobot.evaluation.reporting.table import Cell, Rate, Table
from labutopia_lerobot.experiments import planning
from labutopia_lerobot.experiments.measured import Measured, kept_results
from labutopia_lerobot.experiments.parts.evaluation_part import EvaluationPart

from .written_rows import keep, written


def test_a_result_stands_beside_what_is_not_measured(tmp_path):
    out = tmp_path / "out"
    words = ("level1/pick", "obs=state", "demonstrations=[10,25]", "evaluate_at=[500]")
    chosen = parse([*words, "policy=[act,diffusion,expert]", f"out={out}"])
    evaluations = planning.evaluations(planning.parts_of(chosen))
    act = [e for e in evaluations if e.label == "act"]
    for number, each in enumerate(act):
        if each.demonstrations == 25 or each.at is None:
            keep(each.place, written("level1/pick", "act", 0.5 + number / 10, n=20, obs="state"))
    measured = Measured.of(evaluations)
    (line,) = measured.tables()[0].lines
    task, condition, of_act, of_diffusion, of_expert = line
    assert (task, condition) == ("level1/pick", "id")
    assert of_act.n == 20
    assert of_diffusion == of_expert == "not measured"
    titles = [table.title for table in measured.tables()]
    assert titles == [
        "All tasks",
        "Why they fail",
        "Success over demonstrations",
        "Success over steps of the training",
    ]
    curves = measured.tables()[2]
    assert [line[0] for line in curves.lines] == ["act, level1/pick, id"]
    assert curves.note.endswith("Not measured yet: 1 of 2 curves.")
    assert [chart["policy"] for chart in measured.curves()] == [
        f"act, id: {title.lower()}" for title in titles[2:]
    ]
    ((policy, task, condition, failures, causes),) = measured.tables()[1].lines
    assert (policy, task, condition) == ("act", "level1/pick", "id")
    assert failures == of_act.n - of_act.count
    assert sum(int(cause.rsplit(" ", 1)[1]) for cause in causes.split(", ")) == failures
    moved = kept_results(out / "eval", evaluations)
    assert moved.tables()[0].lines == measured.tables()[0].lines


def test_what_differs_in_one_thing_is_compared_with_the_usual_seed_by_seed(tmp_path):
    file, out = tmp_path / "mine.yaml", tmp_path / "out"
    file.write_text(
        "obs: state\nstudies:\n"
        "  - {policy: act, task: [level2/pour_liquid, level1/pick]}\n"
        "  - {policy: act, task: [level2/pour_liquid, level1/pick], label: coarse, control: act, "
        "particles: 300}\n"
    )
    evaluations = planning.evaluations(
        planning.parts_of(parse([f"experiment={file}", f"out={out}"]))
    )
    usual, _, coarse, _ = evaluations
    rows = written("level2/pour_liquid", "act", 0.9, n=40, obs="state")
    keep(usual.place, rows)
    assert _control(evaluations)[-3:] == ("not measured",) * 3
    keep(coarse.place, [replace(row, particles=300, drawn={"color": "red"}) for row in rows])
    assert _control(evaluations)[-3:] == ("other episodes",) * 3  # these are other scenes
    shutil.rmtree(coarse.place)
    keep(coarse.place, [replace(row, particles=300, success=False) for row in rows])
    *names, lost, won, difference, _, _ = _control(evaluations)
    assert names == ["coarse", "act", "level2/pour_liquid", "id"]
    assert (lost.count, won.count) == (0, sum(row.success for row in rows))
    assert difference.startswith(f"{-100 * won.count / 40:.1f} [")
    titles = [table.title for table in Measured.of(evaluations).tables()]
    assert not any("common seeds" in title for title in titles)  # their conditions differ


def test_trainings_that_differ_in_their_seed_stand_in_a_table_of_their_own(tmp_path):
    words = ("level1/pick", "obs=state", "policy=[act,mlp]", "trainings=3", f"out={tmp_path}")
    evaluations = planning.evaluations(planning.parts_of(parse([*words])))
    act = [each for each in evaluations if each.label == "act"]
    for each, lost in zip(act[:2], (0, 10), strict=True):
        rows = written("level1/pick", "act", 1.0, n=40, obs="state")
        keep(each.place, [replace(row, success=row.seed >= 100_000 + lost) for row in rows])
    measured = Measured.of(evaluations)
    (table,) = measured.trainings()
    of_act, of_mlp = table.lines
    assert of_act == ("act", "level1/pick", "id", 100, "40, 30, not measured of 40", "87.5", "17.7")
    assert of_mlp[4:] == ("not measured",) * 3
    assert [each.repeat for each in measured.final] == [0, 0]  # other tables have the first
    assert measured.by_task().lines[0][2].count == 40
    assert table in measured.tables()


def _control(evaluations: list[EvaluationPart]) -> tuple[Cell, ...]:
    """Return the line of the first control; the second is not measured."""
    (table,) = Measured.of(evaluations).controls()
    first, second = table.lines
    assert second[4:] == ("not measured",) * 5
    return first


def test_a_table_compares_what_has_learned_from_as_many_demonstrations(tmp_path):
    file = tmp_path / "mine.yaml"
    file.write_text(
        "obs: state\nstudies:\n"
        "  - {policy: [act, diffusion], task: [level1/pick, level1/press], demonstrations: 50}\n"
        "  - {policy: act, task: level1/pick, demonstrations: [10, 50, 200]}\n"
    )
    parts = planning.parts_of(parse([f"experiment={file}"]))
    final = Measured.of(planning.evaluations(parts)).final
    assert [evaluation.demonstrations for evaluation in final] == [50] * 4


def test_the_page_of_results_has_the_tables_and_curves_of_an_experiment(tmp_path):
    kept = keep(tmp_path / "act", written("level1/pick", "act", 0.9, n=10))
    rates = {"act, level1/pick": {10: Rate(1, 10, (0.0, 0.4)), 100: Rate(9, 10, (0.6, 1.0))}}
    chart = curve("Success over demonstrations", [10, 25, 100], rates)
    table = Table("All tasks", ("Task", "act"), (("level1/pick", "not measured"),))
    shown = page(load_results(kept), {}, [table], [chart])
    assert shown.index("All tasks") < shown.index("Level 1")
    assert "not measured" in shown
    assert "act, level1/pick 90" in shown
