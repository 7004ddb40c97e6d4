"""Outlines of vessels: from a catalogue's numbers to the corners of the outer surface.

All lengths are in millimetres, as in catalogues. First comes the greatest diameter below the lip,
then the height. What follows are further diameters and heights of the same outside.
"""

import math

type Outline = tuple[tuple[float, float], ...]
"""(radius, height) corners [mm], from the rim it stands on (height 0) up to the lip."""

_STEPS = 4
"""Edges that a quarter of a circle is cut into: radii are right to within 2 %."""


def _quarter() -> list[tuple[float, float]]:
    """Return sine and cosine of angles from 0 to a right one, exact at both ends."""
    angles = [math.pi / 2 * step / _STEPS for step in range(1, _STEPS)]
    return [(0.0, 1.0), *((math.sin(a), math.cos(a)) for a in angles), (1.0, 0.0)]


def _heel(radius: float) -> Outline:
    """Return the rounded edge of a flat bottom."""
    round_off = min(1.5, 0.15 * radius)
    return (radius - round_off, 0.0), (radius, 2 * round_off)


def straight(diameter: float, height: float) -> Outline:
    """Return a plain upright wall."""
    return *_heel(diameter / 2), (diameter / 2, height)


def beaker(diameter: float, height: float) -> Outline:
    """Return an upright wall under a lip that flares by a thirtieth of the diameter."""
    lip = diameter / 30
    return *_heel(diameter / 2), (diameter / 2, height - lip), (diameter / 2 + lip, height)


def tapered(diameter: float, height: float, base: float) -> Outline:
    """Return a wall that widens from the base to the mouth."""
    return *_heel(base / 2), (diameter / 2, height)


def conical(diameter: float, height: float, neck: float) -> Outline:
    """Return an Erlenmeyer flask: a cone, and a neck over the upper quarter."""
    heel = 0.05 * diameter
    foot = (diameter / 2 - heel, 0.0), (diameter / 2, heel)
    return *foot, (neck / 2, 0.75 * height), (neck / 2, height)


def conical_beaker(diameter: float, height: float, mouth: float) -> Outline:
    """Return a Philips beaker: a cone with a lip."""
    lip = mouth / 20
    below = (mouth / 2, height - 2 * lip)
    return *_heel(diameter / 2), below, (mouth / 2 + lip, height)


def footed(diameter: float, height: float, tube: float, foot_height: float) -> Outline:
    """Return a graduated cylinder: a tube with a lip on a foot of the greatest diameter."""
    lip, foot = 0.08 * tube, diameter / 2
    edge = (foot - 1.0, 0.0), (foot, 0.3 * foot_height), (tube / 2, foot_height)
    return *edge, (tube / 2, height - lip), (tube / 2 + lip, height)


def globe(diameter: float, height: float, neck: float, foot: float) -> Outline:
    """Return a sphere with a neck, cut off at the bottom where it is as wide as the foot."""
    radius = diameter / 2
    low, high = math.acos(foot / diameter), math.acos(neck / diameter)
    middle = radius * math.sin(low)
    below = [-low * (1 - step / 5) for step in range(1, 6)]
    arc = [*below, *(high * step / 3 for step in range(1, 4))]
    body = [(radius * math.cos(a), middle + radius * math.sin(a)) for a in arc]
    return (foot / 2, 0.0), *body, (neck / 2, height)


def round_globe(diameter: float, height: float, neck: float) -> Outline:
    """Return a sphere with a neck; its lowest corner is a tip of a tenth of the diameter."""
    return globe(diameter, height, neck, 0.1 * diameter)


def pear(diameter: float, height: float, neck: float, shoulder: float) -> Outline:
    """Return a volumetric flask: a pear up to the shoulder, then a long neck."""
    foot, radius, widest = 0.30 * diameter, diameter / 2, 0.42 * shoulder
    lower = [(foot + (radius - foot) * s, widest * (1 - c)) for s, c in _quarter()]
    upper = []
    for step in range(1, 6):
        share = (1 + math.cos(math.pi * step / 5)) / 2
        upper.append((neck / 2 + (radius - neck / 2) * share, _between(widest, shoulder, step / 5)))
    return *lower, *upper, (neck / 2, height)


def tube(diameter: float, height: float) -> Outline:
    """Return a tube with a hemispherical bottom, whose lowest corner is a tip of 30 % of it."""
    radius, low = diameter / 2, math.acos(0.3)
    arc = [-low * (1 - step / 4) for step in range(1, 5)]
    middle = radius * math.sin(low)
    bottom = [(radius * math.cos(a), middle + radius * math.sin(a)) for a in arc]
    return (0.3 * radius, 0.0), *bottom, (radius, height)


def pointed(diameter: float, height: float, cone: float) -> Outline:
    """Return a tube that ends in a cone of a height, with a tip of 30 % of the diameter."""
    return (0.15 * diameter, 0.0), (diameter / 2, cone), (diameter / 2, height)


def bottle(diameter: float, height: float, neck: float) -> Outline:
    """Return a bottle: a body over 62 %, a round shoulder up to 80 %, a neck."""
    radius, low, high = diameter / 2, 0.62 * height, 0.80 * height
    shoulder = [(neck / 2 + (radius - neck / 2) * c, _between(low, high, s)) for s, c in _quarter()]
    return *_heel(radius), *shoulder, (neck / 2, height)


def bowl(diameter: float, height: float, foot: float) -> Outline:
    """Return a bowl: a quarter of an ellipse from the foot up to an upright lip."""
    slope = (diameter - foot) / 2
    return tuple((foot / 2 + slope * s, height * (1 - c)) for s, c in _quarter())


def cap(diameter: float, height: float) -> Outline:
    """Return a watch glass: a piece of a sphere, flat where it is less than 30 % as wide."""
    sphere = ((diameter / 2) ** 2 + height**2) / (2 * height)
    radii = [diameter / 2 * share for share in (0.3, 0.5, 0.7, 0.85, 1.0)]
    rises = [sphere - math.sqrt(sphere**2 - radius**2) for radius in radii]
    stretch = height / (rises[-1] - rises[0])
    return tuple((r, stretch * (z - rises[0])) for r, z in zip(radii, rises, strict=True))


def _between(low: float, high: float, share: float) -> float:
    return low + share * (high - low)


def funnel(diameter: float, height: float, stem: float, length: float) -> Outline:
    """Return a funnel: a stem that widens to 110 %, and a cone."""
    return (0.45 * stem, 0.0), (0.55 * stem, length), (diameter / 2, height)


def thistle(diameter: float, height: float, stem: float) -> Outline:
    """Return a stem under a bulb whose mouth is 80 % as wide."""
    low, wide = height - 1.1 * diameter, height - 0.55 * diameter
    bulb = (stem / 2, low), (0.42 * diameter, wide - 0.25 * diameter), (diameter / 2, wide)
    return (0.45 * stem, 0.0), *bulb, (0.40 * diameter, height)


def separating(diameter: float, height: float, neck: float, stem: float, length: float) -> Outline:
    """Return a separating funnel: a stem, a pear that is widest at its upper end, a neck."""
    top = 0.87 * height
    tall = top - length
    cone = (0.35 * stem, 0.0), (stem / 2, 0.2 * length), (stem / 2, length)
    pear = [(0.30, 0.40), (0.50, 0.65), (0.40, 0.90)]
    body = [(share * diameter, length + up * tall) for share, up in pear]
    return *cone, *body, (neck / 2, top), (neck / 2, height)


def burette(diameter: float, height: float, stem: float, tap: float) -> Outline:
    """Return a burette: a tip, a stem up to its stopcock, a tube."""
    stem_ends = (stem / 2, 0.3 * tap), (stem / 2, tap)
    return (0.25 * stem, 0.0), *stem_ends, (diameter / 2, tap + 10), (diameter / 2, height)


def pipette(diameter: float, height: float, stem: float, bulb: float) -> Outline:
    """Return a one-mark pipette: a drawn tip, a bulb around 45 % of the height, a stem."""
    middle, half = 0.45 * height, stem / 2
    low, high = middle - bulb / 2, middle + bulb / 2
    slope = min(0.2 * bulb, diameter)
    body = (half, low), (diameter / 2, low + slope), (diameter / 2, high - slope), (half, high)
    return (0.5 * half, 0.0), (half, 0.06 * height), *body, (half, height)


def pulled(diameter: float, height: float, tip: float, length: float) -> Outline:
    """Return a tube whose lower end is drawn to a tip over a length."""
    return (tip / 2, 0.0), (diameter / 2, length), (diameter / 2, height)


def socket_tube(diameter: float, height: float, socket: float, length: float) -> Outline:
    """Return a tube with a wider socket above and a slightly narrower lower end."""
    foot = (0.45 * diameter, 0.0), (diameter / 2, 0.06 * height)
    low = height - length
    return *foot, (diameter / 2, low - 6), (socket / 2, low), (socket / 2, height)


def dented(diameter: float, height: float, dents: float, count: float) -> Outline:
    """Return a tube that is narrower at so many rings."""
    corners = [(0.40 * diameter, 0.0), (diameter / 2, 0.08 * height)]
    pitch = 0.80 * height / count
    for number in range(round(count)):
        middle = 0.14 * height + (number + 0.3) * pitch
        corners += [(diameter / 2, middle - 0.18 * pitch), (dents / 2, middle)]
        corners += [(diameter / 2, middle + 0.18 * pitch)]
    return *corners, (diameter / 2, height)
