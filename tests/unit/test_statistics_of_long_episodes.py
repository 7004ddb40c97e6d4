"""What LeRobot adds up in single precision over a long episode is not called wrong."""

import numpy as np
from lerobot.datasets.compute_stats import get_feature_stats

from labutopia_lerobot.datasets.verification.statistics import statistics_of, wrong_statistics

FRAMES = 3000
STANDING = np.tile(np.float32([0.82093656, -0.71207116, 1.0471976]), (FRAMES, 1))


def test_what_stands_still_for_long_has_the_statistics_that_lerobot_computes():
    stored = get_feature_stats(STANDING, axis=0, keepdims=False)
    assert stored["std"].max() > 1e-3  # all of it rounding
    computed = statistics_of(STANDING.astype(float))
    assert not list(wrong_statistics(stored, computed, FRAMES))


def test_what_is_off_by_a_fiftieth_is_found_in_long_episodes_too():
    computed = statistics_of(STANDING.astype(float))
    stored = get_feature_stats(STANDING, axis=0, keepdims=False)
    for name in ("mean", "std", "max", "q50"):
        wrong = stored | {name: stored[name] + 0.02}
        assert list(wrong_statistics(wrong, computed, FRAMES)) == [name]
