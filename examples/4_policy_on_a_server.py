"""A policy that answers from elsewhere, by openpi's protocol, as large models do.

The server here holds the arm where it is; put your model into `answer`. In another process or on
another machine, only its address changes: `labutopia-eval policy=remote policy.address=HOST:PORT`.
"""

import argparse
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
from websockets.sync.server import serve

from labutopia_lerobot.evaluation.remote.openpi_server import pack, unpack


def answer(observation):
    """Return the next actions, shape (n, 8), from what is observed and the instruction."""
    asked.append(observation["prompt"])
    return np.repeat(observation["observation/state"][None], 10, axis=0).astype(np.float32)


def talk(connection) -> None:
    """Answer one client as long as it asks."""
    connection.send(pack({}))  # what there is to know about the server
    for message in connection:
        connection.send(pack({"actions": answer(unpack(message))}))


asked: list[str] = []


def main() -> None:
    """Serve the policy, and let the evaluator ask it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--episodes", type=int, default=2)
    parser.add_argument("--out", default="outputs/example/remote")
    given = parser.parse_args()
    with serve(talk, "127.0.0.1", 0, compression=None, max_size=None) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        port = server.socket.getsockname()[1]
        subprocess.run(
            [
                *(str(Path(sys.executable).parent / "labutopia-eval"), "task=level1/pick"),
                *("obs=state", "policy=remote", "policy.protocol=openpi"),
                *(f"policy.address=127.0.0.1:{port}", f"episodes={given.episodes}", "workers=1"),
                f"out={given.out}",
            ],
            check=True,
        )
        server.shutdown()
    print(f"The server was asked {len(asked)} times: {asked[0]}")


if __name__ == "__main__":
    main()
