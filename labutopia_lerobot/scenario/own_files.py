"""Files of the user's own that settings name: a room, and a language model's answers.

Rows and datasets call them by their content, `NAME@HASH`, so that no path is in them. A process
knows such a name once it has read the file.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from labutopia_lerobot.chemistry.kept_answers import load_answers, reasoner_label
from labutopia_lerobot.scenes import load_room, room_label


@dataclass(frozen=True)
class OwnFiles:
    """The files that a dataset was recorded with.

    Attributes:
        room: That of its room, if it is of somebody's own.
        reasoner: That of a language model's answers, if they decided what reacts.
    """

    room: str | None = None
    reasoner: str | None = None

    def read(self) -> None:
        """Let this process know them by their content.

        Raises:
            UserError: If one cannot be read, is no room to work in, or holds no answers.
        """
        if self.room is not None:
            load_room(self.room)
        if self.reasoner is not None:
            load_answers(self.reasoner)


NO_FILES = OwnFiles()


def without_paths(options: Mapping[str, Any]) -> dict[str, Any]:
    """Return the options of a setting with files called by their content.

    Raises:
        UserError: If a file cannot be read, is no room, or holds no answers.
    """
    labels = {
        "room": room_label(options["room"]),
        "reasoner": reasoner_label(options["reasoner"]),
    }
    return {**options, **labels}
