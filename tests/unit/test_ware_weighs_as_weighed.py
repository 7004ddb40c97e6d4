"""Ware of drawn tube weighs what its maker says that tube of its diameter and wall weighs.

From SCHOTT's brochure "DURAN: Tubing, Capillary and Rod of Borosilicate Glass 3.3", pages 2 to 4,
which says for each outside diameter and wall what a piece of about 1500 mm weighs. A round bottom
is as much glass as the tube that it ends: half a sphere has the area of a cylinder of its height.
"""

import pytest

from labutopia_lerobot.labware.glass.catalogue import glassware

GRAMS_PER_1500_MM = {(8, 1.0): 74, (12, 1.0): 116, (18, 1.2): 212, (20, 1.2): 237, (30, 1.4): 421}
"""Outside diameter and wall [mm] -> mass [g]; walls are within 5 % of what is stated there."""


@pytest.mark.parametrize(
    ("kind", "size"),
    [
        ("glass_tube", "8 x 200 mm"),
        ("test_tube", "12 x 75 mm"),
        ("test_tube", "12 x 100 mm"),
        ("test_tube", "18 x 180 mm"),
        ("test_tube", "20 x 150 mm"),
        ("test_tube", "30 x 200 mm"),
    ],
)
def test_it_weighs_what_as_much_drawn_tube_weighs(kind, size):
    piece = glassware(kind, size)
    profile = piece.profile
    across = 2000 * profile.outer_radius(profile.height / 2)
    tube = GRAMS_PER_1500_MM[round(across), round(1000 * profile.wall, 1)]
    assert 1000 * piece.mass == pytest.approx(tube * profile.height / 1.5, rel=0.03)
