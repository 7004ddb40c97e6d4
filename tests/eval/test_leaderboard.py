import json
from pathlib import Path

import make_leaderboard


def test_the_leaderboard_is_up_to_date() -> None:
    assert make_leaderboard.PAGE.read_text() == make_leaderboard.page(make_leaderboard.RESULTS)


def test_a_submission_has_a_line_of_its_own(tmp_path: Path) -> None:
    kept = json.loads((make_leaderboard.RESULTS / "level1-pick.json").read_text())
    (tmp_path / "submissions").mkdir()
    (tmp_path / "level1-pick.json").write_text(json.dumps(kept))
    for row in kept["rows"]:
        row |= {"success": row["seed"] % 2 == 0, "policy": "act", "obs": "state"}
    (tmp_path / "submissions" / "someone.json").write_text(json.dumps(kept))
    _, expert, someone = (
        line
        for line in make_leaderboard.page(tmp_path).splitlines()
        if line.count("|") == 5 and "---" not in line
    )
    assert expert.startswith("| scripted expert | 100 % | 100/100 (96 to 100 %) |")
    assert someone.startswith("| someone, state | 50 % | 50/100 (40 to 60 %) |")
