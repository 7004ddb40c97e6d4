"""Heat alone: what tests of temperatures share. Nothing moves, only the processes step."""

from labutopia_lerobot.layout import Placement
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import DOOR_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation


def warm_up(simulation: Simulation, seconds: float) -> None:
    """Let the processes work alone: nothing moves, and only heat flows."""
    for _ in range(round(30 * seconds)):
        simulation.apparatus.step()


def celsius(simulation: Simulation, name: str) -> float:
    return simulation.apparatus.reading(name).value


def alone(piece) -> Simulation:
    """Return an instrument alone on the bench, come to rest."""
    simulation = Simulation(compile_scene([piece], PANDA, LABORATORY, DOOR_VIEW))
    simulation.reset({piece: Placement(1.0, 0.0, 0.0)})
    return simulation


def turn(simulation: Simulation, joint: str, position: float) -> None:
    simulation.data.joint(joint).qpos[:] = position
