"""Guards: what must be so before an instrument runs, and what keeps its lid shut while it does."""

import math
from dataclasses import dataclass
from typing import override

import mujoco
import numpy as np

from labutopia_lerobot.labware.parts.dials import MovingPart
from labutopia_lerobot.labware.parts.drive import Drive
from labutopia_lerobot.labware.parts.motor import Bolt
from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.world import ON, FloatArray, Reading

_STANDSTILL = 5.0
"""Speed below which a lid may be opened [rpm]; ours: EN 61010-2-020 wants a lid locked until the
rotor turns so slowly that it hurts nobody."""
_RELEASED = 3.0
"""How long the latch stays released after its button was pressed [s]; ours."""
_CHECKED = 0.1
"""Share of the highest speed from which the balance of the rotor is watched; ours."""


@dataclass(frozen=True)
class Flipped(Process):
    """A rocker or lever that switches: its reading, with its name, is 1 where it is thrown, else 0.

    Attributes:
        of: The rocker.
    """

    of: MovingPart

    @property
    def name(self) -> str:
        return self.of.name

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        return Reading(float(apparatus.joint(self.of.joint) > self.of.widest / 2), ON)


@dataclass(frozen=True)
class Shut(Process):
    """A contact that feels whether a door or lid is shut: its reading is 1 if it is, else 0.

    Attributes:
        of: The door or lid.
        warning: What a display writes while it is open.
        within: Position up to which it counts as shut [rad or m]; ours, that of a door's contact.
    """

    of: MovingPart
    warning: str = "LID OPEN"
    within: float = math.radians(2.0)

    @property
    def name(self) -> str:
        return f"{self.of.name}_shut"

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        return Reading(float(apparatus.joint(self.of.joint) < self.within), ON)

    @override
    def text(self, apparatus: Apparatus) -> str:
        return "" if self.reading(apparatus).value else self.warning


@dataclass(frozen=True)
class Balanced(Process):
    """Feels whether what is in a rotor balances: 1 until it trips, and again once the lid was open.

    Attributes:
        name: What its reading is called.
        rotor: Body that turns; it is moved by the first motor of the drive.
        drive: What turns it.
        highest: Its highest speed [rpm].
        radius: Of the circle of its bores [m].
        depth: How far below and above the rotor's origin things count that stand in it [m].
        lid: The lid over it.
        limit: The most mass on one side that nothing on the other balances [kg].
    """

    name: str
    rotor: str
    drive: Drive
    highest: float
    radius: float
    depth: float
    lid: Shut
    limit: float

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return ("tripped",)

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        apparatus.memory(self)[:] = 0.0

    @override
    def step(self, apparatus: Apparatus) -> None:
        memory = apparatus.memory(self)
        if not self.lid.reading(apparatus).value:
            memory[0] = 0.0
        elif apparatus.memory(self.drive)[0] > _CHECKED * self.highest:
            memory[0] = max(memory[0], self.uneven(apparatus) > self.limit)

    def uneven(self, apparatus: Apparatus) -> float:
        """Return the mass on the circle of the bores that would balance the rotor [kg]."""
        model, data = apparatus.model, apparatus.data
        rotor = data.body(self.rotor)
        roots = np.flatnonzero(model.body_parentid == 0)
        free = [root for root in roots if root and _is_free(model, int(root))]
        places, masses = data.subtree_com[free], model.body_subtreemass[free]
        if apparatus.liquid is not None:
            wet, heavy = apparatus.liquid.masses()
            places, masses = np.vstack([places, wet]), np.append(masses, heavy)
        local = (places - rotor.xpos) @ rotor.xmat.reshape(3, 3)
        aside = np.linalg.norm(local[:, :2], axis=1)
        held = (aside < 1.4 * self.radius) & (np.abs(local[:, 2]) < self.depth)
        moment: FloatArray = masses[held] @ local[held, :2]
        return float(np.linalg.norm(moment)) / self.radius

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        return Reading(float(apparatus.memory(self)[0] == 0.0), ON)

    @override
    def text(self, apparatus: Apparatus) -> str:
        return "" if self.reading(apparatus).value else "UNBALANCED"


@dataclass(frozen=True)
class Lock(Process):
    """Keeps a shut lid shut, unless the rotor stands still and its button was pressed just now.

    Attributes:
        name: What its reading is called: 1 while it is locked.
        bolt: What keeps the lid shut.
        lid: What feels whether it is shut.
        button: Name of the button that releases it.
        drive: What must stand still.
    """

    name: str
    bolt: Bolt
    lid: Shut
    button: str
    drive: Drive

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return "released", "locked"

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        apparatus.memory(self)[:] = 0.0

    @override
    def step(self, apparatus: Apparatus) -> None:
        memory = apparatus.memory(self)
        still = self.drive.reading(apparatus).value < _STANDSTILL
        still &= apparatus.memory(self.drive)[0] < _STANDSTILL
        memory[0] = max(0.0, memory[0] - apparatus.period)
        if still and apparatus.reading(self.button).value:
            memory[0] = _RELEASED
        memory[1] = bool(self.lid.reading(apparatus).value) and not (still and memory[0] > 0.0)
        self.bolt.command(apparatus, bolted=bool(memory[1]))

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        return Reading(float(apparatus.memory(self)[1]), ON)


def _is_free(model: mujoco.MjModel, body: int) -> bool:
    first = int(model.body_jntadr[body])
    return first >= 0 and int(model.jnt_type[first]) == int(mujoco.mjtJoint.mjJNT_FREE)
