"""One step of a liquid: all that happens to its particles in it, in order."""

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.kernel import kernel
from labutopia_lerobot.liquids.solver.bodies import (
    Glass,
    Shapes,
    add_moment,
    clearances,
    into,
    out_of,
    stop_at_vessels,
)
from labutopia_lerobot.liquids.solver.contacts import Contacts, find_contacts, gap
from labutopia_lerobot.liquids.solver.flow import GRAVITY, REACH, Flow, Matter
from labutopia_lerobot.liquids.solver.fluid import blend, pack
from labutopia_lerobot.liquids.solver.neighbors import near_pairs
from labutopia_lerobot.liquids.solver.smoothing import BEHIND_WALL, look_up

_WETTING = 10.0
"""Rate at which what lies on the bench comes to rest [1/s]: a puddle's rim sticks."""

NOTHING = -1
"""Owner number of a particle that touches neither a vessel nor a shape."""


@kernel
def advance(
    positions: NDArray[np.float64],
    velocities: NDArray[np.float64],
    pressure: NDArray[np.float64],
    matter: Matter,
    glass: Glass,
    shapes: Shapes,
    flow: Flow,
    impulse: NDArray[np.float64],
    touching: NDArray[np.int64],
) -> None:
    """Move the liquid on by one step.

    Args:
        positions: Shape (n, 3), metres, world frame, none in glass; changed in place.
        velocities: Shape (n, 3), m/s, world frame; changed in place.
        pressure: See `fluid.pack`; changed in place.
        matter: What each particle is made of.
        glass: The vessels.
        shapes: Everything else.
        flow: What all of it has in common.
        impulse: Set to the sum over particles of the momentum per unit of relative mass [m/s] that
            every vessel and shape gave them, and of its moments about the world's origin [m^2/s],
            shape (owners, 6).
        touching: Set to the owner that each particle touches, something fixed before all else, or
            to `NOTHING`; shape (n,).
    """
    dt = 1.0 / flow.hertz
    reach = REACH * flow.spacing
    impulse[:] = 0.0
    velocities[:, 2] -= GRAVITY * dt
    ends = positions + dt * velocities
    clear = clearances(positions, ends, glass)
    stop_at_vessels(positions, ends, glass, clear, matter.mass, impulse)
    contacts = find_contacts(ends, glass, shapes, clear, reach)
    pairs = near_pairs(ends, reach)
    unpacked = ends.copy()
    pack(ends, pairs, contacts, pressure, matter, flow)
    _come_nearer(clear, unpacked, ends)
    stop_at_vessels(positions, ends, glass, clear, matter.mass, impulse)
    velocities[:] = (ends - positions) / dt
    positions[:] = ends
    for _ in range(flow.passes):
        blend(positions, velocities, pairs, matter, reach)
    _add_pushes(positions, contacts, matter.mass, impulse)
    impulse /= dt
    _drag(positions, velocities, contacts, matter, glass, shapes, flow, impulse, touching)


@kernel
def _come_nearer(
    clear: NDArray[np.float64], start: NDArray[np.float64], end: NDArray[np.float64]
) -> None:
    """Take from the clearances, shape (vessels, n) [m], what particles have been moved by.

    They may be nearer to all glass by as much.
    """
    for a in range(len(start)):
        x, y, z = end[a, 0] - start[a, 0], end[a, 1] - start[a, 1], end[a, 2] - start[a, 2]
        moved = np.sqrt(x * x + y * y + z * z)
        for v in range(len(clear)):
            clear[v, a] -= moved


@kernel
def _add_pushes(
    positions: NDArray[np.float64],
    contacts: Contacts,
    mass: NDArray[np.float64],
    impulse: NDArray[np.float64],
) -> None:
    """Add what walls have pushed particles by, times their masses, to the sums of their owners."""
    moved = np.empty(3)
    for a in range(len(positions)):
        for c in range(contacts.starts[a], contacts.starts[a + 1]):
            for k in range(3):
                moved[k] = mass[a] * (contacts.push[c] * contacts.normal[c, k])
            add_moment(impulse[contacts.owner[c]], positions[a], moved)


@kernel
def _drag(
    positions: NDArray[np.float64],
    velocities: NDArray[np.float64],
    contacts: Contacts,
    matter: Matter,
    glass: Glass,
    shapes: Shapes,
    flow: Flow,
    impulse: NDArray[np.float64],
    touching: NDArray[np.int64],
) -> None:
    """Let walls carry liquid along, by viscosity and, on the bench, by wetting; return which touch.

    A particle touches what its centre is less than a spacing from: where it settles, half a spacing
    is left.
    """
    dt = 1.0 / flow.hertz
    vessels = len(glass.starts) - 1
    reach = REACH * flow.spacing
    local, before, change = np.empty(3), np.empty(3), np.empty(3)
    for a in range(len(positions)):
        touching[a] = NOTHING
        viscous = 1.0 - (1.0 - matter.viscosity[a]) ** flow.passes
        for c in range(contacts.starts[a], contacts.starts[a + 1]):
            owner = contacts.owner[c]
            x, y, z = positions[a, 0], positions[a, 1], positions[a, 2]
            distance = gap(contacts, c, x, y, z)
            part = 2.0 * contacts.extent[c] * look_up(BEHIND_WALL, distance / reach)
            rate, fixed = viscous, False
            if owner < vessels:
                into(glass.now, owner, positions[a], local)
                out_of(glass.before, owner, local, before)
            else:
                s = owner - vessels
                into(shapes.now, s, positions[a], local)
                out_of(shapes.before, s, local, before)
                rate = max(rate, _WETTING * dt)
                fixed = shapes.fixed[s]
            if distance < flow.spacing and (fixed or touching[a] == NOTHING):
                touching[a] = owner
            for k in range(3):
                wall = (positions[a, k] - before[k]) / dt
                change[k] = rate * part * (wall - velocities[a, k])
                velocities[a, k] += change[k]
                change[k] *= matter.mass[a]
            add_moment(impulse[owner], positions[a], change)
