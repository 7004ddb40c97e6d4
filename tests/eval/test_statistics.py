from dataclasses import replace

from labutopia_lerobot.evaluation.rows import Row, summarise


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
    assert (trained.condition.split, trained.n, trained.mean_seconds_to_success) == (
        "train",
        1,
        None,
    )


def test_a_summary_counts_steps_and_keeps_conditions_apart() -> None:
    done = row(0, "success", ever=True, lifted=2.0)
    rows = [
        replace(done, step_times={"pick": 2.0, "pour": 3.0}),
        replace(done, seed=1, step_times={"pick": 2.0, "pour": None}),
        replace(done, seed=0, split="ood", axes=["light"]),
        replace(done, seed=0, split="ood", axes=["all"]),
    ]
    plain, light, everything = summarise(rows)
    assert plain.step_rates == {"pick": 1.0, "pour": 0.5}
    assert (light.condition.axes, everything.condition.axes) == (("light",), ("all",))


def test_intervals_of_a_summary_are_wider_the_more_they_promise() -> None:
    rows = [row(seed, "success", ever=True, lifted=2.0) for seed in range(8)]
    rows += [row(seed, "timeout", ever=False, lifted=None) for seed in range(8, 20)]
    (found,) = summarise(rows)
    assert found.exact95 is not None
    assert found.anytime95 is not None
    widths = [high - low for low, high in (found.wilson95, found.exact95, found.anytime95)]
    assert widths == sorted(widths)
    assert all(low < 0.4 < high for low, high in (found.wilson95, found.exact95, found.anytime95))
