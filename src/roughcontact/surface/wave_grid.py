"""The waves of a grid that repeats itself: their wave vectors, and the power that a spectrum gives each.

Half of the waves stand for all, as in a real transform: shape ``(ny, nx//2 + 1)``, on a line ``(n//2 + 1,)``.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Literal, Protocol, TypeAlias, runtime_checkable

import numpy as np
import numpy.typing as npt
import scipy.fft

__all__ = [
    "PlanarSpectrum",
    "Spectrum",
    "Support",
    "multiplicity",
    "wave_powers",
    "wave_vectors",
    "wavenumbers",
]

Array = npt.NDArray[np.float64]
Support: TypeAlias = Literal["square", "disc"]


@runtime_checkable
class PlanarSpectrum(Protocol):
    """A spectrum that depends on the direction of a wave, not on its length alone."""

    def at(self, qy: Array, qx: Array) -> Array:
        """Return C2D [m^4] at the wave vectors ``(qy, qx)`` [rad/m]; even: the same at ``(-qy, -qx)``."""


# A plain callable gives C(|q|): C2D [m^4] of a surface, the two-sided C1D [m^3] of a line.
Spectrum: TypeAlias = Callable[[Array], Array] | PlanarSpectrum


def wave_vectors(shape: tuple[int, ...], spacing: tuple[float, ...]) -> tuple[Array, ...]:
    """Return the components of the wave vectors [rad/m], an open mesh: ``(qy, qx)``, on a line ``(q,)``."""
    last = len(shape) - 1
    components = [
        2 * np.pi * (scipy.fft.rfftfreq(n, d) if axis == last else scipy.fft.fftfreq(n, d))
        for axis, (n, d) in enumerate(zip(shape, spacing, strict=True))
    ]
    return tuple(np.meshgrid(*components, indexing="ij", sparse=True))


def wavenumbers(shape: tuple[int, ...], spacing: tuple[float, ...]) -> Array:
    """Return the lengths |q| [rad/m] of the wave vectors."""
    vectors = wave_vectors(shape, spacing)
    return np.abs(vectors[0]) if len(vectors) == 1 else np.hypot(*vectors)


def multiplicity(shape: tuple[int, ...]) -> Array:
    """Return how many waves each column of the half stands for: 2, but 1 where q and -q share a column."""
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
        raise ValueError(f"support must be 'square' or 'disc', not {support!r}")
    if getattr(spectrum, "dimension", len(shape)) != len(shape):
        raise ValueError(
            f"the spectrum has dimension {spectrum.dimension}, "  # type: ignore[union-attr]
            f"but the grid {len(shape)} axes: make it with dimension={len(shape)}"
        )
    lengths = wavenumbers(shape, spacing)
    density = _density(spectrum, lengths, wave_vectors(shape, spacing))
    if density.shape != lengths.shape:
        raise ValueError(f"the spectrum returned shape {density.shape} for waves of shape {lengths.shape}")
    if not (np.isfinite(density).all() and (density >= 0).all()):
        raise ValueError("the spectrum must be finite and not negative at every wave of the grid but q = 0")
    # B^2 = (2 pi)^ndim / area * C
    powers = density * math.prod(2 * math.pi / (n * d) for n, d in zip(shape, spacing, strict=True))
    powers.flat[0] = 0
    for axis, n in enumerate(shape):
        if n % 2 == 0:
            powers[(slice(None),) * axis + (n // 2,)] = 0
    if support == "disc":
        powers[lengths > math.pi / max(spacing)] = 0
    if not powers.any():
        raise ValueError(
            "no wave of this grid lies inside the limits of the spectrum: widen them or the grid"
        )
    return powers


def _density(spectrum: Spectrum, lengths: Array, vectors: tuple[Array, ...]) -> Array:
    """Return the spectrum at every wave, at q = 0 that of a neighbour: a power law has no value there."""
    if not isinstance(spectrum, PlanarSpectrum):
        moved = lengths.copy()
        moved.flat[:1] = moved.flat[1:2] if moved.size > 1 else 1.0
        return np.asarray(spectrum(moved), dtype=np.float64)
    if len(vectors) != 2:
        raise ValueError("a spectrum of the wave vector needs a grid of two axes, not one")
    mesh = [np.broadcast_to(component, lengths.shape).copy() for component in vectors]
    for component in mesh:
        component.flat[:1] = component.flat[1:2] if component.size > 1 else 1.0
    return np.asarray(spectrum.at(*mesh), dtype=np.float64)
