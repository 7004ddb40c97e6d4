"""What `labutopia-bench` measures with is what users run."""

from labutopia_lerobot.cli.speed import _record
from labutopia_lerobot.setting import Setting


def test_it_records_what_it_is_to_time() -> None:
    assert _record(Setting("level1/pick", obs="state"), episodes=1) > 100
