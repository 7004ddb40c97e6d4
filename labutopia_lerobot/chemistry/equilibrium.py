"""Equilibrium of what is dissolved with the solids and gases that may form.

Activity model: ideal dilute. The activity of a dissolved species is its concentration over
1 mol/l, that of water, of a pure solid and of a gas at the pressure at which it leaves is 1.

Every species is made of components: ``ln c_j = k_j + sum_i a_ji x_i``, x being the logarithms of
the components' concentrations. The x of equilibrium minimise the convex function
``sum_j c_j(x) - sum_i t_i x_i`` (t: totals) under ``k_p + sum_i a_pi x_i <= 0``: no phase is
supersaturated. The multipliers of these limits are the amounts of the phases. This is the dual of
the least Gibbs energy (Smith and Missen, Chemical Reaction Equilibrium Analysis, 1982), so there
is one solution, and which of several solids stay is not guessed but follows.

A primal-dual interior-point method (Boyd and Vandenberghe, Convex Optimization, section 11.7) finds
the phases, a few steps of Newton's method with exactly those make it precise.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.chemistry.errors import ChemistryError
from labutopia_lerobot.kernel import kernel

Floats = NDArray[np.float64]

_PRECISION = 1e-11
"""Largest error of a mass balance, relative to the sum of what is in it. An estimate of ours."""

_MOST_STEPS = 400
"""Steps after which the interior-point method gives up; mixtures take about forty."""

_LONGEST_STEPS = (6.0, 1.0, 0.25)
"""Of the logarithm of a concentration: the exponentials are not linear beyond. Tried in turn."""


class NoEquilibriumError(ChemistryError):
    """The equilibrium of a mixture was not computed; the message names the mixture's totals."""


@dataclass(frozen=True)
class Equilibrium:
    """What the solver answers.

    Attributes:
        logarithms: Natural, of the components' concentrations [ln(mol/l)]; shape (components,).
        concentrations: Of the dissolved species [mol/l]; shape (species,).
        phases: Amount of each phase per litre of solution [mol/l]; shape (phases,).
    """

    logarithms: NDArray[np.float64]
    concentrations: NDArray[np.float64]
    phases: NDArray[np.float64]


def solve(
    constants: NDArray[np.float64],
    species: NDArray[np.float64],
    phase_constants: NDArray[np.float64],
    phases: NDArray[np.float64],
    totals: NDArray[np.float64],
) -> Equilibrium:
    """Return the one equilibrium of these totals.

    Args:
        constants: Natural logarithm of each dissolved species' formation constant.
        species: Components in each dissolved species; shape (species, components).
        phase_constants: The same as ``constants`` for the phases.
        phases: Components in each phase; shape (phases, components).
        totals: Of each component [mol/l]; of protons it may be negative.

    Raises:
        NoEquilibriumError: The totals are not finite, or no species can hold them.
    """
    if np.all(np.isfinite(totals)):
        for longest in _LONGEST_STEPS:
            x, amounts, solved = _solve(
                constants, species, phase_constants, phases, totals, longest
            )
            if solved:
                return Equilibrium(x, np.exp(constants + species @ x), amounts)
    raise NoEquilibriumError(f"no equilibrium was reached for the totals {totals} mol/l")


@kernel
def _solve_linear(matrix: Floats, right: Floats) -> bool:
    """Solve in place by Gauss's elimination with scaled pivots; the answer is in ``right``."""
    size = right.shape[0]
    for row in range(size):
        largest = 0.0
        for column in range(size):
            largest = max(largest, abs(matrix[row, column]))
        if largest > 0.0:
            for column in range(size):
                matrix[row, column] /= largest
            right[row] /= largest
    for pivot in range(size):
        best = pivot
        for row in range(pivot + 1, size):
            if abs(matrix[row, pivot]) > abs(matrix[best, pivot]):
                best = row
        if matrix[best, pivot] == 0.0:
            return False
        if best != pivot:
            for column in range(pivot, size):
                matrix[pivot, column], matrix[best, column] = (
                    matrix[best, column],
                    matrix[pivot, column],
                )
            right[pivot], right[best] = right[best], right[pivot]
        for row in range(pivot + 1, size):
            factor = matrix[row, pivot] / matrix[pivot, pivot]
            if factor != 0.0:
                for column in range(pivot, size):
                    matrix[row, column] -= factor * matrix[pivot, column]
                right[row] -= factor * right[pivot]
    for pivot in range(size - 1, -1, -1):
        for column in range(pivot + 1, size):
            right[pivot] -= matrix[pivot, column] * right[column]
        right[pivot] /= matrix[pivot, pivot]
    return True


@kernel
def _balance(
    constants: Floats,
    species: Floats,
    totals: Floats,
    x: Floats,
    concentrations: Floats,
    residual: Floats,
    scale: Floats,
) -> None:
    """Write the concentrations at ``x``, what the balances miss and the size of what is in them."""
    for i in range(totals.shape[0]):
        residual[i] = -totals[i]
        scale[i] = abs(totals[i])
    for j in range(constants.shape[0]):
        exponent = constants[j]
        for i in range(totals.shape[0]):
            exponent += species[j, i] * x[i]
        concentrations[j] = np.exp(min(exponent, 300.0))
        for i in range(totals.shape[0]):
            part = species[j, i] * concentrations[j]
            residual[i] += part
            scale[i] += abs(part)


@kernel
def _first_guess(
    constants: Floats,
    species: Floats,
    totals: Floats,
    x: Floats,
    concentrations: Floats,
) -> None:
    """Bring ``x`` near, each component by itself.

    Positive continuous fractions: Carrayrou, Mose and Behra, AIChE Journal 48 (2002) 894.
    """
    components = totals.shape[0]
    for i in range(components):
        x[i] = np.log(totals[i]) if totals[i] > 0.0 else -16.0
        x[i] = max(x[i], -60.0)
    for _ in range(60):
        farthest = 0.0
        for i in range(components):
            consumed = max(totals[i], 0.0)
            made = max(-totals[i], 0.0)
            power = 1.0
            for j in range(constants.shape[0]):
                if species[j, i] == 0.0:
                    continue
                exponent = constants[j]
                for other in range(components):
                    exponent += species[j, other] * x[other]
                part = species[j, i] * np.exp(min(exponent, 300.0))
                if part > 0.0:
                    made += part
                    power = max(power, species[j, i])
                else:
                    consumed -= part
            step = np.log((consumed + 1e-30) / (made + 1e-30)) / power
            x[i] += step if abs(step) < 30.0 else np.sign(step) * 30.0
            farthest = max(farthest, abs(step))
        if farthest < 0.5:
            break


@kernel
def _solve(
    constants: Floats,
    species: Floats,
    phase_constants: Floats,
    phases: Floats,
    totals: Floats,
    longest: float,
) -> tuple[Floats, Floats, bool]:
    """Return the logarithms of the components, the amounts of the phases, whether it is solved."""
    components, limits = totals.shape[0], phase_constants.shape[0]
    x = np.empty(components)
    concentrations = np.empty(constants.shape[0])
    _first_guess(constants, species, totals, x, concentrations)
    residual, scale = np.empty(components), np.empty(components)
    amounts, slack, gap = np.empty(limits), np.empty(limits), np.empty(limits)
    largest = 1e-12
    for i in range(components):
        largest = max(largest, abs(totals[i]))
    for p in range(limits):
        saturation = phase_constants[p]
        for i in range(components):
            saturation += phases[p, i] * x[i]
        slack[p] = max(-saturation, 1.0)
        amounts[p] = 0.1 * largest / slack[p]
    matrix, step = np.empty((components, components)), np.empty(components)
    for _ in range(_MOST_STEPS):
        _balance(constants, species, totals, x, concentrations, residual, scale)
        complementarity = 0.0
        error = 0.0
        for p in range(limits):
            complementarity += amounts[p] * slack[p] / limits
            gap[p] = phase_constants[p] + slack[p]
            for i in range(components):
                gap[p] += phases[p, i] * x[i]
                residual[i] += phases[p, i] * amounts[p]
                scale[i] += abs(phases[p, i]) * amounts[p]
            error = max(error, abs(gap[p]))
        for i in range(components):
            error = max(error, abs(residual[i]) / (scale[i] + 1e-300))
            if not np.isfinite(x[i]):
                return x, amounts, False
        if error < 1e-7 and complementarity < 1e-10 * largest:
            break
        centre = max(0.1 * complementarity, 1e-13 * largest)  # or the weights overflow
        for i in range(components):
            for other in range(components):
                matrix[i, other] = 0.0
            step[i] = -residual[i]
        for j in range(constants.shape[0]):
            for i in range(components):
                if species[j, i] != 0.0:
                    part = species[j, i] * concentrations[j]
                    for other in range(components):
                        matrix[i, other] += part * species[j, other]
        for p in range(limits):
            weight = amounts[p] / slack[p]
            change = (centre + amounts[p] * gap[p]) / slack[p] - amounts[p]
            for i in range(components):
                if phases[p, i] != 0.0:
                    step[i] -= phases[p, i] * change
                    for other in range(components):
                        matrix[i, other] += weight * phases[p, i] * phases[p, other]
        for i in range(components):
            matrix[i, i] *= 1.0 + 1e-13
            matrix[i, i] += 1e-290
        if not _solve_linear(matrix, step):
            return x, amounts, False
        length = 1.0
        for i in range(components):
            length = min(length, longest / max(abs(step[i]), 1e-300))
        kept = length
        for p in range(limits):
            slack_step = -gap[p]
            for i in range(components):
                slack_step -= phases[p, i] * step[i]
            amount_step = (centre - amounts[p] * slack_step) / slack[p] - amounts[p]
            gap[p] = slack_step
            if slack_step < 0.0:
                kept = min(kept, -0.99 * slack[p] / slack_step)
            if amount_step < 0.0:
                kept = min(kept, -0.99 * amounts[p] / amount_step)
        for p in range(limits):
            amount_step = (centre - amounts[p] * gap[p]) / slack[p] - amounts[p]
            slack[p] += kept * gap[p]
            amounts[p] += kept * amount_step
        for i in range(components):
            x[i] += kept * step[i]
    active = np.empty(limits, dtype=np.bool_)
    for p in range(limits):
        active[p] = amounts[p] > slack[p] * 1e-6 * largest
    inside, inside_amounts = x.copy(), amounts.copy()
    for _ in range(2 * limits + 4):
        solved = _polish(
            constants, species, phase_constants, phases, totals, x, amounts, active, longest
        )
        if not solved:  # two phases that hardly differ: leave out the one there is least of
            least = -1
            for p in range(limits):
                if active[p] and (least < 0 or inside_amounts[p] < inside_amounts[least]):
                    least = p
            if least < 0:
                return x, amounts, False
            active[least] = False
            for i in range(components):
                x[i] = inside[i]
            for p in range(limits):
                amounts[p] = inside_amounts[p]
            continue
        worst, which, joins = 1e-11, -1, False
        for p in range(limits):
            if active[p]:
                if amounts[p] < -1e-15 * largest and -amounts[p] / largest > worst * 1e-3:
                    worst, which, joins = -amounts[p] / largest * 1e3, p, False
            else:
                saturation = phase_constants[p]
                for i in range(components):
                    saturation += phases[p, i] * x[i]
                if saturation > worst:
                    worst, which, joins = saturation, p, True
        if which < 0:
            for p in range(limits):
                amounts[p] = max(amounts[p], 0.0)
            return x, amounts, True
        active[which] = joins
    return x, amounts, False


@kernel
def _polish(
    constants: Floats,
    species: Floats,
    phase_constants: Floats,
    phases: Floats,
    totals: Floats,
    x: Floats,
    amounts: Floats,
    active: NDArray[np.bool_],
    longest: float,
) -> bool:
    """Solve with exactly the active phases by Newton's method; say whether it converged."""
    components, limits = totals.shape[0], phase_constants.shape[0]
    members = np.empty(limits, dtype=np.int64)
    count = 0
    for p in range(limits):
        if active[p]:
            members[count] = p
            count += 1
        else:
            amounts[p] = 0.0
    size = components + count
    matrix, step = np.empty((size, size)), np.empty(size)
    concentrations = np.empty(constants.shape[0])
    residual, scale = np.empty(components), np.empty(components)
    for _ in range(200):
        _balance(constants, species, totals, x, concentrations, residual, scale)
        error = 0.0
        for row in range(size):
            for column in range(size):
                matrix[row, column] = 0.0
        for row in range(count):
            p = members[row]
            saturation = phase_constants[p]
            for i in range(components):
                saturation += phases[p, i] * x[i]
                residual[i] += phases[p, i] * amounts[p]
                scale[i] += abs(phases[p, i] * amounts[p])
                matrix[components + row, i] = phases[p, i]
                matrix[i, components + row] = phases[p, i]
            step[components + row] = -saturation
            error = max(error, abs(saturation))
        for i in range(components):
            step[i] = -residual[i]
            error = max(error, abs(residual[i]) / (scale[i] + 1e-300))
            if not np.isfinite(x[i]):
                return False
        for j in range(constants.shape[0]):
            for i in range(components):
                if species[j, i] != 0.0:
                    part = species[j, i] * concentrations[j]
                    for other in range(components):
                        matrix[i, other] += part * species[j, other]
        if error < _PRECISION:
            return True
        if not _solve_linear(matrix, step):
            return False
        length = 1.0
        for i in range(components):
            length = min(length, longest / max(abs(step[i]), 1e-300))
        for i in range(components):
            x[i] += length * step[i]
        for row in range(count):
            amounts[members[row]] += length * step[components + row]
    return error < 1e-9
