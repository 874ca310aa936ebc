"""Distributions of the pressure in contact and of the gap outside it; methods of `Solution`."""

from __future__ import annotations

import numpy as np

from roughcontact.arrays import on_host
from roughcontact.contact.solution import Solution
from roughcontact.errors import InputError
from roughcontact.validation import Array, Mask, numeric_method

__all__ = ["gap_histogram", "pressure_histogram"]


@numeric_method
def pressure_histogram(solution: Solution, bins: int = 50) -> tuple[Array, Array]:
    """Return the distribution of the pressure over the contact area.

    Cells are weighted by their area.

    Parameters
    ----------
    solution : Solution
    bins : int
        Number of bins of equal width from zero to the largest value.

    Returns
    -------
    density : array, shape (bins,)
        Probability density [1/Pa]; [m/N] on springs.
    edges : array, shape (bins + 1,)
        Edges of the bins [Pa]; [N/m] on springs.

    Raises
    ------
    ValueError
        If there is no bin.

    Examples
    --------
    >>> import roughcontact as rc
    >>> solution = rc.press(rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4), 1e9, force=1e-3)
    >>> density, edges = solution.pressure_histogram(bins=4)  # of Hertz' pressures the large ones are frequent
    >>> (density * edges[1]).round(2)
    array([0.13, 0.13, 0.33, 0.4 ])
    """
    return _density(solution, solution.pressure, solution.contact, bins)


@numeric_method
def gap_histogram(solution: Solution, bins: int = 50) -> tuple[Array, Array]:
    """Return the distribution of the gap over the cells that are not in contact.

    Cells are weighted by their area.

    Parameters
    ----------
    solution : Solution
    bins : int
        Number of bins of equal width from zero to the largest value.

    Returns
    -------
    density : array, shape (bins,)
        Probability density [1/m].
    edges : array, shape (bins + 1,)
        Edges of the bins [m].

    Raises
    ------
    ValueError
        If there is no bin.

    Examples
    --------
    >>> import roughcontact as rc
    >>> solution = rc.press(rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4), 1e9, force=1e-3)
    >>> density, edges = solution.gap_histogram(bins=4)  # of the open cells
    >>> (density * edges[1]).round(2)
    array([0.39, 0.38, 0.18, 0.05])
    """
    return _density(solution, solution.gap, ~solution.contact & solution.problem.measured, bins)


def _density(solution: Solution, field: Array, mask: Mask, bins: int) -> tuple[Array, Array]:
    """Return the density of a field over the area of the cells of a mask, and its edges, on the host."""
    if bins < 1:
        raise InputError(f"a histogram needs at least one bin, not {bins}")
    chosen = on_host(mask).astype(bool)
    values, areas = on_host(field)[chosen], solution.problem.measure.on(np.flatnonzero(chosen))
    values = np.maximum(values, 0.0)  # a gap within rounding may be negative
    if not values.size:
        return np.zeros(int(bins)), np.linspace(0.0, 1.0, int(bins) + 1)
    end = float(values.max()) or 1.0
    density, edges = np.histogram(values, bins=int(bins), range=(0.0, end), weights=areas, density=True)
    return density, edges
