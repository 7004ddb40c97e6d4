"""A level means the paper's tasks; what goes beyond is found by name and listed after them."""

from labutopia_lerobot.registry import (
    choose_tasks,
    is_beyond_paper,
    task_files,
    tasks_of_levels,
)
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import Setting


def test_a_level_holds_the_tasks_of_the_paper_only():
    assert "level1/pick" in tasks_of_levels([1])
    assert "level1/squeeze" not in tasks_of_levels([1])


def test_a_task_beyond_the_paper_is_found_by_its_id_and_by_its_level_and_name():
    assert canonical_task(Setting("level1/squeeze")).instruction.startswith("Squeeze")
    assert choose_tasks("level1/squeeze", None) == ["level1/squeeze"]
    assert choose_tasks("squeeze", [1]) == ["level1/squeeze"]


def test_tasks_beyond_the_paper_come_after_all_of_the_paper():
    beyond = [is_beyond_paper(task_id) for task_id in task_files()]
    assert any(beyond)
    assert not all(beyond)
    assert beyond == sorted(beyond)


def test_users_may_have_tasks_beyond_the_paper_too(tmp_path):
    folder = tmp_path / "level2" / "beyond"
    folder.mkdir(parents=True)
    (folder / "extra.py").write_text("def extra(): ...\n")
    assert is_beyond_paper("level2/extra", tmp_path)
    assert "level2/extra" not in tasks_of_levels([2], tmp_path)
