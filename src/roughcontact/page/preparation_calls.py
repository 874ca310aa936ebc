"""The steps of a preparation, each as the method of a surface and as the option of ``surface prepare``."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from roughcontact.errors import InputError, placed
from roughcontact.files.quantity import LENGTH, parse_with_unit

if TYPE_CHECKING:
    from roughcontact.page.recipe import PagePreparation
    from roughcontact.surface.surface import Surface

__all__ = ["Call", "calls_of", "written_value"]


@dataclass(frozen=True, slots=True)
class Call:
    """One step.

    Parameters
    ----------
    place : str
        Field of the page.
    method : str
        Of `roughcontact.Surface`.
    options : tuple of str
        Of the command line.
    given : tuple
        Arguments by place.
    named : dict
        Arguments by name.
    """

    place: str
    method: str
    options: tuple[str, ...]
    given: tuple[Any, ...] = ()
    named: dict[str, Any] = field(default_factory=dict)

    def apply(self, surface: Surface) -> Surface:
        """Return the surface after the step."""
        with placed(self.place):
            _require_waves(surface, self.named.get("short_cutoff"))
            prepared: Surface = getattr(surface, self.method)(*self.given, **self.named)
        return prepared

    @property
    def python(self) -> str:
        """The step as a line of Python."""
        arguments = [written_value(value) for value in self.given]
        arguments += [f"{name}={written_value(value)}" for name, value in self.named.items()]
        return f"surface = surface.{self.method}({', '.join(arguments)})"


def calls_of(wanted: PagePreparation) -> list[Call]:
    """Return the steps in their order."""
    found: list[Call] = []
    if wanted.crop is not None:
        top, bottom, left, right = wanted.crop
        cut = (slice(top, bottom), slice(left, right))
        found.append(Call("crop", "cropped", ("--crop", f"{top}:{bottom},{left}:{right}"), cut))
    if wanted.despike is not None:
        found.append(Call("despike", "despiked", ("--despike", wanted.despike), (wanted.despike,)))
    if wanted.level != "none":
        found.append(Call("level", "levelled", ("--level", wanted.level), (wanted.level,)))
    if wanted.form is not None:
        form = int(wanted.form) if wanted.form.isdigit() else wanted.form
        found.append(Call("form", "without_form", ("--form", wanted.form), (form,)))
    if wanted.fill:
        found.append(Call("fill", "filled", ("--fill",)))
    cutoffs = {"short_cutoff": wanted.short_cutoff, "long_cutoff": wanted.long_cutoff}
    lengths = {name: text for name, text in cutoffs.items() if text is not None}
    if lengths:
        options = [part for name, text in lengths.items() for part in (f"--{name.replace('_', '-')}", text)]
        named = {name: _cutoff(name, text) for name, text in lengths.items()}
        found.append(Call(next(iter(lengths)), "filtered", tuple(options), (), named))
    if wanted.downsample is not None and wanted.downsample != 1:
        options = ["--downsample", str(wanted.downsample)]
        found.append(Call("downsample", "downsampled", tuple(options), (wanted.downsample,)))
    return found


def _cutoff(field: str, text: str) -> float:
    with placed(field):
        return parse_with_unit(text, LENGTH)


def _require_waves(surface: Surface, short: float | None) -> None:
    """Refuse a cut-off that leaves nothing but the mean, as the command does."""
    longest = max(surface.grid.lengths)
    if short is not None and short >= longest:
        raise InputError(
            f"a cut-off of {short:g} m leaves nothing of a map of {longest:g} m",
            "give a shorter one, such as 10um",
        )


def written_value(value: Any) -> str:
    """Return a value as Python writes it."""
    if isinstance(value, slice):
        return f"slice({value.start}, {value.stop})"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, tuple):
        return "(" + ", ".join(written_value(each) for each in value) + ("," if len(value) == 1 else "") + ")"
    return repr(value)
