"""The noise of a measured map: its size, the length over which it is correlated, and draws of it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce

import numpy as np
import scipy.fft

from roughcontact.errors import about
from roughcontact.grid import Grid
from roughcontact.surface.analysis.correlation import LagMap, autocorrelation
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, RngLike, as_generator, positive, require_numbers

__all__ = ["Noise", "between_neighbours", "require_fits"]

LONGEST = 1 / 4  # of the shorter side of a map: longer noise is a form
REACH = 4  # correlation lengths, beyond which the covariance is exp(-16)
SHORTEST = 2 / 3  # of a cell: neighbours correlated by less than 0.1 count as independent in repeats
WHITE = 1e-3  # of a cell: a correlation length so short that neighbours are independent


@dataclass(frozen=True, slots=True)
class Noise:
    """Random errors of the heights of a map, with the covariance ``rms^2 exp(-r^2 / correlation_length^2)``.

    Parameters
    ----------
    rms : float
        Standard deviation of one height [m].
    correlation_length : float
        Distance [m] at which the correlation of two errors is 1/e. With zero, the errors of all cells are independent
        (white noise).

    Raises
    ------
    ValueError
        If a value is negative, NaN or infinite.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6)
    >>> noise = rc.Noise(rms=3e-9, correlation_length=4e-6)
    >>> repeats = [rc.Surface(noise.draw(grid, seed), grid) for seed in range(8)]
    >>> found = rc.Noise.from_repeats(repeats)
    >>> f"{found.rms * 1e9:.1f} nm, {found.correlation_length * 1e6:.1f} um"
    '3.0 nm, 3.9 um'
    """

    rms: float
    correlation_length: float = 0.0

    def __post_init__(self) -> None:
        require_numbers(self, rms="m", correlation_length="m")
        for name in ("rms", "correlation_length"):
            object.__setattr__(self, name, float(positive(getattr(self, name), name, zero=True)))

    def __str__(self) -> str:
        """Return the noise in words."""
        if not self.correlation_length:
            return f"white noise of {self.rms:.3g} m rms"
        return f"noise of {self.rms:.3g} m rms with a correlation length of {self.correlation_length:.3g} m"

    @classmethod
    def from_repeats(cls, surfaces: Sequence[Surface]) -> Noise:
        """Return the noise of one map from repeated measurements of it.

        The noise is the scatter about the mean of the repeats. The mean height and, unless the map is periodic, the
        least-squares plane of each deviation are removed first: a tilt between two repeats is not noise, because maps
        are levelled.

        Parameters
        ----------
        surfaces : sequence of Surface
            Two or more maps of one place on one grid [m]. Four repeats give the rms within a few per cent.

        Returns
        -------
        Noise
            The correlation length is the mean of those along both axes; zero if it is below two thirds of a cell.

        Raises
        ------
        ValueError
            If there are fewer than two surfaces, or their grids differ.

        Examples
        --------
        >>> import numpy as np
        >>> import roughcontact as rc
        >>> ball = rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4)
        >>> rng = np.random.default_rng(1)
        >>> repeats = [rc.Surface(ball.heights + rng.normal(0, 2e-9, (64, 64)), ball.grid) for _ in range(4)]
        >>> print(rc.Noise.from_repeats(repeats))
        white noise of 2e-09 m rms
        """
        given = list(surfaces)
        if len(given) < 2 or not all(isinstance(each, Surface) for each in given):
            raise about("the repeats", "must be two or more surfaces", "give several maps of one place")
        mean = reduce(Surface.__add__, given) * (1 / len(given))
        deviations = [(each - mean).levelled("auto") for each in given]
        lags = [autocorrelation(each) for each in deviations]
        squares = sum(each.rms**2 for each in deviations) / (len(given) - 1)
        length = sum(_decay(lags, axis) for axis in range(mean.grid.ndim)) / mean.grid.ndim
        return cls(math.sqrt(squares), length if length > SHORTEST * min(mean.grid.spacing) else 0.0)

    def draw(self, grid: Grid, rng: RngLike = None) -> Array:
        """Return heights [m] of the noise on a grid.

        Parameters
        ----------
        grid : Grid
            Along its periodic axes the noise is periodic.
        rng : Generator or int, optional
            Source of the random numbers, or their seed.

        Returns
        -------
        array, shape of the grid
            Its mean over many draws is zero.

        Raises
        ------
        ValueError
            If the correlation length exceeds a quarter of the map.

        Examples
        --------
        >>> import roughcontact as rc
        >>> rc.Noise(rms=3e-9).draw(rc.Grid((64, 32), 1e-6), 1).shape
        (64, 32)
        """
        shape, spectrum = self._spectrum(grid)
        white = as_generator(rng).standard_normal(shape)
        return self.rms * _filtered(white, np.sqrt(spectrum), grid)

    def spread(self, derivative: Array, grid: Grid) -> float:
        """Return the standard deviation that the noise gives to a number, to first order.

        Parameters
        ----------
        derivative : array, shape of the grid
            Derivatives of the number with respect to the heights, as `sensitivity` returns them.
        grid : Grid

        Returns
        -------
        float
            In the unit of the number.

        Raises
        ------
        ValueError
            If the correlation length exceeds a quarter of the map.

        Examples
        --------
        >>> import roughcontact as rc
        >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
        >>> derivatives = rc.sensitivity(rc.press(ball, 1e9, force=1e-3), reference="level")
        >>> f"{rc.Noise(rms=3e-9).spread(derivatives.depth_at_force, ball.grid) * 1e9:.2f} nm"
        '0.43 nm'
        """
        shape, spectrum = self._spectrum(grid)
        padded = np.zeros(shape)
        padded[tuple(map(slice, grid.shape))] = derivative
        return self.rms * math.sqrt(max(0.0, float(np.sum(derivative * _filtered(padded, spectrum, grid)))))

    def _spectrum(self, grid: Grid) -> tuple[tuple[int, ...], Array]:
        """Return the shape of a periodic grid on which the noise of the map is stationary, and its power there."""
        require_fits(self, grid)
        shape, parts = [], list[Array]()
        for n, spacing, periodic in zip(grid.shape, grid.spacing, grid.periodic, strict=True):
            length = max(self.correlation_length / spacing, WHITE)
            size = n if periodic else scipy.fft.next_fast_len(n + math.ceil(REACH * length), real=True)
            lags = np.arange(size)[:, None] - size * np.arange(-1, 3)
            covariance = np.exp(-np.minimum((lags / length) ** 2, 700.0)).sum(axis=1)
            last = len(parts) == grid.ndim - 1
            waves = scipy.fft.rfft(covariance) if last else scipy.fft.fft(covariance)
            shape.append(size)
            parts.append(np.maximum(waves.real, 0.0))
        return tuple(shape), reduce(np.multiply.outer, parts)


def require_fits(noise: Noise, grid: Grid) -> None:
    """Raise a ValueError if the noise is too long for a map on a grid."""
    longest = LONGEST * min(grid.lengths)
    if noise.correlation_length > longest:
        raise about(
            "correlation_length [m]",
            f"must be at most a quarter of the map, {longest:.3g} m, not {noise.correlation_length:.3g}",
            "remove longer errors from the map as a form: levelled('quadratic')",
        )


def between_neighbours(noise: Noise, grid: Grid) -> float:
    """Return the rms difference [m] that the noise gives to the heights of neighbouring cells."""
    length = max(noise.correlation_length, WHITE * min(grid.spacing))
    squares = [-2 * math.expm1(-min((spacing / length) ** 2, 700.0)) for spacing in grid.spacing]
    return noise.rms * math.sqrt(sum(squares) / len(squares))


def _filtered(field: Array, factors: Array, grid: Grid) -> Array:
    """Return the field with its waves multiplied by factors, on the cells of the grid."""
    product = scipy.fft.irfftn(scipy.fft.rfftn(field) * factors, field.shape)
    return product[tuple(map(slice, grid.shape))]


def _decay(lags: Sequence[LagMap], axis: int) -> float:
    """Return the lag along an axis [m] at which the mean correlation falls to 1/e, exact for a Gaussian covariance."""
    steps = lags[0].lags[axis]
    middle = [int(np.argmin(np.abs(each))) for each in lags[0].lags]
    place = tuple(slice(m, None) if k == axis else m for k, m in enumerate(middle))
    mean = np.mean([each.value[place] for each in lags], axis=0)
    if not mean[0] > 0:
        return 0.0
    rates = np.sqrt(-np.log(np.clip(mean / mean[0], 1e-12, 1.0)))  # proportional to the lag
    spacing, below = float(steps[1] - steps[0]), np.flatnonzero(rates >= 1)
    after = int(below[0]) if below.size else rates.size - 1
    share = (1 - rates[after - 1]) / (rates[after] - rates[after - 1]) if below.size else 1.0
    return spacing * (after - 1 + float(share))
