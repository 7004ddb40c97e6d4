"""Which pieces of a long table `make test` takes: `make test-slow` takes the others too."""

from collections.abc import Hashable, Sequence
from itertools import groupby
from typing import Any

import pytest


def smallest_and_largest(pairs: Sequence[tuple[Any, Hashable]]) -> list[Any]:
    """Return kinds and sizes as parameters; of a kind all but its first and last size are slow.

    Args:
        pairs: Kind and size, those of a kind together and by size.
    """
    found = []
    for _, several in groupby(pairs, key=lambda pair: pair[0]):
        of_kind = list(several)
        for pair in of_kind:
            marks = [] if pair in (of_kind[0], of_kind[-1]) else [pytest.mark.slow]
            name = "-".join(str(part) for part in pair).replace(" ", "")
            found.append(pytest.param(*pair, marks=marks, id=name))
    return found
