"""Meters of conductivity, temperature, absorbance, refraction and pH against handbooks."""

import math

import numpy as np
import pytest

from labutopia_lerobot.chemistry.conductivity import conductivity
from labutopia_lerobot.chemistry.inventory import Inventory, Solute
from labutopia_lerobot.chemistry.refraction import refractive_index
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.measuring.conductivity_meter import ConductivityMeter
from labutopia_lerobot.labware.instruments.measuring.digital_thermometer import DigitalThermometer
from labutopia_lerobot.labware.instruments.measuring.ph_paper import PhPaper
from labutopia_lerobot.labware.instruments.measuring.refractometer import Refractometer
from labutopia_lerobot.labware.instruments.measuring.spectrophotometer import Spectrophotometer
from labutopia_lerobot.labware.parts.indicator_paper import DRY, SCALE
from labutopia_lerobot.labware.piece import Piece
from labutopia_lerobot.layout import Inside, OnBench, sample_layout
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import WIDE_VESSEL_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.sim.view import SimulatedWorld
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.world import Reading


def concentrations(of: str, molar: float) -> dict[str, float]:
    """Return what a solution holds, dissolved [mol/m^3]."""
    solutes = (Solute(of, molar),)
    inventory = Inventory.of([solutes])
    held = inventory.amounts(inventory.filled(solutes, 1.0))
    return {key: mol for key, mol in held.items() if key.endswith("(aq)")}


def bench(meter: Piece, vessel: Piece, at: Inside, ml: float, *solutes: Solute) -> Simulation:
    """Return a vessel with a solution at an instrument."""
    filling = Filling(ml, dissolved=solutes)
    pieces = [meter, vessel]
    scene = compile_scene(pieces, PANDA, LABORATORY, WIDE_VESSEL_VIEW, {vessel: filling}, 200)
    simulation, rng = Simulation(scene), np.random.default_rng(0)
    there = OnBench((0.3, 0.3), (0.1, 0.1), (0.0, 0.0))
    simulation.reset(sample_layout({meter: there, vessel: at}, rng), rng=rng)
    simulation.fill(rng)
    return simulation


def read(simulation: Simulation, name: str, seconds: float = 0.5) -> Reading:
    """Return a reading some time later."""
    for _ in range(round(30 * seconds)):
        simulation.step(simulation.command)
    return SimulatedWorld(simulation).reading(name)


def turn(simulation: Simulation, joint: str, to: float) -> None:
    simulation.data.joint(joint).qpos[0] = to


@pytest.mark.parametrize(
    ("of", "molar", "printed"),
    [
        ("potassium chloride", 0.01, 1.413),
        ("potassium chloride", 0.1, 12.88),
        ("sodium chloride", 0.1, 10.67),
        ("hydrochloric acid", 0.1, 39.1),
        ("sodium sulfate", 0.05, 8.99),
        ("acetic acid", 0.1, 0.52),
    ],
)
def test_solutions_conduct_as_printed(of: str, molar: float, printed: float) -> None:
    """CRC Handbook, "Electrical conductivity of aqueous solutions" [mS/cm]."""
    assert 10.0 * conductivity(concentrations(of, molar)) == pytest.approx(printed, rel=0.03)


def test_an_ion_of_unknown_conductivity_is_said_to_be_unknown() -> None:
    assert math.isnan(conductivity({"Na^+(aq)": 10.0, "C17H35COO^-(aq)": 10.0}))


def test_the_conductivity_meter_reads_a_standard_and_dashes_in_air() -> None:
    beaker = glassware("beaker", "150 ml", "beaker")
    meter, below = ConductivityMeter("meter", lowered=0.110), (0.060, -0.287, 0.0)
    at = Inside(meter, below)
    simulation = bench(meter, beaker, at, 60.0, Solute("potassium chloride", 0.01))
    reading = read(simulation, "meter_conductivity", 1.0)
    assert reading.shown == pytest.approx(1.413, rel=0.02)
    assert reading.settled
    assert reading.text == f"{reading.shown:.3f} mS/cm"
    turn(simulation, "meter_electrode_slide", 0.0)
    assert read(simulation, "meter_conductivity").text == "--.--- mS/cm"


def test_the_thermometer_reads_the_layer_that_its_tip_is_in_and_in_air_the_room() -> None:
    """95 % of a change are there after three time constants of 2 s."""
    beaker = glassware("beaker", "150 ml", "beaker")
    meter, below = DigitalThermometer("meter", lowered=0.110), (0.060, -0.287, 0.0)
    simulation = bench(meter, beaker, Inside(meter, below), 60.0)
    assert read(simulation, "meter_temperature", 4.0).shown == pytest.approx(20.0, abs=0.2)
    liquid, tip = simulation.liquid, simulation.data.site("meter_tip").xpos
    assert liquid is not None
    liquid.temperatures[:] = 333.15
    rising = read(simulation, "meter_temperature", 6.0)
    assert rising.shown == pytest.approx(60.0 - 0.05 * 40.0, abs=1.0)
    far = np.linalg.norm(liquid.positions - tip, axis=1) > 0.025
    liquid.temperatures[far] = 363.15
    handling = simulation.apparatus.liquid
    assert handling is not None
    assert handling.temperature_at(tip) == pytest.approx(333.0, abs=2.0)
    turn(simulation, "meter_electrode_slide", 0.0)
    assert read(simulation, "meter_temperature", 12.0).shown == pytest.approx(20.0, abs=0.5)


def in_beam(of: str, molar: float, nanometres: float) -> Simulation:
    """Return a round cell in the beam, its lid shut; a trace of acid keeps hydroxides away."""
    meter, cell = Spectrophotometer("meter"), glassware("test_tube", "12 x 75 mm", "cell")
    at = Inside(meter, (-0.0115, -0.165, 0.0785))
    simulation = bench(meter, cell, at, 4.0, Solute(of, molar), Solute("sulfuric acid", 1e-3))
    knob = meter.wavelength
    turn(simulation, knob.joint, knob.widest * (nanometres - 325.0) / 675.0)
    return simulation


def test_absorbance_is_proportional_to_concentration() -> None:
    """Of copper(II) at 810 nm 12 l/(mol cm): Cotton and Wilkinson."""
    half, full = (
        read(in_beam("copper(II) sulfate", c, 810.0), "meter_absorbance", 1.5) for c in (0.05, 0.1)
    )
    assert full.value == pytest.approx(12.0 * 0.1, rel=0.05)
    assert half.value == pytest.approx(full.value / 2, abs=0.01)
    assert full.text == f"{full.shown:.3f} A"


@pytest.mark.slow
def test_an_open_lid_and_an_unknown_spectrum_show_dashes() -> None:
    """Of hexacyanidoferrate(III) 1020 l/(mol cm) at 420 nm."""
    simulation = in_beam("potassium hexacyanidoferrate(III)", 1e-3, 420.0)
    assert read(simulation, "meter_absorbance", 3.0).value == pytest.approx(1.02, abs=0.02)
    turn(simulation, "meter_lid_hinge", 1.0)
    assert read(simulation, "meter_absorbance").text == "--.--- A"
    unknown = in_beam("iron(II) sulfate", 0.1, 525.0)
    assert math.isnan(read(unknown, "meter_absorbance").value)


@pytest.mark.parametrize(
    ("of", "molar", "printed"),
    [("sodium chloride", 1.833, 1.3505), ("sucrose", 0.3033, 1.3479), ("glucose", 0.576, 1.3477)],
)
def test_solutions_of_ten_percent_bend_light_as_printed(
    of: str, molar: float, printed: float
) -> None:
    """CRC Handbook, "Concentrative properties of aqueous solutions", 20 C."""
    assert refractive_index(concentrations(of, molar), 293.15) == pytest.approx(printed, abs=2e-4)


def test_water_bends_light_less_when_it_is_warm_and_what_is_not_known_is_not_said() -> None:
    """1.3330 at 20 C, 1.3325 at 25 C (CRC Handbook)."""
    assert refractive_index({}, 293.15) == pytest.approx(1.3330, abs=5e-5)
    assert refractive_index({}, 298.15) == pytest.approx(1.3325, abs=5e-5)
    assert math.isnan(refractive_index(concentrations("copper(II) sulfate", 0.1), 293.15))


def test_a_drop_is_read_once_the_prisms_are_shut_on_it() -> None:
    meter, beaker = Refractometer("meter"), glassware("beaker", "150 ml", "beaker")
    aside = Inside(meter, (0.0, -0.25, 0.0))
    simulation = bench(meter, beaker, aside, 60.0, Solute("sodium chloride", 1.0))
    name, hinge = meter.reads.name, meter.prism.joint
    assert math.isnan(read(simulation, name).value)
    turn(simulation, hinge, 1.5)
    liquid = simulation.liquid
    assert liquid is not None
    stage = simulation.data.site("meter_stage").xpos
    liquid.positions[:3] = stage + np.array([0.0, 0.0, 0.003])
    assert math.isnan(read(simulation, name, 0.1).value)
    turn(simulation, hinge, 0.0)
    assert read(simulation, name).shown == pytest.approx(1.3330 + 0.0096, abs=2e-4)
    turn(simulation, hinge, 1.5)
    assert read(simulation, name, 0.1).text == "--.---- nD"


@pytest.mark.parametrize(
    ("of", "molar", "ph"),
    [
        ("hydrochloric acid", 0.1, 1),
        ("acetic acid", 0.1, 3),
        ("sodium chloride", 0.1, 7),
        ("sodium hydroxide", 0.1, 13),
    ],
)
def test_a_strip_of_ph_paper_keeps_the_colour_of_the_last_drop_on_it(
    of: str, molar: float, ph: int
) -> None:
    paper, beaker = PhPaper("paper"), glassware("beaker", "150 ml", "beaker")
    simulation = bench(paper, beaker, Inside(paper, (0.0, -0.25, 0.0)), 60.0, Solute(of, molar))
    first, second, *rest = (strip.name for strip in paper.strips)
    assert read(simulation, second).text == "-- pH"
    liquid = simulation.liquid
    assert liquid is not None
    over = simulation.data.site(second).xpos + np.array([0.0, 0.0, 0.02])
    liquid.positions[:3], liquid.velocities[:3] = over, 0.0
    liquid.positions[:3, 0] += np.array([-0.004, 0.0, 0.004])
    assert read(simulation, second).shown == ph
    liquid.take(np.flatnonzero(np.linalg.norm(liquid.positions - over, axis=1) < 0.05))
    assert read(simulation, second).shown == ph
    assert all(math.isnan(read(simulation, name, 0.1).value) for name in (first, *rest))
    simulation.apparatus.show()
    seen = {name: simulation.apparatus.model.geom(name).rgba[:3] for name in (first, second)}
    assert tuple(seen[first]) == pytest.approx(DRY)
    nearest = min(SCALE, key=lambda step: float(np.abs(seen[second] - SCALE[step]).sum()))
    assert abs(nearest - ph) <= 1


@pytest.mark.parametrize(
    ("aside", "wet"),
    [((0.023, 0.0), True), ((-0.023, 0.006), True), ((0.0, 0.015), False), ((0.03, 0.0), False)],
)
def test_a_drop_anywhere_on_a_strip_wets_it_and_one_beside_it_does_not(
    aside: tuple[float, float], wet: bool
) -> None:
    paper, beaker = PhPaper("paper"), glassware("beaker", "150 ml", "beaker")
    at = Inside(paper, (0.0, -0.25, 0.0))
    simulation = bench(paper, beaker, at, 60.0, Solute("hydrochloric acid", 0.1))
    strip, liquid = simulation.apparatus.site(paper.strips[1].name), simulation.liquid
    assert liquid is not None
    liquid.positions[0] = strip.position_w + strip.rotation_w @ (*aside, 0.003)
    liquid.velocities[0] = 0.0
    assert (read(simulation, paper.strips[1].name, 0.1).value == 1.0) == wet
