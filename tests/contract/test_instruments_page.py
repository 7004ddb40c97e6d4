"""`docs/instruments.md` is what the script would write, with a picture of every instrument."""

import make_instruments
from labutopia_lerobot.labware.instrument_catalogue import catalogue


def test_the_page_is_what_the_script_writes():
    reported = "run: python scripts/make_instruments.py"
    assert make_instruments.page() == make_instruments.PAGE.read_text(), reported


def test_every_instrument_has_a_small_picture():
    drawn = {file.stem: file.stat().st_size for file in make_instruments.PICTURES.iterdir()}
    assert set(drawn) == set(catalogue())
    assert sum(drawn.values()) < 1_500_000
