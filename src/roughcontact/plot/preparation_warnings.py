"""Suspicious features of a measured map, and the option of ``surface prepare`` that corrects each."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from roughcontact.plot.facts import quantity
from roughcontact.recipe.preparation import masks_named
from roughcontact.surface.preparation.despike import without_spikes
from roughcontact.surface.preparation.outliers import OUTLYING, height_limits
from roughcontact.surface.preparation.polynomial import polynomial_trend
from roughcontact.surface.preparation.spikes import find_spikes
from roughcontact.surface.preparation.streaks import tail_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from roughcontact.surface.preparation.spikes import Spikes
    from roughcontact.surface.surface import Surface
    from roughcontact.validation import Array

__all__ = ["PreparationWarning", "preparation_warnings"]

_FEW = (
    32  # cells along a side: with fewer there is no decade of waves between a third of the side and two cells
)
_LINES = 8  # rows or columns at least for statistics of the steps between them
_WHOLE = 0.5  # smallest measured part of a row


@dataclass(frozen=True, slots=True)
class PreparationWarning:
    """A suspicious feature of a map, and the step of ``surface prepare`` that corrects it.

    Parameters
    ----------
    kind : str
        Its name, in a word or two.
    words : str
        Its description.
    remedy : str
        The remedy, as options of the command line.
    step : tuple of str, optional
        The first option and its value; None if no option corrects it.
    """

    kind: str
    words: str
    remedy: str
    step: tuple[str, str] | None = None

    def __str__(self) -> str:
        return f"{self.kind}: {self.words}: {self.remedy}"


def preparation_warnings(surface: Surface) -> tuple[Spikes, list[PreparationWarning]]:
    """Return the spikes of a surface, and the warnings about it."""
    spikes = find_spikes(surface)
    clean = without_spikes(surface, spikes)
    found = [*_spikes(spikes), *_far(clean), *_trends(clean), *_steps(surface), *_cells(surface)]
    return spikes, found


def _spikes(spikes: Spikes) -> Iterator[PreparationWarning]:
    if spikes.count:
        place = ",".join(str(k) for k in spikes.places[0])
        largest = quantity("heights", float(spikes.height[0]))
        words = f"{spikes}, the largest by {largest}, at cell {place}"
        remedy = "--despike missing or filled"
        if spikes.streak.any():
            remedy += ", then look at the pressure for pieces of streaks (docs/concepts/spikes.md)"
        yield PreparationWarning("spikes", words, remedy, ("despike", "filled"))


def _far(clean: Surface) -> Iterator[PreparationWarning]:
    """Yield warnings about heights far from nearly all others without the tilt, above and below."""
    heights = clean.levelled("auto").heights
    for name, limit, sign in zip(("below", "above"), height_limits(heights), (-1, 1), strict=True):
        if far := int(np.count_nonzero(sign * heights > sign * limit)):
            count = "1 point" if far == 1 else f"{far} points"
            mask = masks_named(f"masked({name}={limit:.6g})", "")
            words = f"{count} more than {OUTLYING:g} rms heights {name} the mean of nearly all"
            level = "mean" if all(clean.grid.periodic) else "plane"
            yield PreparationWarning(
                f"points far {name}", words, f"--level {level} --mask {mask}", ("mask", mask)
            )


def _trends(clean: Surface) -> Iterator[PreparationWarning]:
    """Yield warnings about the plane and the quadratic form if they are larger than the remaining heights."""
    if all(clean.grid.periodic):
        return
    flat, tilt = _without(clean.heights, 1)
    rest, form = _without(flat, 2)
    trend = "plane" if clean.grid.ndim == 2 else "line"
    if tilt > float(np.nanstd(flat)):
        words = f"the {trend} has an rms height of {quantity('rms', tilt)}, more than the rest"
        yield PreparationWarning("tilt", words, "--level plane", ("level", "plane"))
    if form > float(np.nanstd(rest)) > 0:
        words = f"the quadratic part has an rms height of {quantity('rms', form)}, more than the rest"
        remedy = "--form 2, sphere or cylinder, for only the roughness"
        yield PreparationWarning("form", words, remedy, ("form", "2"))


def _without(heights: Array, degree: int) -> tuple[Array, float]:
    """Return the heights without their least-squares polynomial, and the rms height of the polynomial."""
    trend = polynomial_trend(heights, degree)
    return heights - trend, float(np.std(trend[~np.isnan(heights)]))


def _steps(surface: Surface) -> Iterator[PreparationWarning]:
    """Yield a warning about the largest step between two rows or columns, if it is significant."""
    if surface.grid.ndim == 1:
        return
    for axis, name in enumerate(("rows", "columns")):
        differences = np.diff(surface.heights, axis=axis)
        # The median of a row with few measured points is not reliable.
        known = (
            np.count_nonzero(~np.isnan(differences), axis=1 - axis) >= _WHOLE * surface.grid.shape[1 - axis]
        )
        if np.count_nonzero(known) < _LINES:
            continue
        jumps = np.full(known.size, 0.0)
        jumps[known] = np.nanmedian(differences[known] if axis == 0 else differences[:, known], axis=1 - axis)
        jumps[known] -= np.median(jumps[known])
        _, limit = tail_of(np.abs(jumps[known]), int(known.sum()))
        place = int(np.argmax(np.abs(jumps)))
        if limit > 0 and abs(jumps[place]) > limit:
            count = surface.grid.shape[axis]
            part = f"0:{place + 1}" if 2 * (place + 1) >= count else f"{place + 1}:{count}"
            crop = f"{part},:" if axis == 0 else f":,{part}"
            step = quantity("heights", float(jumps[place]))
            words = f"{step} between {name} {place} and {place + 1}"
            remedy = f"--crop {crop} keeps one side; --align {name} if each scan line has its own height"
            yield PreparationWarning("step", words, remedy, ("crop", crop))


def _cells(surface: Surface) -> Iterator[PreparationWarning]:
    if min(surface.grid.shape) < _FEW:
        cells = " x ".join(str(n) for n in surface.grid.shape)
        words = f"{cells} hold no decade of waves, and no power law"
        remedy = "no option mends that; measure more points, or read another --channel"
        yield PreparationWarning("few cells", words, remedy)
    if surface.missing:
        words = f"{surface.missing / surface.grid.size:.2%}, which contact leaves out"
        remedy = "--fill for spectra and filters, or --crop"
        yield PreparationWarning("missing points", words, remedy, ("fill", ""))
