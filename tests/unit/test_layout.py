"""Where things start: never one in another, and reported at once where that cannot be."""

import math

import numpy as np
import pytest

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.layout import (
    CLEARANCE,
    ImpossibleStartError,
    OnBench,
    Workspace,
    require_possible,
    sample_layout,
)

WORKSPACE = Workspace(x=(-0.2, 1.2), y=(-0.9, 0.9), robot=(-0.4, 0.0), reach=0.855)
LEFT, RIGHT = (
    glassware("beaker", "250 ml", "left"),
    glassware("beaker", "250 ml", "right"),
)


def test_things_that_share_a_region_never_overlap():
    region = OnBench(x=(0.2, 0.35), y=(-0.1, 0.1))
    rng = np.random.default_rng(0)
    for _ in range(200):
        layout = sample_layout({LEFT: region, RIGHT: region}, rng)
        a, b = layout[LEFT], layout[RIGHT]
        gap = math.hypot(a.x - b.x, a.y - b.y) - LEFT.footprint_radius - RIGHT.footprint_radius
        assert gap >= CLEARANCE


def test_placements_fill_their_region():
    region = OnBench(x=(0.2, 0.35), y=(-0.075, 0.075))
    rng = np.random.default_rng(0)
    drawn = [region.sample(rng, {}) for _ in range(1000)]
    for values, (low, high) in (
        ([p.x for p in drawn], region.x),
        ([p.y for p in drawn], region.y),
        ([p.yaw for p in drawn], region.yaw),
    ):
        assert low <= min(values) < low + 0.02 * (high - low)
        assert high - 0.02 * (high - low) < max(values) <= high


def test_two_things_in_one_spot_are_an_error_that_names_both():
    spot = OnBench(x=(0.3, 0.31), y=(0.0, 0.01))
    with pytest.raises(ImpossibleStartError, match=r"left: OnBench.*right: OnBench"):
        require_possible({LEFT: spot, RIGHT: spot}, WORKSPACE)


def test_a_thing_out_of_reach_is_an_error_that_says_how_far():
    with pytest.raises(ImpossibleStartError, match=r"left would be out of reach .* 1\.00 m from"):
        require_possible({LEFT: OnBench(x=(0.3, 0.6), y=(0.0, 0.0))}, WORKSPACE)


def test_a_thing_off_the_bench_is_an_error_that_says_where():
    with pytest.raises(ImpossibleStartError, match=r"off the bench at x=-0\.3"):
        require_possible({LEFT: OnBench(x=(-0.3, 0.1), y=(0.0, 0.0))}, WORKSPACE)
