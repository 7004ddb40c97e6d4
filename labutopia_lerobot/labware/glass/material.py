"""Materials of vessels: density and look."""

from dataclasses import dataclass

from labutopia_lerobot.labware.glass.profile import BOROSILICATE_DENSITY

type Color = tuple[float, float, float, float]
"""Red, green, blue and opacity, each 0 to 1."""


@dataclass(frozen=True)
class Material:
    """A glass, a ceramic or a plastic; hashable.

    Attributes:
        called: What it is called in a sentence.
        density: Its density [kg/m^3].
        wall: Colour of the wall.
        edge: Colour of lip and heel, where one looks along the wall: the outline.
        bottom: Colour of the bottom.
        ink: Colour of what is printed on it.
        shine: Share of light that its outside mirrors, 0 to 1.
        source: Of the density.
        specific_heat: Heat that warms 1 kg by 1 K [J/kg K]: of borosilicate glass 3.3 by Schott's
            Duran data sheet; of others by Incropera, table A.3, or makers' tables, from memory.
    """

    called: str
    density: float
    wall: Color
    edge: Color
    bottom: Color
    ink: Color
    shine: float
    source: str
    specific_heat: float = 830.0


_WHITE_INK = (0.97, 0.98, 1.0, 0.95)
_BLUE_INK = (0.10, 0.25, 0.55, 0.95)

BOROSILICATE = Material(
    called="borosilicate glass",
    density=BOROSILICATE_DENSITY,
    wall=(0.86, 0.95, 0.96, 0.30),
    edge=(0.88, 0.97, 0.96, 0.80),
    bottom=(0.78, 0.88, 0.86, 0.10),
    ink=_WHITE_INK,
    shine=0.9,
    source="ISO 3585; Schott Duran data sheet",
)
AMBER_GLASS = Material(
    called="amber borosilicate glass",
    density=BOROSILICATE_DENSITY,  # its stain is a skin
    wall=(0.42, 0.20, 0.05, 0.62),
    edge=(0.48, 0.24, 0.07, 0.90),
    bottom=(0.36, 0.17, 0.04, 0.75),
    ink=_WHITE_INK,
    shine=0.9,
    source="as borosilicate 3.3",
)
SODA_LIME = Material(
    called="soda-lime glass",
    density=2500.0,
    wall=(0.80, 0.91, 0.87, 0.26),
    edge=(0.76, 0.92, 0.84, 0.80),
    bottom=(0.74, 0.88, 0.82, 0.11),
    ink=_WHITE_INK,
    shine=0.9,
    source="2.5 g/cm3, Schott AR-Glas data sheet; from memory",
    specific_heat=840.0,
)
QUARTZ = Material(
    called="fused quartz",
    density=2200.0,
    wall=(0.90, 0.92, 0.95, 0.24),
    edge=(0.95, 0.97, 1.0, 0.80),
    bottom=(0.88, 0.90, 0.94, 0.09),
    ink=_WHITE_INK,
    shine=0.9,
    source="2.20 g/cm3, Heraeus HSQ data sheet; from memory",
    specific_heat=740.0,
)
PORCELAIN = Material(
    called="glazed porcelain",
    density=2400.0,
    wall=(0.95, 0.94, 0.91, 1.0),
    edge=(0.90, 0.89, 0.86, 1.0),
    bottom=(0.93, 0.92, 0.89, 1.0),
    ink=_BLUE_INK,
    shine=0.5,
    source="2.4 g/cm3, DIN EN 60672-3 type C 110 (2.2 at least); from memory",
    specific_heat=800.0,
)
POLYPROPYLENE = Material(
    called="polypropylene",
    density=905.0,
    wall=(0.90, 0.92, 0.94, 0.58),
    edge=(0.95, 0.96, 0.97, 0.92),
    bottom=(0.90, 0.92, 0.94, 0.72),
    ink=_BLUE_INK,
    shine=0.25,
    source="0.905 g/cm3, ISO 19069 homopolymers; from memory",
    specific_heat=1900.0,
)
POLYETHYLENE = Material(
    called="high-density polyethylene",
    density=950.0,
    wall=(0.94, 0.94, 0.92, 0.90),
    edge=(0.96, 0.96, 0.94, 1.0),
    bottom=(0.92, 0.92, 0.90, 0.95),
    ink=_BLUE_INK,
    shine=0.15,
    source="0.94 to 0.97 g/cm3, ISO 17855; from memory",
    specific_heat=1900.0,
)
POLYSTYRENE = Material(
    called="polystyrene",
    density=1050.0,
    wall=(0.92, 0.95, 0.98, 0.22),
    edge=(0.95, 0.97, 1.0, 0.75),
    bottom=(0.90, 0.94, 0.97, 0.12),
    ink=_BLUE_INK,
    shine=0.7,
    source="1.05 g/cm3, ISO 24936 crystal polystyrene; from memory",
    specific_heat=1300.0,
)

SOFT_RUBBER = Material(
    called="natural rubber",
    density=1100.0,
    wall=(0.62, 0.25, 0.18, 1.0),
    edge=(0.62, 0.25, 0.18, 1.0),
    bottom=(0.62, 0.25, 0.18, 1.0),
    ink=_WHITE_INK,
    shine=0.05,
    source="bungs of red rubber with filler, 1.1 to 1.3 g/cm3; from memory",
    specific_heat=2010.0,
)
PTFE = Material(
    called="PTFE",
    density=2170.0,
    wall=(0.96, 0.96, 0.95, 1.0),
    edge=(0.96, 0.96, 0.95, 1.0),
    bottom=(0.96, 0.96, 0.95, 1.0),
    ink=_BLUE_INK,
    shine=0.3,
    source="2.13 to 2.20 g/cm3, ISO 20568; from memory",
    specific_heat=1000.0,
)
STAINLESS_STEEL = Material(
    called="stainless steel",
    density=7900.0,
    wall=(0.66, 0.68, 0.70, 1.0),
    edge=(0.66, 0.68, 0.70, 1.0),
    bottom=(0.66, 0.68, 0.70, 1.0),
    ink=_WHITE_INK,
    shine=0.6,
    source="7.9 g/cm3, EN 10088-1, 1.4301",
    specific_heat=480.0,
)
CORK = Material(
    called="pressed cork",
    density=240.0,
    wall=(0.68, 0.50, 0.31, 1.0),
    edge=(0.68, 0.50, 0.31, 1.0),
    bottom=(0.68, 0.50, 0.31, 1.0),
    ink=_BLUE_INK,
    shine=0.05,
    source="0.2 to 0.3 g/cm3; from memory",
    specific_heat=1800.0,
)
