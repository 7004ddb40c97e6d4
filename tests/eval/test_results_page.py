"""docs/results.md says what is measured, and of everything else that it is not."""

import make_results


def test_the_page_of_results_is_up_to_date():
    assert make_results.PAGE.read_text() == make_results.content(), "run scripts/make_results.py"


def test_every_cell_of_the_page_is_a_rate_or_says_that_it_is_not_measured():
    lines = [line for line in make_results.PAGE.read_text().splitlines() if "| level" in line]
    cells = [cell.strip() for line in lines for cell in line.split("|")[3:-1]]
    assert cells
    assert all(cell in ("-", "not measured") or "/" in cell for cell in cells)
