"""One instrument alone, at work: hands set its knobs and press its buttons, time passes."""

import mujoco
import numpy as np

from labutopia_lerobot.labware.instrument_catalogue import instrument
from labutopia_lerobot.labware.parts.instrument import Equipment
from labutopia_lerobot.processes import Apparatus, slots_of
from labutopia_lerobot.world import CONTROL_HZ, Reading
from labutopia_lerobot.world.model import PHYSICS_HZ, SOLIMP, SOLREF


class Bench:
    """An instrument on the floor, its processes stepped as a simulation steps them."""

    def __init__(self, of: str | Equipment) -> None:
        self.piece = instrument(of) if isinstance(of, str) else of
        spec = mujoco.MjSpec()
        spec.compiler.degree = False
        spec.default.geom.solref[:], spec.default.geom.solimp[:] = SOLREF, SOLIMP
        spec.option.timestep = 1.0 / PHYSICS_HZ
        spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
        spec.option.impratio = 30.0
        spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        self.piece.add_to(spec, spec.worldbody)
        processes = self.piece.processes
        spec.nuserdata = slots_of(processes)
        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)
        mujoco.mj_forward(self.model, self.data)
        self.apparatus = Apparatus(self.model, self.data, processes, self.data.userdata)
        self.apparatus.start(np.random.default_rng(0))

    def wait(self, seconds: float) -> None:
        for _ in range(round(CONTROL_HZ * seconds)):
            mujoco.mj_step(self.model, self.data, PHYSICS_HZ // CONTROL_HZ)
            mujoco.mj_step1(self.model, self.data)
            self.apparatus.step()

    def put(self, part, share: float) -> None:
        """Put what moves to a share of its way."""
        self.data.joint(part.joint).qpos[0] = share * part.widest
        self.data.joint(part.joint).qvel[0] = 0.0

    def press(self, button) -> None:
        """Press a button and let it go, within 0.4 s."""
        slide = self.data.joint(button.joint)
        for push in (5.0, 0.0):
            slide.qfrc_applied[:] = push
            self.wait(0.2)

    def read(self, name: str) -> Reading:
        return self.apparatus.reading(name)

    def text(self, name: str) -> str:
        """Return what a display writes of a reading."""
        return self.apparatus.processes[name].text(self.apparatus)
