"""Skills: what scripted experts can do, one class per action."""

from labutopia_lerobot.skills.aspirate import Aspirate
from labutopia_lerobot.skills.back_off import BackOff
from labutopia_lerobot.skills.carry import Carry
from labutopia_lerobot.skills.close import Close
from labutopia_lerobot.skills.dilute import Dilute
from labutopia_lerobot.skills.dispense import Dispense
from labutopia_lerobot.skills.drive_to import DriveTo
from labutopia_lerobot.skills.face import Face
from labutopia_lerobot.skills.go import Go
from labutopia_lerobot.skills.insert import Insert
from labutopia_lerobot.skills.open import Open
from labutopia_lerobot.skills.pick import Pick
from labutopia_lerobot.skills.place import Place
from labutopia_lerobot.skills.pour import Pour
from labutopia_lerobot.skills.pour_measured import PourMeasured
from labutopia_lerobot.skills.press import Press
from labutopia_lerobot.skills.press_into import PressInto
from labutopia_lerobot.skills.push_lid import PushLid
from labutopia_lerobot.skills.run_out import RunOut
from labutopia_lerobot.skills.shake import Shake
from labutopia_lerobot.skills.squeeze import Squeeze
from labutopia_lerobot.skills.stir import Stir
from labutopia_lerobot.skills.take_pipette import TakePipette
from labutopia_lerobot.skills.titrate import Titrate
from labutopia_lerobot.skills.try_each import TryEach
from labutopia_lerobot.skills.turn_knob import TurnKnob
from labutopia_lerobot.skills.wait import WaitUntil, WaitUntilDue, WaitUntilReads

__all__ = [
    "Aspirate",
    "BackOff",
    "Carry",
    "Close",
    "Dilute",
    "Dispense",
    "DriveTo",
    "Face",
    "Go",
    "Insert",
    "Open",
    "Pick",
    "Place",
    "Pour",
    "PourMeasured",
    "Press",
    "PressInto",
    "PushLid",
    "RunOut",
    "Shake",
    "Squeeze",
    "Stir",
    "TakePipette",
    "Titrate",
    "TryEach",
    "TurnKnob",
    "WaitUntil",
    "WaitUntilDue",
    "WaitUntilReads",
]
