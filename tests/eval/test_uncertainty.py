"""Intervals and tests, against other libraries and by simulation."""

import numpy as np
import pytest
from scipy.optimize import minimize_scalar
from scipy.stats import binom, binomtest

from labutopia_lerobot.evaluation.reporting.run_tables import cost_table
from labutopia_lerobot.evaluation.stopping import StoppingRule
from labutopia_lerobot.evaluation.uncertainty import anytime
from labutopia_lerobot.evaluation.uncertainty.intervals import (
    Median,
    PrecisionError,
    anytime_episodes_for,
    episodes_for,
    exact,
    wilson,
)
from labutopia_lerobot.evaluation.uncertainty.paired import PairedOutcomes, holm

RUNS = 10_000


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
def test_wilson_intervals_are_the_published_ones(successes, n, low, high):
    assert wilson(successes, n) == pytest.approx((low, high), abs=5e-5)


@pytest.mark.parametrize("n", [1, 2, 48, 1000])
@pytest.mark.parametrize("confidence", [0.9, 0.99])
def test_wilson_intervals_are_those_of_scipy_and_end_exactly_at_nothing_and_all(n, confidence):
    for successes in range(n + 1):
        published = binomtest(successes, n).proportion_ci(confidence, "wilson")
        found = wilson(successes, n, confidence)
        assert found == pytest.approx((published.low, published.high), abs=1e-14)
        assert (found[0] == 0.0, found[1] == 1.0) == (successes == 0, successes == n)


@pytest.mark.parametrize(("successes", "n"), [(0, 1), (7, 7), (3, 20), (104, 120), (299, 300)])
def test_the_ends_of_an_exact_interval_are_the_rates_that_are_just_not_rejected(successes, n):
    low, high = exact(successes, n, confidence=0.9)
    assert (low == 0.0) == (successes == 0)
    assert (high == 1.0) == (successes == n)
    if successes > 0:
        assert binomtest(successes, n, low, "greater").pvalue == pytest.approx(0.05)
    if successes < n:
        assert binomtest(successes, n, high, "less").pvalue == pytest.approx(0.05)


@pytest.mark.parametrize(("successes", "n"), [(0, 0), (3, 2), (-1, 2)])
def test_impossible_counts_have_no_interval(successes, n):
    for interval in (wilson, exact):
        with pytest.raises(ValueError, match="No rate"):
            interval(successes, n)


def test_the_exact_interval_covers_every_rate_and_wilsons_covers_on_average():
    n = 50
    bounds = {f: np.array([f(k, n) for k in range(n + 1)]) for f in (wilson, exact)}
    rates = np.linspace(0.01, 0.99, 99)
    chance = binom.pmf(np.arange(n + 1), n, rates[:, None])
    coverage = {
        f: (chance * ((low <= rates[:, None]) & (rates[:, None] <= high))).sum(axis=1)
        for f, (low, high) in ((f, b.T) for f, b in bounds.items())
    }
    assert coverage[exact].min() >= 0.95
    assert coverage[wilson].mean() == pytest.approx(0.95, abs=0.005)


@pytest.mark.parametrize(("first", "second"), [(0, 0), (1, 0), (5, 15), (30, 30), (3, 12)])
def test_the_test_on_common_seeds_is_that_of_a_fair_coin(first, second):
    pairs = PairedOutcomes(both=20, first=first, second=second, neither=7)
    total = first + second
    expected = binomtest(first, total).pvalue if total else 1.0
    assert pairs.p_value == pytest.approx(expected)


def most_likely(pairs: PairedOutcomes, difference: float) -> float:
    """Return how often only the second succeeds, by maximising the likelihood."""

    def loss(q: float) -> float:
        alike = 1 - 2 * q - difference
        return -(
            pairs.first * np.log(q + difference)
            + pairs.second * np.log(q)
            + (pairs.both + pairs.neither) * np.log(alike)
        )

    low, high = max(0.0, -difference), (1 - difference) / 2
    found = minimize_scalar(loss, bounds=(low, high), method="bounded", options={"xatol": 1e-12})
    return float(found.x)


@pytest.mark.parametrize(
    "pairs",
    [PairedOutcomes(20, 12, 5, 13), PairedOutcomes(80, 3, 9, 28), PairedOutcomes(1, 30, 2, 9)],
)
def test_the_ends_of_the_difference_are_where_its_score_is_the_quantile(pairs):
    for end in pairs.interval():
        q = most_likely(pairs, end)
        spread = pairs.n * (2 * q + end * (1 - end))
        score = (pairs.first - pairs.second - pairs.n * end) / np.sqrt(spread)
        assert abs(score) == pytest.approx(1.959964, abs=1e-3)


@pytest.mark.parametrize(
    "pairs",
    [
        PairedOutcomes(0, 0, 0, 9),
        PairedOutcomes(9, 0, 0, 0),
        PairedOutcomes(0, 9, 0, 0),
        PairedOutcomes(0, 0, 9, 0),
    ],
)
def test_pairs_that_are_all_alike_have_an_interval(pairs):
    low, high = pairs.interval()
    assert -1.0 <= low <= pairs.difference <= high <= 1.0
    assert low < high


@pytest.mark.parametrize("rates", [(0.5, 0.2, 0.1, 0.2), (0.7, 0.05, 0.15, 0.1)])
def test_the_interval_of_the_difference_covers_it_as_often_as_it_says(rates):
    drawn, counts = np.unique(
        np.random.default_rng(0).multinomial(80, rates, RUNS), axis=0, return_counts=True
    )
    true = rates[1] - rates[2]
    # Only what the two disagree on matters, so that few intervals have to be computed.
    intervals = {
        (first, second): PairedOutcomes(80 - first - second, first, second, 0).interval()
        for first, second in {(int(f), int(s)) for f, s in drawn[:, 1:3]}
    }
    covered = [
        intervals[int(f), int(s)][0] <= true <= intervals[int(f), int(s)][1]
        for f, s in drawn[:, 1:3]
    ]
    assert np.average(covered, weights=counts) == pytest.approx(0.95, abs=0.012)


def test_holm_holds_the_chance_of_any_false_alarm():
    assert holm([0.01, 0.04, 0.03, 0.2]) == pytest.approx([0.04, 0.09, 0.09, 0.2])
    assert holm([0.9, 0.6]) == pytest.approx([1.0, 1.0])
    assert holm([]) == []
    # The smallest adjusted value is the smallest one times their number.
    smallest = np.random.default_rng(0).random((RUNS, 16)).min(axis=1) * 16
    assert (smallest <= 0.05).mean() == pytest.approx(0.05, abs=0.01)


@pytest.mark.parametrize("rate", [0.02, 0.3, 0.5, 0.9])
def test_a_confidence_sequence_misses_the_rate_in_no_more_runs_than_it_says(rate):
    n = np.arange(1, 401)
    wins = (np.random.default_rng(1).random((RUNS, 400)) < rate).cumsum(axis=1)
    against = anytime.log_evidence(wins, n - wins, rate)
    missed = (against >= np.log(20)).any(axis=1).mean()
    assert missed <= 0.05 + 3 * np.sqrt(0.05 * 0.95 / RUNS)


def test_the_ends_of_a_confidence_sequence_are_where_the_evidence_reaches_its_bound():
    low, high = anytime.confidence_sequence([0, 3, 17, 20, 0], [20, 20, 20, 20, 0])
    assert (low[0], high[3]) == (0.0, 1.0)
    assert (low[4], high[4]) == (0.0, 1.0)
    wins = np.array([0, 3, 17, 20])
    for ends, some in ((low, slice(1, 4)), (high, slice(0, 3))):
        evidence = anytime.log_evidence(wins[some], 20 - wins[some], ends[:4][some])
        assert evidence == pytest.approx(np.log(20), abs=1e-6)


@pytest.mark.parametrize("discordant", [0.1, 0.5])
def test_equal_policies_are_distinguished_in_no_more_runs_than_stated(discordant):
    draws = np.random.default_rng(2).random((RUNS, 300))
    better = (draws < discordant / 2).cumsum(axis=1)
    worse = (draws > 1 - discordant / 2).cumsum(axis=1)
    alarms = (anytime.log_evidence(better, worse) >= np.log(20)).any(axis=1).mean()
    assert alarms <= 0.05 + 3 * np.sqrt(0.05 * 0.95 / RUNS)


@pytest.mark.parametrize("rates", [(0.1, 0.1), (0.4, 0.1), (0.02, 0.3)])
def test_a_sequence_of_differences_misses_the_true_one_in_no_more_runs_than_it_says(rates):
    draws = np.random.default_rng(5).random((RUNS, 200))
    first = (draws < rates[0]).cumsum(axis=1)
    second = (draws > 1 - rates[1]).cumsum(axis=1)
    n = np.arange(1, 201)
    wins = (n + first - second) / 2
    true = (1 + rates[0] - rates[1]) / 2
    missed = (anytime.log_evidence(wins, n - wins, true) >= np.log(20)).any(axis=1).mean()
    assert missed <= 0.05 + 3 * np.sqrt(0.05 * 0.95 / RUNS)


def test_the_ends_of_a_sequence_of_differences_are_where_the_evidence_reaches_its_bound():
    for end in anytime.difference_sequence(12, 5, 40):
        evidence = anytime.log_evidence(23.5, 16.5, (1 + end) / 2)
        assert evidence == pytest.approx(np.log(20), abs=1e-6)
    low, high = anytime.difference_sequence(0, 0, 0)
    assert (low, high) == (-1.0, 1.0)


def test_looking_every_time_at_a_fixed_test_would_raise_too_many_false_alarms():
    wins = (np.random.default_rng(3).random((RUNS, 300)) < 0.5).cumsum(axis=1)
    n = np.arange(1, 301)
    score = np.abs(wins - n / 2) / np.sqrt(n / 4)
    assert (score[:, 9:] > 1.96).any(axis=1).mean() > 0.25
    assert (anytime.log_evidence(wins, n - wins) >= np.log(20)).any(axis=1).mean() <= 0.06


def test_a_run_stops_when_its_interval_is_narrow_enough():
    rule, n = StoppingRule(0.1), np.arange(200)
    low, high = anytime.confidence_sequence(n, n)
    narrow = (high - low) / 2 <= 0.1
    assert (rule.enough(n, n) == narrow).all()
    assert narrow.any()
    assert not narrow[0]


def test_a_run_stops_when_two_policies_are_distinguished():
    rule, better = StoppingRule(0.01), np.arange(50)
    distinguished = [anytime.p_value(count, 0) <= 0.05 for count in range(50)]
    assert rule.enough(better, better, better).tolist() == distinguished
    assert rule.enough(better, better, 0, better).tolist() == distinguished
    assert any(distinguished)
    assert not rule.enough(50, 50, 0, 0)


def test_a_wanted_precision_costs_episodes():
    low, high = wilson(episodes_for(0.05) // 2, episodes_for(0.05))
    assert (high - low) / 2 <= 0.0501
    assert episodes_for(0.05) == 381
    assert episodes_for(0.05, rate=0.9) < episodes_for(0.05)
    assert anytime_episodes_for(0.05) > episodes_for(0.05)


@pytest.mark.parametrize("half_width", [0.0, -0.1, 0.5, 1e-9, float("nan")])
def test_an_impossible_precision_is_refused(half_width):
    with pytest.raises(PrecisionError, match=r"such as 0\.05"):
        episodes_for(half_width)
    with pytest.raises(PrecisionError, match=r"such as 0\.05"):
        StoppingRule(half_width)


@pytest.mark.parametrize("half_width", [0.001, 0.002])
def test_a_precision_that_nobody_can_pay_for_is_refused(half_width):
    with pytest.raises(PrecisionError, match="more than 1,000,000 episodes"):
        anytime_episodes_for(half_width)


def test_a_precision_that_some_rates_can_have_is_reported_for_these():
    lines = cost_table(0.002, settings=2).lines
    half, *_, most = lines
    assert half[2] == half[4] == "> 1,000,000"
    assert most[1] == episodes_for(0.002, 0.99)
    assert most[3] == 2 * episodes_for(0.002, 0.99)
    with pytest.raises(PrecisionError, match="half width"):
        cost_table(0.6, settings=1)


def test_the_interval_of_a_median_covers_it_at_least_as_often_as_it_says():
    rng = np.random.default_rng(4)
    covered = 0
    for sample in rng.exponential(size=(500, 25)):
        found = Median.of(list(sample))
        assert found is not None
        assert found.interval is not None
        low, high = found.interval
        covered += low <= np.log(2) <= high
    assert covered / 500 >= 0.95 - 3 * np.sqrt(0.05 * 0.95 / 500)


def test_a_small_sample_has_a_median_without_an_interval_and_none_has_nothing():
    assert Median.of([1.0, 2.0, 9.0]) == Median(2.0, None, 3)
    assert Median.of([]) is None
