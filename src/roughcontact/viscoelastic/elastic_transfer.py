r"""From an elastic loading curve to a viscoelastic history with one rise and one fall, without a further solve.

If F = E* Phi(d) is the elastic law of any frictionless contact - a rough surface's as well as a sphere's - then

    F(t) = \int_0^t E(t - s) dPhi(d(s))          Phi(d(t)) = \int_0^t J(t - s) dF(s)

as long as no point leaves the contact (Lee & Radok, J. Appl. Mech. 27, 438 (1960); Radok, Quart. Appl. Math. 15, 198
(1957)). While the contact recedes (Ting, J. Appl. Mech. 33, 845 (1966)) it is the elastic one at d(t_1), with

    \int_{t_1}^t E(t - s) dd(s) = 0              F(t) = \int_0^{t_1} E(t - s) dPhi(d(s))

The growth is integrated with Phi and d quadratic in small steps; exponentials are integrated exactly.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from roughcontact.errors import InputError
from roughcontact.validation import Array, exactly_one, number, numeric, require, shown
from roughcontact.viscoelastic.prony_series import Viscoelastic
from roughcontact.viscoelastic.rise_and_fall import ROUNDING, ElasticLaw, RiseAndFall
from roughcontact.viscoelastic.time_history import checked_history

__all__ = ["ElasticCurve", "Transfer", "transfer"]


class ElasticCurve(Protocol):
    """The attributes of a curve that the transfer needs: `Curve` and `IndentationCurve` have them.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.mdr import indentation, indenter
    >>> ball = rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4)
    >>> computed = rc.loading_curve(ball, 1e9, forces=[1e-2])
    >>> exact = indentation.indentation_curve(indenter.paraboloid(1e-4), 1e9, forces=[1e-2])
    >>> [f"{each.depth[0] * 1e9:.0f} nm, {each.contact_area[0] * 1e12:.0f} um^2" for each in (computed, exact)]
    ['823 nm, 260 um^2', '825 nm, 259 um^2']
    """

    @property
    def force(self) -> Array:
        """Force [N], shape (n,)."""

    @property
    def depth(self) -> Array:
        """Depth [m], shape (n,)."""

    @property
    def contact_area(self) -> Array:
        """Contact area [m^2], shape (n,)."""

    @property
    def modulus(self) -> float:
        """Reduced modulus [Pa]."""


@dataclass(frozen=True, slots=True, eq=False)
class Transfer:
    """A loading history on a viscoelastic half-space.

    Attributes
    ----------
    time : array, shape (n,)
        [s].
    force, depth, contact_area : array, shape (n,)
        [N], [m], [m^2].
    elastic_force : array, shape (n,)
        Force of the elastic contact of the same size [N]: use it to look up other quantities on the curve.
    growth_time : array, shape (n,)
        t_1 [s], the time at which the growing contact had this size; `time` itself while the contact grows.
    interpolation_error : float
        Estimated error of force, depth and area from the points of the curve [-]: the largest change if every second
        point is left out, relative to the largest value.

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact import viscoelastic
    >>> from roughcontact.mdr import indentation, indenter
    >>> curve = indentation.indentation_curve(indenter.paraboloid(1e-2), 1e9, forces=np.geomspace(1e-3, 1e3, 61))
    >>> soft = viscoelastic.standard_solid(1e8, 1e9, 1.0)
    >>> held = viscoelastic.transfer(curve, soft, [0.0, 100.0], forces=[1.0, 1.0])
    >>> round(float(held.contact_area[1] / held.contact_area[0]), 2)  # 10^(2/3)
    4.64
    """

    time: Array
    force: Array
    depth: Array
    contact_area: Array
    elastic_force: Array
    growth_time: Array
    interpolation_error: float

    def __len__(self) -> int:
        return len(self.time)


@numeric(times="s", forces="N", depths="m")
def transfer(
    curve: ElasticCurve,
    material: Viscoelastic,
    times: Sequence[float] | Array,
    *,
    forces: Sequence[float] | Array | float | None = None,
    depths: Sequence[float] | Array | float | None = None,
) -> Transfer:
    """Transfer an elastic loading curve to a viscoelastic material, for a load that rises once and then falls once.

    Parameters
    ----------
    curve : Curve, IndentationCurve or alike
        Elastic curve with increasing forces and depths.
    material : Viscoelastic
        For example by `standard_solid` or `from_dma` of `roughcontact.viscoelastic`.
    times : array, shape (n,)
        Not decreasing [s]; a repeated time is a jump. There is no load before the first time.
    forces, depths : float or array, shape (n,), optional
        Give exactly one: force [N] or depth [m], linear between the times. One number is a sudden constant load.

    Returns
    -------
    Transfer
        Exact up to the interpolation on the curve (monotone cubic in the logarithms), whose error is estimated. Below
        its first point the curve continues as a power law, only for the part of the history with smaller loads. With a
        dashpot, the force where the rate of the depth changes is the mean of both sides.

    Raises
    ------
    ValueError
        If an argument is of the wrong kind, the load rises twice, the contact grows after it has receded, a load leaves
        the curve, a time leaves the band of the material, or a depth jumps although there is a dashpot.

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact import viscoelastic
    >>> from roughcontact.mdr import indentation, indenter
    >>> elastic = indentation.indentation_curve(indenter.paraboloid(1e-2), 1e8, forces=np.geomspace(1e-5, 10, 90))
    >>> soft = viscoelastic.standard_solid(1e8, 1e9, 1.0)
    >>> creep = viscoelastic.transfer(elastic, soft, [0.0, 100.0], forces=1.0)
    >>> round(float(creep.elastic_force[1] / creep.elastic_force[0]), 4)  # ten times softer in the end
    9.9996
    >>> cycle = viscoelastic.transfer(elastic, soft, [0.0, 1.0, 1.5, 2.0], depths=[0.0, 1e-5, 5e-6, 0.0])
    >>> cycle.force.round(4).tolist(), cycle.growth_time.round(3).tolist()
    ([0.0, 3.0509, 0.0628, 0.0], [0.0, 1.0, 0.13, 0.0])
    """
    name, given = exactly_one(forces=forces, depths=depths)
    loads = number(given, name)
    if missing := [
        name for name in ("force", "depth", "contact_area", "modulus") if not hasattr(curve, name)
    ]:
        raise InputError(
            "an elastic loading curve is needed, for example from rc.loading_curve or indentation_curve, not "
            f"{shown(curve)} without {', '.join(missing)}",
            place="curve",
        )
    many = np.full(np.shape(times), loads) if np.ndim(loads) == 0 else loads
    t, load = checked_history(material, times, many)
    require(load >= 0, f"loads must not be negative, but the least is {load.min():g}", place=name)
    rows = _points(curve)
    history = RiseAndFall.of(material, t, load, name, rows[1])
    found = history.on(ElasticLaw.of(rows))
    used = found[3][found[3] > 0]
    if used.min(initial=np.inf) < rows[0, 0] * (1 - ROUNDING):
        raise InputError(
            f"the elastic curve begins at a force of {rows[0, 0] * curve.modulus:g} N, and the history needs "
            f"{used.min() * curve.modulus:g} N",
            "compute the curve for more loads",
        )
    count = rows.shape[1]
    half = history.on(ElasticLaw.of(rows[:, sorted({*range(1, count, 2), count - 1})]))
    changes = np.abs(half[:3] - found[:3]).max(axis=1) / np.maximum(np.abs(found[:3]).max(axis=1), 1e-300)
    force, depth, area, phi, growth_time = found
    return Transfer(t, force, depth, area, phi * curve.modulus, growth_time, float(changes.max()))


def _points(curve: ElasticCurve) -> Array:
    """Return F/E*, depth and contact area in rows, at the points of a curve where all are positive."""
    rows = np.array([np.asarray(curve.force) / curve.modulus, curve.depth, curve.contact_area])
    rows = rows[:, (rows > 0).all(axis=0)]
    if rows.shape[1] < 3 or (np.diff(rows[:2], axis=1) <= 0).any():
        raise InputError(
            "the elastic curve must have at least three points of increasing force and depth",
            "compute the curve for more loads",
            "curve",
        )
    return rows
