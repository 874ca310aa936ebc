"""The steps of ``surface prepare``: from what the user wrote to what is done with a surface, in order."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING, Any, ClassVar

from roughcontact.cli.messages import UsageError
from roughcontact.cli.option_groups import option
from roughcontact.cli.options import Despike
from roughcontact.cli.report import quantity
from roughcontact.cli.unit_options import LENGTH, parse

if TYPE_CHECKING:
    from roughcontact.surface.surface import Surface

__all__ = ["Preparation", "PreparationOptions", "steps"]

_BLUNTEST = 0.1  # radius of a tip [m]: no tip is larger, and most likely a unit was forgotten


Trend = StrEnum("Trend", ["NONE", "MEAN", "PLANE", "QUADRATIC"])
TipShape = StrEnum("TipShape", ["SPHERE", "PARABOLOID"])
WindowShape = StrEnum("WindowShape", ["HANN", "WELCH", "TUKEY"])


@dataclass(frozen=True, slots=True)
class PreparationOptions:
    """What the user wrote, option by option; None where an option was left out."""

    PANEL: ClassVar = "Steps, in the order in which they are taken"
    crop: str | None = option(
        "1. Keep these rows and columns, counted from 0 at the top left (of a profile 0:512).",
        "0:512,100:612",
    )
    despike: Despike | None = option(
        "2. Spikes, clusters of a few cells far out of all around them: to missing points, or filled smoothly."
    )
    mask: list[str] | None = option(
        "3. Take a region out, to missing points: box= or ellipse= of rows,columns; after 5. heights beyond above=3um "
        "or below=-3um. outside- in front takes out all but the region. May be given again.",
        "box=0:99,10:50",
    )
    level: Trend = option(
        "4. Remove the mean height, or a least-squares plane or quadratic.", default=Trend.NONE
    )
    form: str | None = option("5. Remove a form: a polynomial's degree, sphere or cylinder.", "2")
    fill: bool = option("6. Fill missing points smoothly; else they stay missing.", default=False)
    tip: str | None = option("7. What a tip of this radius records; a large one takes long.", "2um")
    tip_shape: TipShape | None = option("7. Shape of its end (default: sphere).")
    short_cutoff: str | None = option(
        "8. Gaussian filter: remove waves shorter than this (S-filter).", "10um"
    )
    long_cutoff: str | None = option("8. Gaussian filter: remove waves longer than this (L-filter).", "1mm")
    average: int | None = option("9. Average over pixels of K x K cells, as a camera does.", "K")
    downsample: int | None = option(
        "10. Keep every K-th row and column; shorter waves are filtered out first.", "K"
    )
    alias: bool = option("10. Subsample without that filter.", default=False)
    window: WindowShape | None = option("11. Taper the heights about their mean to zero at free edges.")
    share: float | None = option("11. Part of the length that a Tukey window tapers (default: 0.25).", "0.25")


@dataclass(frozen=True, slots=True)
class Preparation:
    """One step: what is being done, in a word for the screen, and how."""

    doing: str
    apply: Callable[[Surface], Surface]


def steps(options: PreparationOptions) -> list[Preparation]:
    """Return what was asked for, in the order of application.

    Raises
    ------
    UsageError
        If an option makes no sense, alone or without another.
    """
    masks = [_mask(text) for text in options.mask or []]
    found = [
        _crop(options.crop),
        _despike(options.despike),
        *(step for step, of_heights in masks if not of_heights),
        _level(options.level),
        _form(options.form),
        *(step for step, of_heights in masks if of_heights),
        Preparation("Filling", lambda surface: surface.filled() if surface.missing else surface)
        if options.fill
        else None,
        _tip(options.tip, options.tip_shape),
        _filter({"short_cutoff": options.short_cutoff, "long_cutoff": options.long_cutoff}),
        _average(options.average),
        _downsample(options.downsample, options.alias),
        _window(options.window, options.share),
    ]
    return [step for step in found if step is not None]


def _crop(text: str | None) -> Preparation | None:
    """Return the cut of ``0:512,100:612``, of a line ``0:512``; an end left open is that of the map."""
    if text is None:
        return None
    parts = _ranges(text, "--crop")
    return Preparation("Cropping", lambda surface: surface.cropped(*parts(surface)))


def _ranges(text: str, name: str) -> Callable[[Surface], list[slice]]:
    """Return what makes the ranges of cells that the user wrote those of a surface, with as many axes."""
    matches = [re.fullmatch(r"\s*(\d*)\s*:\s*(\d*)\s*", part, re.ASCII) for part in text.split(",")]
    if len(matches) > 2 or not all(matches):
        raise UsageError(
            f"{text!r} is no part of a map",
            "write rows,columns such as 0:512,100:612, or 0:512 of a profile",
            place=name,
        )
    parts = [
        slice(*(int(end) if end else None for end in match.groups()))
        for match in matches
        if match is not None
    ]

    def of(surface: Surface) -> list[slice]:
        if len(parts) != surface.grid.ndim:
            wanted = (
                "rows,columns such as 0:512,100:612" if surface.grid.ndim == 2 else "one range such as 0:512"
            )
            raise UsageError(f"{text!r} has {len(parts)} range(s)", f"write {wanted}", place=name)
        return parts

    return of


def _despike(kind: Despike | None) -> Preparation | None:
    return None if kind is None else Preparation("Looking for spikes", kind.remove)


def _mask(text: str) -> tuple[Preparation, bool]:
    """Return the mask that the user wrote, and whether it is one of heights."""
    found = re.fullmatch(r"\s*(outside-)?(box|ellipse|above|below)\s*=(.+)", text)
    if found is None:
        raise UsageError(
            f"{text!r} is no region",
            "write box=0:99,10:50, ellipse=0:99,10:50, above=3um or below=-3um",
            place="--mask",
        )
    outside, kind, value = bool(found[1]), found[2], found[3]
    if kind in ("above", "below"):
        ends: dict[str, Any] = {kind: parse(value, LENGTH, f"--mask {kind}")}
        return Preparation("Masking", lambda surface: surface.masked(**ends, outside=outside)), True
    parts = _ranges(value, f"--mask {kind}")

    def apply(surface: Surface) -> Surface:
        region: Any = {kind: parts(surface)}
        return surface.masked(**region, outside=outside)

    return Preparation("Masking", apply), False


def _level(trend: Trend) -> Preparation | None:
    if trend is Trend.NONE:
        return None
    chosen: Any = trend.value
    return Preparation("Levelling", lambda surface: surface.levelled(chosen))


def _form(text: str | None) -> Preparation | None:
    """Return the removal of the form that the library knows by `text`: a degree or a word."""
    if text is None:
        return None
    shape: Any = text
    if text not in ("sphere", "cylinder"):
        if re.fullmatch(r"\d{1,2}", text, re.ASCII) is None or int(text) > 12:
            raise UsageError(
                f"{text!r} is no form", "write a degree from 0 to 12, sphere or cylinder", place="--form"
            )
        shape = int(text)
    return Preparation("Removing the form", lambda surface: surface.without_form(shape))


def _tip(text: str | None, shape: TipShape | None) -> Preparation | None:
    if text is None:
        if shape is not None:
            raise UsageError("--tip-shape belongs to --tip", "give its radius as well", place="--tip-shape")
        return None
    radius = parse(text, LENGTH, "--tip")
    if not 0 < radius < _BLUNTEST:
        raise UsageError(
            f"a radius of {quantity('lengths', radius)} is no tip",
            "write it with its unit, such as 2um",
            place="--tip",
        )
    chosen: Any = (shape or TipShape.SPHERE).value
    return Preparation("Scanning by the tip", lambda surface: surface.scanned(radius, chosen))


def _filter(given: dict[str, str | None]) -> Preparation | None:
    cutoffs = {
        name: parse(text, LENGTH, f"--{name.replace('_', '-')}")
        for name, text in given.items()
        if text is not None
    }
    return Preparation("Filtering", lambda surface: _filtered(surface, cutoffs)) if cutoffs else None


def _filtered(surface: Surface, cutoffs: dict[str, float]) -> Surface:
    short, longest = cutoffs.get("short_cutoff"), max(surface.grid.lengths)
    if short is not None and short >= longest:
        # Most likely a unit was forgotten: nothing but the mean would be left.
        raise UsageError(
            f"a cut-off of {quantity('lengths', short)} leaves nothing of a map of "
            f"{quantity('lengths', longest)}",
            "give its unit, such as 10um",
            place="--short-cutoff",
        )
    return surface.filtered(**cutoffs)


def _average(factor: int | None) -> Preparation | None:
    if factor is None:
        return None
    _require_factor(factor, "--average")
    return Preparation("Averaging", lambda surface: surface.averaged(factor))


def _require_factor(factor: int, name: str) -> None:
    if factor < 1:
        raise UsageError(f"K must be a whole number from 1 up, not {factor}", place=name)


def _downsample(factor: int | None, alias: bool) -> Preparation | None:
    if factor is None:
        if alias:
            raise UsageError("--alias belongs to --downsample", "give its K as well", place="--alias")
        return None
    _require_factor(factor, "--downsample")
    return Preparation("Subsampling", lambda surface: surface.downsampled(factor, anti_alias=not alias))


def _window(window: WindowShape | None, share: float | None) -> Preparation | None:
    if share is not None and window is not WindowShape.TUKEY:
        raise UsageError("--share belongs to --window tukey", place="--share")
    if window is None:
        return None
    if share is not None and not 0 <= share <= 1:
        raise UsageError(
            f"the tapered part of the length lies between 0 and 1, not at {share:g}", place="--share"
        )
    chosen: Any = window.value
    bent = 0.25 if share is None else share
    return Preparation("Tapering", lambda surface: surface.tapered(chosen, bent))
