"""Rates that were measured on this machine, and what parts will cost by them."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from statistics import fmean

from labutopia_lerobot.evaluation.reporting.table import Cell, Table
from labutopia_lerobot.experiments.part_record import DONE, PartRecord
from labutopia_lerobot.experiments.parts.experiment_part import ExperimentPart

UNKNOWN = "not measured"


@dataclass(frozen=True)
class Rates:
    """What finished parts took.

    Attributes:
        records: Of parts that were done on this machine.
    """

    records: tuple[PartRecord, ...]

    @classmethod
    def of(cls, records: Iterable[PartRecord], machine: str) -> "Rates":
        """Return the rates of one machine; what others took says nothing of it."""
        return cls(tuple(r for r in records if r.state == DONE and r.machine == machine and r.size))

    def knows(self, part: ExperimentPart) -> bool:
        """Return whether a part of the same rate was measured."""
        return bool(self._alike(part))

    def seconds(self, part: ExperimentPart, share: float = 1.0) -> float | None:
        """Return how long a share of a part will take [s], or None if nobody knows."""
        alike = self._alike(part)
        if not alike:
            return None
        working = sum(max(record.seconds - record.startup_s, 0.0) for record in alike)
        rate = working / sum(record.size for record in alike)
        return fmean(record.startup_s for record in alike) + share * part.size * rate

    def stored_bytes(self, part: ExperimentPart) -> float | None:
        """Return how much room a part will take at its peak [bytes], or None if nobody knows."""
        peak = part.peak_bytes
        if peak is not None:
            return peak
        alike = self._alike(part)
        stored = sum(record.stored_bytes for record in alike)
        return part.volume * stored / sum(r.volume for r in alike) if alike else None

    def memory_bytes(self, part: ExperimentPart) -> int | None:
        """Return how much memory a part will need [bytes], or None if nobody knows."""
        return max((record.memory_bytes for record in self._alike(part)), default=None)

    def _alike(self, part: ExperimentPart) -> Sequence[PartRecord]:
        return [record for record in self.records if record.rate_key == part.rate_key]


@dataclass(frozen=True)
class Cost:
    """Cost of the parts that are to be done, as far as their rates are known.

    Attributes:
        seconds: Of all of them, one after the other [s].
        stored_bytes: Of all of them [bytes].
        memory_bytes: Most that one of them needs [bytes].
        unknown: Which of these three nobody has measured of some of the parts.
    """

    seconds: float
    stored_bytes: float
    memory_bytes: float
    unknown: frozenset[str]


def cost_of(parts: Sequence[ExperimentPart], rates: Rates) -> Cost:
    """Return what parts cost together; they are done one after the other."""
    each: dict[str, list[float | None]] = {
        "seconds": [rates.seconds(part) for part in parts],
        "stored_bytes": [rates.stored_bytes(part) for part in parts],
        "memory_bytes": [rates.memory_bytes(part) for part in parts],
    }
    known = {name: [v for v in values if v is not None] for name, values in each.items()}
    return Cost(
        seconds=sum(known["seconds"]),
        stored_bytes=sum(known["stored_bytes"]),
        memory_bytes=max(known["memory_bytes"], default=0.0),
        unknown=frozenset(name for name, values in each.items() if None in values),
    )


def price_list(
    parts: Sequence[ExperimentPart], pending: Sequence[ExperimentPart], rates: Rates
) -> Table:
    """Return the table of what is there, what is to be done and what that costs.

    Args:
        parts: All parts.
        pending: Those to be done.
        rates: What earlier parts took.
    """
    lines: list[tuple[Cell, ...]] = []
    for key in dict.fromkeys(part.rate_key for part in parts):
        todo = [part for part in pending if part.rate_key == key]
        count = sum(part.rate_key == key for part in parts)
        lines.append((key, count, len(todo), *_priced(todo, rates)))
    lines.append(("all", len(parts), len(pending), *_priced(pending, rates)))
    head = ("Parts", "in all", "to do", "hours", "GB", "GB of memory")
    note = (
        "By what parts like them took on this machine, one after the other; more than that where a "
        "+ stands, as some of it is not measured."
    )
    return Table("Cost", head, tuple(lines), note)


def _priced(parts: Sequence[ExperimentPart], rates: Rates) -> list[str]:
    """Return hours, gigabytes, gigabytes of memory; what is not measured at all says so."""
    cost = cost_of(parts, rates)
    shown = []
    for name, unit, form in (
        ("seconds", 3600, ".2f"),
        ("stored_bytes", 1e9, ".2f"),
        ("memory_bytes", 1e9, ".1f"),
    ):
        value = getattr(cost, name)
        known = f"{value / unit:{form}}"
        shown.append(known if name not in cost.unknown else f"{known} +" if value else UNKNOWN)
    return shown
