"""Single precision inside, double precision outside: iterative refinement of the pressure on a region."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import namespace
from roughcontact.contact.conjugate_gradient import Relaxed, relax
from roughcontact.contact.measure import Measure
from roughcontact.halfspace.operator import Linear

__all__ = ["relax_in_single"]

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]

# What one round can take off an error: single precision has seven digits, and a product loses one or two.
GAIN = 1e-4


def relax_in_single(
    operator: Linear,
    region: Mask,
    separation: Array,
    pressure: Array,
    displacement: Array,
    *,
    depth: float | None,
    limit: float,
    max_steps: int,
) -> Relaxed:
    """Solve as `relax` does, its corrections in single precision, its errors by products in double precision.

    Each round solves for what the error asks for, as far as single precision goes, and adds it to the pressure.
    """
    measure, xp = Measure(operator.weights), namespace(pressure)
    p, u, steps, error = pressure, displacement, 0, np.inf
    while True:
        level = u + separation
        d = measure.mean(level, region) if depth is None else depth
        residual = xp.where(region, d - xp.where(region, level, d), 0.0)
        before, error = error, float(xp.max(xp.abs(residual)))
        if error <= limit or steps >= max_steps or not error < before / 2:
            return Relaxed(p, u, d, error, steps)
        wanted = xp.astype(-residual / error, xp.float32)
        zero = xp.zeros_like(wanted)
        found = relax(
            operator,
            region,
            wanted,
            zero,
            zero,
            depth=None if depth is None else 0.0,
            limit=max(GAIN, 0.3 * limit / error),
            max_steps=max_steps - steps,
        )
        p = p + error * xp.astype(found.pressure, xp.float64)
        u, steps = operator.apply(p), steps + found.steps + 1
