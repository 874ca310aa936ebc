"""Many measurements of one surface."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Self

from roughcontact.errors import InputError, about
from roughcontact.measurement.combination import combine, require_one_surface
from roughcontact.measurement.combined_spectrum import CombinedSpectrum
from roughcontact.measurement.instrument import Instrument
from roughcontact.measurement.measurement import Measurement
from roughcontact.surface.surface import Surface

__all__ = ["Measurements"]


@dataclass(frozen=True, slots=True, eq=False)
class Measurements:
    """Maps and profiles of several places of one surface.

    Attributes
    ----------
    measurements : tuple of Measurement
    surface : str
        Name of the surface, if its container states one.
    left_out : tuple of str
        Files of a folder that were not read.

    Examples
    --------
    >>> import roughcontact as rc
    >>> places = {name: rc.self_affine(rc.Grid((64, 64), 1e-6), 0.8, 1e-7, seed) for seed, name in enumerate("abc")}
    >>> many = rc.Measurements.of(places, instruments={"a": rc.Instrument("AFM", tip_radius=1e-6)})
    >>> [one.name for one in many]
    ['a', 'b', 'c']
    >>> many.combined_spectrum().kind
    'C2D'
    """

    measurements: tuple[Measurement, ...]
    surface: str = ""
    left_out: tuple[str, ...] = ()

    @classmethod
    def of(
        cls,
        maps: Mapping[str, Surface],
        *,
        instruments: Mapping[str, Instrument] | None = None,
        repeats: Sequence[Sequence[str]] = (),
        surface: str = "",
        left_out: Sequence[str] = (),
    ) -> Self:
        """Return the measurements from maps and profiles by name.

        Parameters
        ----------
        maps : mapping of str to Surface
            Heights [m], complete.
        instruments : mapping of str to Instrument, optional
            By the name of a map. What is not stated is not corrected.
        repeats : sequence of sequence of str
            Names of maps of one place on one grid; each group becomes one measurement, named after its first map.
        surface : str
            Name of the surface.
        left_out : sequence of str
            Files that were not read; they are named in the notes.

        Returns
        -------
        Measurements

        Raises
        ------
        ValueError
            If there is no map, a name is unknown, points are missing, or a map is of another surface.
        """
        stated = instruments or {}
        if not maps:
            raise about("maps", "must hold one map at least", "give a mapping of names to surfaces")
        for place, names in (
            ("instruments", list(stated)),
            ("repeats", [n for group in repeats for n in group]),
        ):
            for name in names:
                if name not in maps or names.count(name) > 1:
                    known = ", ".join(map(repr, maps))
                    raise InputError(
                        f"{name!r} is no map, or is named twice", f"name each map once, of {known}", place
                    )
        groups = {group[0]: tuple(group) for group in repeats if group}
        later = {name for group in groups.values() for name in group[1:]}
        found = tuple(
            Measurement.of([maps[each] for each in groups.get(name, (name,))], name, stated.get(name))
            for name in maps
            if name not in later
        )
        require_one_surface(found)
        return cls(found, surface, tuple(left_out))

    def __iter__(self) -> Iterator[Measurement]:
        """Iterate over the measurements."""
        return iter(self.measurements)

    def __len__(self) -> int:
        """Return the number of measurements."""
        return len(self.measurements)

    def __str__(self) -> str:
        """Return a line for each measurement."""
        return "\n".join(map(str, self))

    def combined_spectrum(self) -> CombinedSpectrum:
        """Return one spectrum from all measurements in their reliable bands.

        In each bin of a tenth of a decade, ln C is averaged over places with the weights of random effects, from the
        number of waves and the scatter between places (DerSimonian and Laird). The noise is subtracted and the stated
        resolution corrected. Its relative error of 15 % is part of ``CombinedSpectrum.log_error``; so is a change of C
        by a tip, of 10 % at the shortest wave that the tip follows. A measurement more than 3.5 standard deviations
        from the median in three neighbouring bins is left out of the mean and named. If there are profiles, the
        spectrum is C1D, and maps count by their rows.

        Returns
        -------
        CombinedSpectrum

        Raises
        ------
        ValueError
            If no measurement has a reliable wave.
        """
        return combine(self.measurements, self.left_out)
