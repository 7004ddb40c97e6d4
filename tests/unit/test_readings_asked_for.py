"""A task that reads an instrument which does not stand in it is refused when it is loaded."""

from dataclasses import replace

import pytest

from adversary import begun_with
from labutopia_lerobot.registry import task_files
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.sim.asked_for import require_readings
from labutopia_lerobot.task import Task, TaskError


def without(task: Task, name: str) -> Task:
    """Return a task without one of its pieces."""
    return replace(task, start={v: where for v, where in task.start.items() if v.name != name})


def test_the_error_names_task_skill_reading_and_cure(monkeypatch: pytest.MonkeyPatch) -> None:
    blind = without(canonical_task(Setting("level4/titrate")), "meter")
    said = (
        r"^level4/titrate: the skill Titrate asks what 'meter_ph' reads.*Put the instrument.*stand_"
    )
    with pytest.raises(TaskError, match=said):
        begun_with("level4/titrate", blind, monkeypatch)


def test_a_fact_that_reads_is_named_too() -> None:
    task = canonical_task(Setting("level2/pour_to_mass"))
    with pytest.raises(TaskError, match=r"the fact '.*balance_.*' asks what 'balance_"):
        require_readings("level2/pour_to_mass", without(task, "balance"))


@pytest.mark.parametrize("task_id", task_files())
def test_every_task_has_what_it_reads(task_id: str) -> None:
    require_readings(task_id, canonical_task(Setting(task_id)))
