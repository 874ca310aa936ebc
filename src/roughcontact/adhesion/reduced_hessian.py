"""The smallest eigenvalue of the Hessian on the free cells, relative to the elastic Hessian, with a bound.

``(K - D) x = lambda K x`` on the free cells F, with D the curvature of the attraction: lambda is one without
attraction, and zero where a branch ends. It is found by the locally optimal block method (Knyazev, SIAM J. Sci. Comput.
23, 517 (2001)), with the compliance as preconditioner. A residual r of a vector of unit elastic norm means that an
eigenvalue lies within ``sqrt(r.(K_FF)^-1 r)`` of the Ritz value; that is at most ``sqrt(r.C_FF r)``, where C is the
inverse of K, because the inverse of a part is at most the part of the inverse.

Labels E31 to E34 are the lines of the algorithm in docs/concepts/method-adhesion.md.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.linalg

from roughcontact.adhesion.elastic_form import ElasticForm
from roughcontact.adhesion.truncated_newton import Counter, conjugate_gradients
from roughcontact.validation import Array, Mask

__all__ = ["Ritz", "smallest_ratio", "solved_bound"]

STEPS = 120
BLOCK = 2
RELIABLE = 0.02  # bound below which a sign is accepted
DEPENDENT = 1e-12  # of the largest: smaller directions of the basis are left out


@dataclass(frozen=True, slots=True, eq=False)
class Ritz:
    """A Ritz value with the bound of its distance from an eigenvalue.

    Attributes
    ----------
    value, bound : float
        An eigenvalue lies within `bound` of `value`; no eigenvalue is above one. The smallest is at most `value`.
    vectors : tuple of arrays
        Start vectors of the next search.
    residual : array
        Residual of the first vector, whose elastic norm is one.
    """

    value: float
    bound: float
    vectors: tuple[Array, ...]
    residual: Array

    @property
    def positive(self) -> bool:
        """Whether it is positive by more than its bound."""
        return self.value > self.bound


def smallest_ratio(
    form: ElasticForm,
    free: Mask,
    curvature: Array,
    counter: Counter,
    *,
    start: tuple[Array, ...] = (),
    accuracy: float = 1e-3,
    sign_only: bool = False,
    seed: int = 0,
) -> Ritz:
    """Return the smallest eigenvalue of ``(K - D) x = lambda K x`` on the free cells.

    Parameters
    ----------
    form : ElasticForm
    free : array of bool
        The cells that may move.
    curvature : array
        D [Pa/m].
    counter : Counter
        Counts products.
    start : tuple of arrays
        Vectors of a similar problem.
    accuracy : float
        Bound at which to stop.
    sign_only : bool
        Whether to stop as soon as the sign is known.
    seed : int
        Seed of additional start vectors.
    """
    if not np.any(free & (curvature > 0)):
        return Ritz(1.0, 0.0, (), np.zeros(free.shape))
    rng = np.random.default_rng(seed)
    number = float(np.count_nonzero(free))

    def project(x: Array) -> Array:
        x = np.where(free, x, 0.0)
        return np.where(free, x - x.sum() / number, 0.0) if form.mean_free else x

    def precondition(r: Array) -> Array:
        counter.products += 1
        return project(form.compliance(r))

    def image(x: Array) -> Array:
        counter.products += 1
        return np.where(free, form.stiffness(x), 0.0)

    weight = np.where(free, curvature, 0.0)
    first = [project(v) for v in start]  # E31
    block = max(BLOCK, len(start) + 1)
    while len(first) < block:
        first.append(precondition(weight * rng.standard_normal(free.shape)))
    basis, images = np.array(first), np.array([image(x) for x in first])
    value, bound, x, residual = 1.0, np.inf, basis, basis[0]
    for _ in range(STEPS):
        coefficients, values = _ritz(form, basis, images, weight)  # E32
        chosen = coefficients[:, :block].T
        x, kx = _combined(chosen, basis), _combined(chosen, images)
        residuals = [project((1 - v) * k - weight * y) for v, k, y in zip(values, kx, x, strict=False)]
        preconditioned = [precondition(r) for r in residuals]
        value, residual = float(values[0]), residuals[0]
        bound = float(np.sqrt(max(0.0, form.dot(residual, preconditioned[0]))))  # E33
        # E34
        if bound <= accuracy or (sign_only and (value < 0 or bound <= min(RELIABLE, value / 4))):
            break
        # The contribution of the newer parts is the direction of the next step.
        newer = chosen[:, block:]
        old = (
            [_combined(newer, fields[block:]) for fields in (basis, images)]
            if newer.size
            else [basis[:0]] * 2
        )
        basis = np.concatenate([x, preconditioned, old[0]])
        images = np.concatenate([kx, [image(s) for s in preconditioned], old[1]])
    return Ritz(value, bound, tuple(x), residual)


def solved_bound(form: ElasticForm, free: Mask, ritz: Ritz) -> float:
    """Return the bound of a Ritz value by a solve, for a compliance that is not the inverse of the stiffness.

    Under a prescribed force the stiffness is that of a body whose depth is free, and the compliance gives no bound.
    """
    none = np.zeros(form.shape)
    solved, _ = conjugate_gradients(form, free, none, ritz.residual, 1e-6, Counter())
    return float(np.sqrt(max(0.0, form.dot(ritz.residual, solved))))


def _ritz(form: ElasticForm, basis: Array, images: Array, weight: Array) -> tuple[Array, Array]:
    """Return the coefficients of the Ritz vectors and their values, from the smallest up."""
    elastic, adhesive = form.dots(basis, images), form.dots(basis, weight * basis)
    norms = np.sqrt(np.maximum(np.diagonal(elastic), 0.0))
    scale = np.divide(1.0, norms, out=np.zeros_like(norms), where=norms > 0)
    elastic = scale[:, None] * (elastic + elastic.T) / 2 * scale
    adhesive = scale[:, None] * (adhesive + adhesive.T) / 2 * scale
    norms_squared, vectors = scipy.linalg.eigh(elastic)
    kept = norms_squared > DEPENDENT * norms_squared[-1]
    whitened = vectors[:, kept] / np.sqrt(norms_squared[kept])
    ratios, inner = scipy.linalg.eigh(whitened.T @ adhesive @ whitened)
    coefficients = scale[:, None] * (whitened @ inner[:, ::-1])
    return np.asarray(coefficients), np.asarray(1 - ratios[::-1])


def _combined(coefficients: Array, fields: Array) -> Array:
    """Return one sum of the fields for each row of coefficients."""
    return np.asarray(np.tensordot(coefficients, fields, 1))
