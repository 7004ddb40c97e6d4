"""Looks of the parts of a piece: one material each."""

import mujoco

type Rgba = tuple[float, float, float, float]


def add_materials(
    spec: mujoco.MjSpec, piece: str, *looks: tuple[str, Rgba, float], shininess: float = 0.5
) -> None:
    """Add the materials `<piece>_<part>`.

    Args:
        spec: Where to.
        piece: Name of the piece.
        *looks: Part, colour and how strongly it reflects lights, from 0 to 1.
        shininess: How small their reflections are, from 0 to 1.
    """
    for part, rgba, specular in looks:
        name = f"{piece}_{part}"
        spec.add_material(name=name, rgba=rgba, specular=specular, shininess=shininess)
