"""One step in time of a viscoelastic half-space whose displacement is linear within the step.

With A the product of the elastic operator, the strain-like field X and the elements r_k obey

    u = A X,    p = m X + sum r_k + c X',    r_k' = -r_k/tau_k + m_k X'

in units of a reference modulus. Over a step dt, with x = dt/tau_k, e = exp(-x) and phi = (1 - e)/x,

    r_k <- e r_k + m_k phi (X_new - X),    p = M q,    X_new = past + q,    M = m + sum m_k phi + c/dt.

So a step is an elastic contact with the modulus M, whose separation is that of the surface displaced by A past. All
fields are sums of the fields before and of q: a step is a matrix, which also gives their inner products.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from roughcontact.arrays import is_numpy, multiply, namespace
from roughcontact.kernels import buffers
from roughcontact.validation import Array
from roughcontact.viscoelastic.prony_series import Viscoelastic

__all__ = ["Transition"]


@dataclass(frozen=True, slots=True, eq=False)
class Transition:
    """The numbers of a step; moduli in units of the reference modulus.

    Attributes
    ----------
    moduli, ratios : array, shape (k,)
        m_k, and x, the step over the relaxation time.
    equilibrium : float
        m.
    viscous : float
        c/dt; 0 for a jump, under which only a body at rest has a dashpot.
    """

    moduli: Array
    ratios: Array
    equilibrium: float
    viscous: float

    @classmethod
    def of(cls, material: Viscoelastic, reference: float, step: float) -> Transition:
        """Return the numbers for a material and a step [s], 0 for a jump, with a reference modulus [Pa]."""
        return cls(
            np.array(material.moduli, np.float64) / reference,
            step / np.array(material.times, np.float64),
            material.equilibrium / reference,
            material.dashpot / (reference * step) if step else float(material.instantaneous == 0),
        )

    @property
    def kept(self) -> Array:
        """The factors e of the elements over the step, shape (k,)."""
        return np.exp(-self.ratios)

    @property
    def taken(self) -> Array:
        """The factors phi, shape (k,): what an element keeps of a uniform change of the strain."""
        positive = self.ratios > 0
        return np.divide(-np.expm1(-self.ratios), self.ratios, out=np.ones_like(self.ratios), where=positive)

    @property
    def modulus(self) -> float:
        """M, the modulus of the step."""
        return self.equilibrium + self.viscous + float(self.moduli @ self.taken)

    @property
    def past(self) -> Array:
        """Factors of X and r_k in the strain at the end of a step without pressure, shape (k + 1,)."""
        whole = self.modulus
        return np.append((whole - self.equilibrium) / whole, -self.kept / whole)

    @property
    def change(self) -> Array:
        """Factors of X, r_k and q in the change of the strain, shape (k + 2,)."""
        factors = np.append(self.past, 1.0)
        factors[0] -= 1.0
        return factors

    @property
    def matrix(self) -> Array:
        """Factors of X, r_k and q in X and r_k at the end of the step, shape (k + 1, k + 2)."""
        kept, gained = self._kept_and_gained
        own: Array = np.eye(len(kept), len(kept) + 1) * kept[:, None]
        return own + np.outer(gained, self.change)

    def after(self, fields: Any, change: Any) -> Any:
        """Return X and r_k, shape (k + 1, ...), after a change of X."""
        kept, gained = self._kept_and_gained
        ended = (
            buffers.empty(fields.shape, np.float64)
            if is_numpy(fields)
            else namespace(fields).empty_like(fields)
        )
        for place, (own, factor) in enumerate(zip(kept.tolist(), gained.tolist(), strict=True)):
            ended[place] = multiply(fields[place], own)
            ended[place] += multiply(change, factor)
        return ended

    @property
    def _kept_and_gained(self) -> tuple[Array, Array]:
        return np.append(1.0, self.kept), np.append(1.0, self.moduli * self.taken)

    @property
    def middle(self) -> Array:
        """Factors of X, r_k and q in the pressure in the middle of the step, shape (k + 2,)."""
        half = Transition(self.moduli, self.ratios / 2, self.equilibrium, 2 * self.viscous)
        return np.concatenate([[self.equilibrium], half.kept, [0.0]]) + 0.5 * half.modulus * self.change

    def mean_force(self, totals: Array) -> float:
        """Return the force averaged over the step, from the totals of X, r_k and q, shape (k + 2,) [N]."""
        x, taken = self.ratios, self.taken
        averaged = np.where(x < 1e-4, 0.5 - x / 6, (1 - taken) / np.maximum(x, 1e-300))
        own = self.equilibrium * totals[0] + float(taken @ totals[1:-1])
        factor = 0.5 * self.equilibrium + self.viscous + float(self.moduli @ averaged)
        return float(own + factor * (self.change @ totals))

    def dissipated(self, products: Array) -> float:
        """Return the energy that dashpots dissipate [J], from inner products of X, r_k and q, shape (k + 2,) * 2."""
        x, lost, change = self.ratios, -np.expm1(-self.ratios), self.change
        squared = float(change @ products @ change)
        # An element that starts at rest: a series where its terms would cancel.
        series = x * (1 / 3 - x * (1 / 4 - x * (7 / 60 - x / 24)))
        closed = (x - 2 * lost - np.expm1(-2 * x) / 2) / np.maximum(x, 1e-300) ** 2
        damped = self.moduli * np.where(x < 1e-2, series, closed)
        own = self._over_moduli(np.diag(products)[1:-1]) * lost * (1 - lost / 2)
        mixed = (products @ change)[1:-1] * lost * self.taken
        return float(squared * (self.viscous + damped.sum()) + (own + mixed).sum())

    def stored(self, products: Array) -> float:
        """Return the energy of the springs [J], from the inner products of X and r_k, shape (k + 1, k + 1)."""
        own = np.diag(products)
        return 0.5 * float(self.equilibrium * own[0] + self._over_moduli(own[1:]).sum())

    def _over_moduli(self, values: Array) -> Array:
        """Return values of the elements over their moduli; 0 for an element without modulus."""
        return np.divide(values, self.moduli, out=np.zeros_like(values), where=self.moduli > 0)
