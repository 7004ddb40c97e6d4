"""Ware that does not stand stays in the holder that its table says."""

import mujoco
import numpy as np
import pytest

from labutopia_lerobot.labware.glass.catalogue import glassware, vessels
from labutopia_lerobot.labware.instrument_catalogue import instrument
from labutopia_lerobot.labware.instruments.support.cork_ring import CorkRing
from labutopia_lerobot.labware.instruments.support.tube_rack import TubeRack
from vessels_on_a_bench import bench

HELD = [kind for kind, one in vessels().items() if one.holder]


def places_for(kind: str) -> dict[str, tuple[float, float, float]]:
    """Return where in its holder the base of every size goes that fits [m]."""
    holder, found = instrument(vessels()[kind].holder), {}
    for size in vessels()[kind].sizes:
        profile = glassware(kind, size).profile
        widest = 2 * max(radius for radius, _ in profile.outer)
        if isinstance(holder, CorkRing) and 1.05 * holder.hole < widest < 2.0 * holder.hole:
            found[size] = (0.0, 0.0, holder.seat(profile))
        if isinstance(holder, TubeRack) and 0.8 < widest / holder.places[0].width < 1.0:
            found[size] = holder.places[2].at
    return found


@pytest.mark.parametrize("kind", HELD)
def test_some_size_fits_and_stays_in_it_for_ten_seconds(kind):
    places = places_for(kind)
    assert places, "no size fits"
    size, at = next(iter(places.items()))
    vessel = glassware(kind, size, "piece")
    spec = bench(vessel)
    spec.compiler.degree = False
    spec.body("piece").pos = at
    instrument(vessels()[kind].holder).add_to(spec, spec.worldbody)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 2 * 300)
    start = data.body("piece").xpos.copy()
    assert np.linalg.norm(start - at) < 0.006  # a tube leans in its opening
    assert data.body("piece").xmat[8] > np.cos(np.radians(6.0))
    mujoco.mj_step(model, data, 10 * 300)
    assert np.linalg.norm(data.body("piece").xpos - start) < 1e-3
