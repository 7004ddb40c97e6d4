"""Plays episodes, one moment after the other, for all who look."""

import base64
import io
import json
import math
import queue
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from labutopia_lerobot.checks.why import why_failed
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.setting import CAMERAS
from labutopia_lerobot.sim.beauty_camera import beauty_camera
from labutopia_lerobot.sim.eye import eye_at
from labutopia_lerobot.skills.expert import Expert
from labutopia_lerobot.web.episodes import Episodes, Performer
from labutopia_lerobot.web.orbit import Orbit
from labutopia_lerobot.world import CONTROL_HZ

_QUALITY = 85
"""Of JPEG: edges of thin glass stay clean."""
_INSET = (240, 180)
"""Largest width and height of a camera's inset [pixels]."""
_ABSENT_S = 5.0
"""Time after which nobody looks any more, if nobody asks for a moment [s]."""
_FARTHEST_DRAG = 10.0
"""Heights of the picture that a command drags at most: no hand goes so far in 30 ms."""


@dataclass
class Stage:
    """Where moments are published and commands are left: shared by the server's threads.

    Attributes:
        choices: What those who look may choose, and from what.
    """

    choices: Mapping[str, Sequence[str]] = field(default_factory=dict)
    commands: "queue.SimpleQueue[Mapping[str, Any]]" = field(default_factory=queue.SimpleQueue)
    changed: threading.Condition = field(default_factory=threading.Condition)
    number: int = 0
    moment: bytes = b""
    looked_at: float = 0.0

    def publish(self, moment: Mapping[str, Any]) -> None:
        """Let everybody who waits have a new moment."""
        with self.changed:
            self.number += 1
            self.moment = json.dumps({"number": self.number, **moment}).encode()
            self.changed.notify_all()

    def after(self, number: int, within_s: float) -> bytes | None:
        """Return the newest moment as JSON, once it is another than one; None if none comes."""
        with self.changed:
            self.looked_at = time.monotonic()
            if self.changed.wait_for(lambda: bool(self.moment) and self.number != number, within_s):
                return self.moment
            return None

    @property
    def is_watched(self) -> bool:
        """Whether somebody has asked for a moment of late."""
        return time.monotonic() - self.looked_at < _ABSENT_S


class Showing:
    """Episodes, and a camera that those who look move.

    All is done in the thread that made it: OpenGL wants that.

    Args:
        episodes: Those that are shown; pictures are as large as their setting says.
        number: Of the first one.
        stage: Where moments go to and commands come from.
    """

    def __init__(self, episodes: Episodes, number: int, stage: Stage) -> None:
        self._episodes, self._stage = episodes, stage
        self._insets: dict[str, str] = {}
        self._wants_insets = True
        self._playing = False
        self._note = ""
        self._drawn = 0
        self._performer: Performer
        self._orbit: Orbit
        self._home: Orbit
        self._begin(number)
        self._draw()

    def run(self) -> None:
        """Play at real time what is asked for; only an exception ends it."""
        due = time.monotonic()
        while True:
            acted = self._obey()
            steps = self._playing and not self._is_over and self._stage.is_watched
            if steps:
                self._step()
            if steps or acted:
                self._draw()
            due = max(due + 1.0 / CONTROL_HZ, time.monotonic() - 1.0 / CONTROL_HZ)
            time.sleep(max(0.0, due - time.monotonic()))

    @property
    def _is_over(self) -> bool:
        return self._is_played or self._episodes.env.workcell.progress.over

    def _obey(self) -> bool:
        """Do what has been asked for since; return whether there was anything."""
        asked = False
        while True:
            try:
                command = self._stage.commands.get_nowait()
            except queue.Empty:
                return asked
            asked = True
            self._do(command)

    def _do(self, command: Mapping[str, Any]) -> None:
        """Do one thing; what nobody knows is left out: the page that asks may be an old one."""
        right, up, by = (
            _number(command.get(name), _FARTHEST_DRAG) for name in ("right", "up", "by")
        )
        match command.get("do"):
            case "play":
                if self._is_over:
                    self._begin(self._number)
                self._playing = True
            case "pause":
                self._playing = False
            case "step":
                self._playing = False
                self._step()
            case "begin":
                last = self._episodes.last
                self._try(lambda: self._begin(max(0, int(_number(command.get("number"), last)))))
            case "choose":
                self._try(lambda: self._choose(command.get("option"), command.get("value")))
            case "turn":
                self._orbit = self._orbit.turned(right, up)
            case "move":
                self._orbit = self._orbit.moved(right, up)
            case "nearer":
                self._orbit = self._orbit.nearer(by)
            case "home":
                self._orbit = self._home
            case "insets":
                self._wants_insets, self._insets = bool(command.get("on")), {}

    def _try(self, do: Callable[[], None]) -> None:
        """Do what may be refused; those who look see why."""
        self._note = ""
        try:
            do()
        except UserError as error:
            self._note = str(error)

    def _choose(self, option: object, value: object) -> None:
        self._playing, self._note = False, f"Setting up {value}"
        self._draw()  # it takes seconds
        self._episodes.choose(str(option), str(value), self._number)
        self._begin(self._number)
        self._note = ""

    def _begin(self, number: int) -> None:
        self._performer = self._episodes.begin(number)
        self._number, self._is_played = number, False
        env = self._episodes.env
        cell, setting = env.workcell, env.setting
        scene, data = cell.simulation.scene, cell.simulation.data
        pose = beauty_camera(scene, data, cell.task.view.front, setting.width / setting.height)
        places = [cell.world.pose(piece).position_w for piece in cell.task.start]
        home = Orbit.about(np.mean(places, axis=0), pose)
        if not hasattr(self, "_home") or self._orbit == self._home:
            self._orbit = home
        self._home, self._insets = home, {}

    def _step(self) -> None:
        if self._is_over:
            return
        action = self._performer.act()
        if action is None:
            self._is_played = True
        else:
            self._episodes.env.step(action)

    def _draw(self) -> None:
        """Publish what there is to see and to know now."""
        cell = self._episodes.env.workcell
        simulation = cell.simulation
        simulation.draw_liquid()
        eye = eye_at(simulation.scene.model, self._orbit.pose)
        picture = cell.renderer.color(simulation.data, eye)
        if self._wants_insets:  # one after the other: each costs as much as the picture
            missing = [camera for camera in CAMERAS if camera not in self._insets]
            for camera in missing or [CAMERAS[self._drawn % len(CAMERAS)]]:
                self._insets[camera] = _jpeg(cell.color(camera), _INSET)
        self._drawn += 1
        self._stage.publish(
            {
                "picture": _jpeg(picture),
                "insets": self._insets,
                "playing": self._playing and not self._is_over,
                "note": self._note,
                "counted": self._episodes.counted,
                "episode": self._number,
            }
            | self._facts()
        )

    def _facts(self) -> dict[str, Any]:
        """Return what is known of the episode now, fit for JSON."""
        env = self._episodes.env
        cell = env.workcell
        progress, world = cell.progress, cell.world
        liquid = world.liquid
        present = progress.step
        return {
            "task": env.setting.task,
            "room": env.setting.room,
            "instruction": env.task,
            "time": world.time,
            "outcome": progress.outcome,
            "steps": [
                {
                    "name": step.name,
                    "present": present is not None and step.name == present.name,
                    "substeps": [
                        {"name": s.name, "time": progress.substeps[s.name]} for s in step.substeps
                    ],
                }
                for step in cell.task.steps
            ],
            "goal": [fact.name for fact in cell.task.goal],
            "facts": progress.facts,
            "readings": {name: f"{r.shown:g} {r.unit}" for name, r in world.displayed.items()},
            "liquid": {} if liquid is None else liquid.millilitres,
            "why": self._why(),
        }

    def _why(self) -> list[str]:
        """Return why an expert's episode failed, if it is over and did."""
        cell = self._episodes.env.workcell
        if not (cell.progress.over and isinstance(self._performer, Expert)):
            return []
        return why_failed(cell.task, cell.progress, self._performer, cell.world)


def _number(value: Any, most: float) -> float:
    """Return what a page sent as a number, no farther from 0 than `most`; 0 for what is none."""
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        return 0.0
    return 0.0 if math.isnan(number) else min(max(number, -most), most)


def _jpeg(picture: NDArray[np.uint8], within: tuple[int, int] | None = None) -> str:
    """Return a picture as JPEG in base 64, no larger than a size [pixels]."""
    image = Image.fromarray(picture)
    if within is not None:
        image.thumbnail(within, Image.Resampling.BOX)
    out = io.BytesIO()
    image.save(out, "JPEG", quality=_QUALITY)
    return base64.b64encode(out.getvalue()).decode()
