"""The distribution of the heights."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.surface.in_memory import analysed_on_host
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, numeric, require

__all__ = ["HeightHistogram", "height_histogram"]


@dataclass(frozen=True, slots=True, eq=False)
class HeightHistogram:
    """The distribution of measured heights about their mean.

    Attributes
    ----------
    edges : array, shape (n + 1,)
        Edges of the bins [m].
    count : array of int, shape (n,)
        Points in each bin.
    rms : float
        Root mean square height about the mean [m].
    """

    edges: Array
    count: npt.NDArray[np.int64]
    rms: float

    @property
    def density(self) -> Array:
        """Probability density in each bin [1/m]; its integral is 1."""
        return np.asarray(self.count / (self.count.sum() * np.diff(self.edges)))

    @property
    def centres(self) -> Array:
        """Middle of each bin [m]."""
        return np.asarray((self.edges[1:] + self.edges[:-1]) / 2)

    def gaussian(self, height: npt.ArrayLike) -> Array:
        """Return the density of a normal distribution of the same rms height.

        Parameters
        ----------
        height : array
            Heights above the mean [m].

        Returns
        -------
        array, the same shape
            Probability density [1/m].

        Raises
        ------
        ValueError
            If all heights are equal.
        """
        require(self.rms != 0, "all heights are equal: there is no normal distribution of rms 0")
        z = np.asarray(height, dtype=np.float64) / self.rms
        return np.asarray(np.exp(-(z**2) / 2) / (np.sqrt(2 * np.pi) * self.rms))


@numeric(ends="m")
@analysed_on_host
def height_histogram(
    surface: Surface, *, bins: int = 100, ends: tuple[float, float] | None = None
) -> HeightHistogram:
    """Return the histogram of the heights above their mean.

    Parameters
    ----------
    surface : Surface
        Missing points are ignored.
    bins : int
        Number of bins.
    ends : tuple of two floats, optional
        Range of the bins: heights above the mean [m]; by default the lowest and the highest point.

    Returns
    -------
    HeightHistogram
        Edges of the bins and points in each.

    Raises
    ------
    ValueError
        If the number of bins is not a positive whole number, or the ends do not rise or hold no point.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=np.random.default_rng(1))
    >>> histogram = rc.height_histogram(surface, bins=20)
    >>> int(histogram.count.sum()), histogram.edges.size
    (4096, 21)
    """
    require(bins >= 1, f"bins must be a positive whole number, not {bins}", place="bins")
    heights = surface.heights[surface.measured]
    heights -= heights.mean()
    count, edges = np.histogram(heights, bins=int(bins), range=None if ends is None else _ends(ends))
    require(count.sum() > 0, f"ends must have points between them, not {ends}", place="ends")
    return HeightHistogram(edges, count, surface.rms)


def _ends(given: tuple[float, float]) -> tuple[float, float]:
    low, high = (float(end) for end in given)
    require(
        -np.inf < low < high < np.inf,
        f"ends must be a height above the mean [m] and a larger one, not {given}",
    )
    return low, high
