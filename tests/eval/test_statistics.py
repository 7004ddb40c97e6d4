import pytest

from labutopia_lerobot.evaluation.row import Row
from labutopia_lerobot.evaluation.statistics import summarise, wilson95


# Newcombe 1998, "Two-sided confidence intervals for the single proportion", table I, method 3.
@pytest.mark.parametrize(
    ("successes", "n", "low", "high"),
    [
        (81, 263, 0.2553, 0.3662),
        (15, 148, 0.0624, 0.1605),
        (0, 20, 0.0, 0.1611),
        (1, 29, 0.0061, 0.1718),
    ],
)
def test_wilson_intervals_are_the_published_ones(
    successes: int, n: int, low: float, high: float
) -> None:
    assert wilson95(successes, n) == pytest.approx((low, high), abs=5e-5)


@pytest.mark.parametrize(("successes", "n"), [(0, 0), (3, 2), (-1, 2)])
def test_impossible_counts_have_no_interval(successes: int, n: int) -> None:
    with pytest.raises(ValueError, match="No rate"):
        wilson95(successes, n)


def row(seed: int, outcome: str, *, ever: bool, lifted: float | None, split: str = "id") -> Row:
    return Row(
        task="level1/pick",
        split=split,
        policy="act",
        play="single",
        obs="state",
        seed=seed,
        success=outcome == "success",
        ever_success=ever,
        outcome=outcome,
        steps=30 * (seed + 1),
        seconds=seed + 1.0,
        substeps={"gripped": 1.0, "lifted": lifted},
        facts={},
        history={},
        axes=[],
        drawn={},
        liquid=None,
        ml_total=None,
        ml_poured=None,
        ml_retained=None,
        ml_spilled=None,
        ml_clinging=None,
        ml_in_flight=None,
        clipped_actions=0,
        nonfinite_actions=0,
    )


def test_a_summary_counts_its_own_rows_only() -> None:
    rows = [
        row(0, "success", ever=True, lifted=2.0),
        row(1, "timeout", ever=True, lifted=3.0),
        row(2, "dropped", ever=False, lifted=None),
        row(3, "success", ever=True, lifted=2.0),
        row(9, "timeout", ever=False, lifted=None, split="train"),
    ]
    drawn, trained = summarise(rows)
    assert (drawn.n, drawn.successes, drawn.rate, drawn.ever_rate) == (4, 2, 0.5, 0.75)
    assert drawn.substep_rates == {"gripped": 1.0, "lifted": 0.75}
    assert drawn.mean_seconds_to_success == 2.5
    assert drawn.outcomes == {"success": 2, "timeout": 1, "dropped": 1}
    assert (trained.split, trained.n, trained.mean_seconds_to_success) == ("train", 1, None)
