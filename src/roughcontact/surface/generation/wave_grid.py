"""The waves of a periodic grid: their wave vectors, and the power of each in a spectrum.

Half of the waves represent all, as in a real transform: shape ``(ny, nx//2 + 1)``, on a line ``(n//2 + 1,)``.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Literal, Protocol, TypeAlias, runtime_checkable

import numpy as np
import numpy.typing as npt

from roughcontact.errors import InputError, about
from roughcontact.validation import Array, pair, positive_scalar

__all__ = [
    "ALL",
    "Part",
    "PlanarSpectrum",
    "Spectrum",
    "Support",
    "cell_centres",
    "counted_powers",
    "multiplicity",
    "no_wave",
    "require_no_band",
    "scale_of",
    "wave_amplitudes",
    "wave_integers",
    "wave_powers",
    "wave_vectors",
    "wavenumbers",
]

Support: TypeAlias = Literal["square", "disc"]
Part: TypeAlias = tuple[slice, slice]
"""Rows and columns of the stored half of the waves."""

ALL: Part = (slice(None), slice(None))


@runtime_checkable
class PlanarSpectrum(Protocol):
    """A spectrum that depends on the direction of a wave, not only on its length."""

    def at(self, qy: Array, qx: Array) -> Array:
        """Return C2D [m^4] at the wave vectors ``(qy, qx)`` [rad/m]; even: the same at ``(-qy, -qx)``."""


# A plain callable gives C(|q|): C2D [m^4] of a surface, the two-sided C1D [m^3] of a line.
Spectrum: TypeAlias = Callable[[Array], Array] | PlanarSpectrum


def wave_integers(shape: tuple[int, ...]) -> tuple[npt.NDArray[np.int64], ...]:
    """Return the integers k of the waves along each axis, ``(ky, kx)``: signed, and from zero up along the last."""
    *others, last = shape
    signed = [(np.arange(n) + n // 2) % n - n // 2 for n in others]
    return (*signed, np.arange(last // 2 + 1))


def cell_centres(shape: tuple[int, ...]) -> tuple[npt.NDArray[np.complex128], ...]:
    """Return the factors that move the origin of waves from the corner of the first cell to its centre, an open mesh.

    Half a cell is ``exp(i pi k/n)`` along each axis: the height at a point does not depend on the number of cells.
    """
    turns = [np.exp(1j * np.pi * k / n) for k, n in zip(wave_integers(shape), shape, strict=True)]
    return tuple(np.meshgrid(*turns, indexing="ij", sparse=True))


def wave_vectors(shape: tuple[int, ...], spacing: tuple[float, ...], part: Part = ALL) -> tuple[Array, ...]:
    """Return the components of the wave vectors [rad/m], an open mesh: ``(qy, qx)``, on a line ``(q,)``."""
    last = len(shape) - 1
    components = [
        2 * np.pi * (np.fft.rfftfreq(n, d) if axis == last else np.fft.fftfreq(n, d))[here]
        for axis, (n, d, here) in enumerate(zip(shape, spacing, part, strict=False))
    ]
    return tuple(np.meshgrid(*components, indexing="ij", sparse=True))


def wavenumbers(shape: tuple[int, ...], spacing: tuple[float, ...], part: Part = ALL) -> Array:
    """Return the lengths |q| [rad/m] of the wave vectors."""
    vectors = wave_vectors(shape, spacing, part)
    return np.abs(vectors[0]) if len(vectors) == 1 else np.hypot(*vectors)


def multiplicity(shape: tuple[int, ...]) -> Array:
    """Return the number of waves that each column of the half represents: 2, or 1 if q and -q share a column."""
    count = np.full(shape[-1] // 2 + 1, 2.0)
    count[0] = 1
    if shape[-1] % 2 == 0:
        count[-1] = 1
    return count


def wave_powers(
    spectrum: Spectrum,
    shape: tuple[int, ...],
    spacing: tuple[float, ...],
    support: Support = "square",
    part: Part = ALL,
) -> Array:
    """Return B^2 [m^2], the mean square height that `spectrum` gives each wave (thesis, eqs 2.11 and 2.14).

    Parameters
    ----------
    spectrum : callable or PlanarSpectrum
        C(|q|) or C(qy, qx): C2D [m^4] on two axes, the two-sided C1D [m^3] on one.
    shape, spacing : tuple
        Cells of one period and their size [m].
    support : {"square", "disc"}
        All waves of the grid, or those with a wavenumber up to the smaller Nyquist wavenumber.
    part : tuple of slice
        Part of the waves; their powers are the same as in the whole.

    Returns
    -------
    array
        Zero for the mean and for the waves at the Nyquist wavenumber, whose phases are not free.

    Raises
    ------
    ValueError
        If the spectrum belongs to another number of axes, is negative or not finite, or leaves no wave.
    """
    if support not in ("square", "disc"):
        raise about("support", f"must be 'square' or 'disc', not {support!r}")
    if getattr(spectrum, "dimension", len(shape)) != len(shape):
        raise about(
            "the spectrum",
            f"has dimension {spectrum.dimension}, "  # type: ignore[union-attr]
            f"but the grid {len(shape)} axes",
            f"make it with dimension={len(shape)}",
        )
    lengths = wavenumbers(shape, spacing, part)
    density = _density(spectrum, lengths, wave_vectors(shape, spacing, part))
    if density.shape != lengths.shape:
        raise about("the spectrum", f"returned shape {density.shape} for waves of shape {lengths.shape}")
    if not (np.isfinite(density).all() and (density >= 0).all()):
        raise about("the spectrum", "must be finite and not negative at every wave of the grid except q = 0")
    # B^2 = (2 pi)^ndim / area * C
    powers = density * math.prod(2 * math.pi / (n * d) for n, d in zip(shape, spacing, strict=True))
    *others, last = shape
    places = [np.arange(n)[here] for n, here in zip((*others, last // 2 + 1), part, strict=False)]
    powers[np.ix_(*(place == 0 for place in places))] = 0
    for axis, (n, place) in enumerate(zip(shape, places, strict=True)):
        if n % 2 == 0:
            powers[(slice(None),) * axis + (place == n // 2,)] = 0
    if support == "disc":
        powers[lengths > math.pi / max(spacing)] = 0
    if part == ALL and not powers.any():
        raise no_wave()
    return powers


def no_wave() -> ValueError:
    """Return the error about a spectrum without any wave on the grid."""
    return InputError(
        "no wave of this grid lies inside the limits of the spectrum",
        "widen the limits, or take a grid with waves between them",
    )


def wave_amplitudes(
    spectrum: Spectrum,
    shape: tuple[int, ...],
    spacing: tuple[float, ...],
    support: Support = "square",
    *,
    rms: float | None = None,
    rms_band: tuple[float, float] | None = None,
) -> Array:
    """Return B [m] of each wave, with `rms` scaled to that height.

    Parameters
    ----------
    spectrum, shape, spacing, support
        See `wave_powers`.
    rms : float, optional
        Root mean square height [m]; with it the spectrum sets only the shape, without it also the height.
    rms_band : tuple of float, optional
        ``(longest, shortest)``: wavelengths [m] of the waves whose rms height is `rms`, both limits included. By
        default all waves of the grid.

    Returns
    -------
    array
        See `wave_powers`.

    Raises
    ------
    ValueError
        As `wave_powers`; or if `rms_band` comes without `rms`, holds no wave, or holds waves that are not on the grid.
    """
    powers = wave_powers(spectrum, shape, spacing, support)
    if rms is None:
        require_no_band(rms_band)
        return np.sqrt(powers, out=powers)
    total = float(counted_powers(powers, shape, spacing, rms_band).sum())
    np.sqrt(powers, out=powers)
    powers *= scale_of(rms, total, rms_band)
    return powers


def require_no_band(rms_band: tuple[float, float] | None) -> None:
    """Refuse a band of waves without an rms height."""
    if rms_band is not None:
        raise about("rms_band", "selects the waves whose rms height is rms", "also give rms")


def counted_powers(
    powers: Array,
    shape: tuple[int, ...],
    spacing: tuple[float, ...],
    rms_band: tuple[float, float] | None,
    part: Part = ALL,
) -> Array:
    """Return the contribution of each wave of a part to the mean square height that `rms` determines [m^2]."""
    counted = powers * multiplicity(shape)[part[1]] if len(shape) == 2 else powers * multiplicity(shape)
    if rms_band is not None:
        counted *= _inside(rms_band, shape, spacing, part)
    return counted


def scale_of(rms: float, total: float, rms_band: tuple[float, float] | None) -> float:
    """Return the factor of all amplitudes that makes a sum of powers [m^2] the square of `rms`."""
    if not total > 0:
        raise InputError(
            f"no wave of this grid and of the spectrum lies in rms_band {rms_band} m",
            "widen it",
            place="rms_band",
        )
    return rms / math.sqrt(total)


def _inside(
    band: tuple[float, float], shape: tuple[int, ...], spacing: tuple[float, ...], part: Part
) -> npt.NDArray[np.bool_]:
    """Return the mask of waves in a band of wavelengths; the grid must hold the whole band, or its rms would differ."""
    what = "rms_band, the longest and the shortest wavelength [m],"
    longest, shortest = (positive_scalar(length, what) for length in pair(band, what))
    if shortest > longest:
        raise InputError(f"{what} must begin with the longest, not {band}", place="rms_band")
    for n, d in zip(shape, spacing, strict=True):
        finest = (n - 1) // 2
        if n * d / shortest * (1 + 1e-9) >= finest + 1:
            raise about(
                "rms_band",
                f"goes down to {shortest:g} m, but a grid of {n} cells of {d:g} m has only waves longer than "
                f"{n * d / (finest + 1):g} m",
                "end the band above two cells of the coarsest grid",
            )
    lengths = wavenumbers(shape, spacing, part)
    return (lengths >= 2 * math.pi / longest * (1 - 1e-9)) & (lengths <= 2 * math.pi / shortest * (1 + 1e-9))


def _density(spectrum: Spectrum, lengths: Array, vectors: tuple[Array, ...]) -> Array:
    """Return the spectrum at every wave; q = 0, where a power law has no value, gets that of a neighbour."""
    moving = lengths.size > 0 and lengths.flat[0] == 0
    if not isinstance(spectrum, PlanarSpectrum):
        moved = lengths.copy()
        if moving:
            moved.flat[:1] = moved.flat[1:2] if moved.size > 1 else 1.0
        return np.asarray(spectrum(moved), dtype=np.float64)
    if len(vectors) != 2:
        raise InputError("a spectrum of the wave vector needs a grid of two axes, not one", place="spectrum")
    mesh = [np.broadcast_to(component, lengths.shape).copy() for component in vectors]
    for component in mesh if moving else ():
        component.flat[:1] = component.flat[1:2] if component.size > 1 else 1.0
    return np.asarray(spectrum.at(*mesh), dtype=np.float64)
