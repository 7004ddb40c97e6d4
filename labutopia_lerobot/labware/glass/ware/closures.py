"""Stoppers, bungs, caps and lids: what closes vessels."""

from functools import partial

from labutopia_lerobot.labware.glass.closure import Cover, Plug, Screw
from labutopia_lerobot.labware.glass.material import (
    BOROSILICATE,
    POLYPROPYLENE,
    POLYSTYRENE,
    PORCELAIN,
    SODA_LIME,
    SOFT_RUBBER,
)
from labutopia_lerobot.labware.glass.series import ClosureSeries
from labutopia_lerobot.labware.glass.thread import GL32, GL45, Thread
from labutopia_lerobot.labware.glass.utensil import Shape
from labutopia_lerobot.labware.parts.form import Form, Ring, Rod
from labutopia_lerobot.labware.parts.pipe import Cone

_SQUEEZE = 0.00002
"""Excess of a pressed-in plug's radius over the mouth's [m]: makes `pull`."""
_TIGHT = 0.00008
"""Travel by which a screw cap is tightened beyond touching [m]: makes its torque."""


def _stopper(name: str, high: float, low: float, length: float, head: float, *, look: str) -> Shape:
    """Return a ground cone under a flat head."""
    tall = 0.35 * head
    top = length + 0.002
    forms: tuple[Form, ...] = (
        Cone(low, high, (0.0, length), "rim" if look == "glass" else look),
        Rod((0, 0, length), (0, 0, top), 0.8 * head, look),
        Rod((0, 0, top), (0, 0, top + tall), head, "rim" if look == "glass" else look),
    )
    return Shape(forms, top + 0.5 * tall, head)


def _bung(name: str, high: float, low: float, length: float) -> Shape:
    return Shape((Cone(low, high, (0.0, length), "red_rubber"),), 0.85 * length, high)


def _cap(name: str, outer: float, height: float, wall: float, *, look: str = "blue") -> Shape:
    """Return a round cap with a skirt."""
    inside = outer - 2 * wall
    forms = (
        Ring(inside, outer, (0.0, height - wall), look, facets=16),
        Rod((0, 0, height - wall), (0, 0, height), outer, look),
    )
    return Shape(forms, 0.5 * height, outer)


def _lid(name: str, outer: float, height: float, wall: float, knob: float, *, look: str) -> Shape:
    """Return a plate with a rim around the lip and, above, a knob."""
    shape = _cap(name, outer, height, wall, look=look)
    if not knob:
        return shape
    return Shape((*shape.forms, *_knob(height, knob, look)), height + 0.5 * knob, 0.8 * knob)


def _inset_lid(
    name: str, outer: float, height: float, wall: float, within: float, knob: float, *, look: str
) -> Shape:
    """Return a plate whose rim reaches into the mouth, with a knob."""
    forms: tuple[Form, ...] = (
        Ring(within - 2 * wall, within, (0.0, height - wall), look, facets=16),
        Rod((0, 0, height - wall), (0, 0, height), outer, look),
        *_knob(height, knob, look),
    )
    return Shape(forms, height + 0.5 * knob, 0.8 * knob)


def _knob(height: float, size: float, look: str) -> tuple[Form, ...]:
    neck = height + 0.5 * size
    return (
        Rod((0, 0, height), (0, 0, neck), 0.5 * size, look),
        Rod((0, 0, neck), (0, 0, height + size), 0.8 * size, look),
    )


def _plug(high: float, low: float, length: float, *rest: float) -> Plug:
    return Plug(low, high, length, _SQUEEZE)


def _around(outer: float, height: float, wall: float, *rest: float) -> Cover:
    return Cover(height - wall, around=outer - 2 * wall)


def _inset(outer: float, height: float, wall: float, within: float, knob: float) -> Cover:
    return Cover(height - wall, within=within)


def _screw(thread: Thread, outer: float, height: float, wall: float) -> Screw:
    return Screw(thread, height - wall, _TIGHT)


_NS = {
    # large end, small end, length, head [mm]: cone 1:10
    "NS 7/16": (7.5, 5.9, 16, 12),
    "NS 10/19": (10.0, 8.1, 19, 15),
    "NS 12/21": (12.5, 10.4, 21, 17),
    "NS 14/23": (14.5, 12.2, 23, 20),
    "NS 19/26": (18.8, 16.2, 26, 25),
    "NS 24/29": (24.0, 21.1, 29, 32),
    "NS 29/32": (29.2, 26.0, 32, 38),
    "NS 34/35": (34.5, 31.0, 35, 44),
}

SERIES = (
    ClosureSeries(
        "ground_stopper",
        "A stopper of glass with a ground cone.",
        partial(_stopper, look="glass"),
        BOROSILICATE,
        "ISO 383, cones 1:10 of series k; heads ours; from memory",
        _NS,
        stands=False,
        hold=_plug,
        friction=0.4,
        pull=(0.5, 100.0),
    ),
    ClosureSeries(
        "plastic_stopper",
        "A stopper of polypropylene with a conical plug.",
        partial(_stopper, look="natural"),
        POLYPROPYLENE,
        "ISO 383, cones 1:10 of series k; heads ours; from memory",
        _NS,
        stands=False,
        hold=_plug,
        friction=0.4,
        pull=(0.5, 100.0),
    ),
    ClosureSeries(
        "rubber_bung",
        "A bung of red rubber.",
        _bung,
        SOFT_RUBBER,
        "DIN 12871, upper and lower diameter and length; from memory",
        {
            "10.5 mm": (10.5, 8, 18),
            "14 mm": (14, 10.5, 20),
            "16 mm": (16, 12.5, 20),
            "18 mm": (18, 14, 20),
            "21 mm": (21, 16, 25),
            "24 mm": (24, 18, 28),
            "27 mm": (27, 21, 28),
            "31 mm": (31, 24, 30),
            "36 mm": (36, 29, 30),
            "41 mm": (41, 33, 30),
            "47 mm": (47, 38, 35),
            "49 mm": (49, 41, 40),
        },
        hold=_plug,
        friction=0.8,
        pull=(0.5, 100.0),
    ),
    ClosureSeries(
        "screw_cap_gl45",
        "A blue screw cap with a GL 45 thread: a turn counterclockwise lifts it by 4 mm.",
        _cap,
        POLYPROPYLENE,
        "ISO 4796-1, DIN 168-1 GL 45, 52 mm wide; from memory",
        {"GL 45": (52, 22, 3.2)},
        hold=partial(_screw, GL45),
        pull=(0.02, 1.0),
    ),
    ClosureSeries(
        "screw_cap_gl32",
        "A blue screw cap with a GL 32 thread.",
        _cap,
        POLYPROPYLENE,
        "DIN 168-1 GL 32; from memory",
        {"GL 32": (37.6, 16, 2.6)},
        hold=partial(_screw, GL32),
        pull=(0.01, 1.0),
    ),
    ClosureSeries(
        "petri_lid",
        "The lid of a Petri dish of glass.",
        partial(_lid, knob=0.0, look="glass"),
        SODA_LIME,
        "ISO 24998, 5 mm wider than the dish; from memory",
        {
            # outer diameter, height, wall
            "60 mm": (65, 13, 1.5),
            "80 mm": (85, 13, 1.6),
            "100 mm": (106, 14, 1.7),
            "120 mm": (126, 18, 1.8),
            "150 mm": (157, 22, 2.0),
        },
        hold=_around,
    ),
    ClosureSeries(
        "petri_lid_plastic",
        "The lid of a disposable Petri dish.",
        partial(_lid, knob=0.0, look="clear"),
        POLYSTYRENE,
        "ISO 24998, 3 mm wider than the dish; from memory",
        {
            "35 mm": (38, 7, 0.8),
            "60 mm": (63.5, 8, 0.9),
            "90 mm": (93.5, 8, 0.9),
            "150 mm": (154, 10, 1.2),
        },
        hold=_around,
    ),
    ClosureSeries(
        "weighing_bottle_lid",
        "The lid of a weighing bottle, over its rim, with a knob.",
        partial(_lid, look="glass"),
        BOROSILICATE,
        "DIN 12605; ours where it does not say; from memory",
        {
            # outer diameter, height, wall, knob
            "25 mm": (29, 10, 1.5, 8),
            "30 mm": (34, 10, 1.5, 9),
            "40 mm": (44, 12, 1.5, 10),
            "50 mm": (54.5, 12, 1.7, 12),
            "80 mm": (85, 12, 1.8, 14),
        },
        hold=_around,
    ),
    ClosureSeries(
        "crucible_lid",
        "The lid of a crucible, with a rim within its mouth and a knob.",
        partial(_inset_lid, look="ceramic"),
        PORCELAIN,
        "DIN 12904 lids; rim ours; from memory",
        {
            # outer diameter, height, wall, rim, knob
            "50 mm": (52, 5, 2.0, 42, 10),
            "45 mm": (47, 5, 1.9, 37, 9),
            "40 mm": (42, 5, 1.8, 32, 8),
            "35 mm": (37, 4.5, 1.6, 28, 8),
        },
        hold=_inset,
    ),
    ClosureSeries(
        "desiccator_lid",
        "The lid of a desiccator, with a knob.",
        partial(_inset_lid, look="glass"),
        BOROSILICATE,
        "DIN 12491 lids are domed, ours flat; from memory",
        {
            "250 mm": (252, 12, 5.0, 230, 34),
            "190 mm": (192, 11, 4.5, 172, 30),
        },
        hold=_inset,
    ),
)
