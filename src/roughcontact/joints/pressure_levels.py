"""Shear of an interface while the normal pressure varies, too: the state is a stack of levels of the pressure.

The traction of partial slip is a sum of steps of the frictionless pressure, each with its share between -mu and mu:
``tau = int lambda dp'`` over ``0 <= p' <= p``. The displacement is the same sum of the closures, ``s = C int lambda
dp'/K(p')``. A falling pressure removes levels from the top. A rising pressure adds a level. If a level would need more
than mu, the levels slip from the top down (Jäger, J. Tribol. 120, 677 (1998)). With constant pressure this is the
backbone and Masing's rule. It is exact under the same conditions as the law of shear.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from roughcontact.errors import InputError
from roughcontact.guesses import hinted
from roughcontact.joints.masing import ROUNDING
from roughcontact.joints.shear_law import BELOW, TOUCH, ShearLaw
from roughcontact.units import in_si
from roughcontact.validation import Array, finite, positive, require

__all__ = ["ShearHistory", "ShearLevels", "shear_history"]


@hinted
@dataclass(frozen=True, slots=True, eq=False)
class ShearLevels:
    """The state of an interface under shear: levels of the nominal pressure, from zero to the present one.

    Attributes
    ----------
    tops : array, shape (n,)
        Upper ends of the levels [Pa], increasing; each level begins at the end of the level below.
    shares : array, shape (n,)
        Traction over pressure of each level, between -mu and mu.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> levels = rc.ShearLevels(np.array([6.0, 8.0]), np.array([0.0, 0.3]))  # the upper quarter slips
    >>> round(levels.traction, 6)
    0.6
    """

    tops: Array
    shares: Array

    @property
    def bottoms(self) -> Array:
        """Lower ends of the levels [Pa]."""
        return np.append(0.0, self.tops[:-1])

    @property
    def traction(self) -> float:
        """Nominal tangential traction [Pa]."""
        return float(self.shares @ (self.tops - self.bottoms))


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class ShearHistory:
    """The answer of an interface to a history of nominal pressure and tangential traction.

    Attributes
    ----------
    pressure, traction : array, shape (n,)
        The history [Pa].
    displacement : array, shape (n,)
        Tangential displacement of the surfaces [m].
    dissipated : array, shape (n,)
        Energy that friction dissipates in the step that ends at the point [J/m^2].
    slipping : array, shape (n,)
        Fraction of the pressure whose levels slip in the step: the contact at the rest of the pressure sticks.
    levels : ShearLevels
        The state at the end.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> steel = rc.Solid(210e9, 0.3)
    >>> curve = rc.loading_curve(rc.examples.surface("ground"), (steel, steel), pressures=[1e6, 1e7, 3e7, 1e8])
    >>> law = rc.shear_law(curve, (steel, steel), friction=0.2)
    >>> phase = np.linspace(0, 4 * np.pi, 97)  # two cycles, pressure a quarter of a cycle ahead
    >>> history = law.history(5e7 * (1 + 0.5 * np.cos(phase)), 4e6 * np.sin(phase))
    >>> history
    ShearHistory(97 steps, p 2.5e+07 to 7.5e+07 Pa, 0.2159 J/m^2 dissipated)
    >>> f"{history.dissipated[49:].sum():.2g} J/m^2 a cycle, {history.slipping.max():.0%} of the pressure slips"
    '0.16 J/m^2 a cycle, 52% of the pressure slips'
    """

    pressure: Array
    traction: Array
    displacement: Array
    dissipated: Array
    slipping: Array
    levels: ShearLevels

    def __len__(self) -> int:
        return len(self.pressure)

    def __repr__(self) -> str:
        """Return the range of the history, without its arrays."""
        low, high = self.pressure.min(), self.pressure.max()
        return (
            f"ShearHistory({len(self)} steps, p {low:.4g} to {high:.4g} Pa, "
            f"{self.dissipated.sum():.4g} J/m^2 dissipated)"
        )


def shear_history(
    law: ShearLaw, pressures: Sequence[float] | Array, tractions: Sequence[float] | Array
) -> ShearHistory:
    """Return displacement and dissipated energy while pressure and traction vary, from a contact without traction.

    Parameters
    ----------
    law : ShearLaw
        The law of the interface.
    pressures : array, shape (n,)
        Nominal pressures in the order of time [Pa]; between two, both loads change in proportion. The first step
        begins without pressure and traction.
    tractions : array, shape (n,)
        Nominal tangential tractions [Pa], of one direction and either sign.

    Returns
    -------
    ShearHistory
        One point for each pair of loads.

    Raises
    ------
    ValueError
        If a traction exceeds mu p: the surfaces slide, and the displacement is not determined. If a pressure lies
        outside the normal law.

    Examples
    --------
    >>> import roughcontact as rc
    >>> steel = rc.Solid(210e9, 0.3)
    >>> curve = rc.loading_curve(rc.examples.surface("ground"), (steel, steel), pressures=[1e6, 1e7, 3e7, 1e8])
    >>> law = rc.shear_law(curve, (steel, steel), friction=0.2)
    >>> history = law.history([5e7, 5e7, 8e7, 4e7], [0.0, 5e6, 5e6, 5e6])
    >>> [f"{s * 1e9:.0f} nm" for s in history.displacement], [f"{part:.0%}" for part in history.slipping]
    (['0 nm', '45 nm', '45 nm', '61 nm'], ['0%', '50%', '0%', '62%'])
    """
    p = positive(in_si(pressures, "Pa", "pressures"), "pressures")
    tau = finite(in_si(tractions, "Pa", "tractions"), "tractions")
    if p.ndim != 1 or p.shape != tau.shape or not len(p):
        raise InputError(
            f"a history needs a traction for each pressure, not {p.shape} pressures and {tau.shape} tractions",
            "give two rows of the same length",
            "pressures, tractions",
        )
    sliding = np.flatnonzero(abs(tau) > law.friction * p * (1 + ROUNDING))
    if len(sliding):
        step = int(sliding[0])
        raise InputError(
            f"at step {step} the traction {tau[step]:g} Pa exceeds mu p = {law.friction * p[step]:g} Pa: the surfaces "
            "slide, and their displacement is not determined",
            "stop the history before this step, or give smaller tractions",
            "tractions",
        )
    levels, rows = ShearLevels(np.zeros(1), np.zeros(1)), []
    for step, load in enumerate(zip(p.tolist(), tau.tolist(), strict=True)):
        before, (levels, sticks) = levels, _loaded(levels, *load, law.friction)
        moving = levels.shares != 0
        bottoms, tops, shares = levels.bottoms[moving], levels.tops[moving], levels.shares[moving]
        low = law.normal.lowest * (1 - ROUNDING)
        require(bottoms >= low, f"at step {step}, {BELOW}", TOUCH, value=bottoms, place="tractions")
        closure = law.normal.gap_at(bottoms) - law.normal.gap_at(tops)
        rows.append(
            (
                law.ratio * float(shares @ closure),
                _dissipated(law, before, levels, sticks),
                1 - sticks / load[0],
            )
        )
    moved, lost, slipping = np.array(rows).T
    return ShearHistory(p, tau, moved, lost, slipping, levels)


def _loaded(
    levels: ShearLevels, pressure: float, traction: float, friction: float
) -> tuple[ShearLevels, float]:
    """Return the state after a straight path to other loads [Pa], and the pressure up to which its levels stick."""
    kept = levels.bottoms < pressure
    tops, shares = np.minimum(levels.tops[kept], pressure), levels.shares[kept]
    if (rise := pressure - levels.tops[-1]) > 0:
        share = np.clip((traction - levels.traction) / rise, -friction, friction)
        tops, shares = np.append(tops, pressure), np.append(shares, share)
    held = ShearLevels(tops, shares)
    missing = traction - held.traction
    if abs(missing) <= ROUNDING * friction * pressure:
        return held, pressure
    slip = np.copysign(friction, missing)
    # From the top down: the traction that the levels take until they slip, and the level that slips in part.
    takes = abs(slip - shares) * (tops - held.bottoms)
    above = np.cumsum(takes[::-1])[::-1]
    k = int(np.flatnonzero(above >= min(abs(missing), above[0]))[-1])
    sticks = held.bottoms[k] + max(above[k] - abs(missing), 0.0) / abs(slip - shares[k])
    return ShearLevels(np.array([*tops[:k], sticks, pressure]), np.append(shares[: k + 1], slip)), sticks


def _dissipated(law: ShearLaw, before: ShearLevels, after: ShearLevels, sticks: float) -> float:
    """Return the energy that friction dissipates while levels slip from the top down to a pressure [J/m^2].

    While the level at F begins to slip under the pressure P(F), the other levels above it slip by the change of the gap
    at F, so that ``C mu (mu - lambda) int [(P - F)/K(F) + g(P) - g(F)] dF`` is dissipated, with lambda before the step.
    """
    start, slip, normal = before.tops[-1], after.shares[-1], law.normal
    if sticks >= min(start, after.tops[-1]):
        return 0.0
    moving = before.tops > np.maximum(sticks, before.bottoms)
    f = np.append(sticks, before.tops[moving])
    shares, widths = before.shares[moving], np.diff(f)
    # P at each F, from the traction on the straight path
    taken = np.append(np.cumsum(((slip - shares) * widths)[::-1])[::-1], 0.0)
    rise = after.tops[-1] - start
    p = start + rise * taken / (after.traction - before.traction - slip * rise)
    at_f, at_p, energy = normal.gap_at(f), normal.gap_at(p), 0.0
    edges = (p - f) * at_f
    for i, width in enumerate(widths):
        low, high = sorted(p[i : i + 2])
        # Mean gaps over both ranges of pressure
        mean_f = at_f[i : i + 2].mean() - normal.bow(*f[i : i + 2]) / width
        mean_p = at_p[i : i + 2].mean() - (normal.bow(low, high) / (high - low) if high > low else 0.0)
        part = edges[i] - edges[i + 1] + width * (mean_p - 2 * mean_f) + (p[i + 1] - p[i]) * mean_f
        energy += abs(slip - shares[i]) * part
    return law.ratio * law.friction * float(energy)
