"""Approach and retreat of an adhesive body: stable equilibria, snaps between them, and the energy lost in the snaps."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from roughcontact.errors import InputError
from roughcontact.mdr.adhesive_bodies.adhesion import Control, JKRContact
from roughcontact.validation import Array, Mask, number, numeric, require, shown

__all__ = ["AdhesivePath", "adhesive_path"]


@dataclass(frozen=True, slots=True, eq=False)
class AdhesivePath:
    """States of an adhesive body, in the order of the history; radius 0 and force 0 without contact.

    A body that was pulled by more than its pull-off force is detached: its force is 0, not the prescribed one, and
    `detached` is true.

    Attributes
    ----------
    force : array, shape (n,)
        [N], tension negative.
    depth : array, shape (n,)
        [m]; NaN for a body that was torn off under a given force.
    contact_radius : array, shape (n,)
        [m].
    dissipated : array, shape (n,)
        Energy lost in snaps up to each state [J]; infinite after detachment under a given force, which is unlimited.

    Examples
    --------
    >>> from roughcontact.mdr import adhesion, adhesive_path, indenter
    >>> ball = adhesion.jkr(indenter.paraboloid(1e-2), 1e9, work=0.05)
    >>> path = adhesive_path.adhesive_path(ball, depths=[0.0, 1e-7, -1e-6])
    >>> path.detached.tolist(), f"{path.dissipated[-1] * 1e9:.2f} nJ lost in the snaps"
    ([False, False, True], '0.10 nJ lost in the snaps')
    """

    force: Array
    depth: Array
    contact_radius: Array
    dissipated: Array

    @property
    def detached(self) -> Mask:
        """Whether the body has separated after contact, shape (n,)."""
        on = self.contact_radius > 0
        return np.logical_or.accumulate(on) & ~on

    def __len__(self) -> int:
        return len(self.force)


@numeric
def adhesive_path(
    adhesion: JKRContact,
    *,
    depths: Sequence[float] | Array | None = None,
    forces: Sequence[float] | Array | None = None,
    machine_stiffness: float = math.inf,
) -> AdhesivePath:
    """Move an adhesive body, initially far away, through a history.

    It adheres at first touch, depth 0. From then on the edge of the contact moves outwards while this releases energy,
    and inwards when it must: it stays on stable equilibria and snaps where one ends.

    Parameters
    ----------
    adhesion : JKRContact
        The equilibria of the body, from `jkr`.
    depths : array, shape (n,), optional
        History of the depth [m], or of the far end of a spring with `machine_stiffness` [N/m] that holds the body.
    forces : array, shape (n,), optional
        Instead: history of the force [N]. Beyond the pull-off force, the force is 0.
    machine_stiffness : float
        Stiffness of the spring that holds the body [N/m]; if infinite, the depth is given.

    Returns
    -------
    AdhesivePath

    Raises
    ------
    ValueError
        If not exactly one history is given, or the contact leaves the known part of the body.

    Examples
    --------
    >>> from roughcontact.mdr import adhesion, adhesive_path, indenter
    >>> ball = adhesion.jkr(indenter.paraboloid(1e-2), 1e9, work=0.05)
    >>> path = adhesive_path.adhesive_path(ball, depths=[0.0, 1e-7, -1e-6])
    >>> path.contact_radius.round(8).tolist(), path.detached.tolist()
    ([3.155e-05, 4.708e-05, 0.0], [False, False, True])
    """
    if not isinstance(adhesion, JKRContact):
        raise InputError(
            f"a JKRContact is needed, such as jkr(profile, modulus, work), not {shown(adhesion)}",
            place="adhesion",
        )
    require((depths is None) != (forces is None), "give exactly one history, of depths or of forces")
    if depths is not None and not machine_stiffness > 0:
        raise InputError(
            f"the stiffness that holds a depth must be positive [N/m], not {machine_stiffness}",
            place="machine_stiffness",
        )
    control = Control(adhesion, 0.0 if depths is None else machine_stiffness)
    history = np.asarray(number(forces if depths is None else depths, "the history"))
    require(history.ndim == 1, f"a history must be a list of numbers, not of shape {history.shape}")
    if not np.isfinite(history).all():
        raise InputError(
            f"a history must be a list of finite numbers, not {history[~np.isfinite(history)][0]}"
        )
    track = _Track(control, *control.extrema())
    radius, lost = 0.0, 0.0
    states = []
    for c in history.tolist():
        radius, loss = track.move(radius, c)
        lost += loss
        states.append((*_state(control, radius, c), radius, lost))
    force, depth, radii, dissipated = np.array(states).reshape(-1, 4).T
    return AdhesivePath(force, depth, radii, dissipated)


def _state(control: Control, a: float, c: float) -> tuple[float, float]:
    """Return force and depth of a contact of radius `a` under the control `c`."""
    given_force = control.machine_stiffness == 0
    if a == 0:
        return 0.0, (math.nan if given_force and c < 0 else 0.0 if given_force else c)
    # At the radius a the force is linear in the depth, whether the edge is free to move or pinned.
    E = control.adhesion.modulus
    integral = float(control.adhesion.profile.transform_integral(a))
    if given_force:
        return c, (c / (2 * E) + integral) / a
    share = 2 * E * control.compliance
    depth = (c + integral * share) / (1 + a * share)
    return 2 * E * (a * depth - integral), depth


@dataclass(frozen=True, slots=True, eq=False)
class _Track:
    """The monotonic pieces of c(a) between its `extrema`."""

    control: Control
    extrema: Array
    levels: Array

    def move(self, a: float, c: float) -> tuple[float, float]:
        """Return the new radius of the edge from radius `a` when the control becomes `c`, and the energy lost."""
        own = float(self.control.level(a)) if a > 0 else 0.0
        if c > own or (a == 0 and c == 0):
            return self._lead(a, own, c, 1)
        if a > 0 and c < own:
            return self._lead(a, own, c, -1)
        return a, 0.0

    def _pieces(self, a: float, way: int) -> list[tuple[float, float, float]]:
        """Return the pieces from the one with `a` on, outwards or inwards: both ends, and c at the far end."""
        first = int(np.searchsorted(self.extrema, a, side="right" if way > 0 else "left"))
        far = range(first, len(self.extrema)) if way > 0 else range(first - 1, -1, -1)
        ends = self.extrema.tolist()
        return [(ends[index - way], ends[index], float(self.levels[index])) for index in far]

    def _lead(self, a: float, level: float, c: float, way: int) -> tuple[float, float]:
        """Return the new radius of an edge that moves outwards (1) or inwards (-1) from `a`, and the energy lost."""
        loss = 0.0
        for start, end, there in self._pieces(a, way):
            if way * there < way * level:
                continue
            if (
                way * start > way * a
            ):  # c is beyond `level` on the pieces between: a snap to the radius where it is `level` again
                landing = self._cross(start, end, level)
                loss += self._energy(a, level) - self._energy(landing, level)
                a = landing
            if way * there >= way * c:
                return self._cross(a, end, c), loss
            a, level = end, there
        if way < 0:
            torn = math.inf if self.control.machine_stiffness == 0 else self._energy(a, level)
            return 0.0, loss + torn
        last = float(self.extrema[-1])
        if not self.control.adhesion.profile.edge:
            raise InputError(f"the contact spreads beyond {last:g} m, where the body is not known")
        if a < last:
            loss += self._energy(a, level) - self._energy(last, level)
        return last, loss

    def _cross(self, start: float, end: float, level: float) -> float:
        """Return the radius at which c passes a level on a rising piece, given by its ends in either order."""
        low, high = sorted((start, end))
        below, above = (float(self.control.level(a)) - level for a in (low, high))
        if below >= 0 or above <= 0:
            return low if below >= 0 else high
        return float(
            brentq(lambda a: float(self.control.level(a)) - level, low, high, xtol=1e-300, rtol=2.0**-50)
        )

    def _energy(self, a: float, c: float) -> float:
        """Return the energy of body, adhesion and machine at a radius under the control `c` [J]."""
        if a == 0:
            return 0.0
        force, depth = _state(self.control, a, c)
        own = self.control.adhesion.energy(a, depth)
        if self.control.machine_stiffness == 0:
            return own - force * depth
        return own + force**2 / 2 * self.control.compliance
