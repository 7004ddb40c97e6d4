"""`docs/glassware.md` is what the script would write, with a picture of every kind."""

import make_glassware
from labutopia_lerobot.labware.glass.catalogue import catalogue


def test_the_page_is_what_the_script_writes():
    reported = "run: python scripts/make_glassware.py"
    assert make_glassware.page() == make_glassware.PAGE.read_text(), reported


def test_every_kind_has_a_small_picture():
    drawn = {file.stem: file.stat().st_size for file in make_glassware.PICTURES.iterdir()}
    assert set(drawn) == set(catalogue())
    assert sum(drawn.values()) < 600_000
