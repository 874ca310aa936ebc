"""The steady state of Kelvin-Voigt springs under a line that slides over them at a given depth."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughcontact.validation import Array

__all__ = ["SlidingState", "sliding_state"]


STEPS = 100  # of Newton's method for a point of touch; each advances by at least one relaxation length


@dataclass(frozen=True, slots=True, eq=False)
class SlidingState:
    """Forces and contact length over a period of each line; forces are over E*, one value per line.

    Attributes
    ----------
    force : array, shape (lines,)
        Normal force over E* [m^2], the integral of the deflection of the springs.
    friction : array, shape (lines,)
        Force along the line over E* [m^2], from the dissipation in the dampers: a sum of positive terms.
    contact_length : array, shape (lines,)
        Length in contact [m].
    stiffness : array, shape (lines,)
        Derivative of `force` with respect to the depth [m].
    """

    force: Array
    friction: Array
    contact_length: Array
    stiffness: Array


def sliding_state(separation: Array, spacing: float, relaxation_length: float, depth: Array) -> SlidingState:
    """Return the steady state of lines that slide at a depth.

    Parameters
    ----------
    separation : array, shape (lines, points)
        Depth of each point below the highest of its line [m], one period, linear between the points. Springs pass in
        the order of the points.
    spacing : float
        Distance of the points [m].
    relaxation_length : float
        Speed times relaxation time, l [m].
    depth : array, shape (lines,)
        Depth of the highest points below the surface of relaxed springs [m], above 0.

    Notes
    -----
    A spring at the position x of the line is pressed to ``u(x) >= w(x) = depth - separation(x)``. Its force
    ``E* (u + l u')`` is zero without contact and never negative: ``u exp(x/l)`` never decreases. The least such u is

        u(x) = max over x' <= x of w(x') exp(-(x - x')/l),

    a running maximum of ``ln w + x/l``. A maximum more than a period back is exceeded by the one a period later, so
    two periods are enough. Over a period the normal force is ``E* int u``, and the friction force ``E* l int u'^2``.
    """
    points = separation.shape[1]
    w = depth[:, None] - np.concatenate([separation, separation[:, :1]], axis=1)
    x = spacing * np.arange(points + 1)
    y = _log(w) + x / relaxation_length
    slope = np.diff(w, axis=1) / spacing
    peak = _peaks(w[:, :-1], slope, spacing, relaxation_length)
    w_peak, y_peak = _values_at(peak, w, y, slope, x, spacing, relaxation_length)

    before, decay, w_held = _history(y_peak, w_peak, x[:-1] + peak, x, relaxation_length)
    touching = y[:, :-1] >= before  # at the first point of the stretch
    start = np.where(touching, w[:, :-1], w_held * decay)
    share = np.where(touching, 1.0, decay)  # du/d(depth)

    meets = y_peak > before
    end = np.where(meets, peak, spacing)
    first = np.where(meets, 0.0, spacing)
    later = meets & ~touching
    first[later] = _touch(w[:, :-1][later], slope[later], start[later], peak[later], relaxation_length)
    return _summed(w[:, :-1], slope, start, share, (first, end, spacing), relaxation_length)


def _peaks(w: Array, slope: Array, spacing: float, length: float) -> Array:
    """Return the position in each stretch at which ``ln w + x/l`` is largest [m]: there a spring may separate."""
    falling = slope < 0
    peak = np.full(w.shape, float(spacing))
    # The force w + l w' is zero on a falling flank.
    np.divide(w + length * slope, -slope, out=peak, where=falling)
    return np.clip(peak, 0.0, spacing, out=peak)


def _values_at(
    peak: Array, w: Array, y: Array, slope: Array, x: Array, spacing: float, length: float
) -> tuple[Array, Array]:
    """Return w and ``ln w + x/l`` at the peaks; at the ends of a stretch exactly those of the points."""
    at_first, at_last = peak == 0, peak == spacing
    w_peak = w[:, :-1] + slope * peak
    w_peak = np.where(at_first, w[:, :-1], np.where(at_last, w[:, 1:], w_peak))
    y_peak = _log(w_peak) + (x[:-1] + peak) / length
    return w_peak, np.where(at_first, y[:, :-1], np.where(at_last, y[:, 1:], y_peak))


def _history(
    y_peak: Array, w_peak: Array, place: Array, x: Array, length: float
) -> tuple[Array, Array, Array]:
    """Return, at the first point of each stretch, the largest y so far, the decay since then, and its w."""
    lines, points = y_peak.shape
    best = np.maximum.accumulate(y_peak, axis=1)
    last_period = best[:, -1:] - x[-1] / length
    before = np.concatenate([last_period, np.maximum(best[:, :-1], last_period)], axis=1)
    holder = np.maximum.accumulate(np.where(y_peak > before, np.arange(points), -1), axis=1)
    held = np.concatenate([np.full((lines, 1), -1), holder[:, :-1]], axis=1)
    # Held since the previous period: by the last maximum.
    earlier = held < 0
    held = np.where(earlier, holder[:, -1:], held)
    since = x[:-1] - np.take_along_axis(place, held, axis=1) + np.where(earlier, x[-1], 0.0)
    return before, np.exp(-since / length), np.take_along_axis(w_peak, held, axis=1)


def _touch(w: Array, slope: Array, start: Array, peak: Array, length: float) -> Array:
    """Return the position at which a relaxing spring meets a stretch [m]: ``w + slope t = start exp(-t/l)``.

    The difference of both sides is concave and negative at the start: Newton's method converges to the root from
    below.
    """
    t = np.zeros(w.shape)
    np.divide(-w, slope, out=t, where=(w < 0) & (slope > 0))
    for _ in range(STEPS):
        relaxed = start * np.exp(-t / length)
        step = (relaxed - w - slope * t) / (slope + relaxed / length)
        t = np.minimum(t + np.maximum(step, 0.0), peak)
        if (step <= 1e-15 * peak).all():
            break
    return t


def _summed(
    w: Array, slope: Array, start: Array, share: Array, bounds: tuple[Array, Array, float], length: float
) -> SlidingState:
    """Return the integrals over stretches on which a spring relaxes, follows the line, and relaxes again."""
    first, end, spacing = bounds
    contact = end - first
    w_first, w_end = w + slope * first, w + slope * end
    rest = spacing - end
    relax, relax_rest = -length * np.expm1(-first / length), -length * np.expm1(-rest / length)
    force = start * relax + (w_first + w_end) / 2 * contact + w_end * relax_rest
    squares = slope**2 * contact - (
        start**2 * np.expm1(-2 * first / length) + w_end**2 * np.expm1(-2 * rest / length)
    ) / (2 * length)
    return SlidingState(
        force.sum(axis=1),
        length * squares.sum(axis=1),
        contact.sum(axis=1),
        (share * relax + contact + relax_rest).sum(axis=1),
    )


def _log(w: Array) -> Array:
    """Return ln w, and minus infinity where w is not positive."""
    return np.log(w, where=w > 0, out=np.full(w.shape, -np.inf))
