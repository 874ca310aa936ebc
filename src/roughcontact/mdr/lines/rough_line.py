"""Rough lines on independent springs: exact loading curves of many lines at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.errors import InputError, about
from roughcontact.materials import Modulus, as_modulus
from roughcontact.mdr.lines.line_curves import LineCurves
from roughcontact.validation import Array, exactly_one, number, numeric, positive_scalar, require

__all__ = ["checked_lines", "loading_curves"]

Counts = npt.NDArray[np.int32]

# Heights per block: few enough to stay in the cache of a core with all temporary arrays.
BLOCK = 2**15


@numeric
def loading_curves(
    heights: Array,
    spacing: float,
    modulus: Modulus,
    *,
    forces: Sequence[float] | Array | None = None,
    depths: Sequence[float] | Array | None = None,
    energy: bool = True,
) -> LineCurves:
    """Return the loading curves of rough lines pressed into a Winkler foundation (thesis, section A.2).

    Parameters
    ----------
    heights : array, shape (lines, points) or (points,)
        Heights [m], positive toward the foundation. Only their differences within a line matter.
    spacing : float
        Distance of the points [m], and the width of a spring.
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa]; a spring has the stiffness ``E* spacing``.
    forces, depths : array, shape (loads,), optional
        Give exactly one, the same for every line: strictly increasing forces [N], or depths below first touch [m].
    energy : bool
        Whether to compute the elastic energy, which takes a fifth of the time.

    Returns
    -------
    LineCurves

    Raises
    ------
    ValueError
        If heights are missing or infinite, or the input is otherwise invalid.

    Notes
    -----
    Springs are independent, so each line is sorted once. With heights ``h_1 >= h_2 >= ...`` spring
    j + 1 is touched at the depth ``D_j = h_1 - h_(j+1)``, where the force is ``Phi_j = E* spacing sum_(i<=j) i
    (h_i - h_(i+1))``; between two such points the curve is straight. Every sum has positive terms: there is no
    cancellation, and forces stay in order if heights are equal. A spring counts as in contact if it carries load.

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact.mdr import rough_line
    >>> line = np.array([0.0, -1e-6, -2e-6, -3e-6])
    >>> curves = rough_line.loading_curves(line, 1e-6, 1e9, depths=[0.5e-6, 1.5e-6])
    >>> curves.springs.tolist(), (curves.force * 1e3).round(6).tolist()  # [mN]
    ([[1, 2]], [[0.5, 2.0]])
    """
    lines = checked_lines(heights)
    positive_scalar(spacing, "spacing")
    loads, by_force = _loads(forces, depths)
    reduced = as_modulus(modulus)
    spring = reduced * spacing

    count, points = lines.shape
    shape = (count, len(loads))
    springs, found, rms = np.empty(shape, dtype=np.int32), np.empty(shape), np.empty(count)
    stored = np.empty(shape) if energy else np.broadcast_to(np.nan, shape)
    rows = min(count, max(1, BLOCK // points))
    scratch = _Scratch.of(rows, points, loads / spring if by_force else loads, by_force)
    for start in range(0, count, rows):
        part = slice(start, start + rows)
        rms[part] = _solve(lines[part], scratch, springs[part], found[part], stored[part] if energy else None)
    if energy:
        stored *= spring
    return LineCurves(
        force=loads if by_force else spring * found,
        depth=found if by_force else loads,
        springs=springs,
        elastic_energy=stored,
        rms=rms,
        modulus=reduced,
        spacing=float(spacing),
        points=points,
    )


@dataclass(frozen=True, slots=True, eq=False)
class _Scratch:
    """Buffers for one block after the other: new memory would cost more than the computation."""

    loads: Array  # forces over the stiffness of a spring, or depths
    falling: Array  # the same in reverse
    by_force: bool
    lines: tuple[Array, ...]  # five of shape (rows, points)
    queries: tuple[Array, Array]  # of shape (rows, loads)
    places: npt.NDArray[np.intp]  # of shape (rows, loads)

    @classmethod
    def of(cls, rows: int, points: int, loads: Array, by_force: bool) -> _Scratch:
        queries = (rows, len(loads))
        return cls(
            loads,
            loads[::-1].copy(),
            by_force,
            tuple(np.zeros((rows, points)) for _ in range(5)),
            (np.empty(queries), np.empty(queries)),
            np.empty(queries, dtype=np.intp),
        )

    def first(self, rows: int) -> tuple[tuple[Array, ...], tuple[Array, ...], npt.NDArray[np.intp]]:
        """Return the room for the first `rows` lines."""
        return tuple(a[:rows] for a in self.lines), tuple(a[:rows] for a in self.queries), self.places[:rows]


def _solve(heights: Array, scratch: _Scratch, springs: Counts, found: Array, energy: Array | None) -> Array:
    """Write springs in contact, depth (or force) and energy of each line, return its rms; a spring has stiffness 1."""
    loads = scratch.loads
    (ranked, gap, force, depth, work), (below, rise), last = scratch.first(len(heights))
    np.negative(heights, out=ranked)
    ranked.sort(axis=1)
    np.subtract(ranked[:, 1:], ranked[:, :-1], out=gap[:, 1:])  # the first element stays 0
    np.multiply(gap, np.arange(gap.shape[1]), out=work)
    np.cumsum(work, axis=1, out=force)  # Phi_j
    np.subtract(ranked, ranked[:, :1], out=depth)  # D_j

    # Each search continues below the previous one: with falling loads that is the shorter part of a line.
    for row, ordered in enumerate(force if scratch.by_force else depth):
        springs[row, ::-1] = ordered.searchsorted(scratch.falling)
    np.subtract(springs, 1, out=last)
    np.maximum(last, 0, out=last)
    last += gap.shape[1] * np.arange(len(heights))[:, None]
    # With out=, the mode "raise" of take would make a copy; all indices are valid.
    force.take(last, out=below, mode="clip")
    depth.take(last, out=rise, mode="clip")
    if scratch.by_force:
        np.copyto(found, rise)
        np.subtract(loads, below, out=rise)
        rise /= springs
        found += rise
        below += loads
    else:
        np.subtract(loads, rise, out=rise)
        np.multiply(springs, rise, out=found)
        found += below
        below += found
    if energy is not None:
        # Twice the energy at the touch of the last spring, plus twice the mean force since then times the
        # displacement.
        np.add(force[:, 1:], force[:, :-1], out=ranked[:, 1:])
        ranked *= gap
        np.cumsum(ranked, axis=1, out=work)
        work.take(last, out=energy, mode="clip")
        below *= rise
        energy += below
        energy /= 2
    return np.asarray(depth.std(axis=1))


def checked_lines(heights: Array) -> Array:
    """Return heights as rows of lines, or refuse anything else.

    Parameters
    ----------
    heights : array, shape (points,) or (lines, points)
        One line, or one row per line [m].

    Returns
    -------
    array
        Shape (lines, points).

    Examples
    --------
    >>> from roughcontact.mdr import rough_line
    >>> rough_line.checked_lines([0.0, 1e-6]).shape
    (1, 2)
    """
    if not hasattr(heights, "__len__"):
        raise about(
            "heights",
            f"must be an array, not a {type(heights).__name__}",
            "join the curves of batches by LineCurves.joined",
        )
    lines = np.atleast_2d(number(heights, "heights"))
    if lines.ndim != 2 or lines.size == 0:
        raise about("heights", f"must be one line or one row per line, not of shape {np.shape(heights)}")
    if not np.isfinite(lines).all():
        raise InputError(
            f"{int((~np.isfinite(lines)).sum())} heights are missing or infinite",
            "springs are independent, so omit the points of a line that have no height",
        )
    return lines


def _loads(
    forces: Sequence[float] | Array | None, depths: Sequence[float] | Array | None
) -> tuple[Array, bool]:
    """Return the loads and whether they are forces."""
    name, values = exactly_one(forces=forces, depths=depths)
    by_force = name == "forces"
    unit, least = ("N", "above 0") if by_force else ("m", "at least 0")
    loads = np.atleast_1d(number(values, name))
    if loads.ndim != 1 or not len(loads):
        raise InputError(
            f"{name} must hold at least one number in one row, not shape {loads.shape}", place=name
        )
    if not (np.isfinite(loads).all() and (loads > 0 if by_force else loads >= 0).all()):
        raise InputError(
            f"{name} must be finite and {least} [{unit}], not {loads[0]:g} to {loads[-1]:g}", place=name
        )
    require(np.diff(loads) > 0, f"{name} must increase strictly", place=name)
    return loads, by_force
