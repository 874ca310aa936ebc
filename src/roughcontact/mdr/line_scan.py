"""From a line scan alone to the stiffness of the surface it was taken from."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Literal

import numpy as np
import numpy.typing as npt

from roughcontact.grid import Grid
from roughcontact.material import Solid
from roughcontact.mdr.equivalent_line import LineSpectrum, line_spectrum
from roughcontact.mdr.line_curves import LineCurves
from roughcontact.mdr.random_lines import rough_lines
from roughcontact.mdr.rough_line import loading_curves
from roughcontact.surface.analysis.cut import surface_spectrum
from roughcontact.surface.analysis.spectra import power_spectrum
from roughcontact.surface.analysis.windows import Window
from roughcontact.surface.surface import Surface
from roughcontact.validation import numeric, shown

__all__ = ["scan_curves", "scan_spectrum"]

Array = npt.NDArray[np.float64]


@numeric
def scan_spectrum(
    scan: Surface,
    *,
    factor: float = math.pi,
    method: Literal["law", "abel"] = "law",
    hurst: float | None = None,
    window: Window = "auto",
    q_min: float | None = None,
    q_max: float | None = None,
    per_decade: float = 10,
) -> LineSpectrum:
    """Return the spectrum of the line that stands for the surface of a line scan.

    The scan's C1D is that of a straight cut; inverted it is the surface's C2D, and ``factor q C2D`` the line's.
    The scan itself, pressed into springs, would be something else: its spectrum is that of the line times
    ``cut_factor(H)/factor``.

    Parameters
    ----------
    scan : Surface
        On a grid of one axis, without missing points; level it first if its tilt is no roughness.
    factor : float
        lambda, see `line_spectrum`.
    method, hurst
        How the cut is inverted, see `roughcontact.surface_spectrum`.
    window : {"auto", "none", "hann", "hamming", "blackman", "welch"}
        See `roughcontact.power_spectrum`.
    q_min, q_max : float, optional
        The band that counts [rad/m]. By default every wave of the scan: those of the scan's length too, whose powers
        are little known, but which make most of the height of a rough line.
    per_decade : float
        Bins to a factor of ten in wavenumber. A single scan knows each of its waves to 100 % only.

    Raises
    ------
    ValueError
        If the scan has two axes or points are missing, or what `roughcontact.surface_spectrum` refuses.

    Notes
    -----
    Assumed is that the surface is isotropic and statistically the same everywhere, so that one scan speaks for all
    directions and places; that its phases are random, so that the spectrum says all; and that the instrument
    follows the surface up to `q_max`.
    """
    if not isinstance(scan, Surface):
        raise ValueError(f"a line scan is a Surface on a grid of one axis, not {shown(scan)}")
    if scan.grid.ndim != 1:
        raise ValueError(
            "a line scan has one axis; a map has a spectrum C2D of its own: line_spectrum(power_spectrum(surface))"
        )
    profile = power_spectrum(scan, "x", window=window, per_decade=per_decade)
    low = 2 * math.pi / scan.grid.lengths[0] if q_min is None else q_min
    high = math.pi / scan.grid.spacing[0] if q_max is None else q_max
    return line_spectrum(surface_spectrum(profile, method=method, hurst=hurst).within(low, high), factor)


@numeric
def scan_curves(
    scan: Surface,
    modulus: float | Solid | tuple[Solid, Solid],
    rng: np.random.Generator,
    *,
    forces: Sequence[float] | Array,
    count: int = 100,
    spectrum: LineSpectrum | None = None,
) -> LineCurves:
    """Return loading curves of random lines that stand for a square surface as wide as a line scan is long.

    Parameters
    ----------
    scan : Surface
        On a grid of one axis.
    modulus : float, Solid or pair of Solids
        Reduced modulus E* [Pa].
    rng : numpy.random.Generator
        Source of the phases.
    forces : array, shape (loads,)
        Strictly increasing normal forces on the whole square [N].
    count : int
        Number of lines: their scatter is that of patches of the scan's length, not the error of its spectrum.
    spectrum : LineSpectrum, optional
        By default `scan_spectrum` of the scan, with what it assumes.

    Raises
    ------
    ValueError
        As `scan_spectrum` and `loading_curves` do.
    """
    line = scan_spectrum(scan) if spectrum is None else spectrum
    grid = Grid(scan.grid.shape, scan.grid.spacing, periodic=True)
    batches = rough_lines(grid, line, rng, count)
    return LineCurves.joined(
        loading_curves(heights, grid.spacing[0], modulus, forces=forces) for heights in batches
    )
