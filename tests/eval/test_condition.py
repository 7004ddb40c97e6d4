"""One condition, one key: what belongs together in a table, and what does not."""

from dataclasses import asdict, fields, replace
from pathlib import Path

import pytest

from labutopia_lerobot.evaluation.condition import EXPERT, REFERENCES, Condition
from labutopia_lerobot.evaluation.policies import REFERENCE_POLICIES
from labutopia_lerobot.evaluation.rows import Row, from_columns, summarise
from labutopia_lerobot.scenario import draw_scenario
from labutopia_lerobot.setting import PARTICLES, Setting

from .written_rows import written

POUR = Condition("level2/pour_liquid")

OTHER = {
    "task": "level1/pick",
    "split": "ood",
    "axes": ("light",),
    "play": "staged",
    "step": "pour",
    "after": "pick",
    "liquid": "off",
    "particles": 100,
    "reasoner": "model@01234567",
    "robot": "iiwa",
    "room": "organic_7",
    "obs": "state",
    "renderer": "filament",
    "odometry": "drift",
}
"""Field of a condition -> a value that is not the default."""


def pour(**columns: object) -> Row:
    (row,) = written("level2/pour_liquid", "act", 1.0, n=1)
    return replace(row, **columns)  # type: ignore[arg-type]


def test_every_column_that_decides_an_episode_separates_conditions() -> None:
    assert OTHER.keys() == {field.name for field in fields(Condition)}
    plain = pour()
    assert plain.condition == POUR
    for name, value in OTHER.items():
        other = pour(**{name: value})
        assert other.condition == replace(POUR, **{name: value})
        assert len(summarise([plain, other])) == 2, name


def test_what_decides_nothing_separates_no_conditions() -> None:
    assert pour(axes=["wall", "light"]).condition == pour(axes=["light", "wall"]).condition
    assert pour(axes=["all", "light"]).condition == pour(axes=["all"]).condition
    assert pour(liquid="off", particles=9).condition == pour(liquid="off").condition
    assert pour(liquid=None, particles=9).condition == pour(liquid=None).condition
    assert pour(liquid="off", reasoner="m@0").condition == pour(liquid="off").condition
    assert pour(obs="state", renderer="Filament").condition == pour(obs="state").condition
    # Where the order of the steps is drawn, a step alone begins behind another one each time.
    assert pour(step="pour", after="pick").condition == pour(step="pour").condition


def test_axes_in_another_order_are_the_same_setting() -> None:
    named = Setting("level1/pick", axes=("wall", "light", "wall"))
    assert named == Setting("level1/pick", axes=("light", "wall"))
    assert named.axes == ("light", "wall")
    assert Setting("level1/pick", axes=("light", "all")).axes == ("all",)
    drawn = [
        draw_scenario(Setting("level1/pick", axes=axes), 7).drawn
        for axes in (("wall", "light"), ("light", "wall"))
    ]
    assert drawn[0] == drawn[1]


def test_a_scene_is_the_same_whatever_is_seen_of_it() -> None:
    seen = [
        pour(obs=obs, renderer=renderer, policy=policy).scene
        for obs, renderer, policy in (
            ("pixels", "llvmpipe", "act"),
            ("pixels", "Filament on llvmpipe", "pi0"),
            ("state", None, "expert"),
        )
    ]
    assert seen[0] == seen[1] == seen[2]
    decides = OTHER.keys() - {"obs", "renderer", "odometry"}
    others = [pour(**{name: OTHER[name]}).scene for name in decides] + [pour(seed=5).scene]
    assert len({*others, seen[0]}) == len(others) + 1


@pytest.mark.parametrize(
    ("columns", "label"),
    [
        ({}, "act"),
        ({"obs": "state"}, "act, state"),
        ({"liquid": "off"}, "act, liquid=off"),
        ({"particles": 100}, "act, particles=100"),
        ({"robot": "iiwa", "room": "organic_7"}, "act, robot=iiwa, room=organic_7"),
        ({"renderer": "Filament on llvmpipe"}, "act, renderer=filament"),
        ({"after": "pick"}, "act, after=pick"),
        ({"policy": EXPERT, "obs": "state"}, "expert"),
        ({"policy": EXPERT, "obs": "state", "liquid": "off"}, "expert, liquid=off"),
    ],
)
def test_a_table_marks_whatever_is_not_as_published(columns: dict[str, object], label: str) -> None:
    row = pour(**columns)
    assert row.condition.label(row.policy) == label


def test_the_reference_policies_are_those_that_are_played() -> None:
    assert tuple(REFERENCE_POLICIES) == REFERENCES


def test_rows_of_an_earlier_version_were_played_with_the_default_particles() -> None:
    columns = asdict(pour())
    del columns["particles"], columns["after"]
    row = from_columns(Row, columns, Path("old.json"))
    assert (row.particles, row.after) == (PARTICLES, None)
    assert row.condition == POUR


def test_rows_in_the_order_of_their_seeds_are_summarised_by_their_condition() -> None:
    staged = written("level4/clean_beaker", "act", 0.9, n=5, play="staged")
    single = written("level4/clean_beaker", "act", 0.9, n=5, luck=1)
    mixed = sorted([*staged, *single], key=lambda row: row.seed)
    assert [(line.condition.play, line.n) for line in summarise(mixed)] == [
        ("staged", 5),
        ("single", 5),
    ]


def test_a_summary_is_written_column_by_column() -> None:
    (line,) = summarise(written("level2/pour_liquid", "act", 0.9, n=5))
    columns = line.columns
    assert columns["task"] == "level2/pour_liquid"
    assert (columns["particles"], columns["robot"], columns["n"]) == (PARTICLES, "panda", 5)
    assert "condition" not in columns


def test_a_column_of_an_earlier_version_is_read_under_its_present_name(tmp_path: Path) -> None:
    row = asdict(written("level1/pick", "act", 0.5, n=1)[0])
    row["prelude_failures"] = row.pop("setup_failures")
    again = from_columns(Row, row | {"prelude_failures": 3}, tmp_path)
    assert again.setup_failures == 3


def test_where_a_base_believes_to_be_matters_to_who_looks() -> None:
    drifting = Condition("level5/navigate", obs="state", odometry="drift")
    assert drifting.marks("act") == ["state", "odometry=drift"]
    assert drifting.marks(EXPERT) == []
    assert drifting.scene == Condition("level5/navigate", obs="state").scene
