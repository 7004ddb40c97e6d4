"""What a process may be, and what is said of one that cannot."""

import math
from dataclasses import dataclass

import mujoco
import numpy as np
import pytest

from labutopia_lerobot.processes import Apparatus, Process, ProcessError, UnknownReadingError
from labutopia_lerobot.world import Reading
from labutopia_lerobot.world.reading import ReadingError


@dataclass(frozen=True)
class Counter(Process):
    name: str

    @property
    def slots(self):
        return ("count",)

    def step(self, apparatus):
        apparatus.memory(self)[0] += 1

    def reading(self, apparatus):
        return Reading(float(apparatus.memory(self)[0]), "steps")


@dataclass(frozen=True)
class Forgetful(Process):
    name: str

    def step(self, apparatus):
        apparatus.memory(self)[0] += 1


def apparatus_of(*processes: Process) -> Apparatus:
    model = mujoco.MjSpec().compile()
    return Apparatus(model, mujoco.MjData(model), processes)


def test_what_it_remembers_is_in_the_numbers_that_it_was_given():
    model = mujoco.MjSpec().compile()
    numbers = np.zeros(2)
    apparatus = Apparatus(model, mujoco.MjData(model), (Counter("a"), Counter("b")), numbers)
    apparatus.step()
    numbers[1] = 7.0
    apparatus.step()
    assert numbers.tolist() == [2.0, 8.0]
    assert apparatus.reading("b") == Reading(8.0, "steps")


def test_two_of_one_name_are_refused():
    with pytest.raises(ProcessError, match=r"called a: begin the name of each with that of its"):
        apparatus_of(Counter("a"), Forgetful("a"))


def test_one_that_remembers_without_slots_is_asked_to_name_them():
    with pytest.raises(ProcessError, match=r"'a' \(Forgetful\) remembers nothing.*`slots`"):
        apparatus_of(Forgetful("a")).step()


def test_a_reading_that_nothing_gives_is_named_with_those_that_there_are():
    apparatus = apparatus_of(Counter("mass"), Forgetful("b"))
    with pytest.raises(UnknownReadingError, match=r"'mas'.*mean 'mass'.*Readings: mass$"):
        apparatus.reading("mas")
    with pytest.raises(UnknownReadingError, match=r"'b'"):
        apparatus.reading("b")


@pytest.mark.parametrize(("unit", "resolution"), [("", 1.0), ("g", 0.0), ("g", math.nan)])
def test_a_reading_needs_a_unit_and_a_resolution(unit, resolution):
    with pytest.raises(ReadingError, match="needs a unit"):
        Reading(1.0, unit, resolution)


@pytest.mark.parametrize(
    ("reading", "text"),
    [
        (Reading(12.3456, "g", 0.01), "12.35 g"),
        (Reading(-0.001, "g", 0.01), "0.00 g"),
        (Reading(1234.0, "rpm", 50.0), "1250 rpm"),
        (Reading(math.nan, "pH", 0.01), "--.-- pH"),
        (Reading(math.nan, "%RH"), "-- %RH"),
        (Reading(math.inf, "g", 0.01), "Err"),
    ],
)
def test_a_reading_is_written_as_finely_as_it_is_shown(reading, text):
    assert reading.text == text
