"""Why an episode failed, of rows made by hand."""

from dataclasses import replace

import pytest

from labutopia_lerobot.evaluation.failure_causes import cause_of
from labutopia_lerobot.evaluation.rows import Row, summarise

from .test_statistics import row

Fact = dict[str, float | int | None]

END = 10.0
NEVER: Fact = {"first": None, "last": None, "times": 0}
ALWAYS: Fact = {"first": 0.0, "last": END, "times": 1}


def during(first: float, last: float, times: int = 1) -> Fact:
    return {"first": first, "last": last, "times": times}


def failed(outcome: str, substeps: dict[str, float | None], **facts: Fact) -> Row:
    """Return the row of a failure; an underscore in the name of a fact is a blank."""
    history = {
        name.replace("_", " "): fact
        for name, fact in ({"flask_upright": ALWAYS, "flask_steady": ALWAYS} | facts).items()
    }
    return replace(
        row(0, outcome, ever=False, lifted=None),
        substeps=substeps,
        history=history,
        facts={name: fact["last"] == END for name, fact in history.items()},
    )


NOTHING = {"gripped": None, "lifted": None}
GRIPPED = {"gripped": 3.0, "lifted": None}


@pytest.mark.parametrize(
    ("episode", "cause"),
    [
        (failed("success", {"gripped": 1.0, "lifted": 2.0}), None),
        (failed("timeout", NOTHING, flask_gripped=NEVER), "never reached"),
        (
            failed("timeout", NOTHING, flask_gripped=NEVER, flask_steady=during(0, END, 2)),
            "missed grasp",
        ),
        (
            failed("timeout", NOTHING, flask_gripped=NEVER, flask_upright=during(0, 4)),
            "missed grasp",
        ),
        (failed("timeout", GRIPPED, flask_gripped=during(3, 4)), "missed grasp"),
        (
            failed("timeout", GRIPPED, flask_gripped=during(3, 6), flask_lifted=during(5, 6)),
            "dropped",
        ),
        (failed("timeout", GRIPPED, flask_gripped=during(3, END)), "too slow in lifted"),
        (
            failed("timeout", {"gripped": 1.0, "lifted": 2.0}, flask_gripped=during(1, END)),
            "too slow in the goal",
        ),
        (failed("dropped", GRIPPED, flask_gripped=during(3, 6)), "dropped"),
        (failed("dropped", NOTHING, flask_gripped=NEVER), "tipped"),
        (failed("knocked_over", NOTHING, flask_gripped=NEVER), "tipped"),
        (failed("spilled", GRIPPED, flask_gripped=during(3, END)), "spilled"),
        (failed("wrong_button", {"pressed": None}), "wrong object"),
        (failed("collided", NOTHING), "hit something"),
        (failed("rack_struck", NOTHING), "hit something"),
        (failed("diverged", NOTHING), "simulation diverged"),
        (failed("lid_lost", NOTHING), "lid lost"),
        (failed("timeout", {"pressed": None}, finger_on_red=NEVER), "never reached"),
        (failed("timeout", {"pressed": None}, finger_on_red=during(5, 6)), "too slow in pressed"),
    ],
)
def test_a_failure_has_one_cause(episode: Row, cause: str | None) -> None:
    assert cause_of(episode) == cause


def test_what_was_let_go_on_purpose_is_not_lost() -> None:
    substeps = {"pick/gripped": 1.0, "place/placed": 5.0, "place/released": 6.0, "pressed": None}
    facts = {"flask_gripped": during(1, 6), "flask_lifted": during(2, 4)}
    waiting = failed("timeout", substeps, **facts, finger_on_red=NEVER)
    assert cause_of(waiting) == "never reached"
    placing = failed("timeout", substeps | {"place/released": None}, **facts)
    assert cause_of(placing) == "too slow in place/released"


def test_the_second_thing_is_missed_though_the_first_was_in_the_hand() -> None:
    substeps = {"pick/gripped": 1.0, "place/released": 3.0, "again/gripped": None}
    first = {"flask_gripped": during(1, 3), "flask_steady": during(0, END, 4)}
    left = failed("timeout", substeps, **first, rod_gripped=NEVER, rod_upright=ALWAYS)
    assert cause_of(left) == "never reached"
    pushed = failed("timeout", substeps, **first, rod_gripped=NEVER, rod_upright=during(0, 5))
    assert cause_of(pushed) == "missed grasp"


def test_an_interruption_says_what_ended() -> None:
    substeps = {"at_start": 1.0, "shaken": None}
    lost = failed("interrupted", substeps, flask_gripped=during(0, 5), flask_lifted=during(0, 6))
    assert cause_of(lost) == "dropped"
    paused = failed("interrupted", substeps, flask_gripped=ALWAYS)
    assert cause_of(paused) == "interrupted in shaken"


def test_a_goal_that_held_for_an_instant_was_not_kept() -> None:
    episode = failed("timeout", {"gripped": 1.0, "lifted": 2.0}, flask_gripped=during(1, END))
    assert cause_of(replace(episode, ever_success=True)) == "goal not kept"


def test_a_summary_counts_the_causes() -> None:
    episodes = [failed("collided", NOTHING), failed("timeout", NOTHING, flask_gripped=NEVER)] * 2
    episodes += [failed("spilled", NOTHING), failed("spilled", NOTHING), failed("spilled", NOTHING)]
    rows = [replace(episode, cause=cause_of(episode)) for episode in episodes]
    (summary,) = summarise([*rows, row(1, "success", ever=True, lifted=1.0)])
    assert summary.causes == {"spilled": 3, "hit something": 2, "never reached": 2}
