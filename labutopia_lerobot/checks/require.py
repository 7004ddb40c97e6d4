"""How a check fails."""


class CheckFailed(AssertionError):  # noqa: N818  (it is the outcome of a check, not a mistake)
    """What a check claims is not so; the message says what is."""


def require(holds: object, message: str) -> None:
    """Make sure that something holds.

    Raises:
        CheckFailed: If it does not.
    """
    if not holds:
        raise CheckFailed(message)
