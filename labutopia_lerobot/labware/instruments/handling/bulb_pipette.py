"""A Pasteur pipette with a rubber bulb, which a parallel gripper squeezes."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.drawing import Drawing
from labutopia_lerobot.labware.parts.form import Block, Form, Rod, Turned, towards
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.slide import Slide
from labutopia_lerobot.processes import Process
from labutopia_lerobot.world.model import COLLISION_GROUP

_SQUEEZED = 0.0045
"""How far each wall of the bulb goes in until it meets the other [m]."""
_DISPLACES = 2.5e-4
"""Volume that leaves the bulb, per travel of both walls together [m^2]: 2.25 ml when it is flat, as
of a bulb of 2 ml; ours: in proportion."""
_RUBBER, _LOSS = 1500.0, 30.0
"""Stiffness [N/m] and damping [N s/m] of each wall; ours: 7 N squeeze it flat, and it comes back in
a tenth of a second."""
_FELT = 0.3
"""Inertia of each wall with the finger behind it [kg]; ours, as of a piston pipette."""
_STOP = (0.98, 0.995, 0.0001, 0.5, 2)
"""Impedance of the stops, as of a piston pipette; ours."""
_GIVES = 4e-11
"""By how much the bulb grows with the pressure in it [m^3/Pa]; ours: half of what these walls would
give by, as pads hold the other half."""
_ROOM = 6.4e-6
"""Air in tube and bulb at rest [m^3]: 100 mm of 6 mm inside, and the bulb."""
_TIP, _COLUMN = 5e-4, 1.2e-5
"""Radius of the mouth [m], and mean cross-section of what is drawn in [m^2]: 1 ml stands 84 mm
high, 50 mm of that in the drawn tip."""
_BULGE = (
    (0.0, -0.020),
    (0.003, -0.018),
    (0.0045, -0.012),
    (0.0045, 0.012),
    (0.003, 0.017),
    (0, 0.019),
)
"""Outline of half the bulb, about the middle of the grasp [m]."""
_GRIP, _NECK, _TOP = 0.155, 0.130, 0.175
"""Heights of the middle of the bulb, of its neck and of its end above the tip [m]."""


@dataclass(frozen=True)
class BulbPipette(Instrument):
    """A Pasteur pipette with a rubber bulb; its origin is the end of its tip, z up.

    Pads press the two walls of the bulb together; let go of, they draw liquid in. It gives way to
    the weight of the liquid, so that a filled pipette drips when it is raised from a slant.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.012, 0.016, _TOP)
    mass = 0.012
    source = "tube of 7 x 150 mm (ISO 7712), bulb of 2 ml; from memory"
    movable = True
    left_out = "it bears no scale"

    @property
    def grips(self) -> tuple[Slide, Slide]:
        """The walls of the bulb; 0 is at rest."""
        left, right = (
            Slide(f"{self.name}_{side}", _SQUEEZED, friction=0.01, effort=9.0)
            for side in ("left", "right")
        )
        return left, right

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.grips

    @property
    def grip_height(self) -> float:
        """Height of the grasp above the end of the tip [m]."""
        return _GRIP

    @property
    def grip_width(self) -> float:
        """Width of the bulb at rest [m]."""
        return self.size[1]

    @property
    def stroke(self) -> float:
        """Travel of both walls together that displaces 1 ml [m]; no stop marks it."""
        return 1e-6 / _DISPLACES

    @property
    def full_stroke(self) -> float:
        """Travel of both walls together until the bulb is flat [m]."""
        return 2 * _SQUEEZED

    @property
    def stops_at_rest(self) -> bool:
        """Whether springs keep its walls at a stop: a hand that holds it squeezes it a little."""
        return False

    @property
    def draws_at(self) -> str:
        """Name of the frame at the end of its tip; z the way that liquid leaves."""
        return f"{self.name}_tip"

    @property
    def drawn(self) -> str:
        """Name of the reading of what is in it [ml]."""
        return f"{self.name}_drawn"

    @property
    def works(self) -> tuple[Process, ...]:
        joints = tuple(grip.joint for grip in self.grips)
        drawing = Drawing(
            self.drawn,
            self.name,
            joints,
            -_DISPLACES,
            _ROOM,
            self.draws_at,
            _TIP,
            _COLUMN,
            gives=_GIVES,
        )
        return (drawing,)

    def _forms(self) -> list[Form]:
        tube = ((0.0009, 0.0), (0.0012, 0.048), (0.0035, 0.060), (0.0035, 0.136), (0.0, 0.136))
        return [
            Turned(tube, "glass"),
            Rod((0, 0, _NECK), (0, 0, _NECK + 0.008), 0.010, "red_rubber"),
            Block(
                (-0.005, 0.005),
                (-0.0035, 0.0035),
                (_NECK + 0.006, _TOP),
                "red_rubber",
                0.003,
                touch=False,
            ),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        half = self.size[1] / 2
        body.add_site(name=self.draws_at, quat=towards((0.0, 0.0, -1.0)), group=COLLISION_GROUP)
        body.add_site(name=f"{self.name}_grasp", pos=(0, 0, _GRIP), group=COLLISION_GROUP)
        for grip, side in zip(self.grips, (1, -1), strict=True):
            part = grip.add_to(spec, body, (0.0, side * half, _GRIP), (0.0, -side, 0.0))
            inner, outer = (-0.003, 0.0) if side > 0 else (0.0, 0.003)
            forms: list[Form] = [
                Block((-0.006, 0.006), (inner, outer), (-0.013, 0.014), "red_rubber", 0.0014),
                Turned(_BULGE, "red_rubber", (0.0, -side * 0.0045, 0.0), touch=False),
            ]
            assemble(spec, part, self.name, forms, mass=0.002)
            joint = part.joints[0]
            joint.stiffness, joint.springref = [_RUBBER, 0.0, 0.0], 0.0
            joint.solimp_limit = _STOP
            joint.armature, joint.damping = _FELT, [_LOSS, 0.0, 0.0]
