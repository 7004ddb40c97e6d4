"""What must hold for every closure on every kind of vessel that comes with one."""

import math

import mujoco
import numpy as np
import pytest

from extremes import smallest_and_largest
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.labware.glass.catalogue import catalogue, closed, vessels, ware
from labutopia_lerobot.labware.glass.closure import Closure, Screw
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.liquids.liquid import Liquid
from labutopia_lerobot.substances.filling import Filling
from vessels_on_a_bench import bench

CLOSED = [(kind, size) for kind, one in vessels().items() if one.closure for size in one.sizes]
KINDS = [
    (kind, list(one.sizes)[len(one.sizes) // 2]) for kind, one in vessels().items() if one.closure
]
_BY_CLOSURE = {vessels()[kind].closure: kind for kind, _ in KINDS}
every = pytest.mark.parametrize(("kind", "size"), smallest_and_largest(CLOSED))
every_kind = pytest.mark.parametrize(  # of the vessels of a closure `make test` takes one
    ("kind", "size"),
    [
        pytest.param(
            kind,
            size,
            marks=[] if kind in _BY_CLOSURE.values() else [pytest.mark.slow],
            id=kind,
        )
        for kind, size in KINDS
    ],
)


_LETS_GO = 0.005
"""How far a closure has moved when it has let go [m]: askew it may still catch on the rim."""
_UPRIGHT = 1.0
"""How stiffly a hand keeps a cap from tilting [N m/rad]: softer than a wrist is."""


class Held:
    """A vessel that a hand holds, and its closure on it, free."""

    def __init__(self, vessel: Vessel, closure: Closure, *, above: float = 0.0, yaw: float = 0.3):
        spec = bench(vessel, free=False)
        spec.compiler.degree = False
        spec.delete(spec.geom("bench"))
        at = (0.0, 0.0, closure.seat(vessel) + above)
        turn = 0.0 if isinstance(closure.hold, Screw) else yaw
        body = closure.add_to(spec, spec.worldbody)
        body.pos, body.quat = at, (math.cos(turn / 2), 0, 0, math.sin(turn / 2))
        body.add_freejoint(name=closure.name)
        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)
        self._seat, self._closure = closure.seat(vessel), closure.name
        mujoco.mj_forward(self.model, self.data)
        self._taken = self.data.site(f"{closure.name}_grasp").xpos.copy()

    @property
    def rise(self) -> float:
        """How far the closure is above its seat [m]."""
        return float(self.data.body(self._closure).xpos[2]) - self._seat

    @property
    def away(self) -> float:
        """How far it is from its seat [m]."""
        at = self.data.body(self._closure).xpos
        return float(np.linalg.norm(at - (0.0, 0.0, self._seat)))

    @property
    def let_go(self) -> bool:
        """Whether where it is taken has moved away, straight up or askew."""
        moved = self.data.site(f"{self._closure}_grasp").xpos - self._taken
        return float(np.linalg.norm(moved)) > _LETS_GO

    def tip(self, degrees: float, seconds: float) -> None:
        """Lean everything, as seen from the vessel, and wait."""
        for step in range(round(300 * seconds)):
            angle = math.radians(min(1.0, step / 150) * degrees)
            self.model.opt.gravity[:] = 9.81 * math.sin(angle), 0.0, -9.81 * math.cos(angle)
            mujoco.mj_step(self.model, self.data)

    def pull(self, force: float, seconds: float) -> None:
        """Pull upwards, harder and harder up to a force [N]."""
        body, steps = self.model.body(self._closure).id, round(300 * seconds)
        for step in range(steps):
            self.data.xfrc_applied[body, 2] = force * min(1.0, 1.5 * step / steps)
            if force <= 0.0 or not self.let_go:
                mujoco.mj_step(self.model, self.data)
        self.data.xfrc_applied[body] = 0.0

    def turn(self, torque: float, force: float, seconds: float) -> list[tuple[float, float]]:
        """Turn counterclockwise with a torque [N m] up to 2 rad/s, and pull upwards [N].

        Fingers around a cap keep it from tilting: let go on one side, it would catch askew.

        Returns:
            Angle [rad] and rise [m] after every step.
        """
        body, angle, passed = self.model.body(self._closure).id, 0.0, []
        joint = self.data.joint(self._closure)
        turning = int(self.model.joint(self._closure).dofadr[0]) + 3
        self.model.dof_armature[turning : turning + 3] = 5e-3  # of the hand: a cap would whirl
        for _ in range(round(300 * seconds)):
            missing = 2.0 - math.copysign(1.0, torque) * float(joint.qvel[5])
            push = min(max(0.5 * missing, 0.0), abs(torque))
            self.data.xfrc_applied[body, 5] = math.copysign(push, torque)
            self.data.xfrc_applied[body, 2] = force
            tilt = np.cross(self.data.xmat[body].reshape(3, 3)[:, 2], (0.0, 0.0, 1.0))
            self.data.xfrc_applied[body, 3:5] = _UPRIGHT * tilt[:2]
            if self.away < 0.05:
                mujoco.mj_step(self.model, self.data)
            angle += float(joint.qvel[5]) / 300
            passed.append((angle, self.rise))
        self.data.xfrc_applied[body] = 0.0
        return passed


@every
def test_it_comes_with_a_size_that_fits(kind, size):
    vessel, closure = closed(kind, size, "thing")
    seat = closure.seat(vessel)
    assert seat < vessel.height < seat + closure.height
    assert closure.name == "thing_closure"


@every_kind
def test_it_stays_on_while_the_vessel_stands_for_ten_seconds(kind, size):
    vessel, closure = closed(kind, size)
    held = Held(vessel, closure)
    held.tip(0.0, 10.0)
    assert held.away < 1e-3


@every_kind
def test_on_a_vessel_that_is_tipped_only_what_is_tight_holds(kind, size):
    vessel, closure = closed(kind, size)
    held = Held(vessel, closure)
    held.tip(90.0, 4.0)
    if closure.hold.tight:
        assert held.away < 1e-3
    else:  # a rim may still hang on a wall that lies
        held.tip(120.0, 2.0)
        assert held.away > 0.02


@every_kind
def test_it_comes_off_under_the_pull_or_turn_that_its_table_says(kind, size):
    vessel, closure = closed(kind, size)
    least, most = catalogue()[vessels()[kind].closure].pull
    weight = 9.81 * closure.mass
    if isinstance(closure.hold, Screw):
        assert turned_off(vessel, closure, least) is False
        assert turned_off(vessel, closure, most) is True
    elif closure.hold.tight:
        assert pulled_off(vessel, closure, weight + least) is False
        assert pulled_off(vessel, closure, weight + most) is True
    else:
        assert pulled_off(vessel, closure, 1.2 * weight) is True


def pulled_off(vessel: Vessel, closure: Closure, force: float) -> bool:
    held = Held(vessel, closure)
    held.pull(force, 1.5)
    return held.let_go


def turned_off(vessel: Vessel, closure: Closure, torque: float) -> bool:
    """Turn a cap with a torque, and lift it with a little more than its weight."""
    held = Held(vessel, closure)
    held.turn(torque, 1.2 * 9.81 * closure.mass, 6.0)
    return held.away > 0.02


def test_a_screw_cap_rises_by_its_pitch_in_a_turn_and_cannot_be_pulled_off():
    vessel, cap = closed("reagent_bottle", "250 ml")
    held = Held(vessel, cap)
    held.pull(20.0, 1.0)
    assert held.away < 1e-3
    held = Held(vessel, cap)
    passed = held.turn(0.1, 1.2 * 9.81 * cap.mass, 2.5)
    (start, low), (stop, high) = passed[240], passed[-1]
    assert vessel.thread is not None
    rise = (high - low) / (stop - start) * 2 * math.pi
    assert rise == pytest.approx(vessel.thread.pitch, rel=0.15)


@pytest.mark.parametrize(("kind", "size"), [one for one in CLOSED if closed(*one)[0].thread])
def test_a_screw_cap_is_off_at_the_end_of_its_thread_and_not_before(kind, size):
    vessel, cap = closed(kind, size)
    assert vessel.thread is not None
    passed = Held(vessel, cap).turn(0.2, 1.2 * 9.81 * cap.mass, 6.0)
    turns = next(angle for angle, rise in passed if rise > 0.02) / (2 * math.pi)
    assert turns == pytest.approx(vessel.thread.turns, abs=0.15)


@every_kind
def test_it_can_be_put_back(kind, size):
    vessel, closure = closed(kind, size)
    if isinstance(closure.hold, Screw):
        held = Held(vessel, closure)
        held.turn(0.2, 0.0, 2.0)
        assert held.rise > 0.3 * closure.hold.thread.pitch
        held.turn(-0.2, 0.0, 3.0)
    else:
        held = Held(vessel, closure, above=0.01)
        held.pull(-5.0 if closure.hold.tight else 0.0, 1.5)
    assert abs(held.rise) < 0.003
    if closure.hold.tight:
        rise = held.rise
        held.tip(90.0, 3.0)
        assert abs(held.rise - rise) < 0.001


@pytest.mark.parametrize(
    ("kind", "size"),
    [
        ("erlenmeyer_narrow", "250 ml"),
        pytest.param("reagent_bottle", "250 ml", marks=pytest.mark.slow),
    ],
)
def test_what_is_tightly_closed_is_turned_over_and_loses_nothing(kind, size):
    """In necks of less than two particles' width liquid still squeezes past a plug."""
    vessel, closure = closed(kind, size)
    spec = bench(vessel)
    spec.compiler.degree = False
    spec.delete(spec.geom("bench"))
    closure.add_to(spec, spec.worldbody).add_freejoint()
    model = spec.compile()
    data = mujoco.MjData(model)

    def lean(angle: float) -> None:
        turn = (math.cos(angle / 2), 0.0, math.sin(angle / 2), 0.0)
        seat = closure.seat(vessel) * np.array([math.sin(angle), 0.0, math.cos(angle)])
        data.qpos[:] = 0.0, 0.0, 0.0, *turn, *seat, *turn
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)

    lean(0.0)
    filling = Filling(0.4 * vessel.capacity)
    liquid = Liquid(model, data, [vessel], [filling], 300)
    liquid.fill({vessel: filling}, np.random.default_rng(0))
    for step in range(3 * liquid.hertz):
        lean(math.radians(min(170.0, 85.0 * step / liquid.hertz)))
        liquid.step()
    assert not liquid.diverged
    assert liquid.take_account().counts[0, 0] == 300


def test_what_does_not_fit_is_reported():
    bung = ware("rubber_bung", "49 mm")
    assert isinstance(bung, Closure)
    with pytest.raises(UserError, match="rubber_bung does not close tube: it needs a mouth of"):
        bung.seat(ware("test_tube", "16 x 160 mm", "tube"))
    with pytest.raises(UserError, match="beaker_low comes without a closure; kinds that"):
        closed("beaker_low", "250 ml")
