"""One measurement of a surface: a map or a profile, with its instrument, its noise and its reliable band."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, Self

from roughcontact.errors import InputError, about
from roughcontact.evaluation.noise import Noise
from roughcontact.labels.engineering_units import written
from roughcontact.measurement.band import reliable_band
from roughcontact.measurement.instrument import Instrument
from roughcontact.measurement.signal import Signal, assumed_noise, signal_of
from roughcontact.surface.surface import Surface

__all__ = ["Measurement"]

NoiseFound = Literal["repeats", "stated", "spectrum, assumed", "not found"]


@dataclass(frozen=True, slots=True, eq=False)
class Measurement:
    """A map or a profile of a surface, and the waves that it holds reliably.

    Attributes
    ----------
    surface : Surface
        Heights on a grid of two axes or one [m].
    name : str
    instrument : Instrument
    band : tuple of float
        Shortest and longest reliable wavelength [m]. There is no reliable wave if the first is larger.
    limited_by : {"cells", "resolution", "tip", "noise"}
        What sets the shortest wavelength.
    weight : float
        Effective number of independent waves in the band.
    noise : Noise or None
        Random errors of one map.
    noise_found : {"repeats", "stated", "spectrum, assumed", "not found"}
        By differences of repeats, as stated by the instrument, or from the flat end of the spectrum.
    repeats : tuple of Surface
        Further maps of the same place.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rough = rc.self_affine(rc.Grid((64, 64), 1e-6), hurst=0.8, rms=1e-7, rng=1)
    >>> one = rc.Measurement.of([rough], "left", rc.Instrument("AFM", resolution=6e-6))
    >>> f"{one.band[0] * 1e6:.0f} to {one.band[1] * 1e6:.0f} um, limited by {one.limited_by}"
    '6 to 21 um, limited by resolution'
    """

    surface: Surface
    name: str
    instrument: Instrument
    band: tuple[float, float]
    limited_by: str
    weight: float
    noise: Noise | None
    noise_found: NoiseFound
    repeats: tuple[Surface, ...] = ()

    @classmethod
    def of(cls, surfaces: Sequence[Surface], name: str, instrument: Instrument | None = None) -> Self:
        """Return the measurement of one place by one or more maps, whose differences are noise.

        Parameters
        ----------
        surfaces : sequence of Surface
            Maps or profiles of one place on one grid [m].
        name : str
        instrument : Instrument, optional

        Returns
        -------
        Measurement

        Raises
        ------
        ValueError
            If points are missing, or the grids of repeats differ.
        """
        stated = instrument or Instrument()
        first = surfaces[0]
        if holes := sum(surface.missing for surface in surfaces):
            raise about(
                f"{name!r}", f"lacks {holes} heights", "fill them by filled(), or crop the map by cropped()"
            )
        if any(surface.grid != first.grid for surface in surfaces):
            raise InputError(
                f"the repeats of {name!r} lie on different grids",
                "crop them to one, or bring them onto one by rc.resampled()",
                "repeats",
            )
        noise, found = stated.noise, "stated"
        if len(surfaces) > 1:
            noise, found = Noise.from_repeats(surfaces), "repeats"
        elif noise is None:
            noise = assumed_noise(first)
            found = "not found" if noise is None else "spectrum, assumed"
        signal = signal_of(surfaces, noise, stated)
        band, limit = reliable_band(first, signal, stated)
        wave = signal.spectrum.wavelength
        weight = float(signal.spectrum.freedom[(wave >= band[0]) & (wave <= band[1])].sum())
        return cls(first, name, stated, band, limit, weight, noise, found, tuple(surfaces[1:]))  # type: ignore[arg-type]

    def __str__(self) -> str:
        """Return name, instrument, band and noise in a line."""
        short, long = (written(length, "m") for length in self.band)
        band = f"{short} to {long}, limited by {self.limited_by}" if self.reliable else "no reliable wave"
        noise = "" if self.noise is None else f"{self.noise} ({self.noise_found})"
        return "; ".join(
            (self.name, self.instrument.name or "instrument not stated", band, noise or "noise not found")
        )

    @property
    def reliable(self) -> bool:
        """Whether the band holds waves."""
        return self.band[0] < self.band[1]

    def signal(self, direction: Literal["auto", "x"] = "auto") -> tuple[Signal, tuple[float, float]]:
        """Return the spectra of signal and noise, and the reliable band.

        Parameters
        ----------
        direction : {"auto", "x"}
            Rings of a map, or its rows.

        Returns
        -------
        signal : Signal
        band : tuple of float
            Shortest and longest reliable wavelength [m].

        Examples
        --------
        >>> import roughcontact as rc
        >>> rough = rc.self_affine(rc.Grid((64, 64), 1e-6), hurst=0.8, rms=1e-7, rng=1)
        >>> rc.Measurement.of([rough], "left").signal("x")[0].spectrum.kind
        'C1D'
        """
        signal = signal_of((self.surface, *self.repeats), self.noise, self.instrument, direction)
        return signal, self.band if direction == "auto" else reliable_band(
            self.surface, signal, self.instrument
        )[0]
