"""What an episode draws: train and test values never meet, and one axis moves no other."""

import numpy as np
import pytest

from labutopia_lerobot.scenario.draw import AxisError, Draw
from labutopia_lerobot.setting import UnknownOptionError

SEEDS = [[seed, 1, 2, 0] for seed in range(200)]


def sizes(draw: Draw) -> str:
    return draw.choice("size", train=("small", "middle"), test=("large",))


def test_train_and_id_draw_every_train_value_and_no_test_value():
    for split in ("train", "id"):
        drawn = {sizes(Draw(split, (), seeds)) for seeds in SEEDS}
        assert drawn == {"small", "middle"}


def test_ood_draws_test_values_only_on_the_axes_that_are_named():
    def both(axes):
        draws = [Draw("ood", axes, seeds) for seeds in SEEDS]
        return {(sizes(d), d.choice("color", train=("red",), test=("blue",))) for d in draws}

    assert both(("size",)) == {("large", "red")}
    assert both(("color",)) == {("small", "blue"), ("middle", "blue")}
    assert both(("all",)) == {("large", "blue")}


def test_ood_without_axes_shifts_what_the_task_says():
    draw = Draw("ood", (), SEEDS[0])
    assert draw.choice("size", train=("small",), test=("large",)) == "small"
    assert draw.choice("color", train=("red",), test=("blue",), shifted=True) == "blue"
    draw.require_axes("a task", lambda: {"size": True, "colour": False})


def test_overlapping_train_and_test_values_are_refused():
    with pytest.raises(AxisError, match=r"'size'.*\['b'\]"):
        Draw().choice("size", train=("a", "b"), test=("b", "c"))
    with pytest.raises(AxisError, match="part the ranges"):
        Draw().uniform("light", train=(0.5, 1.0), test=((0.9, 1.2),))
    with pytest.raises(AxisError, match="part the ranges"):
        Draw().displacement("camera", 3, train=(0.0, 0.1), test=((0.05, 0.2),))


def test_an_axis_that_is_drawn_twice_is_refused():
    draw = Draw()
    sizes(draw)
    with pytest.raises(AxisError, match="drawn twice"):
        sizes(draw)


def test_ranges_are_kept_and_filled():
    inside = [Draw("id", (), s).uniform("light", train=(0.8, 1.2)) for s in SEEDS]
    assert 0.8 <= min(inside) < 0.85
    assert 1.15 < max(inside) <= 1.2
    spans = ((0.4, 0.6), (1.4, 1.6))
    outside = [
        Draw("ood", ("light",), s).uniform("light", train=(0.8, 1.2), test=spans) for s in SEEDS
    ]
    assert {value < 1.0 for value in outside} == {True, False}
    assert all(any(low <= value <= high for low, high in spans) for value in outside)


def test_displacements_have_any_direction_and_a_length_in_the_range():
    drawn = np.array([Draw("id", (), s).displacement("camera", 3, train=(0.1, 0.2)) for s in SEEDS])
    lengths = np.linalg.norm(drawn, axis=1)
    assert 0.1 <= lengths.min() < lengths.max() <= 0.2
    assert np.abs(drawn.mean(axis=0)).max() < 0.03


def test_a_further_axis_moves_no_other():
    alone, among = Draw("id", (), SEEDS[3]), Draw("id", (), SEEDS[3])
    among.uniform("light", train=(0.0, 1.0))
    assert sizes(alone) == sizes(among)


def test_the_same_seeds_draw_the_same_and_say_so():
    first, second = Draw("id", (), SEEDS[5]), Draw("id", (), SEEDS[5])
    assert sizes(first) == sizes(second) == first.values["size"]


def test_the_canonical_draw_takes_the_first_values():
    draw = Draw()
    assert sizes(draw) == "small"
    assert draw.uniform("light", train=(0.8, 1.2)) == 1.0
    assert not draw.displacement("camera", 3, train=(0.0, 0.1)).any()


def test_an_axis_that_the_task_does_not_have_is_an_error_that_lists_those_it_has():
    draw = Draw("id", ("colour",))
    sizes(draw)
    with pytest.raises(UnknownOptionError, match=r"axes=colour.*It has: size"):
        draw.require_axes("level3/pick", lambda: {"size": True, "colour": False})


def test_ood_without_a_test_value_is_refused():
    draw = Draw("ood", ("size",))
    draw.choice("size", train=("small",))
    with pytest.raises(UnknownOptionError, match="no test value"):
        draw.require_axes("level3/pick", lambda: {"size": True, "colour": False})
    nothing = Draw("ood")
    sizes(nothing)
    with pytest.raises(UnknownOptionError, match="shifts nothing"):
        nothing.require_axes("level3/pick", lambda: {"size": True, "colour": False})
