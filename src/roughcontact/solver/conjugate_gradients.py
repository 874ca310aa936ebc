"""Preconditioned conjugate gradients on a given set of cells: a given displacement, pressure of any sign."""

from __future__ import annotations

from roughcontact.kernels import buffers
from roughcontact.solver.inner_operator import InnerOperator
from roughcontact.solver.vectors import Vectors

__all__ = ["conjugate_gradients"]


def conjugate_gradients(
    inner: InnerOperator, vectors: Vectors, *, limit: float, max_steps: int
) -> tuple[float, int]:
    """Correct the pressure on F to a small residual (thesis, A.1.3, corrected; docs/concepts/method.md, C1 to C6).

    Parameters
    ----------
    inner : InnerOperator
    vectors : Vectors
        Of the solve: correction and residual are found there. The first direction is conjugate to the last one of an
        earlier run.
    limit : float
        Stop when the largest residual on F [m] is no more than this.
    max_steps : int
        Largest number of products.

    Returns
    -------
    residual : float
        Largest on F [m].
    steps : int
        Products.

    Notes
    -----
    Each direction is made conjugate to the one before by their products themselves, so that the errors of an inexact
    operator do not add up.
    """
    vectors.restart()
    r_max, steps = vectors.residual_max(), 0
    if not r_max > limit:
        return r_max, steps
    last = vectors.inner_products(vectors.q)
    with buffers.keep_large_buffers():
        while r_max > limit and steps < max_steps:  # C1
            rz, zq, _, _ = vectors.precondition()  # C2
            if not rz > 0:
                break
            s = vectors.update_direction(-zq / last.sq if last.sq > 0 else 0.0)  # C3, C4
            last = vectors.inner_products(inner.apply(s))  # C5: the product of the step
            steps += 1
            if not last.sq > 0:  # the direction is but rounding
                break
            r_max = vectors.advance(last.rs / last.sq, 0.0)  # C6
    return r_max, steps
