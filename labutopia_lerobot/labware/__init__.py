"""Labware: what stands on the bench. Geometry, mass and grasp frames of glass vessels."""

from labutopia_lerobot.labware.glassware import (
    beaker,
    erlenmeyer_flask,
    graduated_cylinder,
    volumetric_flask,
)
from labutopia_lerobot.labware.profile import Profile
from labutopia_lerobot.labware.vessel import Vessel

__all__ = [
    "Profile",
    "Vessel",
    "beaker",
    "erlenmeyer_flask",
    "graduated_cylinder",
    "volumetric_flask",
]
