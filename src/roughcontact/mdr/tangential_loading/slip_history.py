"""Histories of normal and tangential load, on springs that slip independently.

Each spring of the foundation sticks until its tangential force is mu times its normal force, and then slips (Popov &
Hess, Method of Dimensionality Reduction, 2015, chapter 5). Under a constant normal force this agrees with the theory
of Cattaneo and Mindlin for every history; under a changing one it follows the increments of Mindlin & Deresiewicz
(1953).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from roughcontact.errors import InputError
from roughcontact.materials import Modulus, as_modulus
from roughcontact.mdr.bodies.axisymmetric_profile import Profile
from roughcontact.mdr.bodies.indentation import indented
from roughcontact.theory.tools.roots import bisect
from roughcontact.validation import Array, Mask, exactly_one, number, numeric, positive_scalar, whole

__all__ = ["SlipHistory", "slip_history"]

History = float | Sequence[float] | Array


@dataclass(frozen=True, slots=True, eq=False)
class SlipHistory:
    """States of a body under normal and tangential load, in the order of the history.

    Attributes
    ----------
    normal_force, force : array, shape (n,)
        Normal and tangential force [N].
    depth, displacement : array, shape (n,)
        [m].
    dissipated : array, shape (n,)
        Energy lost by slip up to each state [J].

    Examples
    --------
    >>> from roughcontact.mdr import indenter, slip_history
    >>> history = slip_history.slip_history(
    ...     indenter.paraboloid(1e-2), 1e11, 8e10, 0.3, normal_force=[1.0] * 5, force=[0.0, 0.15, 0.0, -0.15, 0.15]
    ... )
    >>> len(history), f"{history.dissipated[-1] * 1e9:.2f} nJ lost"
    (5, '0.70 nJ lost')
    """

    normal_force: Array
    force: Array
    depth: Array
    displacement: Array
    dissipated: Array

    def __len__(self) -> int:
        return len(self.force)


@numeric
def slip_history(
    profile: Profile,
    modulus: Modulus,
    shear_modulus: float,
    friction: float,
    *,
    normal_force: History | None = None,
    depth: History | None = None,
    force: History | None = None,
    displacement: History | None = None,
    springs: int = 2000,
) -> SlipHistory:
    """Move a body through a history of normal and tangential loads.

    Parameters
    ----------
    profile : Profile
        The body, see `roughcontact.mdr.indenter`.
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or what it follows from.
    shear_modulus : float
        Reduced shear modulus G* [Pa].
    friction : float
        Coefficient of friction.
    normal_force, depth : float or array, shape (n,), optional
        Give exactly one: normal force [N] or depth [m]; a single number is constant. The body is first pressed to the
        first value, without tangential force.
    force, displacement : float or array, shape (n,), optional
        Give exactly one: tangential force [N] or displacement [m], starting at 0 after the first pressing.
    springs : int
        Number of springs from the axis to the largest contact radius. The errors fall as its square.

    Returns
    -------
    SlipHistory

    Raises
    ------
    ValueError
        If the histories do not fit together, or a force is more than friction can hold.

    Notes
    -----
    Between two states all loads change in proportion, and each step is exact for each spring.

    Examples
    --------
    >>> from roughcontact.mdr import indenter, slip_history
    >>> ball = indenter.paraboloid(1e-2)
    >>> path = slip_history.slip_history(ball, 1e11, 8e10, 0.3, normal_force=1.0, force=[0.2, 0.0, -0.2])
    >>> bool(path.displacement[1] > 0)  # slip that does not go back with the force
    True
    """
    normal, tangential, loads = _histories(normal_force, depth, force, displacement)
    E = as_modulus(modulus)
    G, mu = positive_scalar(shear_modulus, "shear_modulus"), positive_scalar(friction, "friction")
    whole(springs, "springs")
    curve = indented(profile, E, normal, loads[0] if normal == "force" else np.maximum(loads[0], 0))
    depths = curve.depth if normal == "force" else loads[0]
    width = float(curve.contact_radius.max()) / springs
    places: Array = width * (np.arange(springs, dtype=np.float64) + 0.5)
    g = profile.transform(places)
    # Friction depends on the sum of the springs, which is within 1/springs^2 of the force.
    capacity = [2 * mu * E * width * float(np.maximum(d - g, 0).sum()) for d in depths.tolist()]
    tau, place, lost = np.zeros(springs), 0.0, 0.0
    before = E * (depths[0] - g)
    states = []
    for d, load, most in zip(depths.tolist(), loads[1].tolist(), capacity, strict=True):
        now = E * (d - g)
        goal = load
        if tangential == "force":
            if abs(load) > most * (1 + 1e-9):
                raise InputError(f"friction holds at most {most:g} N: under {load:g} N the body slides away")
            goal = _displacement(tau, before, now, load, G=G, mu=mu, start=place, width=width)
        tau, loss = _step(tau, before, now, G * (goal - place), mu)
        lost += 2 * width * float(loss.sum()) / G
        place, before = goal, now
        states.append((2 * width * float(tau.sum()), place, lost))
    sums = np.array(states).T
    return SlipHistory(curve.force, sums[0], depths, sums[1], sums[2])


def _histories(
    normal_force: History | None, depth: History | None, force: History | None, displacement: History | None
) -> tuple[Literal["force", "depth"], Literal["force", "displacement"], Array]:
    """Return which loads are given, and both histories, shape (2, n)."""
    _, first = exactly_one(normal_force=normal_force, depth=depth)
    _, second = exactly_one(force=force, displacement=displacement)
    pair = [np.atleast_1d(number(values, "a history")) for values in (first, second)]
    if (
        any(one.ndim != 1 for one in pair)
        or len({one.size for one in pair} - {1}) > 1
        or not all(one.size for one in pair)
    ):
        raise InputError(
            f"histories must be numbers, or lists of one length, not of shapes {pair[0].shape} and {pair[1].shape}"
        )
    loads = np.array(np.broadcast_arrays(*pair))
    if not np.isfinite(loads).all():
        raise InputError(f"histories must be finite, not {loads[~np.isfinite(loads)][0]}")
    return "force" if depth is None else "depth", "force" if displacement is None else "displacement", loads


def _step(tau: Array, before: Array, now: Array, pull: float, mu: float) -> tuple[Array, Array]:
    """Return the tangential forces of the springs after a step, and the energy lost by slip (times G*).

    Parameters
    ----------
    tau : array, shape (n,)
        Tangential forces before, per length.
    before, now : array, shape (n,)
        Normal forces per length at both ends of the step, negative where a spring is not in contact.
    pull : float
        G* times the increment of the displacement.
    """
    change = now - before
    # The part of the step in which a spring is in contact: from its touch, or up to its release.
    part = np.ones_like(now)
    crossing = (before < 0) != (now < 0)
    on = np.maximum(before, now)
    part[crossing] = on[crossing] / np.abs(change[crossing])
    part[(before < 0) & (now < 0)] = 0.0
    start, end = mu * np.maximum(before, 0), mu * np.maximum(now, 0)
    drive = pull * part
    trial = tau + drive
    after = np.clip(trial, -end, end)
    slip = np.abs(trial - after)
    # Forces and limits are linear in the step: slip begins where they meet, and continues to the end.
    approach = drive * np.sign(trial) - (end - start)
    room = start - tau * np.sign(trial)
    met = np.clip(np.divide(room, approach, out=np.zeros_like(room), where=approach > 0), 0, 1)
    mean = (start + (end - start) * met + end) / 2
    return after, slip * mean


def _displacement(
    tau: Array, before: Array, now: Array, force: float, *, G: float, mu: float, start: float, width: float
) -> float:
    """Return the displacement at which the springs carry the tangential force."""
    reach = 2.5 * mu * float(np.maximum(np.abs(before), np.abs(now)).max()) / G

    def beyond(place: Array) -> Mask:
        after, _ = _step(tau, before, now, G * (float(place) - start), mu)
        return np.asarray(2 * width * float(after.sum()) > force)

    return float(bisect(beyond, np.asarray(start - reach), np.asarray(start + reach)))
