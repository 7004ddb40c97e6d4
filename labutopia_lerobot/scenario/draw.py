"""Drawing an episode: one value per axis, with train and test values that never meet."""

import zlib
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.setting import ALL, UnknownOptionError
from labutopia_lerobot.world import FloatArray

type Value = str | int | float | list[float]
"""Value drawn on an axis, as `info`, result rows and datasets have it."""

type Span = tuple[float, float]


class AxisError(UserError, ValueError):
    """An axis that is declared wrongly; the message names it and says the cure."""


class Draw:
    """Draws the values of one episode; a task function asks it for what varies.

    Every axis has a generator of its own, made from the episode's seeds and the axis's name: a
    further axis, or a further value on one, moves nothing else.

    Args:
        split: `train`, `id` or `ood`.
        axes: Axes that the user wants shifted (`ood`) or varied beside the task's own, or `all`.
        seeds: Seeds of the episode; None for the canonical episode, which takes first values.

    Attributes:
        values: Axis -> what was drawn on it.
    """

    def __init__(
        self, split: str = "id", axes: Sequence[str] = (), seeds: Sequence[int] | None = None
    ) -> None:
        self.values: dict[str, Value] = {}
        self._split, self._axes, self._seeds = split, axes, seeds
        self._testable: dict[str, bool] = {}
        self._asked: dict[str, bool] = {}
        self._shifted = False

    def choice[Choice: (str, int, float)](
        self,
        axis: str,
        *,
        train: Sequence[Choice],
        test: Sequence[Choice] = (),
        shifted: bool = False,
    ) -> Choice:
        """Draw one of some values, all equally likely.

        Args:
            axis: What varies, such as `object`.
            train: Values of the splits `train` and `id`; the first is the canonical one.
            test: Values that `ood` draws where this axis is shifted.
            shifted: Whether `ood` shifts this axis when the user names none.

        Raises:
            AxisError: If train and test values overlap, or the axis was drawn before.
        """
        both = set(train) & set(test)
        if both:
            raise AxisError(
                f"Axis '{axis}' has the values {sorted(both)} in train and in test: part them"
            )
        values = self._values_of(axis, train, test, shifted)
        generator = self._generator(axis)
        chosen = values[0] if generator is None else values[int(generator.integers(len(values)))]
        self.values[axis] = chosen
        return chosen

    def uniform(
        self, axis: str, *, train: Span, test: Sequence[Span] = (), shifted: bool = False
    ) -> float:
        """Draw a number, uniform over a range, or over one of the ranges of test values.

        Args:
            axis: What varies, such as `light`.
            train: Least and greatest value; the middle is the canonical one.
            test: Ranges that `ood` draws from where this axis is shifted; none overlaps `train`.
            shifted: Whether `ood` shifts this axis when the user names none.

        Raises:
            AxisError: If train and test ranges overlap, or the axis was drawn before.
        """
        value = self._number(axis, train, test, shifted)
        self.values[axis] = value
        return value

    def displacement(
        self, axis: str, size: int, *, train: Span, test: Sequence[Span] = (), shifted: bool = False
    ) -> FloatArray:
        """Draw a vector, shape (size,), of any direction; its length is uniform over a range.

        Args:
            axis: What varies, such as `camera`.
            size: Number of elements.
            train: Least and greatest length; the canonical vector is zero.
            test: Ranges of length that `ood` draws from where this axis is shifted.
            shifted: Whether `ood` shifts this axis when the user names none.

        Raises:
            AxisError: If train and test ranges overlap, or the axis was drawn before.
        """
        length = self._number(axis, train, test, shifted)
        generator = self._generator(axis, "direction")
        vector = np.zeros(size)
        if generator is not None:
            direction = generator.normal(size=size)
            vector = length * direction / np.linalg.norm(direction)
        self.values[axis] = [float(element) for element in vector]
        return vector

    def vary(self, *axes: str, shifted: bool = False) -> None:
        """Let axes that every task has (see `variation`) vary in this one without being asked to.

        Args:
            *axes: Such as `material`.
            shifted: Whether `ood` shifts them when the user names none.
        """
        self._asked |= dict.fromkeys(axes, shifted)

    def varies(self, axis: str) -> bool:
        """Return whether an axis that is left alone by default varies, for the user or the task."""
        return axis in self._asked or axis in self._axes or ALL in self._axes

    @property
    def axes(self) -> dict[str, bool]:
        """Axis that was drawn -> whether `ood` can shift it."""
        return dict(self._testable)

    def require_axes(self, task_id: str, every: Callable[[], Mapping[str, bool]]) -> None:
        """Make sure, once everything is drawn, that the user's choice of axes meant something.

        Args:
            task_id: The task.
            every: Returns all axes that the task has, drawn or not, as `axes`; asked for a message.

        Raises:
            UnknownOptionError: If the task has no such axis, or `ood` nothing to shift.
        """
        for axis in self._axes:
            if axis != ALL and axis not in self._testable:
                raise UnknownOptionError(f"axes={axis} is no axis of {task_id}. {_listed(every())}")
            if self._split == "ood" and not self._testable.get(axis, any(self._testable.values())):
                raise UnknownOptionError(
                    f"split=ood cannot shift {axis} in {task_id}, which has no test value on it. "
                    f"{_listed(every())}"
                )
        if self._split == "ood" and not self._shifted:
            raise UnknownOptionError(
                f"split=ood shifts nothing in {task_id} by itself: name what to shift, such as "
                f"axes={ALL}. {_listed(every())}"
            )

    def _values_of[Item](
        self, axis: str, train: Sequence[Item], test: Sequence[Item], shifted: bool
    ) -> Sequence[Item]:
        """Return which values the episode draws from."""
        if axis in self._testable:
            raise AxisError(f"Axis '{axis}' is drawn twice: draw it once and keep the value")
        self._testable[axis] = bool(test)
        by_itself = shifted or self._asked.get(axis, False)
        asked = axis in self._axes or ALL in self._axes if self._axes else by_itself
        if self._split == "ood" and asked and test:
            self._shifted = True
            return test
        return train

    def _number(self, axis: str, train: Span, test: Sequence[Span], shifted: bool) -> float:
        for low, high in (train, *test):
            if low > high:
                raise AxisError(f"Axis '{axis}' has the range {(low, high)}: least value first")
        for low, high in test:
            if low < train[1] and train[0] < high:
                raise AxisError(
                    f"Axis '{axis}' trains on {train} and tests on {(low, high)}: part the ranges"
                )
        spans = self._values_of(axis, [train], test, shifted)
        generator = self._generator(axis)
        if generator is None:
            return (spans[0][0] + spans[0][1]) / 2
        low, high = spans[int(generator.integers(len(spans)))]
        return float(generator.uniform(low, high))

    def _generator(self, axis: str, part: str = "") -> np.random.Generator | None:
        if self._seeds is None:
            return None
        return np.random.default_rng([*self._seeds, zlib.crc32(f"{axis}{part}".encode())])


def _listed(axes: Mapping[str, bool]) -> str:
    """Return in words which axes there are, and which of them can be shifted."""
    fixed = [axis for axis, testable in axes.items() if not testable]
    but = f" but {', '.join(fixed)}" if fixed else ""
    return f"It has: {', '.join(axes)} (or {ALL}). split=ood can shift each{but}"
