"""The compiled laboratories of a setting: which one an episode is played in."""

from collections import OrderedDict
from dataclasses import replace

import numpy as np

from labutopia_lerobot.layout import ImpossibleStartError, Workspace, require_possible
from labutopia_lerobot.robots import load_robot
from labutopia_lerobot.scenario import Scenario, canonical_task, draw_scenario, scenario_seeds
from labutopia_lerobot.scenes import load_room
from labutopia_lerobot.setting import Setting, UnknownOptionError
from labutopia_lerobot.sim.asked_for import require_readings
from labutopia_lerobot.sim.workcell import Workcell
from labutopia_lerobot.substances.filling import require_fillable
from labutopia_lerobot.substances.possible_solutions import require_possible_solutions

_TRIES = 5
"""Starts that a reset tries; more failures than that are a defect of the task, or of what a robot
can do."""

_KEPT = 8
"""Workcells that are kept for the next episode of their variant."""


class Workcells:
    """The workcells of a setting: one per discrete variant, the latest used are kept.

    Attributes:
        task: The canonical task: names, widths and limits are those of every draw.

    Raises:
        AxisError: If the task declares an axis wrongly.
        ImpossibleFillingError: If vessels cannot hold what the task puts into them, or what is
            dissolved in them cannot be.
        ImpossibleStartError: If things cannot stand where the task wants them.
        TaskError: If something reads an instrument that does not stand in the task.
        UnknownOptionError: If the task does not have the axes of the setting.
    """

    def __init__(self, setting: Setting) -> None:
        self._setting = setting
        self.task = canonical_task(setting)
        require_fillable(self.task.contents, self.task.start)
        require_possible_solutions(setting.task, self.task.contents)
        require_readings(setting.task, self.task)
        robot = load_robot(setting.robot)
        scenario = draw_scenario(setting, 0)
        room = load_room(scenario.variation.room or setting.room)
        ground = room.ground(robot.base) if self.task.drives and robot.base else None
        require_possible(self.task.start, Workspace.of(room, robot), ground)
        self._kept: OrderedDict[object, Workcell] = OrderedDict()

    def begin(self, seed: int, after: str | None = None) -> tuple[Workcell, Scenario, int]:
        """Begin the episode of a seed.

        Args:
            seed: Seed of the episode.
            after: Step behind which it begins, or None for the start.

        Returns:
            The workcell, what was drawn, and how many starts were discarded before.

        Raises:
            ImpossibleStartError: If no start is any good: something touches what it must not, or
                the expert does not get through the setup.
            TaskError: If the task has no step `after`.
            UnknownOptionError: If a step is played alone, which has its own beginning.
        """
        alone = self._setting.step
        if after is not None and alone is not None:
            raise UnknownOptionError(
                f"step={alone} begins behind the step before it: leave `after` out"
            )
        for attempt in range(_TRIES):
            scenario = draw_scenario(self._setting, seed, attempt)
            workcell = self._workcell(scenario)
            rng = np.random.default_rng(scenario_seeds(self._setting, seed, attempt))
            amiss = workcell.begin(scenario, rng, after)
            if not amiss:
                return workcell, scenario, attempt
        raise ImpossibleStartError(
            f"{self._setting.task} cannot begin with seed {seed} and robot={self._setting.robot}: "
            f"of {_TRIES} starts none was any good, the last since: {amiss}. Give things other "
            "places in the `start` of the task, or choose another robot="
        )

    def close(self) -> None:
        """Give every OpenGL context back."""
        for workcell in self._kept.values():
            workcell.close()

    def _workcell(self, scenario: Scenario) -> Workcell:
        task = scenario.task
        variant = (
            tuple(task.start),
            scenario.variation.distractors,
            scenario.variation.in_the_way,
            scenario.variation.room,
            task.view,
            tuple((one, replace(held, celsius=None)) for one, held in task.contents.items()),
        )
        require_possible_solutions(self._setting.task, task.contents)
        if variant not in self._kept:
            if len(self._kept) == _KEPT:
                self._kept.popitem(last=False)[1].close()
            self._kept[variant] = Workcell(scenario, self._setting)
        self._kept.move_to_end(variant)
        return self._kept[variant]
