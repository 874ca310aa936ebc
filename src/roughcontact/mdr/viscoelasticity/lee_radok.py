r"""From an elastic loading curve to a viscous or viscoelastic one, for a growing contact (thesis, chapter 4).

If F = E* Phi(d) is the elastic law of any frictionless contact - a rough surface's as well as a sphere's - then
(Lee & Radok, J. Appl. Mech. 27, 438 (1960); Radok, Quart. Appl. Math. 15, 198 (1957))

    F(t) = \int_0^t E(t - s) dPhi(d(s))          Phi(d(t)) = \int_0^t J(t - s) dF(s)

as long as no point leaves the contact; the contact at any time is the elastic one at the same depth.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from roughcontact.errors import InputError
from roughcontact.theory.tools.computed import LogCubic
from roughcontact.validation import Array, exactly_one, number, require, shown
from roughcontact.viscoelastic.prony_series import Viscoelastic, checked_material
from roughcontact.viscoelastic.time_history import checked_history

__all__ = ["ElasticCurve", "Transfer", "transfer"]

ROUNDING = 1e-12  # of the largest value: a decrease below this is rounding


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
        Force of the elastic contact at the same depth [N]: use it to look up other quantities on the curve.

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact import viscoelastic
    >>> from roughcontact.mdr import indentation, indenter, lee_radok
    >>> curve = indentation.indentation_curve(indenter.paraboloid(1e-2), 1e9, forces=np.geomspace(1e-3, 1e3, 61))
    >>> soft = viscoelastic.standard_solid(1e8, 1e9, 1.0)
    >>> held = lee_radok.transfer(curve, soft, [0.0, 100.0], forces=[1.0, 1.0])
    >>> round(float(held.contact_area[1] / held.contact_area[0]), 2)  # 10^(2/3)
    4.64
    """

    time: Array
    force: Array
    depth: Array
    contact_area: Array
    elastic_force: Array

    def __len__(self) -> int:
        return len(self.time)


def transfer(
    curve: ElasticCurve,
    material: Viscoelastic,
    times: Sequence[float] | Array,
    *,
    forces: Sequence[float] | Array | float | None = None,
    depths: Sequence[float] | Array | float | None = None,
) -> Transfer:
    """Transfer an elastic loading curve to a viscoelastic material.

    Parameters
    ----------
    curve : Curve, IndentationCurve or alike
        Elastic curve with increasing forces and depths.
    material : Viscoelastic
        Made by `standard_solid`, `maxwell`, `kelvin_voigt`, `viscous` or `prony`.
    times : array, shape (n,)
        Not decreasing [s]; a repeated time is a jump. There is no load before the first time.
    forces, depths : float or array, shape (n,), optional
        Give exactly one: force [N], linear between the times, or depth [m]. One number is a sudden constant load.

    Returns
    -------
    Transfer
        Under given forces it is exact up to the interpolation on the curve, monotone cubic in the logarithms. Under
        given depths Phi is linear between the times: the error falls as the square of the step.

    Raises
    ------
    ValueError
        If an argument is of the wrong kind, the contact shrinks at some time, a load leaves the curve, or a depth
        jumps although there is a dashpot.

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact import viscoelastic
    >>> from roughcontact.mdr import indentation, indenter, lee_radok
    >>> elastic = indentation.indentation_curve(indenter.paraboloid(1e-2), 1e8, forces=np.geomspace(1e-3, 10, 60))
    >>> soft = viscoelastic.standard_solid(1e8, 1e9, 1.0)
    >>> creep = lee_radok.transfer(elastic, soft, [0.0, 100.0], forces=1.0)
    >>> round(float(creep.elastic_force[1] / creep.elastic_force[0]), 4)  # ten times softer in the end
    9.9996
    """
    name, given = exactly_one(forces=forces, depths=depths)
    loads = number(given, name)
    checked_material(material)
    if missing := [
        name for name in ("force", "depth", "contact_area", "modulus") if not hasattr(curve, name)
    ]:
        raise InputError(
            "an elastic loading curve is needed, for example from rc.loading_curve or indentation_curve, not "
            f"{shown(curve)} without {', '.join(missing)}",
            place="curve",
        )
    t, load = checked_history(times, np.full(np.shape(times), loads) if np.ndim(loads) == 0 else loads)
    require(load >= 0, f"loads must not be negative, but the least is {load.min():g}")
    points = _points(curve)
    if forces is None:
        _growing(t, load, "depth")
        phi = _look_up(points[1], points[0], load, "depth") / curve.modulus
        force = _resisting(material, t, phi)
        depth = load
    else:
        force = load
        phi = _creeping(material, t, load)
        _growing(t, phi, "contact")
        depth = _look_up(points[0], points[1], phi * curve.modulus, "elastic force")
    elastic = phi * curve.modulus
    area = _look_up(points[0], points[2], elastic, "elastic force")
    return Transfer(t, force, depth, area, elastic)


def _creeping(material: Viscoelastic, t: Array, force: Array) -> Array:
    """Return the convolution of the creep function with a force that is linear between the times [m^2]."""
    creep = material.creep()
    thetas, compliances = np.array(creep.times), np.array(creep.compliances)
    phi = np.empty_like(t)
    flowed, retarded = 0.0, np.zeros(len(thetas))
    before, load = t[0], 0.0
    for index, (now, F) in enumerate(zip(t, force, strict=True)):
        h = now - before
        if h > 0:
            flowed += creep.fluidity * h * (load + F) / 2
            part = -np.expm1(-h / thetas)
            # theta e' + e = J F(t) with F linear over the step
            retarded += (compliances * load - retarded) * part + compliances * (F - load) * (
                1 - part * thetas / h
            )
        before, load = now, F
        phi[index] = creep.instantaneous * F + flowed + retarded.sum()
    return phi


def _resisting(material: Viscoelastic, t: Array, phi: Array) -> Array:
    """Return the convolution of the relaxation function with Phi, linear between the times [N]."""
    taus, moduli = np.array(material.times), np.array(material.moduli)
    force = material.equilibrium * phi
    elements = np.zeros(len(taus))
    before, last = t[0], 0.0
    for index, (now, value) in enumerate(zip(t, phi, strict=True)):
        h, step = now - before, value - last
        if h > 0:
            part = -np.expm1(-h / taus)
            elements += -elements * part + moduli * taus * step / h * part
        else:
            if material.dashpot and step > 0:
                raise InputError("a dashpot admits no jump of the depth: its force would be infinite")
            elements += moduli * step
        before, last = now, value
        force[index] += elements.sum()
    if material.dashpot:
        if len(t) < 3 or (np.diff(t) == 0).any():
            raise InputError(
                "the force of a dashpot under a given depth needs at least three different times"
            )
        # Phi grows, but a parabola through the first three points may decrease at the first.
        force += material.dashpot * np.maximum(np.gradient(phi, t, edge_order=2), 0.0)
    return force


def _growing(t: Array, value: Array, what: str) -> None:
    """Refuse a history in which the contact shrinks."""
    if len(fall := np.nonzero(np.diff(value) < -ROUNDING * value.max())[0]):
        raise InputError(
            f"the {what} falls from t = {t[fall[0]]:g} s on: the transfer holds only while no point leaves the contact "
            "(Lee & Radok); for a body of revolution use depth_history or force_history"
        )


def _points(curve: ElasticCurve) -> Array:
    """Return force, depth and contact area in rows, at the points of a curve where all are positive."""
    rows = np.array([curve.force, curve.depth, curve.contact_area])
    rows = rows[:, (rows > 0).all(axis=0)]
    if rows.shape[1] < 2 or (np.diff(rows[:2], axis=1) <= 0).any():
        raise InputError("the elastic curve must have at least two points of increasing force and depth")
    return rows


def _look_up(at: Array, of: Array, value: Array, what: str) -> Array:
    """Return one column of a curve at a value of another; 0 at 0."""
    found = np.where(value > 0, LogCubic.of(at, of)(value), 0.0)
    if len(outside := value[np.isnan(found)]):
        raise InputError(
            f"the elastic curve goes from {what} {at[0]:g} to {at[-1]:g}, and the history needs "
            f"{outside.min():g} to {outside.max():g}",
            "compute the curve for more loads",
        )
    return found
