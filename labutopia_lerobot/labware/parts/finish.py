"""Finishes of instruments by name: what they are made of, to the eye."""

import mujoco

from labutopia_lerobot.scenes.finishes import Finish

FINISHES: dict[str, Finish] = {
    "white": Finish((0.93, 0.94, 0.94, 1.0), 0.25, 0.4),
    "cream": Finish((0.92, 0.89, 0.82, 1.0), 0.25, 0.4),
    "light_grey": Finish((0.76, 0.78, 0.79, 1.0), 0.25, 0.4),
    "grey": Finish((0.50, 0.53, 0.56, 1.0), 0.25, 0.4),
    "anthracite": Finish((0.19, 0.21, 0.24, 1.0), 0.25, 0.4),
    "black": Finish((0.06, 0.065, 0.07, 1.0), 0.3, 0.5),
    "blue": Finish((0.10, 0.28, 0.55, 1.0), 0.3, 0.4),
    "light_blue": Finish((0.45, 0.65, 0.80, 1.0), 0.3, 0.4),
    "petrol": Finish((0.08, 0.38, 0.42, 1.0), 0.3, 0.4),
    "red": Finish((0.78, 0.09, 0.08, 1.0), 0.3, 0.4),
    "green": Finish((0.12, 0.50, 0.24, 1.0), 0.3, 0.4),
    "yellow": Finish((0.93, 0.76, 0.10, 1.0), 0.3, 0.4),
    "orange": Finish((0.92, 0.45, 0.10, 1.0), 0.3, 0.4),
    "steel": Finish((0.66, 0.68, 0.70, 1.0), 0.6, 0.5),
    "chrome": Finish((0.80, 0.82, 0.84, 1.0), 0.9, 0.8),
    "dark_steel": Finish((0.36, 0.38, 0.40, 1.0), 0.5, 0.4),
    "brass": Finish((0.76, 0.60, 0.28, 1.0), 0.7, 0.6),
    "ceramic": Finish((0.95, 0.95, 0.93, 1.0), 0.6, 0.8),
    "rubber": Finish((0.11, 0.11, 0.12, 1.0), 0.05, 0.1),
    "copper": Finish((0.72, 0.43, 0.28, 1.0), 0.7, 0.6),
    "chalkboard": Finish((0.09, 0.22, 0.17, 1.0), 0.05, 0.1),
    "door": Finish((0.56, 0.66, 0.72, 1.0), 0.2, 0.3),
    "cloth": Finish((0.90, 0.91, 0.90, 1.0), 0.02, 0.05),
    "wood": Finish((0.68, 0.50, 0.31, 1.0), 0.1, 0.2),
    "glass": Finish((0.76, 0.88, 0.94, 0.22), 0.9, 0.9),
    "glass_edge": Finish((0.60, 0.82, 0.82, 0.75), 0.9, 0.9),
    "smoked": Finish((0.22, 0.25, 0.29, 0.50), 0.9, 0.9),
    "water": Finish((0.55, 0.78, 0.88, 0.55), 0.9, 0.9),
    "rim": Finish((0.82, 0.93, 0.98, 0.80), 0.9, 0.9),
    "clear": Finish((0.92, 0.95, 0.98, 0.30), 0.7, 0.8),
    "amber": Finish((0.42, 0.20, 0.05, 0.75), 0.9, 0.9),
    "natural": Finish((0.90, 0.92, 0.94, 0.75), 0.25, 0.4),
    "red_rubber": Finish((0.62, 0.25, 0.18, 1.0), 0.05, 0.1),
    "screen": Finish((0.04, 0.05, 0.06, 1.0), 0.6, 0.8),
    "glow": Finish((1.00, 0.55, 0.20, 1.0), 0.0, 0.0),
}
"""Painted sheet, plastics, metals and glass; ours, after what laboratories are furnished with."""


def finish(spec: mujoco.MjSpec, piece: str, name: str) -> str:
    """Return the material `<piece>_<name>`, one of `FINISHES`, added where the spec has none yet.

    Raises:
        KeyError: If there is no such finish.
    """
    material = f"{piece}_{name}"
    if spec.material(material) is None:
        look = FINISHES[name]
        spec.add_material(
            name=material, rgba=look.rgba, specular=look.specular, shininess=look.shininess
        )
    return material
