"""The chemistry needs no simulator: neither mujoco nor torch is imported for it."""

import subprocess
import sys

PROGRAM = """
import sys
import labutopia_lerobot.chemistry
from labutopia_lerobot.chemistry.chem_db import lookup
assert lookup({"compounds": ["sodum chloride"]})[0]["chemical_formula"] == "NaCl"
heavy = {"mujoco", "torch", "lerobot", "chemicals", "numba"} & set(sys.modules)
raise SystemExit(", ".join(sorted(heavy)) or 0)
"""


def test_a_lookup_imports_neither_mujoco_nor_torch_nor_the_package_of_data():
    done = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True)
    assert (done.returncode, done.stderr.strip()) == (0, "")
