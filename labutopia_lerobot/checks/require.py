"""The failure of a check."""


class CheckFailed(AssertionError):  # noqa: N818  (it is the outcome of a check, not a mistake)
    """A claim of a check does not hold; the message says what is the case."""


def require(holds: object, message: str) -> None:
    """Make sure that something holds.

    Raises:
        CheckFailed: If it does not.
    """
    if not holds:
        raise CheckFailed(message)
