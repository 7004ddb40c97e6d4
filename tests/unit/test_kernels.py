"""Kernels are compiled when they are first called."""

import os
import subprocess
import sys
from inspect import unwrap
from pathlib import Path

import numpy as np

import labutopia_lerobot.kernel as kernel_module
from labutopia_lerobot.kernel import kernel
from labutopia_lerobot.liquids.solver.smoothing import BEHIND_WALL, look_up, weight


@kernel
def _twice_the_weight(q: float) -> float:
    return 2.0 * weight(q)


def test_a_program_that_only_sends_others_to_play_loads_no_numba():
    program = "import sys, labutopia_lerobot.env; assert 'numba' not in sys.modules"
    subprocess.run([sys.executable, "-c", program], check=True)


def test_a_kernel_calls_another():
    assert _twice_the_weight(0.3) == 2.0 * weight(0.3)


def test_the_smoothing_kernel_is_the_same_to_the_last_bit_uncompiled():
    places = np.random.default_rng(0).uniform(0.0, 1.1, 1000)
    assert [weight(q) for q in places] == [unwrap(weight)(q) for q in places]


def test_half_of_the_smoothing_kernel_is_behind_a_wall_that_is_touched():
    assert abs(look_up(BEHIND_WALL, 0.0) - 0.5) < 1e-6


def test_compiled_kernels_lie_in_the_users_cache_by_the_sources_of_all_kernels(tmp_path):
    program = (
        "import labutopia_lerobot.kernel as k\n"
        "from labutopia_lerobot.liquids.solver.smoothing import weight\n"
        "weight(0.3); print(k._compiled_kernels())"
    )
    environment = os.environ | {"XDG_CACHE_HOME": str(tmp_path)}
    ended = subprocess.run(
        [sys.executable, "-c", program], env=environment, capture_output=True, text=True, check=True
    )
    folder = Path(ended.stdout.strip())
    assert folder.is_relative_to(tmp_path / "labutopia_lerobot" / "kernels")
    assert any(folder.rglob("*.nbi"))
    sources = Path(kernel_module.__file__).parent
    assert not any(sources.rglob("*.nbi"))
