"""Findings of a check: something is wrong, or something could not be checked."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Fault:
    """Something is wrong with the dataset.

    Attributes:
        text: Where and what.
    """

    text: str


@dataclass(frozen=True)
class Unchecked:
    """A check that could not be made.

    Attributes:
        text: Which, and why.
    """

    text: str


type Finding = Fault | Unchecked
