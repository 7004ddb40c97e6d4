"""LeRobot's policy server and client drive our robot, over loopback."""

import threading
from concurrent import futures

import pytest

from labutopia_lerobot.devices import LabUtopiaRobotConfig

grpc = pytest.importorskip("grpc", reason="an extra")

STEPS = 6


def test_a_policy_server_drives_the_robot(save_checkpoint):
    from lerobot.async_inference.configs import PolicyServerConfig, RobotClientConfig
    from lerobot.async_inference.policy_server import PolicyServer
    from lerobot.async_inference.robot_client import RobotClient
    from lerobot.transport import services_pb2_grpc

    server = grpc.server(futures.ThreadPoolExecutor(max_workers=4))
    services_pb2_grpc.add_AsyncInferenceServicer_to_server(
        PolicyServer(PolicyServerConfig(host="127.0.0.1")), server
    )
    port = server.add_insecure_port("127.0.0.1:0")
    server.start()
    robot = LabUtopiaRobotConfig(cameras=("front",), width=64, height=64)
    client = RobotClient(
        RobotClientConfig(
            policy_type="act",
            pretrained_name_or_path=str(save_checkpoint(cameras=("front",))),
            robot=robot,
            actions_per_chunk=4,
            task="Pick up the conical flask from the bench.",
            server_address=f"127.0.0.1:{port}",
        )
    )
    acted = []
    send = client.robot.send_action

    def send_and_count(action):
        acted.append(send(action))
        if len(acted) == STEPS:
            client.shutdown_event.set()
        return acted[-1]

    client.robot.send_action = send_and_count
    assert client.start()
    receiver = threading.Thread(target=client.receive_actions, daemon=True)
    receiver.start()
    client.control_loop(task="Pick up the conical flask from the bench.")
    client.stop()
    receiver.join(timeout=10)
    server.stop(grace=None)
    assert len(acted) == STEPS
    assert all(list(action) == list(client.robot.action_features) for action in acted)
