"""From heights as they were measured to heights that are pressed: steps, in the order in which they are taken."""

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

_MASKED = re.compile(r"\bmasked\((above|below)=([-+.\de]+)\)")  # in what the library says
_REGIONS = ("above", "below", "box", "ellipse")
_BLUNTEST = 0.1  # radius of a tip [m]: no tip is larger, and most likely a unit was forgotten


@dataclass(frozen=True, slots=True)
class Step:
    """What the value of a field is to a method of `roughcontact.Surface`.

    Parameters
    ----------
    method : str
        The method. Fields of the same method, one after the other, are the arguments of one call.
    doing : str
        What it does, for whoever waits.
    named : str or None
        The name of the argument; None where it is given by its place.
    flag : Any
        What a flag stands for as an argument; None where it asks for the call alone.
    """

    method: str
    doing: str = ""
    named: str | None = None
    flag: Any = None

    def call(self, name: str, value: Any) -> Call:
        """Return the call of the step of a field that has a value."""
        value = self.flag if value is True else value
        given = () if value is None or self.named else value if isinstance(value, tuple) else (value,)
        named = {self.named: value} if self.named else {}
        return _on_surface(self.method, given, named, name, self.doing)


def masks_named(text: str, name: str) -> str:
    """Return a text of the library with each call that masks heights as the field is given, `name` before it."""
    return _MASKED.sub(lambda call: f"{name}{call[1]}={float(call[2]) * 1e6:.6g}um", text)


def _mask(text: str) -> dict[str, Any]:
    """Return the region that a text states, as arguments of `roughcontact.Surface.masked`."""
    found = re.fullmatch(rf"\s*(outside-)?({'|'.join(_REGIONS)})\s*=(.+)", text)
    if found is None:
        raise InputError(
            f"{text!r} is no region", "write above=3um, below=-3um, box=0:9,10:30 or ellipse=0:9,10:30"
        )
    kind, value = found[2], found[3]
    region: Any = Amount(LENGTH, positive=False)(value) if kind in ("above", "below") else ranges(value)
    return {kind: region, **({"outside": True} if found[1] else {})}


def _form(text: str) -> int | str:
    """Return the form that a text names: a degree, or a word."""
    if text in ("sphere", "cylinder"):
        return text
    if re.fullmatch(r"\d{1,2}", text, re.ASCII) is None or int(text) > 12:
        raise InputError(f"{text!r} is no form", "write a degree from 0 to 12, sphere or cylinder")
    return int(text)


def _tip(text: str) -> float:
    radius = Amount(LENGTH, "the radius of a tip")(text)
    if radius >= _BLUNTEST:
        raise InputError(f"a radius of {radius:g} m is no tip", "write it with its unit, such as 2um")
    return radius


def _step(
    help: str, example: str | None = None, *step: Any, read: Callable[[Any], Any] = str, **more: Any
) -> Any:
    return described(help, example, read=read, step=Step(*step), **{"needs_whole": True, **more})


@dataclass(frozen=True, slots=True, kw_only=True)
class Preparation:
    """The steps. A step that is left out is not taken, but for levelling before a surface is pressed."""

    TITLE: ClassVar = "Preparation, in this order"
    crop: str | None = _step(
        "Keep these rows and columns, counted from 0 at the top left (of a profile 0:512).",
        "0:40,5:45",
        "cropped",
        "Cropping",
        read=ranges,
    )
    despike: str | None = _step(
        "Spikes and streaks, cells far out of all around them: to missing points, or filled smoothly.",
        None,
        "despiked",
        "Looking for spikes",
        read=Choice(("missing", "filled")),
        everyday=True,
    )
    mask: tuple[str, ...] = _step(
        "Take a region out, to missing points: heights beyond above=3um or below=-3um, which are counted when the form "
        "is gone; box= or ellipse= of rows,columns, such as box=0:9,10:30. outside- in front takes out all but the "
        "region. May be given again.",
        "above=3um",
        "masked",
        "Masking",
        read=_mask,
        names=tuple(f"{out}{kind}=" for out in ("", "outside-") for kind in _REGIONS),
        default=(),
    )
    align: str | None = _step(
        "Bring the median height of each scan line to that of the map: lines that an AFM shifted against each other.",
        None,
        "aligned",
        "Aligning scan lines",
        read=Choice(("rows", "columns")),
    )
    level: str | None = _step(
        "Remove the mean height, or a least-squares plane or quadratic (before a surface is pressed: a plane; of one "
        "whose file says that it repeats itself, the mean).",
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
        "Fill missing points smoothly; else they stay missing.", None, "filled", "Filling", default=False
    )
    tip: str | None = _step(
        "What a tip of this radius records; a large one takes long.",
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
        "Keep every K-th row and column without that filter.",
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
        "Part of the length that a Tukey window tapers (default: 0.25).",
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
        """Yield the steps that are taken; without a word on it the heights are levelled by `level`."""
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
                if found and found[-1].function == call.function:  # an argument more
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
