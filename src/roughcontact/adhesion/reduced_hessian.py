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
BLOCK = 2  # Ritz vectors that are improved
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
        The Ritz vector: the start of the next search. Empty without attraction.
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
    mask, number = free.astype(np.float64), float(np.count_nonzero(free))
    weight = np.where(free, curvature, 0.0)

    def project(x: Array) -> Array:
        x *= mask
        if form.mean_free:
            x -= mask * (x.sum() / number)
        return x

    def precondition(r: Array) -> Array:
        counter.products += 1
        return project(form.compliance(r))

    def image(x: Array) -> Array:
        counter.products += 1
        return form.stiffness(x) * mask

    block = max(BLOCK, len(start) + 1)
    # Large arrays are allocated once: a third takes what is computed from the other two.
    basis, images, spare = (np.empty((3 * block, *free.shape)) for _ in range(3))
    for k in range(block):  # E31
        given = k < len(start)
        basis[k] = (
            project(np.array(start[k])) if given else precondition(weight * rng.standard_normal(free.shape))
        )
        images[k] = image(basis[k])
    size = block
    for _ in range(STEPS):
        np.multiply(weight, basis[:size], out=spare[:size])
        coefficients, values = _ritz(form, basis[:size], images[:size], spare[:size])  # E32
        chosen = coefficients[:, :block].T
        count = len(chosen)
        # The contribution of the newer parts is the direction of the next step.
        newer = np.where(np.arange(size) < block, 0.0, chosen)
        both = np.concatenate([chosen, newer]) if size > block else chosen
        basis, spare = _combined(both, basis, spare), basis
        images, spare = _combined(both, images, spare), images
        size, block = len(both), count
        improved = zip(values[:BLOCK], images, basis, strict=False)
        residuals = [project((1 - v) * k - weight * y) for v, k, y in improved]
        preconditioned = [precondition(r) for r in residuals]
        value = float(values[0])
        bound = float(np.sqrt(max(0.0, form.dot(residuals[0], preconditioned[0]))))  # E33
        # E34
        if bound <= accuracy or (sign_only and (value < 0 or bound <= min(RELIABLE, value / 4))):
            break
        for z in preconditioned:
            basis[size], images[size] = z, image(z)
            size += 1
    return Ritz(value, bound, (np.array(basis[0]),), residuals[0])


def solved_bound(form: ElasticForm, free: Mask, ritz: Ritz) -> float:
    """Return the bound of a Ritz value by a solve, for a compliance that is not the inverse of the stiffness.

    Under a prescribed force the stiffness is that of a body whose depth is free, and the compliance gives no bound.
    """
    none = np.zeros(form.shape)
    solved, _ = conjugate_gradients(form, free, none, ritz.residual, 1e-6, Counter())
    return float(np.sqrt(max(0.0, form.dot(ritz.residual, solved))))


def _ritz(form: ElasticForm, basis: Array, images: Array, weighted: Array) -> tuple[Array, Array]:
    """Return the coefficients of the Ritz vectors and their values, from the smallest up."""
    elastic, adhesive = form.dots(basis, images), form.dots(basis, weighted)
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


def _combined(coefficients: Array, fields: Array, out: Array) -> Array:
    """Write one sum of the fields for each row of coefficients to the first fields of `out`, and return `out`."""
    count, size = coefficients.shape
    np.matmul(coefficients, fields[:size].reshape(size, -1), out=out[:count].reshape(count, -1))
    return out
