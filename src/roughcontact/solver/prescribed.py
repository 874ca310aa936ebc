"""The pressure under a prescribed displacement of a given region (thesis, eq. A.7)."""

from __future__ import annotations

import math
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import numpy as np

from roughcontact.arrays import is_array, is_numpy, max_abs, multiply, namespace
from roughcontact.errors import InputError, about
from roughcontact.halfspace.operators.operator import Operator, capabilities, is_semidefinite
from roughcontact.solver import tuning
from roughcontact.solver.conjugate_gradients import conjugate_gradients
from roughcontact.solver.control import checked_tolerance
from roughcontact.solver.direct import solve_cells
from roughcontact.solver.inner_operator import (
    FullGrid,
    InnerOperator,
    factorisation_pays,
    first_product,
    inner_operator_on,
)
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.rows_operator import on_own_rows
from roughcontact.solver.subdomain import Subdomain, bounding_box, prolong, restrict
from roughcontact.solver.vectors import vectors_on
from roughcontact.threads import one_blas_thread
from roughcontact.units import in_si
from roughcontact.validation import Array, Mask, scalar

__all__ = ["Prescribed", "checked_region", "prescribe", "prescribed_displacement"]


@dataclass(frozen=True, slots=True, eq=False)
class Prescribed:
    """A pressure that gives a region a prescribed displacement, about.

    Attributes
    ----------
    pressure : array
        Pressure [Pa], zero outside the region.
    force : float
        Its sum over the region [N].
    work : float
        Sum of force times prescribed displacement [J], twice the elastic energy: wrong by the square of the residual,
        where the force is wrong by the residual.
    residual : float
        Largest error of the displacement on the region, relative to its largest value.
    steps : int
        Products with the operator; none where few cells were factorised and their matrix shows the accuracy.
    """

    pressure: Array
    force: float
    work: float
    residual: float
    steps: int


def prescribed_displacement(
    mask: Mask,
    displacement: float | Array,
    *,
    operator: Operator,
    tolerance: float = 1e-8,
    max_steps: int = 5000,
    initial: Array | None = None,
) -> Prescribed:
    """Return the pressure that gives a region a prescribed displacement, and presses nowhere else.

    The pressure may be negative: the region is bonded. On a periodic grid the region must leave a cell free.

    Parameters
    ----------
    mask : bool array, shape ``operator.grid.shape``
        The region: the cells that carry pressure, at least one.
    displacement : float or array
        Their displacement [m]; values outside the region do not matter.
    operator : Operator
        Displacement [m] from pressure [Pa].
    tolerance : float
        Largest error of the displacement, relative to its largest value; between 1e-14 and 1e-2.
    max_steps : int
        Largest number of products with the operator, two at least: one for a step, one for its error.
    initial : array, optional
        A pressure [Pa] to start from.

    Returns
    -------
    Prescribed
        Pressure [Pa], force [N] and work [J] with the residual.

    Raises
    ------
    ValueError
        If the region is empty, of a wrong shape, given by other numbers than ones and zeros, or the whole of a
        periodic grid, if the displacement is zero or not finite on it, if the initial pressure is not finite, if one
        of them does not fit the region, or if the operator, the tolerance or the number of steps is not one.
    RuntimeError
        If the tolerance was missed.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6)
    >>> disc = ~np.isnan(rc.shapes.flat_disc(grid, radius=20e-6).heights)
    >>> punch = rc.prescribed_displacement(disc, 1e-9, operator=rc.half_space(grid, 1e9))
    >>> f"{punch.force / (2 * 1e9 * 20e-6 * 1e-9):.1f} of 2 E* a d"
    '1.0 of 2 E* a d'
    """
    answer = prescribe(operator, mask, displacement, tolerance, max_steps, initial)
    if not answer.residual <= tolerance:
        remedy = "a larger tolerance" if answer.steps < max_steps else "more steps (max_steps)"
        raise RuntimeError(
            f"the displacement was met only to {answer.residual:.1e}, by {answer.steps} products, where "
            f"{tolerance:.1e} was asked for: allow {remedy}"
        )
    return answer


def prescribe(
    operator: Operator,
    region: Mask,
    displacement: float | Array,
    tolerance: float,
    max_steps: int = 5000,
    initial: Array | None = None,
) -> Prescribed:
    """Return what `prescribed_displacement` does, with whatever residual was reached."""
    if not (hasattr(operator, "apply") and hasattr(operator, "grid")):
        raise InputError(
            f"an operator is wanted, such as half_space(grid, modulus), not {operator!r}", place="operator"
        )
    if not (isinstance(max_steps, int | np.integer) and max_steps >= 2):
        raise about("max_steps", f"must be a whole number, two at least, not {max_steps!r}")
    tolerance = checked_tolerance(tolerance)
    region = checked_region(region, operator.grid.shape)
    xp = namespace(region)
    if not bool(xp.any(region)):
        raise about("the region", "holds no cell: nothing can be displaced")
    if is_semidefinite(operator) and bool(xp.all(region)):
        raise InputError("all cells of a periodic grid: no pressure moves their mean", "leave a cell free")
    displacement, initial = in_si(displacement, "m", "displacement"), in_si(initial, "Pa", "initial")
    _check("displacement", displacement, region)
    if initial is not None:
        _check("initial pressure", initial, region)
    if is_numpy(region) and np.ndim(displacement) == 0:  # planes are large: one number is not written out
        target: Array = np.broadcast_to(np.float64(displacement), region.shape)
    else:
        target = xp.where(
            region, xp.zeros(region.shape, dtype=xp.float64, device=region.device) + displacement, 0.0
        )
    size = max_abs(target)
    if not 0 < size < math.inf:
        raise about("the displacement", "must be finite, and not zero everywhere on the region [m]")
    if initial is not None and not bool(xp.all(xp.isfinite(initial))):
        raise about("the initial", "pressure must be finite [Pa]")
    subdomain = _subdomain(operator, region)
    part, inside, wanted = operator, region, target
    if subdomain is not None:
        part = _part(operator, subdomain)
        inside, wanted = restrict(region, subdomain), restrict(target, subdomain)

    def start() -> Array | None:
        """Return the pressure to start from. Fields are large: only the solve holds it."""
        begun = None if initial is None else xp.where(region, initial, 0.0)
        return begun if begun is None or subdomain is None else restrict(begun, subdomain)

    with one_blas_thread():
        pressure, residual, steps = _solve(part, inside, wanted, start(), tolerance * size, max_steps, xp)
        # With A p = g - r the work g A^-1 g is p (g + r), except for r A^-1 r.
        work = Measure(part.weights, xp).dot(pressure, wanted + residual)
    whole = pressure if subdomain is None else prolong(pressure, subdomain, region.shape)
    return Prescribed(
        whole, Measure(operator.weights, xp).total(whole), work, max_abs(residual) / size, steps
    )


def _subdomain(operator: Operator, region: Mask) -> Subdomain | None:
    """Return where a solve on a region costs least: on its cells, of a list, or in its box; None for the whole."""
    if not is_numpy(region):  # elsewhere than on the host a box costs a transfer for each of its sides
        return None
    if capabilities(operator).listed:
        return np.flatnonzero(region)
    box = bounding_box(region)
    assert box is not None  # some cell is in the region
    # A box takes a separate kernel, which costs as much as two products or three; in a box nothing is periodic.
    padded = math.prod(2 * (s.stop - s.start) for s in box)
    whole = math.prod(n if p else 2 * n for n, p in zip(region.shape, operator.grid.periodic, strict=True))
    return box if padded < tuning.SMALLER_BOX * whole else None


def _part(operator: Operator, subdomain: Subdomain) -> Operator:
    """Return the operator between the cells of a subdomain."""
    if isinstance(subdomain, tuple):
        return operator.restrict(subdomain)
    submatrix = capabilities(operator).submatrix
    assert submatrix is not None  # of others no list is made
    return submatrix(subdomain)


def _check(name: str, given: Any, region: Mask) -> None:
    """Refuse a field that does not fit its region."""
    if is_array(given) and given.ndim == 0:
        return
    if not is_array(given):
        scalar(given, name)
        return
    if tuple(given.shape) != tuple(region.shape):
        raise InputError(
            f"the {name}, of shape {tuple(given.shape)}, does not fit {tuple(region.shape)} cells"
        )
    if is_numpy(given) != is_numpy(region):
        raise InputError(f"the {name} must be an array of the same library as the region")


def _solve(
    operator: Operator,
    region: Mask,
    wanted: Array,
    pressure: Array | None,
    limit: float,
    max_steps: int,
    xp: Any,
) -> tuple[Array, Array, int]:
    """Return pressure, residual by an exact product [m], and number of products: iterative refinement.

    Labels D1 to D5 are the lines of the algorithm in docs/concepts/method.md.
    """
    # D1: a pressure that is given, of the matrix of few cells, or zero.
    before = math.inf
    inner: InnerOperator | None = None
    exact, steps = True, 0
    if pressure is not None:
        inner, steps = inner_operator_on(operator, region), 1
        u, exact = first_product(operator, pressure, inner)
    elif (found := _on_few_cells(operator, region, wanted)) is not None:
        pressure, u = found
        # The matrix may differ from that of the products.
        if max_abs(xp.where(region, wanted - u, 0.0)) > limit:
            u, steps = operator.apply(pressure), 1
    else:
        pressure, u = (xp.zeros(wanted.shape, dtype=wanted.dtype, device=wanted.device) for _ in range(2))
    while True:
        r = xp.where(region, wanted - u, 0.0)  # D2
        error = max_abs(r)
        if not error > limit or steps >= max_steps:  # D3: small, or no products left
            if exact:
                return pressure, r, steps
            u, exact, steps = operator.apply(pressure), True, steps + 1
            continue
        if inner is None:
            inner = inner_operator_on(operator, region)
        elif not error < before / 2:  # D5
            if not inner.contraction:
                return pressure, r, steps
            inner = FullGrid(operator)  # the inexact one reduces the residual no more
        before = error
        rows = on_own_rows(inner, r)
        part = rows.scaled(rows.gather(r), error)  # so that single precision holds all numbers
        del u, r  # fields are large, here and below
        none = namespace(part).zeros_like(part)
        vectors = vectors_on(rows, Measure(inner.weights, xp), rows.gather(region), part, none)
        _, done = conjugate_gradients(  # D3
            rows,
            vectors,
            limit=max(0.5 * limit / error, inner.contraction),
            max_steps=max_steps - steps - 1,
        )
        correction = vectors.correction
        del vectors, part
        pressure = pressure + rows.scatter(multiply(correction, error))  # D4
        u, exact, steps = operator.apply(pressure), True, steps + done + 1


def _on_few_cells(operator: Operator, region: Mask, wanted: Array) -> tuple[Array, Array] | None:
    """Return the pressure on few cells, and its displacement on them by their matrix.

    More cells start from zero: a start from coarser cells saves almost no product, and takes longer.
    """
    if not is_numpy(region):
        return None
    if not factorisation_pays(operator, int(np.count_nonzero(region)), tuning.DIRECT_CELLS):
        return None
    pressure, u, cells = np.zeros(wanted.shape), np.zeros(wanted.shape), np.flatnonzero(region)
    with suppress(np.linalg.LinAlgError):  # not definite to working precision: iterate instead
        pressure.ravel()[cells], u.ravel()[cells] = solve_cells(operator, cells, wanted.ravel()[cells])
        return pressure, u
    return None


def checked_region(region: Any, shape: tuple[int, ...]) -> Mask:
    """Return the cells of a region, as truth values on the grid.

    Raises
    ------
    ValueError
        If the shape is another, or if there are numbers other than one and zero: heights or gaps, say, or NaN.
    """
    given = region if is_array(region) else np.asarray(region)
    xp = namespace(given)
    if tuple(given.shape) != shape:
        raise InputError(
            f"a region of shape {tuple(given.shape)} does not fit the grid of shape {shape}", place="region"
        )
    if xp.isdtype(given.dtype, "bool"):
        return given
    if xp.isdtype(given.dtype, "numeric"):
        inside: Mask = given == 1
        if bool(xp.all(inside | (given == 0))):
            return inside
    raise InputError(
        "a region is given by truth values, such as pressure > 0, or only by ones and zeros", place="region"
    )
