"""The options that several verbs share, and what they mean."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from roughcontact.cli.messages import UsageError, as_typed, note, plain
from roughcontact.cli.unit_options import PRESSURE, parse, parse_number, parse_size

if TYPE_CHECKING:
    from roughcontact.material import Solid
    from roughcontact.surface.surface import Surface

__all__ = [
    "AnyFileArgument",
    "Bodies",
    "ChannelOption",
    "FileArgument",
    "HardnessOption",
    "JsonOption",
    "Level",
    "LevelOption",
    "ModulusOption",
    "OutOption",
    "PeriodicOption",
    "Poisson2Option",
    "PoissonOption",
    "Reading",
    "SizeOption",
    "ToleranceOption",
    "UnitOption",
    "Young2Option",
    "YoungOption",
    "hardness_of",
    "only_one",
]

_READING, _BODIES, _ANSWER = "Reading the file", "The two bodies", "Answer"
_MAPS_ONLY = (
    "give a map of heights; a line scan is taken by 'surface info', 'surface spectrum' and 'surface prepare'"
)


class Level(StrEnum):
    """What is taken out of the heights before they are pressed."""

    PLANE = "plane"
    MEAN = "mean"
    NONE = "none"


FileArgument = Annotated[Path, typer.Argument(metavar="FILE", help="Measured surface: X3P, NumPy, text, ...")]
AnyFileArgument = Annotated[
    Path, typer.Argument(metavar="FILE", help="Measured surface or line scan: X3P, NumPy, text, ...")
]
ChannelOption = Annotated[
    str | None, typer.Option(metavar="NAME", help="Channel of a file with several.", rich_help_panel=_READING)
]
UnitOption = Annotated[
    str | None,
    typer.Option(
        metavar="um",
        help="Unit of the heights, or metres per unit; it overrides what the file states.",
        rich_help_panel=_READING,
    ),
]
SizeOption = Annotated[
    str | None,
    typer.Option(
        metavar="1mm x 2mm",
        help="Side lengths: height x width of the picture, or its width alone (of a line scan its length); "
        "they override what the file states.",
        rich_help_panel=_READING,
    ),
]
PeriodicOption = Annotated[
    bool | None,
    typer.Option(
        "--periodic/--free",
        help="Whether the surface repeats itself (default: what the file says, else free).",
        rich_help_panel=_READING,
    ),
]
LevelOption = Annotated[
    Level | None,
    typer.Option(help="What to take out of the heights (default: plane).", rich_help_panel=_READING),
]
ModulusOption = Annotated[
    str | None,
    typer.Option(metavar="110GPa", help="Reduced modulus E*.", rich_help_panel=_BODIES),
]
YoungOption = Annotated[
    str | None,
    typer.Option(metavar="210GPa", help="Young's modulus, in place of --modulus.", rich_help_panel=_BODIES),
]
PoissonOption = Annotated[
    str | None, typer.Option(metavar="0.3", help="Poisson's ratio.", rich_help_panel=_BODIES)
]
Young2Option = Annotated[
    str | None,
    typer.Option(
        metavar="70GPa",
        help="Young's modulus of the other body (default: rigid).",
        rich_help_panel=_BODIES,
    ),
]
Poisson2Option = Annotated[
    str | None,
    typer.Option(metavar="0.33", help="Poisson's ratio of the other.", rich_help_panel=_BODIES),
]
ToleranceOption = Annotated[
    str, typer.Option(metavar="1e-8", help="Largest certificate of an answer.", rich_help_panel=_ANSWER)
]
OutOption = Annotated[
    Path | None, typer.Option(metavar="DIR", help="Folder for files and pictures.", rich_help_panel=_ANSWER)
]
HardnessOption = Annotated[
    str | None,
    typer.Option(
        metavar="2GPa",
        help="Pressure that no cell exceeds: there the softer body gives way.",
        rich_help_panel=_BODIES,
    ),
]
JsonOption = Annotated[
    bool,
    typer.Option("--json", help="One JSON object on standard output, in SI units.", rich_help_panel=_ANSWER),
]


@dataclass(frozen=True, slots=True)
class Reading:
    """How to turn a file into the surface to press."""

    file: Path
    channel: str | None
    unit: str | None
    size: str | None
    level: Level | None
    periodic: bool | None

    def as_it_is(self) -> Surface:
        """Return the map of heights as the file holds it."""
        import roughcontact as rc

        with as_typed(self.file):
            try:
                return rc.read(self.file, **self._keywords())
            except rc.ReadError as error:
                if "read_line" not in error.remedy:
                    raise
                raise rc.ReadError(error.file, error.problem, _MAPS_ONLY) from error

    def map_or_line(self) -> Surface:
        """Return the map of heights as the file holds it, or its line scan; say so of a line."""
        from roughcontact.files.read import read_either

        with as_typed(self.file):
            surface = read_either(self.file, **self._keywords())
        if surface.grid.ndim == 1:
            note(f"{plain(str(self.file))} holds a line scan of {surface.grid.size} heights")
        return surface

    def _keywords(self) -> dict[str, Any]:
        size = None if self.size is None else parse_size(self.size, "--size")
        width = size[0] if size is not None and len(size) == 1 else size
        return {"channel": self.channel, "unit": self._unit(), "size": width, "periodic": self.periodic}

    def _unit(self) -> str | float | None:
        """Return the unit by its name, or as the metres that it is."""
        try:
            return None if self.unit is None else float(self.unit)
        except ValueError:
            return self.unit

    def surface(self) -> Surface:
        """Return the surface to press, read and levelled; say on standard error what was decided unasked.

        Raises
        ------
        UsageError
            If reading it needs more memory than is free.
        ValueError
            If no press of it fits in the memory of this machine.
        """
        from roughcontact.contact.problem import require_memory_for

        surface = self.as_it_is()
        require_memory_for(surface)
        level = self.level
        if level is None and self.periodic is None and all(surface.grid.periodic):
            level = Level.MEAN
            note("the file says that the surface is periodic, so that it has no tilt: levelled by its mean")
        elif level is None:
            level = Level.PLANE
            note("the heights are levelled by their plane (--level mean or none for another choice)")
        return (
            surface if level is Level.NONE else surface.levelled("mean" if level is Level.MEAN else "plane")
        )


@dataclass(frozen=True, slots=True)
class Bodies:
    """The elastic constants, as the user gave them."""

    modulus: str | None
    young: str | None
    poisson: str | None
    young2: str | None
    poisson2: str | None

    def reduced_modulus(self) -> float:
        """Return the reduced modulus E* [Pa].

        Raises
        ------
        UsageError
            If neither a reduced modulus nor a Young's modulus is given, or both, or half a body.
        """
        import roughcontact as rc

        only_one(
            {"--modulus": self.modulus, "--young": self.young},
            "the elastic constants, such as --modulus 110GPa",
        )
        if self.modulus is not None:
            if any(value is not None for value in (self.poisson, self.young2, self.poisson2)):
                raise UsageError("--modulus is that of the pair: leave out --poisson, --young2, --poisson2")
            value = parse(self.modulus, PRESSURE, "--modulus")
            if not value > 0:
                raise UsageError(f"--modulus: the reduced modulus must be positive, not {self.modulus!r}")
            return value
        first = _solid(self.young, self.poisson, "--young", "--poisson")
        if self.young2 is None and self.poisson2 is None:
            return rc.reduced_modulus(first)
        return rc.reduced_modulus(first, _solid(self.young2, self.poisson2, "--young2", "--poisson2"))


def hardness_of(text: str | None) -> float | None:
    """Return the hardness [Pa] that was given, if one was.

    Raises
    ------
    UsageError
        If it is no positive pressure.
    """
    if text is None:
        return None
    value = parse(text, PRESSURE, "--hardness")
    if not value > 0:
        raise UsageError(f"--hardness: a hardness must be positive, not {text!r}")
    return value


def only_one(given: dict[str, Any], what: str) -> str:
    """Return the name of the one option that was given.

    Raises
    ------
    UsageError
        If none or several were; the message says `what` is needed.
    """
    names = [name for name, value in given.items() if value is not None]
    if not names:
        raise UsageError(f"give {what} ({' or '.join(given)})")
    if len(names) > 1:
        raise UsageError(f"{' and '.join(names)} exclude each other: give one of them")
    return names[0]


def _solid(young: str | None, poisson: str | None, young_option: str, poisson_option: str) -> Solid:
    import roughcontact as rc

    if young is None or poisson is None:
        missing = poisson_option if poisson is None else young_option
        raise UsageError(f"{young_option} and {poisson_option} belong together: {missing} is missing")
    modulus = parse(young, PRESSURE, young_option)
    if not modulus > 0:
        raise UsageError(f"{young_option}: Young's modulus must be positive, not {young!r}")
    ratio = parse_number(poisson, poisson_option, "0.3")
    if not -1 < ratio <= 0.5:
        raise UsageError(
            f"{poisson_option}: Poisson's ratio lies above -1 and at most at 0.5, not at {poisson!r}"
        )
    return rc.Solid(modulus, ratio)
