"""Partial slip of any contact, from only its frictionless loading curve.

The traction is mu times the increase of the pressure from a smaller force, ``q = mu [p(F) - p(F - Q/mu)]``. The
displacement is therefore mu E*/G* times the increase of the depth, and the sticking region is the contact at the
smaller force (Ciavarella, Int. J. Solids Struct. 35, 2349 (1998); Jaeger, Arch. Appl. Mech. 68, 27 (1998)). This is
exact on a line and for Poisson's ratio 0; otherwise slip is assumed to be along the force, and the ratio E*/G* of a
disc is used.

F stays constant while Q rises from zero. `loading` is a law that predicts ``"depth"`` or ``"stiffness"``, or a computed
curve: it is interpolated by monotone cubics in the logarithms from its lowest to its highest force, and has the depth
0 without force; other forces raise an error.
"""

from __future__ import annotations

import numpy as np
from scipy.integrate import quad

from roughcontact.theory.law import LoadingLaw
from roughcontact.theory.tools.computed import ComputedCurve, as_law
from roughcontact.validation import Array, numeric, positive, positive_scalar, require, scalar

__all__ = ["cycle_loss", "displacement", "stiffness"]


@numeric
def displacement(
    loading: LoadingLaw | ComputedCurve,
    force: float,
    tangential: float | Array,
    *,
    friction: float,
    ratio: float,
) -> Array:
    """Return the tangential displacement [m], ``mu (E*/G*) [d(F) - d(F - Q/mu)]``.

    Parameters
    ----------
    loading : LoadingLaw or computed curve
        Depth d of the frictionless contact as a function of the force: a law that predicts it, or a curve with
        arrays ``force``, ``depth`` and ``stiffness``, such as a `Curve` or an `IndentationCurve`.
    force : float
        Normal force F [N].
    tangential : float or array
        Q [N], at most mu F.
    friction : float
        Coefficient of friction mu [-].
    ratio : float
        E*/G* [-], see `mindlin.ratio`.

    Returns
    -------
    float or array
        Displacement of the bodies [m].

    Raises
    ------
    ValueError
        If the law does not predict the depth, or not at F and F - Q/mu, a number is out of range, or Q above mu F.

    Examples
    --------
    >>> from roughcontact.theory import hertz, jaeger, mindlin
    >>> sphere = hertz.law(radius=1e-2, modulus=1e11)
    >>> gross = mindlin.gross_slip(sphere.predict("depth", 1.0), 0.3, 1.2)
    >>> round(float(jaeger.displacement(sphere, 1.0, 0.3, friction=0.3, ratio=1.2) / gross), 6)  # at Q = mu F
    1.0
    """
    law, held = as_law(loading), _held(force, tangential, friction)
    gained = _known(law, "depth", positive(force, "the force [N]")) - _known(law, "depth", held)
    return np.asarray(friction * positive(ratio, "the ratio E*/G*") * gained)


@numeric
def stiffness(
    loading: LoadingLaw | ComputedCurve,
    force: float,
    tangential: float | Array,
    *,
    friction: float,
    ratio: float,
) -> Array:
    """Return dQ/d displacement [N/m], ``(G*/E*) k(F - Q/mu)``, of a law that predicts the stiffness k.

    Parameters as of `displacement`.

    Parameters
    ----------
    loading : LoadingLaw or computed curve
        Frictionless loading: a law, or a curve in points.
    force : float
        Normal force F [N].
    tangential : float or array
        Tangential force Q, at most mu F [N].
    friction : float
        Coefficient of friction mu [-].
    ratio : float
        E*/G* [-], see `mindlin.ratio` and `mindlin.pair_ratio`.

    Returns
    -------
    float or array
        k_t [N/m].

    Examples
    --------
    >>> from roughcontact.theory import hertz, jaeger
    >>> sphere = hertz.law(radius=1e-2, modulus=1e11)
    >>> start = jaeger.stiffness(sphere, 1.0, 0.0, friction=0.3, ratio=1.2)
    >>> round(float(start / sphere.predict("stiffness", 1.0)), 6)  # 1/ratio while nothing slips
    0.833333
    """
    held = _held(force, tangential, friction)
    return np.asarray(_known(as_law(loading), "stiffness", held) / positive(ratio, "the ratio E*/G*"))


@numeric
def cycle_loss(
    loading: LoadingLaw | ComputedCurve, force: float, amplitude: float, *, friction: float, ratio: float
) -> float:
    """Return the work [J] that friction dissipates in a cycle between +Q1 and -Q1 [N].

    ``W = 4 Q1 D(Q1) - 8 int_0^Q1 D dQ`` with the displacement D as Q rises from zero: the branches of a cycle are
    copies of that curve at twice the scale (Masing's rule). Parameters as of `displacement`.

    Parameters
    ----------
    loading : LoadingLaw or computed curve
        Frictionless loading: a law, or a curve in points.
    force : float
        Normal force F [N].
    amplitude : float
        Largest tangential force of the cycle, at most mu F [N].
    friction : float
        Coefficient of friction mu [-].
    ratio : float
        E*/G* [-], see `mindlin.ratio` and `mindlin.pair_ratio`.

    Returns
    -------
    float
        Work [J].

    Examples
    --------
    >>> from roughcontact.theory import cattaneo, hertz, jaeger
    >>> loss = jaeger.cycle_loss(hertz.law(1e-2, 1e11), 1.0, 0.15, friction=0.3, ratio=1.2)
    >>> round(loss / float(cattaneo.SlippingSphere(1.0, 1e-2, 1e11, 0.3, 1.2).cycle_loss(0.15)), 6)
    1.0
    """
    law = as_law(loading)

    def rise(tangential: float) -> float:
        return float(displacement(law, force, tangential, friction=friction, ratio=ratio))

    positive(scalar(amplitude, "the amplitude [N]"), "the amplitude [N]", zero=True)
    area, _ = quad(rise, 0, amplitude, epsabs=0, epsrel=1e-10, limit=200)
    return 4 * amplitude * rise(amplitude) - 8 * area


def _held(force: float, tangential: float | Array, friction: float) -> Array:
    """Return the force F - Q/mu [N] whose contact is the sticking region."""
    pressed = positive_scalar(force, "the force [N]")
    pulled = positive(tangential, "the tangential force [N]", zero=True) / positive(
        friction, "the friction coefficient"
    )
    require(
        pulled <= pressed,
        f"the tangential force exceeds mu F = {friction * pressed:g} N, at which the contact slides",
        place="tangential",
    )
    return np.asarray(pressed - pulled)


def _known(law: LoadingLaw, quantity: str, force: Array) -> Array:
    """Return a quantity at forces [N], and refuse those at which the law does not predict it."""
    values = law.predict(quantity, force)
    require(
        ~np.isnan(values),
        f"{law.name} has no {quantity} at every force from F - Q/mu to F",
        "take a smaller Q, or a curve of more points",
        value=force,
    )
    return values
