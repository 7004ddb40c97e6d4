"""Recording on a Ray cluster: the same dataset, also when a machine is lost on the way."""

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from labutopia_lerobot.errors import UserError
from recordings import PICK, assert_same_dataset, recording

OPTIONS = [*PICK, "episodes=8"]


@pytest.mark.slow
def test_a_cluster_that_loses_a_machine_records_the_same(tmp_path: Path) -> None:
    pytest.importorskip("ray")
    from ray.cluster_utils import Cluster

    whole = recording(tmp_path / "whole", *OPTIONS)
    cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 1})
    lost = cluster.add_node(num_cpus=1)
    cluster.add_node(num_cpus=1)
    root = tmp_path / "dataset"
    options = [*OPTIONS, f"root={root}", "launcher=ray"]
    try:
        process = subprocess.Popen(
            [sys.executable, "-m", "labutopia_lerobot.cli.record", *options],
            env={**os.environ, "RAY_ADDRESS": cluster.address},
        )
        while not any(root.glob(".recording/candidate_*")):
            assert process.poll() is None
            time.sleep(0.1)
        cluster.remove_node(lost, allow_graceful=False)
        assert process.wait() == 0
    finally:
        cluster.shutdown()
    assert_same_dataset(whole, root)


def test_without_ray_it_is_said_how_to_get_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "ray", None)
    with pytest.raises(UserError, match=r"pip install 'lerobot_env_labutopia\[ray\]'"):
        recording(tmp_path / "dataset", *PICK, "launcher=ray")
