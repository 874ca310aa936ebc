"""Friction of a rough line that slides over viscoelastic springs, in the exact steady state."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.materials import Modulus, as_modulus
from roughcontact.mdr.lines.rough_line import BLOCK, checked_lines, loading_curves
from roughcontact.mdr.viscoelasticity.sliding_state import SlidingState, sliding_state
from roughcontact.validation import Array, number, numeric, positive_scalar, require

__all__ = ["SlidingCurves", "sliding_friction"]

STEPS = 100  # of Newton's method, which needs about ten
TOLERANCE = 1e-12  # of the force


@dataclass(frozen=True, slots=True, eq=False)
class SlidingCurves:
    """Friction of rough lines at one force and several speeds.

    Attributes
    ----------
    speed : array, shape (speeds,)
        [m/s].
    force : float
        Normal force [N].
    depth : array, shape (lines, speeds)
        Approach of the moving line since first touch of relaxed springs [m]; smaller than at rest.
    friction_force : array, shape (lines, speeds)
        Force along the line [N], averaged over a period like the normal force.
    contact_length : array, shape (lines, speeds)
        Length in contact [m].

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact.mdr import sliding_friction
    >>> heights = 1e-6 * np.cos(2 * np.pi * np.arange(256) / 64)
    >>> curves = sliding_friction.sliding_friction(
    ...     heights, 1e-6, 1e7, relaxation_time=1e-3, force=1e-3, speeds=[1e-3, 1e-1]
    ... )
    >>> curves.friction_coefficient.round(4).tolist(), (curves.dissipated_power * 1e6).round(3).tolist()  # [uW]
    ([[0.007, 0.0403]], [[0.007, 4.034]])
    """

    speed: Array
    force: float
    depth: Array
    friction_force: Array
    contact_length: Array

    @property
    def friction_coefficient(self) -> Array:
        """Friction force over normal force [-], shape (lines, speeds)."""
        return self.friction_force / self.force

    @property
    def dissipated_power(self) -> Array:
        """Power that the dampers dissipate [W], friction force times speed, shape (lines, speeds)."""
        return self.friction_force * self.speed


@numeric
def sliding_friction(
    heights: Array,
    spacing: float,
    modulus: Modulus,
    *,
    relaxation_time: float,
    force: float,
    speeds: Sequence[float] | Array,
) -> SlidingCurves:
    """Return the friction of rigid rough lines that slide over a Winkler foundation of Kelvin-Voigt springs.

    Parameters
    ----------
    heights : array, shape (lines, points) or (points,)
        Heights [m] of one period, linear between the points. The springs pass in the order of the points.
    spacing : float
        Distance of the points [m].
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* of the body at low speed [Pa]; 4 G for an incompressible body.
    relaxation_time : float
        Viscosity over shear modulus [s]: a spring of width dx carries ``E* dx (u + relaxation_time du/dt)``.
    force : float
        Normal force [N], the same at every speed.
    speeds : array, shape (speeds,)
        Strictly increasing sliding speeds [m/s].

    Returns
    -------
    SlidingCurves

    Raises
    ------
    ValueError
        If an argument is out of range, or a line is flat.
    ArithmeticError
        If the depth for the force is not found.

    Notes
    -----
    The model of Li, Popov, Dimaki, Filippov, Kürschner and Popov, Phys. Rev. Lett. 111, 034301 (2013). Springs do not
    adhere: a spring separates when its force has fallen to zero, and relaxes until the line meets it again. The
    dampers are the only source of friction. It first grows with the speed, reaches a plateau of the order of the rms
    slope where springs touch only rising flanks, and finally falls to the slope in front of the highest point, the
    only one that still touches: this limit depends on the grid.

    There are no time steps: see `sliding_state`. The depth for the force is found by Newton's method, which converges
    from one side, because the force is convex in the depth.

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact.mdr import sliding_friction
    >>> wave = 1e-6 * np.cos(np.linspace(0, 2 * np.pi, 256, endpoint=False))
    >>> curves = sliding_friction.sliding_friction(
    ...     wave, 1e-6, 1e7, relaxation_time=1e-3, force=1e-3, speeds=[1e-6, 2e-6]
    ... )
    >>> first, second = curves.friction_coefficient[0]
    >>> round(float(second / first), 3)  # at low speed the dampers' force grows with it
    2.0
    """
    lines = checked_lines(heights)
    stiffness = as_modulus(modulus)
    rates = np.atleast_1d(number(speeds, "speeds [m/s]"))
    if rates.ndim != 1 or not len(rates) or not (np.isfinite(rates).all() and (rates > 0).all()):
        raise about("speeds", f"must be positive and finite [m/s], at least one in one row, not {rates}")
    require(np.diff(rates) > 0, "speeds must increase strictly", place="speeds")
    positive_scalar(relaxation_time, "relaxation_time")
    if lines.shape[1] < 2 or not (np.ptp(lines, axis=1) > 0).all():
        raise InputError("a line without asperities slides without friction: its heights must differ")

    depth = loading_curves(lines, spacing, stiffness, forces=[force]).depth[:, 0]
    separation = lines.max(axis=1, keepdims=True) - lines
    shape = (len(lines), len(rates))
    depths, friction, contact = np.empty(shape), np.empty(shape), np.empty(shape)
    rows = max(1, BLOCK // lines.shape[1])
    for start in range(0, len(lines), rows):
        part = slice(start, start + rows)
        guess = depth[part]
        for column, length in enumerate(rates * relaxation_time):
            # The depth decreases with the speed: the previous depth is on the safe side.
            guess, state = _at_force(separation[part], spacing, length, force / stiffness, guess)
            depths[part, column] = guess
            friction[part, column] = stiffness * state.friction
            contact[part, column] = state.contact_length
    return SlidingCurves(rates, float(force), depths, friction, contact)


def _at_force(
    separation: Array, spacing: float, relaxation_length: float, target: float, depth: Array
) -> tuple[Array, SlidingState]:
    """Return depth and state at the force `target` over E* [m^2], from a guess of the depth."""
    for _ in range(STEPS):
        state = sliding_state(separation, spacing, relaxation_length, depth)
        excess = state.force - target
        if (np.abs(excess) <= TOLERANCE * target).all():
            return depth, state
        depth = depth - excess / state.stiffness
    raise ArithmeticError(
        f"the relative error of the force is {float(np.abs(excess).max() / target):.1e} after {STEPS} steps: it is "
        "too small to be distinguished from rounding"
    )
