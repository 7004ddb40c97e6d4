"""The page of compounds is made from the table and is up to date."""

import make_substances


def test_the_page_is_up_to_date():
    reported = "run: python scripts/make_substances.py"
    assert make_substances.page() == make_substances.PAGE.read_text(encoding="utf-8"), reported


def test_every_compound_is_on_the_page_once():
    text = make_substances.PAGE.read_text(encoding="utf-8")
    for one in make_substances.table().substances:
        assert text.count(f"<br>`{one.id}` |") == 1
