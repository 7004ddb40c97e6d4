"""Vessels of every kind, and the bench that tests stand them on."""

import mujoco
import pytest

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.glass.utensil import Utensil
from labutopia_lerobot.labware.glass.vessel import Vessel

FLASK_SIZES = ("300 ml", "500 ml", "1000 ml")
BEAKER_SIZES = ("150 ml", "250 ml", "800 ml")
VESSELS = [
    glassware("measuring_cylinder", "250 ml", "vessel"),
    glassware("pear_shaped_flask", "250 ml", "vessel"),
    *(glassware("conical_flask", size, "vessel") for size in FLASK_SIZES),
    *(glassware("beaker", size, "vessel") for size in BEAKER_SIZES),
]
every_vessel = pytest.mark.parametrize(
    "vessel",
    VESSELS,
    ids=[
        "graduated cylinder",
        "volumetric flask",
        *(f"flask {s}" for s in FLASK_SIZES),
        *(f"beaker {s}" for s in BEAKER_SIZES),
    ],
)


def bench(*vessels: Vessel | Utensil, free: bool = True) -> mujoco.MjSpec:
    """A box whose top is at height 0, and the vessels on it, all at the origin."""
    spec = mujoco.MjSpec()
    spec.option.timestep = 1 / 300
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.impratio = 30
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    box = mujoco.mjtGeom.mjGEOM_BOX
    spec.worldbody.add_geom(name="bench", type=box, size=(1, 1, 0.05), pos=(0, 0, -0.05))
    for vessel in vessels:
        body = vessel.add_to(spec, spec.worldbody)
        if free:
            body.add_freejoint(name=vessel.name)
    return spec
