"""A body of revolution on a viscoelastic half-space under a history of depth or force.

While the contact grows and then recedes once, the springs give the exact solution of Lee & Radok (1960) and Ting
(J. Appl. Mech. 33, 845 (1966)); see Argatov & Popov, ZAMM 96, 956 (2016). In other cases, such as a body that returns
to a surface before it has recovered, they are a model.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from roughcontact.errors import about
from roughcontact.mdr.bodies.axisymmetric_profile import Profile
from roughcontact.mdr.bodies.indentation import Indentation, indent
from roughcontact.mdr.viscoelasticity.viscoelastic_springs import Springs, ViscoelasticFoundation
from roughcontact.theory.tools.roots import bisect
from roughcontact.validation import Array, numeric, require, whole
from roughcontact.viscoelastic.prony_series import Viscoelastic
from roughcontact.viscoelastic.time_history import checked_history

__all__ = ["ViscoelasticHistory", "depth_history", "force_history"]


@dataclass(frozen=True, slots=True, eq=False)
class ViscoelasticHistory:
    """States of a body on a viscoelastic half-space.

    Attributes
    ----------
    time : array, shape (n,)
        [s].
    force : array, shape (n,)
        [N].
    depth : array, shape (n,)
        Depth of the body [m], relative to the surface before first touch.
    contact_radius : array, shape (n,)
        [m], extrapolated from the outer springs.

    Examples
    --------
    >>> from roughcontact import viscoelastic
    >>> from roughcontact.mdr import indenter, viscoelastic_history
    >>> soft = viscoelastic.standard_solid(1e8, 1e9, 1.0)
    >>> held = viscoelastic_history.depth_history(
    ...     indenter.paraboloid(1e-2), soft, [0.0, 0.0, 100.0], [0.0, 1e-5, 1e-5]
    ... )
    >>> len(held), (held.contact_radius * 1e6).round().tolist(), held.force.round(3).tolist()
    (3, [0.0, 316.0, 316.0], [0.0, 4.216, 0.422])
    """

    time: Array
    force: Array
    depth: Array
    contact_radius: Array

    def __len__(self) -> int:
        return len(self.time)


@numeric
def depth_history(
    profile: Profile,
    material: Viscoelastic,
    times: Sequence[float] | Array,
    depths: Sequence[float] | Array,
    *,
    springs: int = 1000,
) -> ViscoelasticHistory:
    """Move a body through a history of its depth.

    Parameters
    ----------
    profile : Profile
    material : Viscoelastic
    times : array, shape (n,)
        [s]; a repeated time is a jump. There is no contact before the first time.
    depths : array, shape (n,)
        [m], linear between the times.
    springs : int
        Number of springs from the axis to the largest contact radius; the error of the force falls as its square.

    Returns
    -------
    ViscoelasticHistory
        Its force at a time is that at the end of the preceding motion: the force of a dashpot jumps with the speed.

    Raises
    ------
    ValueError
        If the history is invalid, or jumps although there is a dashpot.

    Examples
    --------
    >>> from roughcontact import viscoelastic
    >>> from roughcontact.mdr import indenter, viscoelastic_history
    >>> soft = viscoelastic.standard_solid(1e8, 1e9, 1.0)
    >>> held = viscoelastic_history.depth_history(
    ...     indenter.paraboloid(1e-2), soft, [0.0, 0.0, 100.0], [0.0, 1e-5, 1e-5]
    ... )
    >>> round(float(held.force[1] / held.force[2]), 4)  # the force relaxes by E_0/E_inf
    10.0
    """
    t, d = checked_history(material, times, depths)
    require((d > 0).any(), f"the body never touches: its largest depth is {d.max():g} m")
    foundation = _foundation(material, indent(profile, 1.0, depth=float(d.max())), springs)
    state, before, at = foundation.untouched(), float(t[0]), 0.0
    states = []
    for now, depth in zip(t.tolist(), d.tolist(), strict=True):
        state = foundation.move(state, (at, depth), now - before)
        before, at = now, depth
        states.append((foundation.force(state, depth), depth, foundation.contact_radius(state, depth)))
    return ViscoelasticHistory(t, *np.array(states).T)


@numeric
def force_history(
    profile: Profile,
    material: Viscoelastic,
    times: Sequence[float] | Array,
    forces: Sequence[float] | Array,
    *,
    springs: int = 1000,
) -> ViscoelasticHistory:
    """Move a body through a history of its force.

    Parameters
    ----------
    profile : Profile
    material : Viscoelastic
    times : array, shape (n,)
        [s]; a repeated time is a jump. There is no contact before the first time.
    forces : array, shape (n,)
        [N], not negative, linear between the times.
    springs : int
        Number of springs from the axis to the largest contact radius.

    Returns
    -------
    ViscoelasticHistory
        The depth changes uniformly in each step, and the force is met at the end of the step, or with a dashpot in its
        middle. The error falls as the square of the step, except for the first moments, when the depth is not linear
        in time.

    Raises
    ------
    ValueError
        If the history is invalid.

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact import viscoelastic
    >>> from roughcontact.mdr import indenter, viscoelastic_history
    >>> soft, t = viscoelastic.standard_solid(1e8, 1e9, 1.0), np.linspace(0, 20, 41)
    >>> held = viscoelastic_history.force_history(
    ...     indenter.paraboloid(1e-2), soft, t, np.ones(41), springs=100
    ... )
    >>> creep = soft.creep()
    >>> round(float((held.depth[-1] / held.depth[0]) ** 1.5), 1), round(float(creep(20.0) / creep(0.0)), 1)
    (8.8, 8.8)
    """
    t, F = checked_history(material, times, forces)
    if (F < 0).any() or not F.any():
        raise about(
            "forces", f"must not be negative, and one must be positive [N], not {F.min():g} to {F.max():g}"
        )
    # No history up to this force can reach a larger contact than this force at all times.
    most = float(F.max()) * float(material.creep()(t[-1] - t[0]))
    largest = indent(profile, 1.0, force=most)
    foundation = _foundation(material, largest, springs)
    state, before, at, load = foundation.untouched(), float(t[0]), 0.0, 0.0
    states = []
    for now, force in zip(t.tolist(), F.tolist(), strict=True):
        if force == load == 0:  # a body without load follows the surface
            state = foundation.rest(state, now - before)
            at = float((state.place + foundation.transform).min())
        elif now > before or not material.dashpot:  # a dashpot needs time to move under a sudden force
            state, at = _loaded(foundation, state, at, now - before, (load, force), largest.depth)
        before, load = now, force
        states.append((force, at, foundation.contact_radius(state, at)))
    return ViscoelasticHistory(t, *np.array(states).T)


def _loaded(
    foundation: ViscoelasticFoundation,
    state: Springs,
    at: float,
    duration: float,
    force: tuple[float, float],
    scale: float,
) -> tuple[Springs, float]:
    """Return the springs and the depth after a step, with the force met at its end, or with a dashpot in its middle."""
    parts, goal = (2, sum(force) / 2) if foundation.material.dashpot else (1, force[1])

    def force_at(depth: float) -> float:
        return foundation.force(foundation.move(state, (at, depth), duration / parts), depth)

    met = _depth(force_at, goal, at, scale)
    end = at + 2 * (met - at) if parts == 2 else met
    return foundation.move(state, (at, end), duration), end


def _depth(force: Callable[[float], float], goal: float, start: float, scale: float) -> float:
    """Return the largest depth at which the force does not exceed the goal."""
    low = high = start
    width = 1e-3 * scale
    while force(high) <= goal:
        low, high, width = high, high + width, 2 * width
    width = 1e-3 * scale
    while force(low) > goal:
        low, high, width = low - width, low, 2 * width
    if goal > 0:
        return float(brentq(lambda d: force(d) - goal, low, high, xtol=1e-15 * scale))
    return float(bisect(lambda d: np.asarray(force(float(d)) > goal), np.asarray(low), np.asarray(high)))


def _foundation(material: Viscoelastic, largest: Indentation, springs: int) -> ViscoelasticFoundation:
    """Return the springs under the largest contact."""
    profile, width = largest.profile, largest.contact_radius / whole(springs, "springs")
    require(
        profile.rises,
        "if the transform of a body decreases somewhere, the contact is not one disc at every load",
    )
    # Two further springs beyond, if the body continues, locate the rim of the largest contact.
    places: Array = width * (np.arange(springs + 2, dtype=np.float64) + 0.5)
    return ViscoelasticFoundation(material, profile.transform(places[places < profile.radius]), width)
