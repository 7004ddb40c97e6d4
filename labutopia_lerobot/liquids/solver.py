"""The liquid of a scene: particles, and one call that moves them on."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.liquids.bodies import (
    Glass,
    Shapes,
    add_moment,
    clearances,
    into,
    out_of,
    stop_at_vessels,
)
from labutopia_lerobot.liquids.compilation import kernel
from labutopia_lerobot.liquids.contacts import Contacts, find_contacts, gap
from labutopia_lerobot.liquids.fluid import blend, pack
from labutopia_lerobot.liquids.neighbors import near_pairs
from labutopia_lerobot.liquids.smoothing import BEHIND_WALL, SECOND_MOMENT, look_up
from labutopia_lerobot.liquids.substance import Substance

LIQUID_HZ = 150
"""Steps per second as a rule: one for every two of physics. A step moves the fastest wall that the
robot can swing, 2 m/s, by less than three particles."""

DEEP_HZ = 300
"""Steps per second of a deep liquid: one for every step of physics."""

_DEEP = 0.9
"""A liquid is deep if gravity * depth / (`LIQUID_HZ` * spacing)^2 is more than this. The push that
a particle needs in a step goes with it: at 1.1 liquid lies still, at 2.2 it boils (measured)."""

_ITERATIONS = {LIQUID_HZ: 4, DEEP_HZ: 2}
"""Times that a step moves particles apart."""

GRAVITY = 9.81
"""Acceleration of free fall [m/s^2], as in MuJoCo."""

REACH = 2.0
"""Reach of the kernel in particle spacings: some thirty neighbours in the bulk."""

PACKING = 0.925
"""Density of a packed liquid in sums of the kernel. A cubic lattice has 1; this makes up for what a
settled liquid is compressed by when corrections end after a few iterations (`docs/liquids.md`)."""

_LEAST_GAP = 0.25
"""Distance from a wall that particles keep in any case, in spacings; half is where they settle."""

_LEAST_VISCOSITY = 0.02
"""Part of the velocity difference to its neighbours that a particle always loses in a step: less
than this, 12 times water's viscosity at 0.1 ml, cannot be told apart at this resolution."""

_MOST_VISCOSITY = 0.5
"""Part that may be evened out at once; a thicker liquid takes several passes."""

_COHESION = 0.1
"""Pull between particles per surface tension / (density * spacing^2)."""

_WETTING = 10.0
"""Rate at which what lies on the bench comes to rest [1/s]: a puddle's rim sticks."""


class Flow(NamedTuple):
    """Numbers of a substance at a resolution.

    Attributes:
        hertz: Steps per second.
        iterations: Times that a step moves particles apart.
        spacing: Edge of the cube that a particle's volume fills [m].
        viscosity: Part of the velocity difference that is evened out in a pass.
        passes: Passes per step.
        cohesion: Greatest change of velocity by one neighbour in a pass [m/s].
    """

    hertz: int
    iterations: int
    spacing: float
    viscosity: float
    passes: int
    cohesion: float

    @classmethod
    def of(cls, substance: Substance, volume: float, depth: float) -> "Flow":
        """Return the numbers for particles of a volume [m^3], in liquid of a depth [m].

        Evening out a part c of the difference in every step of duration dt spreads momentum like
        the kinematic viscosity c M / (2 dt), where M is the kernel's second moment along an axis.
        """
        spacing = volume ** (1 / 3)
        deep = GRAVITY * depth > _DEEP * (LIQUID_HZ * spacing) ** 2
        hertz = DEEP_HZ if deep else LIQUID_HZ
        dt = 1.0 / hertz
        moment = SECOND_MOMENT * (REACH * spacing) ** 2
        wanted = _LEAST_VISCOSITY + 2 * substance.kinematic_viscosity * dt / moment
        passes = int(np.ceil(wanted / _MOST_VISCOSITY))
        pull = substance.surface_tension / (substance.density * spacing**2)
        cohesion = _COHESION * pull * dt / passes
        return cls(hertz, _ITERATIONS[hertz], spacing, wanted / passes, passes, cohesion)


@kernel
def advance(
    positions: NDArray[np.float64],
    velocities: NDArray[np.float64],
    pressure: NDArray[np.float64],
    glass: Glass,
    shapes: Shapes,
    flow: Flow,
    impulse: NDArray[np.float64],
    on_surface: NDArray[np.bool_],
) -> None:
    """Move the liquid on by one step.

    Args:
        positions: Shape (n, 3), metres, world frame, none in glass; changed in place.
        velocities: Shape (n, 3), m/s, world frame; changed in place.
        pressure: See `fluid.pack`; changed in place.
        glass: The vessels.
        shapes: Everything else.
        flow: What flows.
        impulse: Set to the sum over particles of the velocity [m/s] that every vessel and shape
            gave them, and of its moments about the world's origin [m^2/s], shape (owners, 6).
        on_surface: Set to whether a particle lies on something that is no vessel, shape (n,).
    """
    dt = 1.0 / flow.hertz
    reach = REACH * flow.spacing
    share = REACH**-3 / PACKING
    impulse[:] = 0.0
    velocities[:, 2] -= GRAVITY * dt
    ends = positions + dt * velocities
    clear = clearances(positions, ends, glass)
    stop_at_vessels(positions, ends, glass, clear, impulse)
    contacts = find_contacts(ends, glass, shapes, clear, reach)
    pairs = near_pairs(ends, reach)
    unpacked = ends.copy()
    pack(
        ends,
        pairs,
        contacts,
        pressure,
        flow.iterations,
        reach,
        share,
        1.0 / PACKING,
        _LEAST_GAP * flow.spacing,
        flow.spacing,
    )
    # What has been moved may be nearer to all glass by as much.
    clear -= np.sqrt(np.sum((ends - unpacked) ** 2, axis=1))
    stop_at_vessels(positions, ends, glass, clear, impulse)
    velocities[:] = (ends - positions) / dt
    positions[:] = ends
    for _ in range(flow.passes):
        blend(positions, velocities, pairs, reach, share, flow.viscosity, flow.cohesion)
    moved = np.empty(3)
    for a in range(len(positions)):
        for c in range(contacts.starts[a], contacts.starts[a + 1]):
            for k in range(3):
                moved[k] = contacts.push[c] * contacts.normal[c, k]
            add_moment(impulse[contacts.owner[c]], positions[a], moved)
    impulse /= dt
    _drag(positions, velocities, contacts, glass, shapes, flow, impulse, on_surface)


@kernel
def _drag(
    positions: NDArray[np.float64],
    velocities: NDArray[np.float64],
    contacts: Contacts,
    glass: Glass,
    shapes: Shapes,
    flow: Flow,
    impulse: NDArray[np.float64],
    on_surface: NDArray[np.bool_],
) -> None:
    """Let walls carry liquid along: by its viscosity, and on the bench by wetting."""
    dt = 1.0 / flow.hertz
    vessels = len(glass.starts) - 1
    reach = REACH * flow.spacing
    viscous = 1.0 - (1.0 - flow.viscosity) ** flow.passes
    local, before, change = np.empty(3), np.empty(3), np.empty(3)
    for a in range(len(positions)):
        on_surface[a] = False
        for c in range(contacts.starts[a], contacts.starts[a + 1]):
            owner = contacts.owner[c]
            x, y, z = positions[a, 0], positions[a, 1], positions[a, 2]
            distance = gap(contacts, c, x, y, z)
            part = 2.0 * contacts.extent[c] * look_up(BEHIND_WALL, distance / reach)
            rate = viscous
            if owner < vessels:
                into(glass.now, owner, positions[a], local)
                out_of(glass.before, owner, local, before)
            else:
                s = owner - vessels
                into(shapes.now, s, positions[a], local)
                out_of(shapes.before, s, local, before)
                rate = max(rate, _WETTING * dt)
                if distance < flow.spacing:
                    on_surface[a] = True
            for k in range(3):
                wall = (positions[a, k] - before[k]) / dt
                change[k] = rate * part * (wall - velocities[a, k])
                velocities[a, k] += change[k]
            add_moment(impulse[owner], positions[a], change)
