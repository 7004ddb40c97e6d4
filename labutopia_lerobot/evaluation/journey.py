"""What a robot has driven in an episode, beside its success; it is measured and decides nothing."""

import math
from collections.abc import Sequence

import numpy as np

from labutopia_lerobot.navigation.docking import approach_to
from labutopia_lerobot.navigation.footprint_clearance import FootprintClearance
from labutopia_lerobot.navigation.path_planner import BlockedPlaceError, UnreachableGoalError
from labutopia_lerobot.skills.drive_to import DriveTo
from labutopia_lerobot.skills.face import Face
from labutopia_lerobot.skills.skill import PhaseError
from labutopia_lerobot.skills.way import Way, base_at, dock_for
from labutopia_lerobot.task import Step
from labutopia_lerobot.world import Dock, FloatArray, World


class Journey:
    """Measures the driving of one episode; `note` it after every step.

    The shortest way is the planner's for the paper's disc, from where the robot starts to the
    places that the steps drive to, in their order; where they face what they have driven to, the
    last bit straight in, and back out.

    Args:
        steps: The played steps of a task in which one drives.
        world: Where.
    """

    def __init__(self, steps: Sequence[Step], world: World) -> None:
        self._world = world
        self._way = Way.of(world)
        self._places = [base_at(world)[0]]
        self._near = FootprintClearance.of(self._way.occupancy, self._way.footprint)
        self._clearance = self._gap = math.inf
        self._dock: Dock | None = None
        self._shortest = self._shortest_way(steps)

    def note(self) -> None:
        """Look at the world after a control step."""
        place, yaw = base_at(self._world)
        self._places.append(place)
        self._gap = min(self._gap, self._near.at(place, yaw))
        near = float(self._way.planner.clearance.at(place[None])[0])
        self._clearance = min(self._clearance, near)

    def columns(self, *, success: bool) -> dict[str, float | None]:
        """Return what a row says of it; None for a number that there is not.

        `m_clear` is the least distance of the base's middle from things, `m_gap` that of its
        footprint, both on the map. `m_off_dock` and `deg_off_dock` are how far it is at the end,
        in place and heading, from where the planner would dock for the last thing that is faced.
        SPL is that of an episode: 1 for the shortest way, less for a longer one, 0 without success
        (Anderson et al., 2018, "On Evaluation of Embodied Navigation Agents").

        Args:
            success: Whether the episode was one.
        """
        driven = float(np.hypot(*np.diff(self._places, axis=0).T).sum())
        known = math.isfinite(self._shortest)
        share = self._shortest / max(driven, self._shortest, 1e-9) if known else math.nan
        shares = {"spl": share if success or not known else 0.0}
        lengths = {"m_driven": driven, "m_shortest": self._shortest}
        distances = {"m_clear": self._clearance, "m_gap": self._gap}
        numbers = lengths | distances | shares | self._errors()
        return {n: round(v, 3) if math.isfinite(v) else None for n, v in numbers.items()}

    def _errors(self) -> dict[str, float]:
        """Return how far the base is from the last dock: place [m] and heading [deg]."""
        if self._dock is None:
            return {"m_off_dock": math.inf, "deg_off_dock": math.inf}
        place, yaw = base_at(self._world)
        off = math.degrees(abs(math.remainder(yaw - self._dock.yaw, 2.0 * math.pi)))
        return {"m_off_dock": math.dist(place, self._dock.position), "deg_off_dock": off}

    def _turning_place(self) -> tuple[FloatArray, float]:
        """Return where the robot can turn first, and how far straight back that is [m].

        That is where it starts, unless a step begins at a bench.
        """
        way, (here, yaw) = self._way, base_at(self._world)
        if way.planner.free(here):
            return here, 0.0
        try:
            out = approach_to(way.planner, way.occupancy, way.footprint, here, yaw)
        except BlockedPlaceError:
            return here, 0.0
        return out, math.dist(out, here)

    def _shortest_way(self, steps: Sequence[Step]) -> float:
        """Return its length [m]; infinite where there is none, or nothing is driven to."""
        here, straight = self._turning_place()
        length, driven_to = 0.0, None
        skills = [skill for step in steps for skill in step.skills]
        if not any(isinstance(skill, DriveTo) for skill in skills):
            length = math.inf
        for skill in skills:
            if not isinstance(skill, DriveTo | Face):
                continue
            try:
                dock = dock_for(self._world, skill.thing, from_above=skill.from_above)
                if isinstance(skill, DriveTo):
                    length += straight + self._way.shortest(here, dock.before).length
                    here, straight, driven_to = dock.before, 0.0, skill.thing
                    continue
            except (BlockedPlaceError, UnreachableGoalError, PhaseError):
                return math.inf
            self._dock = dock
            if driven_to == skill.thing:  # what is faced again has been gone in to
                straight, driven_to = math.dist(dock.before, dock.position), None
                length += straight
        return length
