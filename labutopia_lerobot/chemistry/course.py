"""How a mixture comes to rest: reactions one after the other, equilibrium after each."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from labutopia_lerobot.chemistry.change import Change, whole, with_acid_of
from labutopia_lerobot.chemistry.compound import Compound
from labutopia_lerobot.chemistry.describe import describe
from labutopia_lerobot.chemistry.hazards import Charge
from labutopia_lerobot.chemistry.network import WATER
from labutopia_lerobot.chemistry.refusals import ImpossibleConditionsError
from labutopia_lerobot.chemistry.rules import known, redox
from labutopia_lerobot.chemistry.rules.reaction_step import ReactionStep, in_what_is_there
from labutopia_lerobot.chemistry.speciation import ph_of, settle

_MOST_STEPS = 40
"""Reactions one after the other that a mixture may take."""

_UNSEEN = 1e-4
"""Share of a solid that must react for the reaction to count; ours. Less would be a crawl without
end: aluminium in the trace of acid that its own ions make."""


@dataclass(frozen=True)
class ReactionVessel:
    """Where and how it happens.

    Attributes:
        volume: Of the solution [m^3]; 0 if there is no water.
        temperature: [K].
        open_system: Whether gas leaves.
        catalysts: Formulas of what is there and stays.
        ph: What it is held at, or None.
        alone: Whether there is one compound besides water.
        slow: Whether slow reactions happen, to their end.
        forms: Keys of what may form: solids and gases, and of each redox or listed reaction one
            product at least; None for all that the rules know.
    """

    volume: float
    temperature: float
    open_system: bool = True
    catalysts: frozenset[str] = frozenset()
    ph: float | None = None
    alone: bool = False
    slow: bool = True
    forms: frozenset[str] | None = None

    @property
    def is_wet(self) -> bool:
        return self.volume > 0.0


def proceed(
    before: Mapping[str, float], vessel: ReactionVessel, *, described: bool = True
) -> tuple[dict[str, float], list[Change]]:
    """Return what becomes of these species, and by which reactions.

    Args:
        before: Amounts by key [mol].
        vessel: Where it happens.
        described: Whether equilibria are written as reactions, which takes most of the time.
    """
    state = {key: before[key] for key in sorted(before)}
    steps: list[Change] = []
    equilibria: list[Change] = []
    settled = _settled(state, vessel)
    for _ in range(_MOST_STEPS):
        done = _first_step(state, settled, vessel)
        if done is None and vessel.is_wet and state != settled:
            done = _first_step(settled, settled, vessel)  # with what came into solution only now
            if done is not None:
                equilibria += describe(state, settled, alone=False) if described else []
                state = dict(settled)
        if done is None:
            break
        for key, n in done.coefficients.items():
            left = state.get(key, 0.0) + n * done.extent
            state[key] = left if abs(left) > 1e-13 * done.extent else 0.0
        state = {key: mol for key, mol in state.items() if mol}
        _join(steps, done)
        settled = _settled(state, vessel)
    if vessel.is_wet and described:
        equilibria += describe(state, settled, alone=vessel.alone and not steps)
    for one in equilibria:
        _join(steps, one)
    return settled, steps


def too_slow(settled: Mapping[str, float], vessel: ReactionVessel) -> str:
    """Return the equation of a slow reaction whose rate is not known, or nothing.

    Args:
        settled: Amounts by key at equilibrium [mol].
        vessel: Where they are, in water.
    """
    for step in known.steps(
        settled,
        temperature=vessel.temperature,
        ph=ph_of(settled, vessel.volume),
        catalysts=_present(settled, vessel),
    ):
        if step.slow and not step.timed:
            done = _done(_in_solution(step, settled), settled, vessel.forms)
            if done is not None:
                return done.written()
    return ""


def _present(settled: Mapping[str, float], vessel: ReactionVessel) -> frozenset[str]:
    """Return the formulas of what may be a catalyst."""
    return vessel.catalysts | {key.removesuffix("(aq)") for key in settled}


def _join(changes: list[Change], one: Change) -> None:
    """Add a reaction to the list, or its extent to the same reaction that is there."""
    for index, other in enumerate(changes):
        if other.coefficients == one.coefficients:
            used = max(other.used, one.used)
            changes[index] = replace(other, extent=other.extent + one.extent, used=used)
            return
    changes.append(one)


def _settled(state: Mapping[str, float], vessel: ReactionVessel) -> dict[str, float]:
    if not vessel.is_wet:
        return dict(state)
    settled = settle(
        state,
        vessel.volume,
        vessel.temperature,
        open_system=vessel.open_system,
        ph=vessel.ph,
        forms=vessel.forms,
    )
    if settled.get(WATER, 0.0) < -1e-9 * max(settled.values()):
        raise ImpossibleConditionsError(
            "there is less water than these compounds bind: pour them in with more volume"
        )
    return settled


def _first_step(
    state: Mapping[str, float], settled: Mapping[str, float], vessel: ReactionVessel
) -> Change | None:
    """Return the first reaction that uses something up, done as far as it goes."""
    ph = None
    if vessel.is_wet:
        ph = ph_of(settled, vessel.volume)
        for step in redox.steps(state, settled, vessel.volume, vessel.temperature):
            done = _done(step, state, vessel.forms)
            if done is not None:
                return done
    present = _present(settled, vessel)
    pool = settled if vessel.is_wet else state
    for step in known.steps(pool, temperature=vessel.temperature, ph=ph, catalysts=present):
        if step.slow and not vessel.slow:
            continue
        step = _in_solution(step, state) if vessel.is_wet else step
        done = _done(step, state, vessel.forms)
        if done is not None:
            return done
    return None


def _in_solution(step: ReactionStep, state: Mapping[str, float]) -> ReactionStep:
    """Return a step with the forms, the acid and the base that the solution holds."""
    numbers = with_acid_of(in_what_is_there(step.coefficients, state), state, 14.0)
    balanced = None if numbers is None else whole(numbers)
    return step if balanced is None else replace(step, coefficients=balanced)


def _done(
    step: ReactionStep, state: Mapping[str, float], forms: frozenset[str] | None
) -> Change | None:
    products = {key for key, n in step.coefficients.items() if n > 0}
    if forms is not None and forms.isdisjoint(products):
        return None
    ratios = {
        key: state.get(key, 0.0) / -n
        for key, n in step.coefficients.items()
        if n < 0 and key != WATER
    }
    scarce = min(ratios.values(), default=0.0)
    extent = scarce
    if step.conversion < 1.0:
        made = min(state.get(key, 0.0) / n for key, n in step.coefficients.items() if n > 0)
        extent = step.conversion * (scarce + made) - made
    total = max(state.values())
    solid = min((ratio for key, ratio in ratios.items() if key.endswith("(s)")), default=0.0)
    if extent <= max(1e-9 * total, 1e-15, _UNSEEN * solid):
        return None
    return Change(
        step.coefficients,
        extent,
        step.kind,
        step.rationale,
        confidence=step.confidence,
        slow=step.slow,
        used=extent / scarce,
    )


def charge_of(
    compounds: Sequence[Compound], before: Mapping[str, float], vessel: ReactionVessel
) -> Charge:
    """Return what a vessel is charged with, as far as dangers go.

    Args:
        compounds: Everything in it, catalysts too.
        before: Amounts of their species by key [mol].
        vessel: Where it happens.
    """
    undiluted = {
        one.formula for one in compounds if any(f"{one.formula}({p})" in before for p in "slg")
    }
    ph = None
    if vessel.is_wet:
        ph = ph_of(_settled(before, vessel), vessel.volume)
    return Charge(compounds, vessel.temperature, ph, undiluted)
