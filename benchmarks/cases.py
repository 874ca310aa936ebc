"""The problems of the comparison: unit square, E* = 1 Pa, surfaces of fixed seeds, every number stated here."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
import numpy.typing as npt

import roughcontact as rc

__all__ = ["CASES", "Problem", "chosen"]

Array = npt.NDArray[np.float64]

RMS = 0.01  # [m]; no answer depends on it but by scaling
LOADS = (1e-3, 0.046, 0.45)  # dimensionless force F / (E* h L)


@dataclass(frozen=True, eq=False)
class Problem:
    """One surface under one force."""

    heights: Array  # [m], shape (n, n), positive toward the flat
    spacing: tuple[float, float]  # [m]
    periodic: bool
    force: float  # [N]
    modulus: float = 1.0  # [Pa]


def fractal(n: int, seed: int, *, hurst: float, load: float) -> Problem:
    """Return a self-affine square with every wave of its grid, free (the thesis' squares)."""
    surface = rc.self_affine(_grid(n, False), hurst, RMS, np.random.default_rng(seed))
    return Problem(surface.heights, surface.grid.spacing, False, load * RMS)


def nominally_flat(n: int, seed: int, *, periodic: bool, slope_pressure: float) -> Problem:
    """Return a surface with waves from L/4 down to 8 cells under a mean pressure of so many E* times its rms slope."""
    surface = rc.self_affine(
        _grid(n, periodic),
        0.8,
        RMS,
        np.random.default_rng(seed),
        long_cutoff=1 / 4,
        short_cutoff=8 / n,
    )
    return Problem(
        surface.heights, surface.grid.spacing, periodic, slope_pressure * _rms_slope(surface.heights)
    )


def sphere(n: int, seed: int) -> Problem:  # a sphere has no seed
    """Return a sphere under the force of Hertz that makes 12 % of the square touch."""
    radius, contact = 5.0, np.sqrt(0.12 / np.pi)
    x = (np.arange(n) + 0.5) / n - 0.5
    heights = np.sqrt(radius**2 - x[:, None] ** 2 - x**2)
    return Problem(heights - heights.mean(), (1 / n, 1 / n), False, 4 * contact**3 / (3 * radius))


def _grid(n: int, periodic: bool) -> rc.Grid:
    return rc.Grid((n, n), 1 / n, periodic=periodic)


def _rms_slope(heights: Array) -> float:
    """Return the root mean square of |grad h| of a surface on the unit square."""
    n = len(heights)
    q = 2 * np.pi * np.fft.fftfreq(n, 1 / n)
    waves = np.abs(np.fft.fft2(heights)) ** 2 * (q[:, None] ** 2 + q**2)
    return float(np.sqrt(waves.sum())) / n**2


# Mean pressures over E* times the rms slope that bring 8 % and half of the cells into contact.
EIGHT_PERCENT, HALF = 0.0333, 0.265

CASES: dict[str, Callable[[int, int], Problem]] = {
    **{f"fractal-{h}-{load}": partial(fractal, hurst=h, load=load) for h in (0.8, 0.3) for load in LOADS},
    "flat-free": partial(nominally_flat, periodic=False, slope_pressure=EIGHT_PERCENT),
    "flat-periodic": partial(nominally_flat, periodic=True, slope_pressure=EIGHT_PERCENT),
    "flat-half": partial(nominally_flat, periodic=True, slope_pressure=HALF),
    "sphere": sphere,
}


def chosen(prefixes: str) -> list[str]:
    """Return the names of the cases that begin with one of the comma-separated `prefixes`."""
    wanted = tuple(part.strip() for part in prefixes.split(",") if part.strip())
    names = [name for name in CASES if name.startswith(wanted)]
    if not names:
        raise ValueError(f"no case begins with {prefixes!r}; there are {', '.join(CASES)}")
    return names
