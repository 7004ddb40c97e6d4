"""One step of position-based fluid (Macklin and Mueller 2013, "Position Based Fluids").

Every particle is a fixed volume of liquid. A step predicts where the particles would go, moves them
until none is more tightly packed than liquid is, and takes the velocities from where they have come
to. Walls take part in the packing as if liquid went on behind them (Koschier and Bender 2017,
"Density Maps for Improved SPH Boundary Handling", for plane walls), so that a particle keeps its
distance from glass as from other particles.

Density is counted in volumes, not in masses, so that where a dense liquid lies under a light one
neither is torn off the other (Solenthaler and Pajarola 2008, "Density Contrast SPH Interfaces").
Every correction is shared out by inverse masses: what is lighter than its surroundings rises.

Two things are not in the paper. Corrections are begun with a part of the previous step's, since a
settled liquid needs the same again to carry its weight; and a correction that went too far is taken
back. Both keep a settled liquid still.
"""

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.kernel import kernel
from labutopia_lerobot.liquids.solver.contacts import Contacts, gap
from labutopia_lerobot.liquids.solver.flow import PACKING, REACH, Flow, Matter
from labutopia_lerobot.liquids.solver.neighbors import Pairs
from labutopia_lerobot.liquids.solver.smoothing import AT_WALL, BEHIND_WALL, look_up, slope, weight

type Vectors = NDArray[np.float64]
"""Shape (n, 3)."""

type OfPairs = NDArray[np.float64]
"""Vectors of pairs, shape (3, pairs): their parts lie one after the other, so that a loop over all
pairs that only computes is done for several at once (SIMD)."""

_RELAXATION = 0.02
"""Softens the correction of nearly isolated particles (the paper's equation 11), times 1 / h^2."""

_STEP = 0.35
"""Part of a correction that is made, since all neighbours are corrected at the same time."""

_KEPT = 0.5
"""Part of the previous step's corrections that a step begins with."""


_LEAST_GAP = 0.25
"""Distance from a wall that particles keep in any case, in spacings; half is where they settle."""

_SHARE = REACH**-3 / PACKING
"""Contribution of a particle to the density, of 1, times the kernel's `weight`."""

_WALL_SHARE = 1.0 / PACKING
"""Contribution of a wall to the density, times the kernel's part behind it."""


@kernel
def pack(
    positions: Vectors,
    pairs: Pairs,
    contacts: Contacts,
    pressure: NDArray[np.float64],
    matter: Matter,
    flow: Flow,
) -> None:
    """Move particles apart until the liquid is nowhere denser than it is at rest.

    Args:
        positions: Metres, world frame; changed in place.
        pairs: Neighbours.
        contacts: Walls near the particles; what they push is added to their `push`.
        pressure: What the corrections of the previous step came to, shape (n,), square metres, not
            positive; changed in place.
        matter: What each particle is made of.
        flow: What all of it has in common.
    """
    n, reach = len(positions), REACH * flow.spacing
    gradients, shares = np.empty((3, len(pairs.second))), np.empty(len(pairs.second))
    wall_gradient = np.empty(len(contacts.offset))
    density, diagonal = np.empty(n), np.empty(n)
    factor = np.empty(n)
    moves = np.empty((n, 3))
    pressure *= _KEPT
    for turn in range(flow.iterations + 1):
        _measure(positions, pairs, contacts, reach, density, shares, gradients, wall_gradient)
        if turn == 0:
            _diagonal(pairs, contacts, gradients, wall_gradient, matter.lightness, diagonal)
            diagonal += _RELAXATION / reach**2
            factor[:] = pressure
        else:
            for a in range(n):
                # Pressure pushes or it is nothing: never more is taken back than was given.
                new = min(0.0, pressure[a] - _STEP * (density[a] - 1.0) / diagonal[a])
                factor[a] = new - pressure[a]
                pressure[a] = new
        _push_apart(pairs, gradients, factor, moves)
        for a in range(n):
            for k in range(3):
                positions[a, k] += matter.lightness[a] * moves[a, k]
        _push_off_walls(positions, contacts, wall_gradient, factor, matter.lightness, flow.spacing)


@kernel
def _push_apart(
    pairs: Pairs, gradients: OfPairs, factor: NDArray[np.float64], moves: Vectors
) -> None:
    """Set the corrections that neighbours give each other, per unit of lightness [m]."""
    moves[:] = 0.0
    for k in range(len(moves)):
        a = pairs.first[k]
        mine = factor[a]
        mx, my, mz = 0.0, 0.0, 0.0
        for p in range(pairs.starts[k], pairs.starts[k + 1]):
            b = pairs.second[p]
            s = mine + factor[b]
            gx, gy, gz = s * gradients[0, p], s * gradients[1, p], s * gradients[2, p]
            mx += gx
            my += gy
            mz += gz
            moves[b, 0] -= gx
            moves[b, 1] -= gy
            moves[b, 2] -= gz
        moves[a, 0] += mx
        moves[a, 1] += my
        moves[a, 2] += mz


@kernel
def _push_off_walls(
    positions: Vectors,
    contacts: Contacts,
    wall_gradient: NDArray[np.float64],
    factor: NDArray[np.float64],
    lightness: NDArray[np.float64],
    spacing: float,
) -> None:
    """Make the corrections that walls give, and keep particles a least distance away from them."""
    least = _LEAST_GAP * spacing
    for a in range(len(positions)):
        for c in range(contacts.starts[a], contacts.starts[a + 1]):
            push = lightness[a] * (factor[a] * wall_gradient[c])
            for k in range(3):
                positions[a, k] += push * contacts.normal[c, k]
            x, y, z = positions[a, 0], positions[a, 1], positions[a, 2]
            # What is deep in a wall, as a drop that a finger closes on, is not shot out of it.
            short = min(least - gap(contacts, c, x, y, z), spacing)
            if short > 0.0 and contacts.extent[c] > 0.5:
                push += short
                for k in range(3):
                    positions[a, k] += short * contacts.normal[c, k]
            contacts.push[c] += push


@kernel
def _measure(
    positions: Vectors,
    pairs: Pairs,
    contacts: Contacts,
    reach: float,
    density: NDArray[np.float64],
    shares: NDArray[np.float64],
    gradients: OfPairs,
    wall_gradient: NDArray[np.float64],
) -> None:
    """Find the density at every particle, of 1 at rest, and how it changes with distances [1/m]."""
    density[:] = _SHARE * weight(0.0)
    per_reach = 1.0 / reach
    _find_differences(positions, pairs, gradients)
    _weigh(gradients[0], gradients[1], gradients[2], per_reach, shares)
    for k in range(len(positions)):
        own = 0.0
        for p in range(pairs.starts[k], pairs.starts[k + 1]):
            own += shares[p]
            density[pairs.second[p]] += shares[p]
        density[pairs.first[k]] += own
    for a in range(len(positions)):
        x, y, z = positions[a, 0], positions[a, 1], positions[a, 2]
        # What is left of space before all the walls: overlaps, as in a corner, do not count twice.
        free = 1.0
        for c in range(contacts.starts[a], contacts.starts[a + 1]):
            q = gap(contacts, c, x, y, z) * per_reach
            free *= 1.0 - contacts.extent[c] * look_up(BEHIND_WALL, q)
        density[a] += _WALL_SHARE * (1.0 - free)
        for c in range(contacts.starts[a], contacts.starts[a + 1]):
            q = gap(contacts, c, x, y, z) * per_reach
            others = free / (1.0 - contacts.extent[c] * look_up(BEHIND_WALL, q))
            wall_gradient[c] = -_WALL_SHARE * others * contacts.extent[c] * look_up(AT_WALL, q)
            wall_gradient[c] *= per_reach


@kernel
def _find_differences(positions: Vectors, pairs: Pairs, differences: OfPairs) -> None:
    """Set how far the first of each pair is from the second [m]."""
    for k in range(len(positions)):
        a = pairs.first[k]
        x, y, z = positions[a, 0], positions[a, 1], positions[a, 2]
        for p in range(pairs.starts[k], pairs.starts[k + 1]):
            b = pairs.second[p]
            differences[0, p] = x - positions[b, 0]
            differences[1, p] = y - positions[b, 1]
            differences[2, p] = z - positions[b, 2]


@kernel
def _weigh(
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    z: NDArray[np.float64],
    per_reach: float,
    shares: NDArray[np.float64],
) -> None:
    """Set the share of each pair in the density of both; turn its difference into the gradient."""
    for p in range(len(shares)):
        q = np.sqrt(x[p] * x[p] + y[p] * y[p] + z[p] * z[p]) * per_reach
        shares[p] = _SHARE * weight(q)
        s = _SHARE * per_reach * per_reach * slope(q)
        x[p], y[p], z[p] = s * x[p], s * y[p], s * z[p]


@kernel
def _diagonal(
    pairs: Pairs,
    contacts: Contacts,
    gradients: OfPairs,
    wall_gradient: NDArray[np.float64],
    lightness: NDArray[np.float64],
    diagonal: NDArray[np.float64],
) -> None:
    """Find the sum of the squared gradients of each density (the denominator of equation 9).

    Each is weighted with the inverse mass of the particle that it moves (Mueller et al. 2007,
    "Position Based Dynamics", equation 8).
    """
    total = np.zeros((len(diagonal), 3))
    diagonal[:] = 0.0
    for k in range(len(diagonal)):
        a = pairs.first[k]
        for p in range(pairs.starts[k], pairs.starts[k + 1]):
            b = pairs.second[p]
            square = 0.0
            for axis in range(3):
                total[a, axis] += gradients[axis, p]
                total[b, axis] -= gradients[axis, p]
                square += gradients[axis, p] ** 2
            diagonal[a] += lightness[b] * square
            diagonal[b] += lightness[a] * square
    for a in range(len(diagonal)):
        for c in range(contacts.starts[a], contacts.starts[a + 1]):
            for axis in range(3):
                total[a, axis] += wall_gradient[c] * contacts.normal[c, axis]
        own = total[a, 0] ** 2 + total[a, 1] ** 2 + total[a, 2] ** 2
        diagonal[a] += lightness[a] * own


@kernel
def blend(
    positions: Vectors,
    velocities: Vectors,
    pairs: Pairs,
    matter: Matter,
    reach: float,
) -> None:
    """Exchange momentum between neighbours: viscosity (XSPH), and the pull of surface tension.

    Args:
        positions: Metres, world frame.
        velocities: Metres per second; changed in place, the sum of momenta stays.
        pairs: Neighbours.
        matter: What each particle is made of; a pair has the mean of its two.
        reach: Of the kernel [m].
    """
    n, count = len(positions), len(pairs.second)
    thickness, cohesion = matter.thickness, matter.cohesion
    change = np.zeros((n, 3))
    apart, r, w, pulls = np.empty((3, count)), np.empty(count), np.empty(count), np.empty(count)
    _find_differences(positions, pairs, apart)
    _attract(apart[0], apart[1], apart[2], reach, r, w, pulls)
    for k in range(n):
        a = pairs.first[k]
        for p in range(pairs.starts[k], pairs.starts[k + 1]):
            b = pairs.second[p]
            even = (thickness[a] + thickness[b]) * _SHARE * w[p]
            pull = (cohesion[a] + cohesion[b]) * pulls[p] / r[p]
            cx = even * (velocities[b, 0] - velocities[a, 0]) - pull * apart[0, p]
            cy = even * (velocities[b, 1] - velocities[a, 1]) - pull * apart[1, p]
            cz = even * (velocities[b, 2] - velocities[a, 2]) - pull * apart[2, p]
            change[a, 0] += cx
            change[a, 1] += cy
            change[a, 2] += cz
            change[b, 0] -= cx
            change[b, 1] -= cy
            change[b, 2] -= cz
    for a in range(n):
        for axis in range(3):
            velocities[a, axis] += matter.lightness[a] * change[a, axis]


@kernel
def _attract(
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    z: NDArray[np.float64],
    reach: float,
    distances: NDArray[np.float64],
    weights: NDArray[np.float64],
    pulls: NDArray[np.float64],
) -> None:
    """Set the distance [m], the kernel's weight and the pull of each pair from its difference."""
    for p in range(len(pulls)):
        r = np.sqrt(x[p] * x[p] + y[p] * y[p] + z[p] * z[p]) + 1e-9
        q = r / reach
        distances[p], weights[p] = r, weight(q)
        pulls[p] = _attraction(q) if q < 1.0 else 0.0


@kernel
def _attraction(q: float) -> float:
    """Pull between two particles at the distance q h, at most 1; near ones repel each other.

    The spline of Akinci et al. (2013, "Versatile Surface Tension and Adhesion for SPH Fluids",
    equation 2).
    """
    cube = (1.0 - q) ** 3 * q**3
    return 64.0 * cube if q > 0.5 else 128.0 * cube - 1.0
