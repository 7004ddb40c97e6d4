"""What an environment lets its user choose, and the error for anything else."""

from collections.abc import Collection, Iterable

from labutopia_lerobot.errors import UserError

SPLITS = ("train", "id")
"""Same distribution, different seeds: demonstrations come from `train`, scores from `id`."""

LIQUID = ("on", "off")
"""Whether what the task's vessels hold is simulated."""


class UnknownOptionError(UserError, ValueError):
    """An argument of the environment that is not one of its choices; the message lists them."""


def require_choices(name: str, values: Iterable[object], choices: Collection[object]) -> None:
    """Make sure that every value of the option `name` is one of the choices.

    Raises:
        UnknownOptionError: If one is not; the message lists the choices.
    """
    for value in values:
        if value not in choices:
            listed = ", ".join(str(choice) for choice in choices)
            raise UnknownOptionError(f"{name}={value!r} is unknown. Choose from: {listed}")
