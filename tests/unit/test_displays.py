"""Displays show what there is to read, and pictures show the displays."""

import mujoco
import numpy as np
import pytest

from labutopia_lerobot.labware.catalogue import instrument
from labutopia_lerobot.labware.glass.catalogue import ware
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.reading import Clock
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import DOOR_VIEW
from labutopia_lerobot.sim.classic_renderer import ClassicRenderer
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation


def beside_a_weight(kind: str, grams: float) -> tuple[mujoco.MjModel, mujoco.MjData, Display]:
    """Return an instrument with a weight on its first place, come to rest, and its display."""
    piece = instrument(kind)
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    piece.add_to(spec, spec.worldbody)
    bare = spec.compile()
    data = mujoco.MjData(bare)
    mujoco.mj_forward(bare, data)
    if grams:
        weight = spec.worldbody.add_body(name="weight", pos=data.site(piece.places[0].name).xpos)
        weight.add_freejoint()
        weight.add_geom(
            type=mujoco.mjtGeom.mjGEOM_CYLINDER,
            size=(0.02, 0.02, 0.0),
            pos=(0.0, 0.0, 0.021),
            mass=grams / 1e3,
        )
    camera = np.array([0.0, -1.0, 0.0, 0.5, 0.0, 0.866])  # from the front, above
    spec.worldbody.add_camera(name="front", pos=(-0.35, 0.0, 0.35), xyaxes=camera)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 1500)
    return model, data, piece.displays[0]


@pytest.mark.parametrize(
    ("kind", "grams", "digits"),
    [("analytical_balance", 100.0, 4), ("precision_balance", 1234.56, 2)],
)
def test_a_balance_shows_the_mass_on_its_pan(kind, grams, digits):
    model, data, display = beside_a_weight(kind, grams)
    number, unit = display.reading.text(model, data).split()
    assert (len(number.partition(".")[2]), unit) == (digits, "g")
    assert float(number) == pytest.approx(grams, rel=3e-4)  # what the contact solver leaves


@pytest.mark.parametrize(
    ("kind", "part", "shut", "moved"),
    [
        ("refrigerator", "upper", "+4.0 \u00b0C", "DOOR OPEN"),
        ("ultra_low_freezer", "lid", "-80.0 \u00b0C", "LID OPEN"),
        ("gas_chromatograph", "door", "50.0 \u00b0C", "OVEN OPEN"),
        ("ph_meter", "electrode", "pH -.--", "pH 7.00"),
        ("liquid_chromatograph", "purge", "1.00 ml/min", "PURGE"),
        ("desiccator_cabinet", "door", "32 %RH", "DOOR OPEN"),
        ("glove_box", "lock", "O2 0.4 ppm", "LOCK OPEN"),
        ("laminar_flow_bench", "fan", "0.00 m/s", "0.45 m/s"),
    ],
)
def test_a_display_says_what_was_opened_or_switched_on(kind, part, shut, moved):
    model, data, display = beside_a_weight(kind, 0.0)
    assert display.reading.text(model, data) == shut
    mechanism = getattr(instrument(kind), part)
    data.joint(mechanism.joint).qpos[0] = mechanism.widest
    assert display.reading.text(model, data) == moved


def test_an_empty_pan_weighs_nothing_and_too_much_is_an_error():
    for grams, text in ((0.0, "0.0000 g"), (300.0, "Err")):
        model, data, display = beside_a_weight("analytical_balance", grams)
        assert display.reading.text(model, data) == text


def test_a_display_shows_what_a_knob_is_set_to():
    model, data, display = beside_a_weight("stirring_hot_plate", 0.0)
    assert display.reading.text(model, data) == "20 \u00b0C"
    data.joint("stirring_hot_plate_heat_hinge").qpos[0] = np.radians(300.0)
    assert display.reading.text(model, data) == "320 \u00b0C"


def test_a_clock_counts_up_or_down():
    model = mujoco.MjSpec().compile()
    data = mujoco.MjData(model)
    data.time = 61.5
    assert Clock().text(model, data) == "01:01"
    assert Clock(90.0).text(model, data) == "00:29"
    assert Clock(60.0).text(model, data) == "00:00"


def test_a_text_too_long_for_its_display_is_written_smaller():
    display = Display("display", (0.06, 0.02), Clock())
    short, long = (display.picture(text) for text in ("1 g", "1000.0000 rpm"))
    assert short.shape == long.shape == (48, 144, 3)
    assert (short != display.picture("")).any(axis=(0, 2)).sum() < 60
    assert not (long != display.picture(""))[:, :3].any()


def test_pictures_show_the_reading_of_now():
    model, data, display = beside_a_weight("stirring_hot_plate", 0.0)
    renderer = ClassicRenderer(model, 200, 200, displays=[display])
    cold = renderer.color(data, "front").copy()
    assert np.array_equal(cold, renderer.color(data, "front"))
    heat = data.joint("stirring_hot_plate_heat_hinge")
    heat.qpos[0] = np.radians(300.0)  # without forward kinematics nothing else has moved
    assert not np.array_equal(cold, renderer.color(data, "front"))
    heat.qpos[0] = 0.0
    back = renderer.color(data, "front")
    renderer.close()
    assert np.abs(back.astype(int) - cold).max() <= 1


def test_a_tare_button_sets_the_display_to_zero_with_what_is_on_the_pan():
    balance, boat = instrument("precision_balance"), ware("weighing_boat", "85 x 85 x 24 mm")
    simulation = Simulation(compile_scene([balance, boat], PANDA, LABORATORY, DOOR_VIEW))
    data, (display,) = simulation.data, balance.displays
    model = simulation.scene.model
    seat = Placement(0.06, 0.0, 0.0, height=0.0955)
    simulation.reset({balance: Placement(0.0, 0.0, 0.0), boat: seat})

    def shown() -> float:
        return float(display.reading.text(model, data).split()[0])

    def press(force: float) -> None:
        for _ in range(15):
            data.joint(balance.tare.joint).qfrc_applied[:] = force
            simulation.step(simulation.command)

    press(0.0)
    assert shown() == pytest.approx(1e3 * boat.mass, abs=0.05)
    press(5.0)
    press(0.0)
    assert abs(shown()) < 0.05
    kept = simulation.state()
    data.joint("weighing_boat_free").qpos[2] += 0.5
    simulation.step(simulation.command)
    assert shown() == pytest.approx(-1e3 * boat.mass, abs=0.05)
    simulation.restore(kept)
    simulation.step(simulation.command)
    assert abs(shown()) < 0.05
