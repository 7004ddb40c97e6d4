"""Reading a JSON file that must hold an object."""

import json
from pathlib import Path
from typing import Any

from labutopia_lerobot.errors import UserError


def read_json_object(file: Path, refusal: type[UserError]) -> dict[str, Any]:
    """Return what a JSON file holds.

    Args:
        file: The file.
        refusal: What is raised otherwise.

    Raises:
        UserError: Of the kind `refusal`, if it cannot be read or holds something else.
    """
    try:
        content = json.loads(file.read_text())
    except (OSError, ValueError, RecursionError) as error:
        raise refusal(f"{file} cannot be read: {error}") from None
    if not isinstance(content, dict):
        raise refusal(f"{file} is no JSON object")
    return content
