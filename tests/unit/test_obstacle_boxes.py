"""The boxes that spare particles shapes far away leave out no shape that matters."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from labutopia_lerobot.liquids.solver.bodies import BodyFrames, Shapes
from labutopia_lerobot.liquids.solver.contacts import _boxes_around, _outside
from labutopia_lerobot.liquids.solver.obstacles import (
    BOX,
    CAPSULE,
    CYLINDER,
    PLANE,
    SPHERE,
    distance,
)

REACH = 0.01
SIZE = np.array([0.03, 0.05, 0.02])
SPREAD = 0.2


def posed(kind: int, seed: int) -> Shapes:
    draws = np.random.default_rng(seed)
    rotation = Rotation.random(random_state=seed).as_matrix()
    frames = BodyFrames(draws.uniform(-0.1, 0.1, (1, 3)), rotation[None].copy())
    return Shapes(np.array([kind]), SIZE[None].copy(), np.array([True]), frames, frames)


@pytest.mark.parametrize("kind", [PLANE, SPHERE, CAPSULE, CYLINDER, BOX])
@pytest.mark.parametrize("seed", range(5))
def test_whatever_is_within_reach_of_a_shape_is_in_its_box(kind, seed) -> None:
    shapes = posed(kind, seed)
    (box,) = _boxes_around(shapes, np.array([0]), REACH)
    points = np.random.default_rng(seed).uniform(-SPREAD, SPREAD, (4000, 3))
    origin, rotation = shapes.now.origin[0], shapes.now.rotation[0]
    local = (points - origin) @ rotation
    far = np.array([distance(kind, SIZE, *point)[0] for point in local])
    outside = np.array([_outside(box, point) for point in points])
    assert (far < REACH).any()
    assert not outside[far < REACH].any()
    if kind != PLANE:
        assert outside.mean() > 0.5
