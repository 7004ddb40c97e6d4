"""Recording on a Ray cluster: the same dataset, also when a machine is lost on the way."""

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.experiments.part_record import DONE, PartRecords
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


@pytest.mark.slow
def test_an_experiment_on_a_cluster_makes_what_it_makes_on_one_machine(tmp_path: Path) -> None:
    pytest.importorskip("ray")
    from ray.cluster_utils import Cluster

    here, there = tmp_path / "here", tmp_path / "there"
    made(here)
    cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 1})
    cluster.add_node(num_cpus=1)
    try:
        made(there, "launcher=ray", RAY_ADDRESS=cluster.address)
        refused = experiment(there, "launcher=ray", "workers=9", RAY_ADDRESS=cluster.address)
    finally:
        cluster.shutdown()
    assert digests(here) == digests(there)
    assert len(digests(here)) == 2 * len(["record", "verify", "train", "evaluate"])
    assert refused.returncode == 2
    assert "has 9 cores" in refused.stderr


def experiment(out: Path, *words: str, **variables: str) -> "subprocess.CompletedProcess[str]":
    small = ["task=[level1/press,level1/close_door]", "obs=state", "policy=mlp", "steps=4"]
    few = ["demonstrations=2", "episodes=1", "workers=1", "warm_up=false", "videos=0"]
    program = [sys.executable, "-m", "labutopia_lerobot.cli.experiment", *small, *few]
    return subprocess.run(
        [*program, f"out={out}", *words],
        env={**os.environ, **variables},
        capture_output=True,
        text=True,
        check=False,
    )


def made(out: Path, *words: str, **variables: str) -> None:
    ended = experiment(out, *words, **variables)
    assert ended.returncode == 0, ended.stderr


def digests(out: Path) -> dict[str, str]:
    """Return what an experiment has made: part -> hash; of trainings, that they are done."""
    records = list(PartRecords(out).all())
    assert all(record.state == DONE for record in records)
    return {each.name: "" if "train" in each.name else each.digest for each in records}


def test_without_ray_it_is_said_how_to_get_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "ray", None)
    with pytest.raises(UserError, match=r"pip install 'lerobot_env_labutopia\[ray\]'"):
        recording(tmp_path / "dataset", *PICK, "launcher=ray")
