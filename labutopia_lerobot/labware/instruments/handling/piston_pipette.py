"""A piston pipette that a parallel gripper works: its two grips are pressed together."""

from dataclasses import dataclass
from typing import ClassVar

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.drawing import Drawing
from labutopia_lerobot.labware.parts.form import Block, Form, Rod, Turned, towards
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.slide import Slide
from labutopia_lerobot.processes import Process
from labutopia_lerobot.world.model import COLLISION_GROUP

_FIRST, _SECOND = 0.003, 0.0045
"""Travel of each grip to the first and to the second stop [m]; ours."""
_PRELOAD, _SPRING = 3.0, 1600.0
"""Force at rest [N] and stiffness [N/m] of each grip's spring: 8 N at the first stop; ours, so that
the pads carry it before it gives way."""
_BLOWING = 4000.0
"""Stiffness beyond the first stop [N/m]: 8 N more at the second; ours. Twice as much would swing at
300 steps a second."""
_GREASE, _FELT = 30.0, 0.3
"""Damping [N s/m] and inertia [kg] of each grip, the piston's and the hand's; ours."""
_STOP = (0.98, 0.995, 0.0001, 0.5, 2)
"""Impedance of the stops: 20 N press them in by less than 0.13 mm; ours."""
_GRIP = 0.150
"""Height of the middle of the grips above the tip's end [m]."""
_HOOK = 0.190
"""Height of the underside of its hook above the tip's end [m]."""


@dataclass(frozen=True)
class PistonPipette(Instrument):
    """An air-displacement pipette of 1 ml; its origin is the end of its tip, z up.

    As in any such pipette (ISO 8655-2), the first stop displaces the set volume and the second
    blows out the rest. In place of a thumb's button it has two grips, which pads press together.

    Attributes:
        name: Name of its root body; prefix of all its elements.
        volume: What the first stop displaces [m^3].
    """

    name: str
    volume: float = 1e-6
    size = (0.024, 0.044, 0.230)
    mass = 0.085
    source = "1 ml, 85 g and 230 mm with its tip, as usual; from memory"
    movable: ClassVar[bool] = True

    @property
    def grips(self) -> tuple[Slide, Slide]:
        """What the pads press together; 0 is at rest."""
        left, right = (
            Slide(f"{self.name}_{side}", _SECOND, 0.1, 20.0) for side in ("left", "right")
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
        """Distance of the grips' outer faces at rest [m]."""
        return self.size[1]

    @property
    def hangs_by(self) -> float:
        """Height of the underside of the hook above the end of the tip [m]."""
        return _HOOK

    @property
    def stroke(self) -> float:
        """Travel of both grips together to the first stop [m]."""
        return 2 * _FIRST

    @property
    def full_stroke(self) -> float:
        """Travel of both grips together to the second stop [m]."""
        return 2 * _SECOND

    @property
    def stops_at_rest(self) -> bool:
        """Whether springs keep its grips at a stop while a hand holds it."""
        return True

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
        area = -self.volume / (2 * _FIRST)
        room = 1e-6 - area * 2 * _SECOND  # 1 ml of air stays, pressed or not; ours
        return (Drawing(self.drawn, self.name, joints, area, room, self.draws_at, 4e-4, 2e-5),)

    def _forms(self) -> list[Form]:
        return [
            Turned(((0.0008, 0.0), (0.0045, 0.070), (0.0, 0.071)), "natural"),
            Rod((0, 0, 0.066), (0, 0, 0.120), 0.012, "light_grey"),
            Rod((0, 0, 0.120), (0, 0, 0.230), 0.024, "white"),
            Block((-0.010, 0.010), (-0.020, 0.020), (_HOOK, 0.200), "petrol"),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        half = self.size[1] / 2
        body.add_site(name=self.draws_at, quat=towards((0.0, 0.0, -1.0)), group=COLLISION_GROUP)
        body.add_site(name=f"{self.name}_grasp", pos=(0, 0, _GRIP), group=COLLISION_GROUP)
        for grip, side in zip(self.grips, (1, -1), strict=True):
            part = grip.add_to(spec, body, (0.0, side * half, _GRIP), (0.0, -side, 0.0))
            inner, outer = (-0.004, 0.0) if side > 0 else (0.0, 0.004)
            form = Block((-0.010, 0.010), (inner, outer), (-0.020, 0.020), "petrol", 0.001)
            assemble(spec, part, self.name, [form], mass=0.006)
            joint = part.joints[0]
            joint.stiffness, joint.springref = [_SPRING, 0.0, 0.0], -_PRELOAD / _SPRING
            joint.solimp_limit = _STOP
            joint.armature, joint.damping = _FELT, [_GREASE, 0.0, 0.0]
            stop = spec.add_tendon(name=f"{grip.name}_stop", stiffness=[_BLOWING, 0.0, 0.0])
            stop.springlength = (-0.01, _FIRST)
            stop.wrap_joint(grip.joint, 1.0)
