"""`--web`: what is played is shown in a browser, and to this machine alone."""

import math
import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial

import httpx
import numpy as np
import pytest

from browser import Page, needs_browser, opened
from labutopia_lerobot.datasets.tables import read_episodes
from labutopia_lerobot.scenes.views import VESSEL_VIEW
from labutopia_lerobot.web.episodes_site import EpisodesSite
from labutopia_lerobot.web.orbit import Orbit
from labutopia_lerobot.web.server import LOOPBACK, served
from labutopia_lerobot.web.showing import Stage
from recordings import recording

SMALL = ("--web", "--width", "160", "--height", "90")


def start(*arguments: str, program: str = "view") -> "subprocess.Popen[str]":
    main = f"from labutopia_lerobot.cli.{program} import main; main()"
    return subprocess.Popen(
        [sys.executable, "-c", main, *SMALL, *arguments],
        env={**os.environ, "PYTHONUNBUFFERED": "1"},
        # A shell that starts the tests in the background has Ctrl-C ignored.
        preexec_fn=partial(signal.signal, signal.SIGINT, signal.SIG_DFL),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


@contextmanager
def address_of(process: "subprocess.Popen[str]") -> Iterator[str]:
    """Yield where a program shows something; Ctrl-C ends it in the end, with status 0."""
    assert process.stdout is not None
    line = process.stdout.readline()
    assert line.startswith("Open http://127.0.0.1:"), line
    assert "ssh -L" in process.stdout.readline()
    try:
        yield line.split()[1]
        process.send_signal(signal.SIGINT)
        assert process.wait(timeout=60) == 0
    finally:
        process.kill()


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    """A viewer of level1/pick."""
    with address_of(start("level1/pick", "liquid=off", "--port", "0")) as found:
        yield found


def moment(address: str, after: int | str = "") -> dict:
    return httpx.get(f"{address}/moment?after={after}", timeout=60).json()


def do(address: str, **command: object) -> dict:
    """Send a command, and return the moment that follows it."""
    before = moment(address)["number"]
    assert httpx.post(f"{address}/do", json=command, timeout=60).status_code == 204
    return moment(address, before)


def test_a_step_is_one_thirtieth_of_a_second_and_a_seed_begins_anew(address):
    began = do(address, do="begin", number=3)
    assert (began["counted"], began["episode"]) == ("seed", 3)
    assert (began["time"], began["outcome"]) == (0.0, "running")
    stepped = do(address, do="step")
    assert stepped["time"] == pytest.approx(1 / 30)
    assert set(stepped["insets"]) == {"front", "top", "wrist"}
    assert do(address, do="insets", on=False)["insets"] == {}
    assert set(do(address, do="insets", on=True)["insets"]) == {"front", "top", "wrist"}


def test_the_camera_turns_and_comes_home_while_the_episode_waits(address):
    home = do(address, do="home")
    turned = do(address, do="turn", right=0.3, up=0.1)
    assert turned["time"] == home["time"]
    assert turned["picture"] != home["picture"]
    assert do(address, do="nearer", by=0.5)["picture"] != turned["picture"]
    assert do(address, do="home")["picture"] == home["picture"]


@pytest.mark.parametrize(
    "command",
    [
        {"do": "turn", "right": "far", "up": None},
        {"do": "turn", "right": 1e308, "up": -1e308},
        {"do": "begin", "number": -5},
        {"do": "begin", "number": 1e40},
        {"do": "choose"},
        {"do": "choose", "option": "tasks_dir", "value": "/"},
        {"do": ["step"]},
        {"do": "dance"},
        {},
    ],
)
def test_a_command_that_makes_no_sense_leaves_the_viewer_alive(address, command):
    assert do(address, **command)["outcome"] == "running"


def test_other_pages_of_the_browser_can_neither_look_nor_command(address):
    stranger = {"Host": "evil.example"}  # a name that was let to point to this machine
    assert httpx.get(f"{address}/moment", headers=stranger).status_code == 403
    assert httpx.get(address, headers={"Host": "localhost:1234"}).status_code == 200
    form = {"Content-Type": "text/plain"}  # the kinds that a page may send elsewhere unasked
    number = moment(address)["number"]
    for content, kind in ((b'{"do":"step"}', form), (b"no", {"Content-Type": "application/json"})):
        assert httpx.post(f"{address}/do", content=content, headers=kind).status_code == 400
    long = httpx.post(f"{address}/do", json={"do": "x" * 2000})
    assert long.status_code == 400
    assert httpx.get(f"{address}/../etc/passwd").status_code == 404
    assert moment(address)["number"] == number


def test_task_and_room_are_chosen_and_what_cannot_be_played_is_told(address):
    choices = httpx.get(f"{address}/choices", timeout=60).json()
    assert {"level1/pick", "level1/press"} <= set(choices["task"])
    assert "laboratory" in choices["room"]
    do(address, do="choose", option="task", value="level1/press")
    pressing = settled(address)
    assert (pressing["task"], pressing["time"]) == ("level1/press", 0.0)
    do(address, do="choose", option="task", value="level2/neutralise")  # liquid=off
    refused = settled(address)
    assert refused["task"] == "level1/press"
    assert "liquid" in refused["note"]
    assert do(address, do="choose", option="room", value="nowhere")["room"] == "laboratory"
    do(address, do="choose", option="task", value="level1/pick")
    assert settled(address)["task"] == "level1/pick"


def settled(address: str) -> dict:
    """Return the first moment in which nothing is being set up."""
    seen = moment(address)
    while seen["note"].startswith("Setting up"):
        seen = moment(address, seen["number"])
    return seen


@pytest.mark.slow
def test_a_recording_is_shown_as_it_was_recorded(tmp_path):
    root = recording(tmp_path / "seen", "task=level1/press", "obs=state", "episodes=2", workers=1)
    _, last = read_episodes(root)
    with address_of(start(str(root), "--port", "0", program="replay")) as there:
        assert httpx.get(f"{there}/choices", timeout=60).json() == {}
        first = moment(there)
        assert (first["counted"], first["episode"], first["time"]) == ("episode", 0, 0.0)
        assert do(there, do="begin", number=99)["episode"] == 1
        do(there, do="play")
        seen = moment(there)
        while seen["playing"]:
            seen = moment(there, seen["number"])
        assert seen["outcome"] == "success"
        assert seen["time"] == pytest.approx(last["length"] / 30)


@needs_browser
def test_a_browser_plays_an_episode_and_shows_each_substep_as_it_latches(address, tmp_path):
    with opened(tmp_path) as page:
        page.go(address)
        page.wait_for("typeof now !== 'undefined' && !!now")
        press(page, "again")
        page.wait_for("now && now.time === 0")
        assert "Pick up the conical flask" in page.value("document.body.innerText")
        press(page, "play")
        page.wait_for(
            "[...document.querySelectorAll('.sub.held')].some(e => /gripped/.test(e.innerText))"
        )
        press(page, "play")
        page.wait_for("document.getElementById('play').textContent === 'Play'")
        paused = page.value("now.time")
        assert 1.0 < paused < 6.0
        assert page.value("document.getElementById('picture').naturalWidth") == 160
        assert page.value("document.querySelectorAll('#insets img').length") == 3
        page.go(address)  # as a browser that leaves and comes back
        page.wait_for("typeof now !== 'undefined' && !!now")
        assert page.value("now.time") == pytest.approx(paused, abs=0.2)
        press(page, "play")
        page.wait_for("document.getElementById('outcome').textContent === 'success'")
        assert page.value("document.getElementById('play').textContent") == "Play"
        assert all(each.startswith(f"{address}/") for each in page.addresses)


def press(page: Page, button: str) -> None:
    page.value(f"document.getElementById('{button}').click()")


@pytest.mark.slow
def test_nothing_is_played_while_nobody_looks(address):
    do(address, do="begin", number=0)
    do(address, do="play")
    time.sleep(9.0)
    assert (
        moment(address)["time"] < 5.0 + 1.0
    )  # seconds after which nobody is taken to look, and one
    do(address, do="pause")


@pytest.mark.slow
def test_a_port_in_use_is_one_line_with_the_cure():
    with socket.socket() as taken:
        taken.bind((LOOPBACK, 0))
        taken.listen()
        port = taken.getsockname()[1]
        process = start("level1/pick", "--port", str(port))
        _, said = process.communicate(timeout=120)
    assert process.returncode == 2
    assert said.splitlines()[-1] == (
        f"Error: Port {port} is in use: choose another with --port, such as --port {port + 1}, "
        "or --port 0 for any that is free"
    )


def test_it_listens_on_loopback_only():
    with served(0, EpisodesSite(Stage())) as address:
        port = int(address.rpartition(":")[2])
        with socket.create_connection((LOOPBACK, port), timeout=5):
            pass
        with socket.socket() as elsewhere:  # another address of the same port is still free
            elsewhere.bind(("127.0.0.2", port))


def test_an_orbit_keeps_its_point_in_the_middle_and_does_not_turn_over():
    begun = Orbit.about(np.array([0.2, 0.0, 0.8]), VESSEL_VIEW.front)
    assert begun.pose.position_w == pytest.approx(VESSEL_VIEW.front.position_w)
    for orbit in (begun.turned(0.4, 0.2), begun.turned(-3.0, 9.0), begun.nearer(1.0)):
        pose = orbit.pose
        forward = np.array(pose.direction_w)
        assert np.linalg.norm(forward) == pytest.approx(1.0)
        reached = np.array(pose.position_w) + orbit.distance * forward
        assert reached == pytest.approx(begun.target_w)
        assert -math.radians(12) < orbit.height < math.radians(86)
    assert begun.nearer(99.0).distance == 0.25
    assert begun.nearer(-99.0).distance == 6.0
    moved = begun.moved(0.1, 0.0)
    assert moved.target_w[1] != begun.target_w[1]
    assert moved.distance == begun.distance
