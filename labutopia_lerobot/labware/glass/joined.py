"""Parts joined to a wall of revolution: arms, necks, jackets, spouts, handles, plates.

Each function takes numbers in millimetres, as in catalogues, and returns what makes the forms for a
wall. They are drawn and touched, but sealed where they join: liquid knows walls of revolution, and
stopcocks.
"""

import math
from collections.abc import Callable

from labutopia_lerobot.labware.glass.draining import Bore
from labutopia_lerobot.labware.glass.moving_fittings import Fitting, Flap, SnapLid, Stopcock
from labutopia_lerobot.labware.glass.profile import Profile
from labutopia_lerobot.labware.parts.form import Block, Form, Ring, Rod, Turned
from labutopia_lerobot.labware.parts.pipe import Pipe
from labutopia_lerobot.labware.parts.solid import Vector
from labutopia_lerobot.labware.parts.valve import Tap

type Joined = Callable[[Profile], tuple[Form, ...]]
"""Function from a wall to the forms joined to it."""
type Fitted = Callable[[str, Profile], tuple[Fitting, ...]]
"""Function from the name of a piece and its wall to the fittings that move on it."""

_AXIS_ALONG_Y = (math.sqrt(0.5), -math.sqrt(0.5), 0.0, 0.0)


def together(*parts: Joined) -> Joined:
    """Return several as one."""
    return lambda profile: tuple(form for part in parts for form in part(profile))


def arm(
    share: float, out: float, diameter: float, lean: float = 0.0, azimuth: float = 0.0
) -> Joined:
    """Return a tube that leaves the wall.

    Args:
        share: Height at which it leaves, as a share of the whole.
        out: How long it is [mm].
        diameter: Its outer diameter [mm]; its wall is an eighth of it.
        lean: How far it rises from the horizontal [deg].
        azimuth: Where around the axis it is [deg].
    """

    def forms(profile: Profile) -> tuple[Form, ...]:
        height = share * profile.height
        start = _on_wall(profile, height, azimuth, math.radians(lean), 0.0)
        stop = _on_wall(profile, height, azimuth, math.radians(lean), 1e-3 * out)
        return (Pipe(start, stop, 1e-3 * diameter, 1e-3 * diameter / 8, "glass"),)

    return forms


def nozzle(share: float, azimuth: float = 0.0) -> Joined:
    """Return an olive for a hose of 9 mm, 35 mm long, at a share of the height."""

    def forms(profile: Profile) -> tuple[Form, ...]:
        height = share * profile.height
        at = [_on_wall(profile, height, azimuth, 0.0, 1e-3 * out) for out in (0, 35)]
        bead = [_on_wall(profile, height, azimuth, 0.0, 1e-3 * out) for out in (24, 30)]
        return (
            Pipe(at[0], at[1], 0.008, 0.0015, "glass"),
            Pipe(bead[0], bead[1], 0.010, 0.0015, "glass_edge"),
        )

    return forms


def jacket(low: float, high: float, diameter: float, wall: float = 1.6) -> Joined:
    """Return a double wall between two shares of the height, with a hose's olive at either end.

    Args:
        low: Its lower end, as a share of the height.
        high: Its upper end, as a share of the height.
        diameter: Its outer diameter [mm].
        wall: Its thickness [mm].
    """

    def forms(profile: Profile) -> tuple[Form, ...]:
        bottom, top, radius = low * profile.height, high * profile.height, 5e-4 * diameter
        ends = []
        for height in (bottom + 0.008, top - 0.008):
            start, stop = (radius - 5e-4 * wall, 0.0, height), (radius + 0.030, 0.0, height)
            ends.append(Pipe(start, stop, 0.008, 0.0015, "glass"))
        inner = 2e3 * profile.outer_radius(bottom)
        closing = [
            Ring(1e-3 * inner, 2 * radius, (z, z + 1e-3 * wall), "glass", touch=False)
            for z in (bottom, top - 1e-3 * wall)
        ]
        wide = Ring(2 * radius - 2e-3 * wall, 2 * radius, (bottom, top), "glass")
        return wide, *closing, *ends

    return forms


def bulbs(low: float, high: float, count: int, diameter: float) -> Joined:
    """Return round bulbs or the turns of a coil around a tube, to be seen only; see `jacket`."""

    def forms(profile: Profile) -> tuple[Form, ...]:
        bottom, tall = low * profile.height, (high - low) * profile.height / count
        made: list[Form] = []
        for number in range(count):
            middle = bottom + (number + 0.5) * tall
            inner, outer = profile.outer_radius(middle), 5e-4 * diameter
            half = 0.48 * tall
            section = ((inner, -half), (outer, -0.4 * half), (outer, 0.4 * half), (inner, half))
            made.append(Turned(section, "glass", (0, 0, middle), edge=0, touch=False, segments=12))
        return tuple(made)

    return forms


def spout(look: str = "rim") -> Joined:
    """Return the spout of a beaker, a quarter around from its scale: a wedge outside the lip."""

    def forms(profile: Profile) -> tuple[Form, ...]:
        radius, top = profile.outer_radius(profile.height), profile.height
        out, low, half = 0.16 * radius, 0.10 * profile.height, 0.22 * radius
        left, right = (half, 0.97 * radius, top), (-half, 0.97 * radius, top)
        tip, foot = (0.0, radius + out, top), (0.0, profile.outer_radius(top - low), top - low)
        return tuple(
            Rod(a, b, 2.2 * profile.wall, look, segments=8)
            for a, b in ((left, tip), (right, tip), (tip, foot))
        )

    return forms


def handle(low: float, high: float, out: float, thick: float, look: str) -> Joined:
    """Return an ear between two shares of the height.

    Args:
        low: Where it ends below.
        high: Where it ends above.
        out: How far it stands out [mm].
        thick: Its side [mm].
        look: Its finish.
    """

    def forms(profile: Profile) -> tuple[Form, ...]:
        bottom, top, half = low * profile.height, high * profile.height, 5e-4 * thick
        near, far = profile.outer_radius(bottom), profile.outer_radius(top) + 1e-3 * out
        side = (-half, half)
        return (
            Block((far - 2 * half, far), side, (bottom, top), look),
            Block((near - 1e-3, far), side, (bottom, bottom + 2 * half), look),
            Block((profile.outer_radius(top) - 1e-3, far), side, (top - 2 * half, top), look),
        )

    return forms


def plate(share: float, thick: float, look: str) -> Joined:
    """Return a filter plate across the inside, at a share of the height, so thick [mm]."""

    def forms(profile: Profile) -> tuple[Form, ...]:
        height = share * profile.height
        across = 2 * profile.inner_radius(height)
        return (Rod((0, 0, height), (0, 0, height + 1e-3 * thick), across, look),)

    return forms


def stopcock(
    height: float,
    hole: float,
    plug: float,
    outlet: tuple[float, float],
    *,
    column: bool = False,
    vented: bool = False,
    out: float = 0.0,
) -> Fitted:
    """Return a stopcock in a stem, or on a wall; it is shut as it is built.

    Args:
        height: Where it is [mm].
        hole: Diameter of the hole through its plug [mm].
        plug: Diameter of the plug [mm].
        outlet: Radius and length of the bore from there on [mm].
        column: Whether the tube above is so narrow that liquid stands in it as a column.
        vented: Whether air gets in when the mouth is closed.
        out: How far from the wall it comes out, towards -y [mm]; 0 at the end of the stem.
    """
    bore = Bore(1e-3 * plug, 1e-3 * hole, 1e-3 * outlet[0], 1e-3 * outlet[1])

    def fittings(name: str, profile: Profile) -> tuple[Fitting, ...]:
        z = 1e-3 * height
        radius = profile.outer_radius(z) + 0.004
        tap = Tap(f"{name}_stopcock", length=0.030, look="white", standoff=0.014)
        at, turn = (0.0, -radius, z), _AXIS_ALONG_Y
        if not out:
            low = (0.0, 0.0, profile.bottom)
            tip = (0.0, 0.0, 0.0)
            return (Stopcock(tap, at, turn, bore, low, tip, column=column, vented=vented),)
        low = (0.0, -profile.inner_radius(z), z)
        tip = (0.0, -profile.outer_radius(z) - 1e-3 * out, z)
        return (Stopcock(tap, at, turn, bore, low, tip, (0.0, -1.0, 0.0), vented=vented),)

    return fittings


def barrel(height: float) -> Joined:
    """Return the barrel of a stopcock across a stem, at a height [mm]."""

    def forms(profile: Profile) -> tuple[Form, ...]:
        z = 1e-3 * height
        reach = profile.outer_radius(z) + 0.004
        return (Rod((0.0, -reach, z), (0.0, reach, z), 0.014, "glass_edge"),)

    return forms


def snap_lid(name: str, profile: Profile) -> tuple[Fitting, ...]:
    """Return the hinged lid of a microtube."""
    radius, bore = profile.outer_radius(profile.height), profile.inner_radius(profile.height)
    hinge, lid = radius + 0.0012, f"{name}_lid"
    forms: tuple[Form, ...] = (
        Rod((-hinge, 0.0, 0.0002), (-hinge, 0.0, 0.0012), 2 * radius + 0.001, "natural"),
        Rod((-hinge, 0.0, -0.0018), (-hinge, 0.0, 0.0002), 1.8 * bore, "natural", touch=False),
        Block((-0.0016, 0.0), (-0.0015, 0.0015), (-0.0003, 0.0006), "natural", 0.0, touch=False),
        Block(
            (-2 * hinge - 0.0025, -2 * hinge + 0.001),
            (-0.0015, 0.0015),
            (0.0002, 0.0012),
            "natural",
            0.0,
            touch=False,
        ),
    )
    reach = 2 * radius + 0.0012 + 0.0008
    at = (hinge, 0.0, profile.height)
    return (SnapLid(Flap(lid), at, reach, forms, mass=2.4 * math.pi * radius**2),)


def _on_wall(profile: Profile, height: float, azimuth: float, lean: float, out: float) -> Vector:
    """Return the point that is so far out of the wall, along a line through it [m]."""
    turn = math.radians(azimuth)
    radius = profile.outer_radius(height) - 0.5 * profile.wall + out * math.cos(lean)
    return radius * math.cos(turn), radius * math.sin(turn), height + out * math.sin(lean)
