"""From only a line scan to the stiffness of its surface."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Literal

from roughcontact.errors import InputError
from roughcontact.grid import Grid
from roughcontact.materials import Modulus
from roughcontact.mdr.lines.equivalent_line import LineSpectrum, line_spectrum
from roughcontact.mdr.lines.line_curves import LineCurves
from roughcontact.mdr.lines.random_lines import rough_lines
from roughcontact.mdr.lines.rough_line import loading_curves
from roughcontact.surface.analysis.cut import surface_spectrum
from roughcontact.surface.analysis.preprocess import SpectralWindow
from roughcontact.surface.analysis.spectra import power_spectrum
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, RngLike, numeric

__all__ = ["scan_curves", "scan_spectrum"]


@numeric
def scan_spectrum(
    scan: Surface,
    *,
    factor: float = math.pi,
    method: Literal["law", "abel"] = "law",
    hurst: float | None = None,
    window: SpectralWindow = "auto",
    q_min: float | None = None,
    q_max: float | None = None,
    per_decade: float = 10,
) -> LineSpectrum:
    """Return the spectrum of the line that is equivalent to the surface of a line scan.

    C1D of the scan is that of a straight cut. Its inversion gives C2D of the surface, and ``factor q C2D`` is the
    spectrum of the line. Do not press the scan into springs: its spectrum is that of the line times
    ``cut_factor(H)/factor``.

    Parameters
    ----------
    scan : Surface
        On a grid of one axis, without missing points; remove its tilt first (least squares) if it is not roughness.
    factor : float
        lambda, see `line_spectrum`.
    method : {"law", "abel"}
        Method of the inversion, see `roughcontact.surface_spectrum`.
    hurst : float, optional
        Hurst exponent of the law, see `roughcontact.surface_spectrum`; by default that of the scan.
    window : {"auto", "none", "hann", "hamming", "blackman", "welch", "tukey"}
        See `roughcontact.power_spectrum`.
    q_min, q_max : float, optional
        The band to use [rad/m]. By default every wave of the scan, including those of the length of the scan, whose
        powers are uncertain, but which cause most of the height of a rough line.
    per_decade : float
        Bins to a factor of ten in wavenumber. The power of each wave of a single scan has a standard error of 100 %.

    Returns
    -------
    LineSpectrum

    Raises
    ------
    ValueError
        If the scan has two axes or points are missing, or if `roughcontact.surface_spectrum` raises it.

    Notes
    -----
    The surface is assumed to be isotropic and statistically homogeneous, because one scan represents all directions
    and places. Its phases are assumed to be random, because only the spectrum is used. The instrument must follow the
    surface up to `q_max`.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> from roughcontact.mdr import line_scan
    >>> scan = rc.self_affine(rc.Grid(256, 1e-6, True), 0.8, 1e-7, np.random.default_rng(0))
    >>> line = line_scan.scan_spectrum(scan)
    >>> slope = np.diff(np.log(line([1e5, 1e6])))[0] / np.log(10)
    >>> round(float(slope), 1)  # C1D of the line, lambda q C2D ~ q^(-2 H - 1)
    -2.6
    """
    if scan.grid.ndim != 1:
        raise InputError(
            "a line scan has one axis; for a map use its spectrum C2D: line_spectrum(power_spectrum(surface))"
        )
    profile = power_spectrum(scan, "x", window=window, per_decade=per_decade)
    low = 2 * math.pi / scan.grid.lengths[0] if q_min is None else q_min
    high = math.pi / scan.grid.spacing[0] if q_max is None else q_max
    return line_spectrum(surface_spectrum(profile, method=method, hurst=hurst).within(low, high), factor)


@numeric
def scan_curves(
    scan: Surface,
    modulus: Modulus,
    rng: RngLike,
    *,
    forces: Sequence[float] | Array,
    count: int = 100,
    spectrum: LineSpectrum | None = None,
) -> LineCurves:
    """Return loading curves of random lines that are equivalent to a square surface with the length of a line scan.

    Parameters
    ----------
    scan : Surface
        On a grid of one axis.
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa].
    rng : int, numpy.random.Generator, SeedSequence, BitGenerator or None
        Source of the phases.
    forces : array, shape (loads,)
        Strictly increasing normal forces on the whole square [N].
    count : int
        Number of lines: their scatter is that of patches of the length of the scan, not the error of its spectrum.
    spectrum : LineSpectrum, optional
        By default `scan_spectrum` of the scan, with its assumptions.

    Returns
    -------
    LineCurves

    Raises
    ------
    ValueError
        As for `scan_spectrum` and `loading_curves`.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> from roughcontact.mdr import line_scan
    >>> scan = rc.self_affine(rc.Grid(256, 1e-6, True), 0.8, 1e-7, np.random.default_rng(0))
    >>> curves = line_scan.scan_curves(scan, 1e9, np.random.default_rng(1), forces=[1e-4, 1e-3], count=20)
    >>> bool(np.diff(curves.mean_stiffness()) > 0)  # stiffer under more force
    True
    """
    line = scan_spectrum(scan) if spectrum is None else spectrum
    grid = Grid(scan.grid.shape, scan.grid.spacing, periodic=True)
    batches = rough_lines(grid, line, rng, count)
    return LineCurves.joined(
        loading_curves(heights, grid.spacing[0], modulus, forces=forces) for heights in batches
    )
