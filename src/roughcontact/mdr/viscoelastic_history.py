"""A body of revolution on a viscoelastic half-space under any history of depth or force.

While the contact grows and then recedes once, the springs give the exact solution of Lee & Radok (1960) and Ting
(J. Appl. Mech. 33, 845 (1966)); see Argatov & Popov, ZAMM 96, 956 (2016). Beyond - a body that comes back to a surface
that has not yet recovered - they are a model.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from scipy.optimize import brentq

from roughcontact.mdr.axisymmetric_profile import Profile, checked_profile
from roughcontact.mdr.indentation import indentation_curve
from roughcontact.mdr.viscoelastic import Viscoelastic, checked_material, ordered
from roughcontact.mdr.viscoelastic_springs import Springs, ViscoelasticFoundation
from roughcontact.theory.tools.roots import bisect
from roughcontact.validation import Array, number, numeric, whole

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
        Of the body [m], against the surface before first touch.
    contact_radius : array, shape (n,)
        [m], drawn on from the springs outside.
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
    """Lead a body through a history of its depth.

    Parameters
    ----------
    profile : Profile
    material : Viscoelastic
    times : array, shape (n,)
        [s]; a time that stands twice is a jump. Before the first the body is off.
    depths : array, shape (n,)
        [m], straight lines in between.
    springs : int
        Number of springs from the axis to the largest contact radius; the force's error falls as its square.

    Returns
    -------
    ViscoelasticHistory
        Whose force at a time is that at the end of the motion before it: a dashpot feels a change of speed at once.

    Raises
    ------
    ValueError
        If the history makes no sense, or jumps into a dashpot.

    Examples
    --------
    >>> from roughcontact.mdr import indenter, viscoelastic, viscoelastic_history
    >>> soft = viscoelastic.standard_solid(1e8, 1e9, 1.0)
    >>> held = viscoelastic_history.depth_history(
    ...     indenter.paraboloid(1e-2), soft, [0.0, 0.0, 100.0], [0.0, 1e-5, 1e-5]
    ... )
    >>> round(float(held.force[1] / held.force[2]), 4)  # the force relaxes by E_0/E_inf
    10.0
    """
    checked_material(material)
    t, d = _history(times, depths)
    if not (d > 0).any():
        raise ValueError(f"the body never touches: its largest depth is {d.max():g} m")
    top = float(indentation_curve(profile, 1.0, depths=[d.max()]).contact_radius[0])
    foundation, width = _foundation(profile, material, top, springs)
    state, at = foundation.untouched(), 0.0
    states = []
    for index, (now, depth) in enumerate(zip(t.tolist(), d.tolist(), strict=True)):
        if index and now > t[index - 1]:
            state = foundation.move(state, (at, depth), now - float(t[index - 1]))
        else:
            state = foundation.jump(state, depth)
        at = depth
        states.append(
            (_force(foundation, state, depth, width), depth, _radius(foundation, state, depth, width))
        )
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
    """Lead a body through a history of its force.

    Parameters
    ----------
    profile : Profile
    material : Viscoelastic
    times : array, shape (n,)
        [s]; a time that stands twice is a jump. Before the first the body is off.
    forces : array, shape (n,)
        [N], not negative, straight lines in between.
    springs : int
        Number of springs from the axis to the largest contact radius.

    Returns
    -------
    ViscoelasticHistory
        The depth moves evenly in each step and has the force right at its end, with a dashpot in its middle. The
        error falls as the square of the step, but for what the first moments cost, when the depth is no straight line.

    Raises
    ------
    ValueError
        If the history makes no sense.

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact.mdr import indenter, viscoelastic, viscoelastic_history
    >>> soft, t = viscoelastic.standard_solid(1e8, 1e9, 1.0), np.linspace(0, 20, 41)
    >>> held = viscoelastic_history.force_history(
    ...     indenter.paraboloid(1e-2), soft, t, np.ones(41), springs=100
    ... )
    >>> creep = soft.creep()
    >>> round(float((held.depth[-1] / held.depth[0]) ** 1.5), 1), round(float(creep(20.0) / creep(0.0)), 1)
    (8.8, 8.8)
    """
    checked_material(material)
    t, F = _history(times, forces)
    if (F < 0).any() or not F.any():
        raise ValueError(
            f"forces must not be negative, and one must be positive [N], not {F.min():g} to {F.max():g}"
        )
    # No history up to this force can reach a larger contact than the force itself, all the time.
    most = float(F.max()) * float(material.creep()(t[-1] - t[0]))
    top = float(indentation_curve(profile, 1.0, forces=[most]).contact_radius[0])
    foundation, width = _foundation(profile, material, top, springs)
    scale = float(indentation_curve(profile, 1.0, forces=[most]).depth[0])
    state, at = foundation.untouched(), 0.0
    states = []
    before, load = float(t[0]), 0.0
    for now, force in zip(t.tolist(), F.tolist(), strict=True):
        step = _step(foundation, state, at, now - before)
        if force == load == 0:  # a body without load follows the surface
            state = foundation.rest(state, now - before)
            at = float((state.place + foundation.transform).min())
        elif step is not None:
            goal = (load + force) / 2 if material.dashpot and now > before else force
            try_part, whole = step

            def answer(depth: float, go: Callable[[float], Springs] = try_part) -> float:
                return _force(foundation, go(depth), depth, width)

            d = _depth(answer, goal, at, scale)
            state, at = whole(d), d if not material.dashpot else at + 2 * (d - at)
        before, load = now, force
        states.append((force, at, _radius(foundation, state, at, width)))
    return ViscoelasticHistory(t, *np.array(states).T)


def _step(
    foundation: ViscoelasticFoundation, state: Springs, at: float, duration: float
) -> tuple[Callable[[float], Springs], Callable[[float], Springs]] | None:
    """Return the springs as functions of the depth at which the force is met: there, and at the end of the step."""
    dashpot = foundation.material.dashpot > 0
    if duration == 0:
        # A sudden force moves a dashpot only with time.
        return None if dashpot else (partial(foundation.jump, state),) * 2

    def move(depth: float) -> Springs:
        return foundation.move(state, (at, depth), duration)

    if not dashpot:
        return move, move
    return (
        lambda depth: foundation.move(state, (at, depth), duration / 2),
        lambda depth: move(at + 2 * (depth - at)),
    )


def _depth(force: Callable[[float], float], goal: float, start: float, scale: float) -> float:
    """Return the largest depth at which the force is not above the goal."""
    low = high = start
    width = 1e-3 * scale
    while force(high) <= goal:
        low, high, width = high, high + width, 2 * width
    width = 1e-3 * scale
    while force(low) > goal:
        low, high, width = low - width, low, 2 * width
    if goal > 0:
        return float(brentq(lambda d: force(d) - goal, low, high, xtol=1e-15 * scale))
    return float(
        bisect(lambda d: np.array([force(float(d[0])) > goal]), np.array([low]), np.array([high]))[0]
    )


def _history(times: Sequence[float] | Array, loads: Sequence[float] | Array) -> tuple[Array, Array]:
    t, load = np.asarray(number(times, "times [s]")), np.asarray(number(loads, "loads"))
    if t.ndim != 1 or t.shape != load.shape or not len(t):
        raise ValueError(f"a history wants as many times as loads, not {t.shape} and {load.shape}")
    ordered(t, load)
    return t, load


def _foundation(
    profile: Profile, material: Viscoelastic, top: float, springs: int
) -> tuple[ViscoelasticFoundation, float]:
    if not checked_profile(profile).rises:
        raise ValueError(
            "on a body whose transform falls somewhere the contact is not one disc at every load"
        )
    width = top / whole(springs, "springs")
    # Two more beyond, if the body goes on, tell where the rim of the largest contact lies.
    places: Array = width * (np.arange(springs + 2, dtype=np.float64) + 0.5)
    return ViscoelasticFoundation(material, profile.transform(places[places < profile.radius])), width


def _force(foundation: ViscoelasticFoundation, state: Springs, depth: float, width: float) -> float:
    """Return the sum of the springs [N]; over the last cell the stress is drawn on as far as the contact goes."""
    touched = np.nonzero(state.on)[0]
    if not len(touched):
        return 0.0
    last = int(touched[-1])
    length = _radius(foundation, state, depth, width) - width * last
    slope = float(state.stress[last] - state.stress[last - 1]) if last else 0.0
    mean = float(state.stress[last]) + slope * (length / width - 1) / 2
    return 2 * width * float(state.stress[:last].sum()) + 2 * length * mean


def _radius(foundation: ViscoelasticFoundation, state: Springs, depth: float, width: float) -> float:
    """Return where the contact ends [m]: where the gaps of the two springs outside, drawn on, close."""
    touched = np.nonzero(state.on)[0]
    if not len(touched):
        return 0.0
    last = int(touched[-1])
    centre = width * (last + 0.5)
    if last + 2 >= len(state.on):
        return centre + width / 2
    near, far = (state.place + foundation.transform - depth)[last + 1 : last + 3]
    return centre + width * (1 - min(1.0, near / (far - near)) if far > near else 0.5)
