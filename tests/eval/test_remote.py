"""Policies elsewhere, played over real servers on loopback: fast, slow, dead, hostile, raising."""

import os
import pickle
import threading
from collections.abc import Callable, Iterator
from concurrent import futures
from dataclasses import replace
from pathlib import Path
from typing import Any

import msgpack
import numpy as np
import pytest

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.evaluation.checkpoint import open_checkpoint
from labutopia_lerobot.evaluation.config import EvaluationOptionError, PolicyConfig
from labutopia_lerobot.evaluation.jobs import EvaluationJob
from labutopia_lerobot.evaluation.policies import PolicyServerError, PolicyUnreachable
from labutopia_lerobot.evaluation.remote.openpi_server import pack, unpack
from labutopia_lerobot.evaluation.remote.remote_policy import (
    RemoteServer,
    open_server,
)
from labutopia_lerobot.evaluation.rollout import play
from labutopia_lerobot.setting import Setting

from .conftest import Saver
from .openpi_server import HOME, OpenPi, openpi_array

STATE = Setting("level1/pick", obs="state")


@pytest.fixture
def openpi() -> Iterator[OpenPi]:
    server = OpenPi()
    yield server
    server.die()


def reached(server: OpenPi, **options: Any) -> RemoteServer:
    setting = options.pop("setting", STATE)
    policy = PolicyConfig("remote", address=server.address, protocol="openpi", **options)
    return open_server(policy, setting, workers=2)


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return LabEnv(STATE)


def started(remote: RemoteServer, env: LabEnv) -> tuple[Any, Any]:
    observation, _ = env.reset(seed=0)
    policy = remote()
    policy.start(env, 0)
    return policy, observation


def act_often(policy: Any, observation: Any) -> None:
    for _ in range(300):
        policy.act(observation)


def test_a_policy_of_openpi_gets_its_own_names_and_plays_so_many_of_its_actions(
    openpi: OpenPi, env: LabEnv
) -> None:
    chunk = np.array([HOME] * 5) + 0.01 * np.arange(5)[:, None]
    openpi.answer = lambda _: openpi.actions(chunk)
    policy, observation = started(reached(openpi, actions=3), env)
    played = np.array([policy.act(observation) for _ in range(4)])
    np.testing.assert_allclose(played, chunk[[0, 1, 2, 0]], atol=1e-6)
    assert len(openpi.seen) == 2
    assert openpi.seen[0]["prompt"] == env.task_description
    np.testing.assert_array_equal(openpi.seen[0]["observation/state"], observation["agent_pos"])
    assert "observation/environment_state" in openpi.seen[0]


def test_names_of_the_users_own_choose_the_cameras(openpi: OpenPi) -> None:
    names = {"observation.images.top": "observation/exterior_image_1_left"}
    remote = reached(openpi, rename=names, setting=Setting("level1/pick"))
    assert remote.setting.cameras == ("top",)
    assert reached(openpi, setting=Setting("level1/pick")).setting.cameras == ("front", "wrist")


def test_arrays_survive_both_ways() -> None:
    image = np.arange(24, dtype=np.uint8).reshape(2, 4, 3)
    assert pack({"image": image}) == msgpack.packb({"image": openpi_array(image)})
    back = unpack(pack({"image": image, "x": np.float32(0.5), "prompt": "pick"}))
    np.testing.assert_array_equal(back["image"], image)
    assert (back["x"], back["prompt"]) == (np.float32(0.5), "pick")


def test_objects_are_neither_sent_nor_received() -> None:
    with pytest.raises(TypeError):
        pack({"x": np.array([object()])})
    hostile = {b"__ndarray__": True, b"data": b"12345678", b"dtype": "|O", b"shape": [1]}
    with pytest.raises(ValueError, match="elements of type object"):
        unpack(msgpack.packb(hostile))


def test_a_slow_server_makes_the_robot_hold_its_position(openpi: OpenPi, env: LabEnv) -> None:
    policy, observation = started(reached(openpi, actions=1, patience=0.05), env)
    first = policy.act(observation)
    go = threading.Event()
    later = np.array(HOME) + 0.1

    def slowly(_: dict) -> bytes:
        go.wait(10)
        return openpi.actions(later[None])

    openpi.answer = slowly
    held = [policy.act(observation) for _ in range(3)]
    assert all((action == first).all() for action in held)
    go.set()
    for _ in range(300):
        action = policy.act(observation)
        if not (action == first).all():
            break
    np.testing.assert_allclose(action, later, atol=1e-6)
    assert len(openpi.seen) == 2, "while an answer is on its way nothing else is asked"


def test_a_server_that_dies_and_comes_not_back_is_unreachable(openpi: OpenPi, env: LabEnv) -> None:
    policy, observation = started(reached(openpi, actions=1, patience=0.1, timeout=0.6), env)
    first = policy.act(observation)
    openpi.die()
    assert (policy.act(observation) == first).all()
    with pytest.raises(PolicyUnreachable):
        act_often(policy, observation)


def test_an_episode_without_answers_is_a_failure_of_its_own_kind(openpi: OpenPi) -> None:
    remote = reached(openpi, patience=0.1, timeout=0.3)
    openpi.die()
    row = play(EvaluationJob(STATE, "remote", remote), 100_000).row
    assert (row.success, row.outcome, row.steps) == (False, "policy_unreachable", 0)
    assert row.cause == "policy unreachable"


def test_a_policy_that_raises_elsewhere_stops_the_run_and_the_episode_is_named(
    openpi: OpenPi,
) -> None:
    openpi.answer = lambda _: "Traceback: ZeroDivisionError"
    with pytest.raises(PolicyServerError, match="ZeroDivisionError") as reported:
        play(EvaluationJob(STATE, "remote", reached(openpi)), 100_001)
    assert reported.value.__notes__ == [
        "In the episode of level1/pick, split id, seed 100001, played by remote, single"
    ]


@pytest.mark.parametrize(
    ("answer", "message"),
    [
        (OpenPi.actions(np.zeros((5, 7))), r"shape \(5, 7\).*\(any number, 8\)"),
        (msgpack.packb({"action": 1}), "does not answer as openpi's do"),
        (b"\xc1", "does not answer as openpi's do"),
    ],
)
def test_other_answers_than_actions_are_reported(
    openpi: OpenPi, env: LabEnv, answer: bytes, message: str
) -> None:
    openpi.answer = lambda _: answer
    policy, observation = started(reached(openpi), env)
    with pytest.raises(PolicyServerError, match=message):
        policy.act(observation)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"address": None}, "policy.address=HOST:PORT"),
        ({"address": "localhost"}, "is not HOST:PORT"),
        ({"patience": 40.0}, "must be from 0 s to policy.timeout=30 s"),
        ({"actions": 0}, "at least 1"),
        ({"protocol": "lerobot"}, "policy.path="),
        ({"protocol": "lerobot", "path": "x"}, "obs=state cannot be played"),
    ],
)
def test_impossible_options_are_reported(options: dict[str, Any], message: str) -> None:
    policy = PolicyConfig("remote", **{"address": "127.0.0.1:9", "protocol": "openpi"} | options)
    with pytest.raises(EvaluationOptionError, match=message):
        open_server(policy, STATE, workers=1)


def test_a_server_that_is_not_there_is_reported_before_anything_is_played() -> None:
    policy = PolicyConfig("remote", address="127.0.0.1:9", protocol="openpi")
    with pytest.raises(
        PolicyServerError, match=r"Nobody listens at policy\.address=127\.0\.0\.1:9"
    ):
        open_server(policy, STATE, workers=1)


Start = Callable[..., tuple[str, Any]]
PIXELS = Setting("level1/pick", cameras=("front",), width=64, height=64)


@pytest.fixture(scope="module")
def lerobot_server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Start]:
    """Start LeRobot's own server with options of its configuration; it writes a folder `logs`."""
    import grpc

    before = Path.cwd()
    os.chdir(tmp_path_factory.mktemp("server"))
    from lerobot.async_inference.configs import PolicyServerConfig
    from lerobot.async_inference.policy_server import PolicyServer
    from lerobot.transport import services_pb2_grpc

    running = []

    def begin(**options: Any) -> tuple[str, grpc.Server]:
        server = grpc.server(futures.ThreadPoolExecutor(4))
        served = PolicyServer(PolicyServerConfig(**options))
        services_pb2_grpc.add_AsyncInferenceServicer_to_server(served, server)
        port = server.add_insecure_port("127.0.0.1:0")
        server.start()
        running.append(server)
        return f"127.0.0.1:{port}", server

    yield begin
    for server in running:
        server.stop(None)
    os.chdir(before)


def over_lerobot(address: str, path: Path, **options: Any) -> RemoteServer:
    policy = PolicyConfig("remote", address=address, path=str(path), device="cpu", **options)
    return open_server(policy, PIXELS, workers=1)


def test_over_lerobots_server_a_checkpoint_commands_what_it_commands_here(
    lerobot_server: Start, save_checkpoint: Saver
) -> None:
    folder = save_checkpoint(cameras=("front",))
    remote = over_lerobot(lerobot_server(inference_latency=0.0)[0], folder)
    assert remote.type == "act"
    env = LabEnv(PIXELS)
    policy, observation = started(remote, env)
    here = open_checkpoint(folder, "act", PIXELS, device="cpu")()
    here.start(env, 0)
    for _ in range(6):  # one chunk has four actions
        np.testing.assert_allclose(policy.act(observation), here.act(observation), atol=1e-5)


def test_a_policy_that_raises_in_lerobots_server_stops_the_run(
    lerobot_server: Start, save_checkpoint: Saver
) -> None:
    folder = save_checkpoint(cameras=("wrist",))  # it has no picture of the front
    policy, observation = started(over_lerobot(lerobot_server()[0], folder), LabEnv(PIXELS))
    with pytest.raises(PolicyServerError, match="says why in its log"):
        policy.act(observation)


def test_a_lerobot_server_that_is_slow_and_then_stops(
    lerobot_server: Start, save_checkpoint: Saver
) -> None:
    folder = save_checkpoint(cameras=("front",))
    address, server = lerobot_server(inference_latency=0.5)
    slow = over_lerobot(address, folder, actions=1, patience=0.05)
    policy, observation = started(slow, LabEnv(PIXELS))
    first = policy.act(observation)  # the server loads the checkpoint first
    assert (policy.act(observation) == first).all(), "it holds its position"
    hasty = over_lerobot(address, folder, patience=0.05, timeout=0.5)
    impatient, observation = started(hasty, LabEnv(PIXELS))
    server.stop(None)
    with pytest.raises(PolicyUnreachable):
        impatient.act(observation)


def test_what_lerobots_server_cannot_load_is_reported(lerobot_server: Start) -> None:
    remote = over_lerobot(lerobot_server()[0], Path("/nowhere/at/all"), type="act")
    policy, observation = started(remote, LabEnv(PIXELS))
    with pytest.raises(PolicyServerError, match="refuses"):
        policy.act(observation)


def test_lerobots_server_is_asked_by_one_worker_only() -> None:
    policy = PolicyConfig("remote", address="127.0.0.1:9", path="x", type="act")
    with pytest.raises(EvaluationOptionError, match="workers=2 is too many"):
        open_server(policy, replace(STATE, obs="pixels"), workers=2)


def test_a_pickle_that_is_no_list_of_actions_runs_nothing(tmp_path: Path) -> None:
    from labutopia_lerobot.evaluation.remote.lerobot_server import read_actions

    class Attack:
        def __reduce__(self) -> tuple[Any, ...]:
            return os.system, (f"touch {tmp_path / 'mark'}",)

    with pytest.raises(PolicyServerError, match="system, which is no part of"):
        read_actions(pickle.dumps([Attack()]))
    with pytest.raises(PolicyServerError, match="no list of actions"):
        read_actions(b"nothing")
    assert not list(tmp_path.iterdir())
