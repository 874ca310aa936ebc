"""The preparation of measured heights before they are pressed: steps in their order."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any, ClassVar

from roughcontact.errors import InputError
from roughcontact.files.quantity import LENGTH
from roughcontact.recipe.job_calls import Call
from roughcontact.recipe.recipe_fields import check, described, specs, value_of
from roughcontact.recipe.texts import Amount, Choice, PureNumber, ranges, whole

__all__ = ["Preparation", "Step", "masks_named"]

# In messages of the library.
_MASKED = re.compile(r"\bmasked\((above|below)=([-+.\de]+)\)")
_BOXED = re.compile(r"\bmasked\(box=\(slice\((\d+), (\d+)\), slice\((\d+), (\d+)\)\)\)")
_REGIONS = ("above", "below", "box", "ellipse")
_BLUNTEST = 0.1  # radius of a tip [m]: for a larger value most likely the unit is missing


@dataclass(frozen=True, slots=True)
class Step:
    """The use of a field as an argument of a method of `roughcontact.Surface`.

    Parameters
    ----------
    method : str
        The method. Fields of the same method, one after the other, are the arguments of one call.
    doing : str
        The name of the step in reports of progress.
    named : str or None
        The name of the argument; None if it is given by its place.
    flag : Any
        The argument for a flag; None if the call has no argument for it.
    """

    method: str
    doing: str = ""
    named: str | None = None
    flag: Any = None

    def call(self, name: str, value: Any) -> Call:
        """Return the call of a step whose field has a value."""
        value = self.flag if value is True else value
        given = () if value is None or self.named else value if isinstance(value, tuple) else (value,)
        named = {self.named: value} if self.named else {}
        return _on_surface(self.method, given, named, name, self.doing)


def masks_named(text: str, name: str) -> str:
    """Return a text of the library in which each call of `masked` is written as the field, after `name`."""
    text = _BOXED.sub(rf"{name}box=\1:\2,\3:\4", text)
    return _MASKED.sub(lambda call: f"{name}{call[1]}={float(call[2]) * 1e6:.6g}um", text)


def _mask(text: str) -> dict[str, Any]:
    """Return the region in a text, as arguments of `roughcontact.Surface.masked`."""
    found = re.fullmatch(rf"\s*(outside-)?({'|'.join(_REGIONS)})\s*=(.+)", text)
    if found is None:
        raise InputError(
            f"{text!r} is not a region", "write above=3um, below=-3um, box=0:9,10:30 or ellipse=0:9,10:30"
        )
    kind, value = found[2], found[3]
    region: Any = Amount(LENGTH, positive=False)(value) if kind in ("above", "below") else ranges(value)
    return {kind: region, **({"outside": True} if found[1] else {})}


def _form(text: str) -> int | str:
    """Return the form in a text: a degree, or a word."""
    if text in ("sphere", "cylinder"):
        return text
    if re.fullmatch(r"\d{1,2}", text, re.ASCII) is None or int(text) > 12:
        raise InputError(f"{text!r} is not a form", "write a degree from 0 to 12, sphere or cylinder")
    return int(text)


def _tip(text: str) -> float:
    radius = Amount(LENGTH, "the radius of a tip")(text)
    if radius >= _BLUNTEST:
        raise InputError(
            f"a radius of {radius:g} m is too large for a tip", "write it with its unit, such as 2um"
        )
    return radius


def _step(
    help: str, example: str | None = None, *step: Any, read: Callable[[Any], Any] = str, **more: Any
) -> Any:
    return described(help, example, read=read, step=Step(*step), **{"needs_whole": True, **more})


@dataclass(frozen=True, slots=True, kw_only=True)
class Preparation:
    """The steps. Steps that are left out are skipped, except levelling before a surface is pressed."""

    TITLE: ClassVar = "Preparation, in this order"
    crop: str | None = _step(
        "Keep these rows and columns, counted from 0 at the top left (for a profile 0:512).",
        "0:40,5:45",
        "cropped",
        "Cropping",
        read=ranges,
    )
    despike: str | None = _step(
        "Remove spikes and streaks, cells far from all their neighbours: mark them as missing, or fill them smoothly.",
        None,
        "despiked",
        "Searching for spikes",
        read=Choice(("missing", "filled")),
        everyday=True,
    )
    mask: tuple[str, ...] = _step(
        "Mark a region as missing: heights above=3um or below=-3um, measured after the form is removed; or box= or "
        "ellipse= of rows,columns, such as box=0:9,10:30. With outside- in front, everything except the region is "
        "marked. May be repeated.",
        "above=3um",
        "masked",
        "Masking",
        read=_mask,
        names=tuple(f"{out}{kind}=" for out in ("", "outside-") for kind in _REGIONS),
        default=(),
    )
    align: str | None = _step(
        "Align scan lines that an AFM shifted against each other: each gets the median height of the map.",
        None,
        "aligned",
        "Aligning scan lines",
        read=Choice(("rows", "columns")),
    )
    level: str | None = _step(
        "Remove the mean height, or a least-squares plane or quadratic (default before pressing: a plane; for a file "
        "marked as periodic the mean).",
        None,
        "levelled",
        "Levelling",
        read=Choice(("none", "mean", "plane", "quadratic")),
        everyday=True,
        needs_whole=False,
    )
    form: str | None = _step(
        "Remove a form: a polynomial's degree, sphere or cylinder.",
        "2",
        "without_form",
        "Removing the form",
        read=_form,
    )
    fill: bool = _step(
        "Fill missing points smoothly; otherwise they stay missing.", None, "filled", "Filling", default=False
    )
    tip: str | None = _step(
        "Simulate the scan of a tip of this radius; large tips take long.",
        "2um",
        "scanned",
        "Scanning by the tip",
        read=_tip,
    )
    tip_shape: str | None = _step(
        "Shape of the tip's end (default: sphere).",
        None,
        "scanned",
        read=Choice(("sphere", "paraboloid")),
        needs="tip",
    )
    short_cutoff: str | None = _step(
        "Gaussian filter: remove waves shorter than this (S-filter).",
        "10um",
        "filtered",
        "Filtering",
        "short_cutoff",
        read=Amount(LENGTH, "the cut-off"),
    )
    long_cutoff: str | None = _step(
        "Gaussian filter: remove waves longer than this (L-filter).",
        "1mm",
        "filtered",
        "Filtering",
        "long_cutoff",
        read=Amount(LENGTH, "the cut-off"),
    )
    average: str | None = _step(
        "Average over pixels of K x K cells, as a camera does.",
        "K",
        "averaged",
        "Averaging",
        read=whole(1, "the number of cells"),
    )
    downsample: str | None = _step(
        "Keep every K-th row and column; shorter waves are filtered out first.",
        "K",
        "downsampled",
        "Subsampling",
        read=whole(1, "the number of cells"),
    )
    alias: bool = _step(
        "Keep every K-th row and column without filtering first.",
        None,
        "downsampled",
        "",
        "anti_alias",
        False,
        default=False,
        needs="downsample",
    )
    window: str | None = _step(
        "Taper the heights about their mean to zero at free edges.",
        None,
        "tapered",
        "Tapering",
        read=Choice(("hann", "welch", "tukey")),
    )
    share: str | None = _step(
        "Share of the length that a Tukey window tapers (default: 0.25).",
        "0.25",
        "tapered",
        read=PureNumber(0, 1, "the tapered part of the length", "0.25"),
        needs="window",
    )

    def __post_init__(self) -> None:
        check(self)
        if self.share is not None and self.window != "tukey":
            raise InputError("`share` belongs to a Tukey window", "give `window` tukey", "share")

    def calls(self, level: str = "none") -> Iterator[Call]:
        """Yield the calls of the steps; `level` is the default of the field of this name."""
        found: list[Call] = []
        regions: list[dict[str, Any]] = value_of(self, "mask")
        heights = [region for region in regions if region.keys() & {"above", "below"}]
        for each, spec in specs(self):
            value = value_of(self, each.name)
            if each.name == "mask":
                found += [_masked(region) for region in regions if region not in heights]
            elif each.name == "level" and value is None:
                value = level
            if each.name != "mask" and value not in (None, False, "none"):
                call = spec.step.call(each.name, value)
                if found and found[-1].function == call.function:  # one more argument
                    before = found.pop()
                    call = replace(
                        before, given=before.given + call.given, named={**before.named, **call.named}
                    )
                found.append(call)
            if each.name == "form":
                found += map(_masked, heights)
        yield from found


def _masked(region: dict[str, Any]) -> Call:
    return _on_surface("masked", (), region, "mask", "Masking")


def _on_surface(method: str, given: tuple[Any, ...], named: dict[str, Any], name: str, doing: str) -> Call:
    return Call(f"surface.{method}", given, named, "surface", place=f"preparation.{name}", doing=doing)
