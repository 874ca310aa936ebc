"""The steps of a preparation, each as the method of a surface and as the option of ``surface prepare``."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from roughcontact.files.quantity import LENGTH, parse

if TYPE_CHECKING:
    from roughcontact.page.recipe import PagePreparation
    from roughcontact.surface.surface import Surface

__all__ = ["Call", "calls_of", "written_value"]


@dataclass(frozen=True, slots=True)
class Call:
    """One step.

    Parameters
    ----------
    method : str
        Of `roughcontact.Surface`.
    options : tuple of str
        Of the command line.
    given : tuple
        Arguments by place.
    named : dict
        Arguments by name.
    """

    method: str
    options: tuple[str, ...]
    given: tuple[Any, ...] = ()
    named: dict[str, Any] = field(default_factory=dict)

    def apply(self, surface: Surface) -> Surface:
        """Return the surface after the step."""
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
        found.append(Call("cropped", ("--crop", f"{top}:{bottom},{left}:{right}"), cut))
    if wanted.despike is not None:
        found.append(Call("despiked", ("--despike", wanted.despike), (wanted.despike,)))
    if wanted.level != "none":
        found.append(Call("levelled", ("--level", wanted.level), (wanted.level,)))
    if wanted.form is not None:
        form = int(wanted.form) if wanted.form.isdigit() else wanted.form
        found.append(Call("without_form", ("--form", wanted.form), (form,)))
    if wanted.fill:
        found.append(Call("filled", ("--fill",)))
    cutoffs = {"short_cutoff": wanted.short_cutoff, "long_cutoff": wanted.long_cutoff}
    lengths = {name: text for name, text in cutoffs.items() if text is not None}
    if lengths:
        options = [part for name, text in lengths.items() for part in (f"--{name.replace('_', '-')}", text)]
        named = {name: parse(text, LENGTH) for name, text in lengths.items()}
        found.append(Call("filtered", tuple(options), (), named))
    if wanted.downsample is not None and wanted.downsample != 1:
        found.append(Call("downsampled", ("--downsample", str(wanted.downsample)), (wanted.downsample,)))
    return found


def written_value(value: Any) -> str:
    """Return a value as Python writes it."""
    if isinstance(value, slice):
        return f"slice({value.start}, {value.stop})"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, tuple):
        return "(" + ", ".join(written_value(each) for each in value) + ("," if len(value) == 1 else "") + ")"
    return repr(value)
