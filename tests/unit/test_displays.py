"""Displays show what there is to read, and pictures show the displays."""

import mujoco
import numpy as np
import pytest

from labutopia_lerobot.labware.instrument_catalogue import instrument
from labutopia_lerobot.labware.parts.dials import Clock
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.processes import Apparatus
from labutopia_lerobot.sim.classic_renderer import ClassicRenderer


def at_rest(kind: str) -> tuple[Apparatus, Display]:
    """Return an instrument that has come to rest, and its first display."""
    piece = instrument(kind)
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    piece.add_to(spec, spec.worldbody)
    camera = np.array([0.0, -1.0, 0.0, 0.5, 0.0, 0.866])  # from the front, above
    spec.worldbody.add_camera(name="front", pos=(-0.35, 0.0, 0.35), xyaxes=camera)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    apparatus = Apparatus(model, data, piece.processes)
    apparatus.start(np.random.default_rng(0))
    return apparatus, piece.displays[0]


@pytest.mark.parametrize(
    ("kind", "part", "shut", "moved"),
    [
        ("refrigerator", "upper", "4.0 \u00b0C", "DOOR OPEN"),
        ("ultra_low_freezer", "lid", "-80.0 \u00b0C", "LID OPEN"),
        ("gas_chromatograph", "door", "20.0 \u00b0C", "OVEN OPEN"),
        ("ph_meter", "electrode", "--.-- pH", "--.-- pH"),
        ("liquid_chromatograph", "purge", "--.-- ml/min", "PURGE"),
        ("desiccator_cabinet", "door", "30 %RH", "DOOR OPEN"),
        ("glove_box", "lock", "--.- ppm O2", "LOCK OPEN"),
    ],
)
def test_a_display_shows_a_number_or_dashes_or_what_is_open(kind, part, shut, moved):
    apparatus, display = at_rest(kind)
    assert display.of.text(apparatus) == shut
    mechanism = getattr(instrument(kind), part)
    apparatus.data.joint(mechanism.joint).qpos[0] = mechanism.widest
    assert display.of.text(apparatus) == moved


def run(apparatus: Apparatus, seconds: float) -> None:
    """Let every process of an instrument go on, while its parts stay where they are."""
    for _ in range(round(seconds / apparatus.period)):
        apparatus.step()


def test_a_display_of_a_speed_shows_what_turns_not_what_the_knob_is_set_to():
    apparatus, _ = at_rest("stirring_hot_plate")
    display = instrument("stirring_hot_plate").displays[1]
    apparatus.data.joint("stirring_hot_plate_speed_hinge").qpos[0] = np.radians(300.0)
    assert display.of.text(apparatus) == "0 rpm"
    run(apparatus, 1.0)
    assert display.of.text(apparatus) == "set 1500 rpm"
    run(apparatus, 2.0)
    assert display.of.text(apparatus) == "750 rpm"
    run(apparatus, 5.0)
    assert display.of.text(apparatus) == "1500 rpm"


def test_a_display_of_temperature_shows_what_the_thermometer_has_not_what_the_knob_is_set_to():
    apparatus, display = at_rest("stirring_hot_plate")
    apparatus.data.joint("stirring_hot_plate_heat_hinge").qpos[0] = np.radians(300.0)
    assert display.of.text(apparatus) == "20 \u00b0C"


def test_a_clock_counts_up_or_down():
    model = mujoco.MjSpec().compile()
    data = mujoco.MjData(model)
    data.time = 61.5
    apparatus = Apparatus(model, data, ())
    assert Clock("clock").text(apparatus) == "01:01"
    assert Clock("clock", 90.0).text(apparatus) == "00:29"
    assert Clock("clock", 60.0).text(apparatus) == "00:00"


def test_a_text_too_long_for_its_display_is_written_smaller():
    display = Display("display", (0.06, 0.02), Clock("clock"))
    short, long = (display.picture(text) for text in ("1 g", "1000.0000 rpm"))
    assert short.shape == long.shape == (48, 144, 3)
    assert (short != display.picture("")).any(axis=(0, 2)).sum() < 60
    assert not (long != display.picture(""))[:, :3].any()


def test_pictures_show_the_reading_of_now():
    apparatus, _ = at_rest("stirring_hot_plate")
    data = apparatus.data
    renderer = ClassicRenderer(apparatus.model, 200, 200, apparatus=apparatus)
    cold = renderer.color(data, "front").copy()
    assert np.array_equal(cold, renderer.color(data, "front"))
    speed = apparatus.data.joint("stirring_hot_plate_speed_hinge")
    speed.qpos[0] = np.radians(300.0)  # without forward kinematics nothing else has moved
    run(apparatus, 1.0)
    assert not np.array_equal(cold, renderer.color(data, "front"))
    speed.qpos[0] = 0.0
    run(apparatus, 3.0)
    back = renderer.color(data, "front")
    renderer.close()
    assert np.abs(back.astype(int) - cold).max() <= 1
