"""One spectrum from many measurements of a surface, with its interval at each wavenumber."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
from scipy.stats import t

from roughcontact.errors import about
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.labelled import dataset_of, described
from roughcontact.validation import Array, numeric, require

if TYPE_CHECKING:
    import xarray

__all__ = ["CombinedSpectrum"]


@dataclass(frozen=True, slots=True, eq=False)
class CombinedSpectrum:
    """The spectrum of a surface from maps and profiles of several places, without their noise and blur.

    Attributes
    ----------
    wavenumber : array, shape (n,)
        Centres of bins that are evenly spaced in its logarithm [rad/m].
    density : array, shape (n,)
        Geometric mean over places: C2D [m^4], or C1D [m^3] if there are profiles.
    kind : {"C2D", "C1D"}
    log_error : array, shape (n,)
        Standard deviation of the mean ``ln density``.
    log_waves : array, shape (n,)
        Its part by the finite number of waves, which is independent between bins. The other part, by the scatter
        between places and by the instruments, is not.
    log_spread : array, shape (n,)
        Standard deviation of ``ln density`` between places, the inhomogeneity of the surface. NaN where a single map
        holds the waves.
    freedom : array, shape (n,)
        Degrees of freedom of `log_error`.
    names : tuple of str, length m
    map_density : array, shape (m, n)
        Density of each measurement in its reliable band, NaN outside.
    q_min, q_max : float
        The band that the measurements hold [rad/m].
    outlying : tuple of str
        Measurements that differ from the others; they do not count in the mean.
    notes : tuple of str
        What to know of the spectrum, the most important first.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rough = rc.self_affine(rc.Grid((96, 96), 1e-6, periodic=True), hurst=0.8, rms=1e-7, rng=1)
    >>> places = [rough.cropped(slice(0, 64), slice(k, k + 64)) for k in (0, 32)]
    >>> found = rc.Measurements.of(dict(zip("ab", places))).combined_spectrum()
    >>> low, high = found.interval(0.95)
    >>> bool((low < found.density).all() and (found.density < high).all())
    True
    >>> found.to_dataset()["density"].attrs["units"]
    'm4'
    """

    wavenumber: Array
    density: Array
    kind: Literal["C2D", "C1D"]
    log_error: Array
    log_waves: Array
    log_spread: Array
    freedom: Array
    names: tuple[str, ...]
    map_density: Array
    q_min: float
    q_max: float
    outlying: tuple[str, ...]
    notes: tuple[str, ...]

    @property
    def wavelength(self) -> Array:
        """Wavelength of each bin, 2 pi/q [m]."""
        return 2 * np.pi / self.wavenumber

    @property
    def count(self) -> Array:
        """Number of measurements in each bin, without the outlying ones."""
        used = [name not in self.outlying for name in self.names]
        return np.asarray(np.isfinite(self.map_density[used]).sum(axis=0))

    @numeric
    def interval(self, level: float = 0.95, *, of: Literal["mean", "place"] = "mean") -> tuple[Array, Array]:
        """Return the ends of the interval of the density at each wavenumber, by Student's t.

        Parameters
        ----------
        level : float
            Probability of the interval, between 0 and 1.
        of : {"mean", "place"}
            Of the mean of the surface, or of another place of it (NaN where its scatter is not known).

        Returns
        -------
        low, high : array, shape (n,)
            In the unit of the density.

        Raises
        ------
        ValueError
            If the level is not between 0 and 1, or `of` is unknown.
        """
        if not 0 < level < 1:
            raise about("level", f"must lie between 0 and 1, not {level}", "give one such as 0.95")
        require(of in ("mean", "place"), f"of must be 'mean' or 'place', not {of!r}", place="of")
        error = self.log_error if of == "mean" else np.hypot(self.log_error, self.log_spread)
        half = t.ppf((1 + level) / 2, self.freedom) * error
        return self.density * np.exp(-half), self.density * np.exp(half)

    def to_dataset(self, level: float = 0.95) -> xarray.Dataset:
        """Return the spectrum as a table along ``wavenumber``, with the measurements along ``measurement``.

        Parameters
        ----------
        level : float
            Probability of the intervals.

        Returns
        -------
        xarray.Dataset
            Variables with units and long names; the notes are an attribute.
        """
        unit = {"C2D": "m4", "C1D": "m3"}[self.kind]
        ends = zip(("mean", "place"), (self.interval(level, of=of) for of in ("mean", "place")), strict=True)
        along = "wavenumber"
        data = {
            "density": described(along, self.density, f"power spectrum {self.kind}", unit),
            "log_error": described(along, self.log_error, "standard deviation of the mean ln density"),
            "log_waves": described(along, self.log_waves, "part of log_error by the number of waves"),
            "log_spread": described(
                along, self.log_spread, "standard deviation of ln density between places"
            ),
            "count": described(along, self.count, "number of measurements"),
            "map_density": described(
                ("measurement", along), self.map_density, "density of one measurement in its band", unit
            ),
            "outlying": described(
                "measurement", np.isin(self.names, self.outlying), "differs from the others, not in the mean"
            ),
        }
        for of, values in ends:
            for end, value in zip(("low", "high"), values, strict=True):
                words = f"{end} end of the interval of the {of}, probability {level:g}"
                data[f"{of}_{end}"] = described(along, value, words, unit)
        coordinates = {
            along: described(along, self.wavenumber, "wavenumber", "rad m-1"),
            "measurement": ("measurement", list(self.names), {"long_name": "name of the measurement"}),
        }
        title = "combined power spectrum of a surface"
        geometry = Geometry.SURFACE if self.kind == "C2D" else Geometry.LINE
        return dataset_of(data, coordinates, title, geometry).assign_attrs(
            kind=self.kind, notes="\n".join(self.notes)
        )
