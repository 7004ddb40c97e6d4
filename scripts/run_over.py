"""Tilt at which liquid runs over the barrier of a slowly tilted vessel, compared with geometry.

The barrier is the highest point that liquid has to pass on its way out: the lip or, where a flared
rim leads down already, its shoulder. At some tilt the plane through it cuts off just what is in the
vessel. Water may stand a little above: pinned at an edge it bulges by about its capillary length
before it runs (de Gennes, Brochard-Wyart and Quere 2004, "Capillarity and Wetting Phenomena",
section 2.3).
"""

from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from labutopia_lerobot.labware.glass.profile import Profile
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.liquids.solver.flow import GRAVITY
from labutopia_lerobot.setting import PARTICLES
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.substances.substance import WATER
from liquid_experiments import filled, move_to

CAPILLARY_LENGTH = float(np.sqrt(0.0728 / (WATER.density * GRAVITY)))
"""Capillary length of water against air at 20 degrees Celsius, surface tension 72.8 mN/m [m]."""
_SLOW, _FAST = np.radians(1.0), np.radians(8.0)
"""Angular speed of a vessel about the barrier, and on the way there [rad/s]: waves die away."""
_EARLY = np.radians(3.0)
"""Angle before the barrier from which it is tilted slowly [rad]."""
_RUNNING = 0.002
"""Part of the liquid that has left when it runs over: two of 1,000 particles."""


class RunOver(NamedTuple):
    """The moment at which a vessel has run over.

    Attributes:
        late: How far it was tilted beyond the tilt at which the surface reaches the barrier [rad].
        above: How high the surface would stand above the barrier then, if nothing had left [m].
    """

    late: float
    above: float


def volume_below(profile: Profile, tilt: float, above: float = 0.0) -> float:
    """Return what a tilted vessel holds below a level plane [m^3].

    Args:
        profile: Of the vessel.
        tilt: Of its axis [rad], between 0 and 90 degrees, both excluded.
        above: How high the plane is above the barrier [m].
    """
    heights = np.linspace(profile.bottom, profile.height, 400)
    radii = np.array([profile.inner_radius(height) for height in heights])
    rise, run = np.cos(tilt), np.sin(tilt)
    barrier = (heights * rise - radii * run).max()
    # Of each disc, what lies further down the slope than this.
    edge = (heights * rise - barrier - above) / run
    cut = np.clip(edge, -radii, radii)
    segments = radii**2 * np.arccos(cut / radii) - cut * np.sqrt(radii**2 - cut**2)
    return float(np.trapezoid(segments, heights))


def tilt_to_barrier(profile: Profile, volume: float) -> float:
    """Return the tilt at which the surface of a volume [m^3] reaches the barrier [rad]."""
    lowest, highest = np.radians(0.5), np.radians(89.5)
    return brentq(lambda tilt: volume_below(profile, tilt) - volume, lowest, highest)


def run_over(vessel: Vessel, ml: float, count: int = PARTICLES, seed: int = 0) -> RunOver:
    """Tilt a filled vessel slowly until liquid runs over."""
    model, data, liquid = filled(vessel, Filling(ml), count, height=0.3, bench=False, seed=seed)
    profile, volume = vessel.profile, ml * 1e-6
    right = tilt_to_barrier(profile, volume)
    tilt, inside = 0.0, 1.0
    while inside > 1.0 - _RUNNING:
        tilt += (_FAST if tilt < right - _EARLY else _SLOW) / liquid.hertz
        move_to(model, data, (0, 0, 0.3), tilt)
        liquid.step()
        inside = liquid.take_account().inside[vessel.name] / volume
    above = brentq(lambda above: volume_below(profile, tilt, above) - volume, -0.05, 0.05)
    return RunOver(tilt - right, above)
