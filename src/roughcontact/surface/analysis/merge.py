"""One spectrum from several instruments (thesis, fig. 14)."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.surface.analysis.power import PowerSpectrum, require_measured
from roughcontact.validation import numeric, require

__all__ = ["merge_spectra", "spectra_ratio"]


@numeric
def merge_spectra(spectra: Sequence[PowerSpectrum], *, per_decade: float = 20) -> PowerSpectrum:
    """Return one spectrum over the reliable bands of all `spectra`.

    Where bands overlap, densities are averaged with the number of independent waves as weight. Densities are not
    scaled to fit: check `spectra_ratio` first.

    Parameters
    ----------
    spectra : sequence of PowerSpectrum
        All of one kind. Each is cut to its ``q_min`` to ``q_max``; set these by ``spectrum.within(...)``.
    per_decade : float
        Bins to a factor of ten in wavenumber.

    Returns
    -------
    PowerSpectrum
        Without a window: the bands begin where windows no longer matter.

    Raises
    ------
    ValueError
        If there is no spectrum, or kinds differ.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> rng = np.random.default_rng(1)
    >>> wide, near = (rc.Grid((64, 64), spacing, periodic=True) for spacing in (4e-6, 1e-6))
    >>> merged = rc.merge_spectra([rc.power_spectrum(rc.self_affine(g, 0.8, 1e-6, rng)) for g in (wide, near)])
    >>> f"{2e6 * np.pi / merged.q_min:.0f} um to {2e6 * np.pi / merged.q_max:.0f} um"
    '256 um to 2 um'
    """
    parts = _of_one_kind(spectra)
    arrays = [
        np.concatenate([getattr(part, name) for part in parts])
        for name in ("wavenumber", "density", "count", "freedom")
    ]
    # Equal wavenumbers of two instruments count as one bin before the values go into a spectrum.
    q, group = np.unique(np.log(arrays[0]).round(12), return_inverse=True)
    weight, number = arrays[3], arrays[2]
    freedom = np.asarray(np.bincount(group, weight), dtype=np.float64)
    whole = PowerSpectrum(
        wavenumber=np.exp(q),
        density=np.bincount(group, weight * arrays[1]) / freedom,
        kind=parts[0].kind,
        count=np.asarray(np.bincount(group, number), dtype=np.float64),
        freedom=freedom,
        q_min=min(part.q_min for part in parts),
        q_max=max(part.q_max for part in parts),
    )
    return whole.rebinned(per_decade)


def spectra_ratio(one: PowerSpectrum, other: PowerSpectrum) -> tuple[float, float]:
    """Return the mean ratio of two densities in the band that they share, and its standard error.

    A ratio many standard errors from 1 shows that the instruments have not measured the same surface.

    Parameters
    ----------
    one, other : PowerSpectrum
        Of one kind, each with its reliable band.

    Returns
    -------
    ratio : float
        Density of `one` over that of the `other` [-], the geometric mean over bins of a tenth of a decade.
    standard_error : float
        Standard error of the ratio [-], for Gaussian surfaces.

    Raises
    ------
    ValueError
        If kinds differ or the bands share less than two bins of a tenth of a decade.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=np.random.default_rng(1))
    >>> ratio, error = rc.spectra_ratio(rc.power_spectrum(surface), rc.power_spectrum(2 * surface))
    >>> f"{ratio:.3f}"
    '0.250'
    """
    _of_one_kind((one, other))
    low, high = max(one.q_min, other.q_min), min(one.q_max, other.q_max)
    require(low < high, f"the bands do not overlap: one begins at {low:g}, the other ends at {high:g} rad/m")
    first, second = (s.within(low, high).rebinned(10) for s in (one, other))
    bins, others = (np.floor(np.log10(s.wavenumber) * 10 + 1e-9).astype(np.int64) for s in (first, second))
    shared, at_first, at_second = np.intersect1d(bins, others, return_indices=True)
    if shared.size < 2:
        raise InputError(
            f"the bands share {shared.size} bin(s) from {low:g} to {high:g} rad/m: too few to compare"
        )
    ratio = np.log(first.density[at_first] / second.density[at_second])
    variance = 1 / first.freedom[at_first] + 1 / second.freedom[at_second]
    mean = float(np.average(ratio, weights=1 / variance))
    return math.exp(mean), math.exp(mean) / math.sqrt(float((1 / variance).sum()))


def _of_one_kind(spectra: Sequence[PowerSpectrum]) -> list[PowerSpectrum]:
    """Return the reliable part of each spectrum."""
    require(len(spectra) > 0, "there is no spectrum to merge")
    for each in spectra:
        require_measured(each)
    kinds = {spectrum.kind for spectrum in spectra}
    if len(kinds) > 1:
        raise about(
            "spectra", "of surfaces (C2D) and of profiles (C1D) cannot be merged", "see surface_spectrum"
        )
    return [spectrum.within() for spectrum in spectra]
