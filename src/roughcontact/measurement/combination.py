"""The spectra of measurements in common bins, and their mean."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Literal, NamedTuple

import numpy as np

from roughcontact.errors import InputError
from roughcontact.labels.engineering_units import written
from roughcontact.labels.note import Note, Rank, in_order
from roughcontact.measurement.band import bin_centres
from roughcontact.measurement.bins import Binned, averaged, binned, slopes
from roughcontact.measurement.combined_spectrum import CombinedSpectrum
from roughcontact.measurement.measurement import Measurement
from roughcontact.measurement.scatter import another_surface, between_places, outlying
from roughcontact.validation import Array, Mask

__all__ = ["combine", "require_one_surface"]


class _Common(NamedTuple):
    """Measurements in common bins: their centres, values and kind, and the ends of the bands [rad/m]."""

    used: tuple[Measurement, ...]
    centres: Array
    found: Binned
    kind: Literal["C2D", "C1D"]
    q_min: float
    q_max: float


def _common(measurements: Sequence[Measurement]) -> _Common:
    """Return the measurements with reliable waves in common bins: rings of maps, or rows if there are profiles."""
    profiles = any(one.surface.grid.ndim == 1 for one in measurements)
    pairs = [(one, *one.signal("x" if profiles else "auto")) for one in measurements if one.reliable]
    pairs = [each for each in pairs if each[2][0] < each[2][1]]
    if not pairs:
        limits = ", ".join(sorted({one.limited_by for one in measurements}))
        raise InputError(
            f"no measurement has a reliable wave (limited by {limits})",
            "measure larger maps, finer cells or with less noise, or check what is stated of the instrument",
            "maps",
        )
    used, signals, bands = zip(*pairs, strict=True)
    q_min, q_max = 2 * math.pi / max(band[1] for band in bands), 2 * math.pi / min(band[0] for band in bands)
    centres = bin_centres(q_min, q_max)
    found = binned(signals, bands, centres, np.zeros(centres.size))
    found = binned(signals, bands, centres, slopes(found, centres))
    return _Common(used, centres, found, signals[0].spectrum.kind, q_min, q_max)


def require_one_surface(measurements: Sequence[Measurement]) -> None:
    """Refuse a map whose spectrum shows that it is of another surface than the others."""
    if not any(one.reliable for one in measurements):
        return
    used, _, found, *_ = _common(measurements)
    if (other := another_surface(found)) is not None:
        name = used[other[0]].name
        raise InputError(
            f"{name!r} is not of the surface of the others: its spectrum is {other[1]:.3g} times theirs in all bins",
            "leave it out, or check its unit",
            "maps",
        )


def combine(measurements: Sequence[Measurement], left_out: Sequence[str] = ()) -> CombinedSpectrum:
    """Return the mean of ln C over places, with weights of random effects: the scatter of waves and of places.

    Parameters
    ----------
    measurements : sequence of Measurement
    left_out : sequence of str
        Files that were not read.
    """
    used, centres, found, kind, q_min, q_max = _common(measurements)
    rows = outlying(found)
    out = np.asarray(rows.any(axis=1))
    names = tuple(one.name for one in used)
    kept = Binned(*(each[~out] for each in found))
    spread, spare = between_places(kept)
    own = np.nan_to_num(kept.variance, nan=math.inf)
    scatter = np.nan_to_num(spread) ** 2
    mean, total = averaged(kept.log, 1 / (own + scatter))
    some = np.isfinite(mean)
    blur, _ = averaged(kept.blur, 1 / (own + scatter))
    with np.errstate(divide="ignore", invalid="ignore"):
        alone = 1 / (1 / own).sum(axis=0)  # variance of the mean by the waves, without the places
        count = np.isfinite(kept.log).sum(axis=0)
        # Satterthwaite: the part of the places is estimated, from count - 1 differences; from few it may seem zero.
        freedom = np.maximum(count - 1, 1) / (1 - alone * total) ** 2
        freedom = np.where(spare > 0, np.minimum(freedom, spare), math.inf)
        error = np.sqrt(1 / total + blur**2)
    outliers = tuple(name for name, gone in zip(names, out, strict=True) if gone)
    notes = [*_notes(measurements, used), *_outlying_notes(names, rows, centres)]
    if left_out:
        text = f"not read, because their ending is not that of a map: {', '.join(left_out)}"
        notes.append(Note(Rank.LIMITED, text))
    if (single := int((count[some] == 1).sum())) > 0:
        text = f"{single} of {some.sum()} bins hold one map only: their scatter between places is that of neighbours"
        notes.append(Note(Rank.LIMITED, f"{text}, or not known"))
    waves = np.sqrt(alone[some])
    return CombinedSpectrum(
        *(centres[some], np.exp(mean[some]), kind, error[some], waves, spread[some], freedom[some]),
        *(names, np.exp(found.log[:, some]), q_min, q_max, outliers, in_order(notes)),
    )


def _notes(measurements: Sequence[Measurement], used: Sequence[Measurement]) -> Iterator[Note]:
    """Yield what is assumed, not known and not used."""

    def listed(chosen: Sequence[Measurement]) -> str:
        return ", ".join(repr(one.name) for one in chosen)

    if gone := [one for one in measurements if one not in used]:
        yield Note(Rank.DOUBTFUL, f"{listed(gone)}: no reliable wave, not in the spectrum")
    if assumed := [one for one in used if one.noise_found == "spectrum, assumed"]:
        text = f"{listed(assumed)}: the noise is assumed, from the flat end of the spectrum; repeats would show it"
        yield Note(Rank.DOUBTFUL, text)
    if silent := [
        one for one in used if one.instrument.resolution is None and one.instrument.tip_radius is None
    ]:
        text = f"{listed(silent)}: no resolution and no tip radius are stated, so blur is not corrected"
        yield Note(Rank.LIMITED, text)
    dimensions = {one.surface.grid.ndim for one in used}
    if len(dimensions) == 2:
        yield Note(Rank.USUAL, "maps count by the profiles along their rows, because there are profiles")


def _outlying_notes(names: Sequence[str], rows: Mask, centres: Array) -> Iterator[Note]:
    """Yield the names of the measurements that stand out, and where."""
    for name, bins in zip(names, rows, strict=True):
        if bins.any():
            waves = 2 * math.pi / centres[bins]
            ends = f"{written(waves.min(), 'm', 2)} to {written(waves.max(), 'm', 2)}"
            text = f"{name!r} differs from the other measurements at wavelengths of {ends}; it is left out of the mean"
            yield Note(Rank.DOUBTFUL, text)
