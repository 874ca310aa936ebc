"""The options that several commands share, in groups, and what they mean."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from roughcontact.cli.contact.profile_options import PROFILE, ProfileBody
from roughcontact.cli.job import slabs_of_job
from roughcontact.cli.material_options import known_material, modulus_of, softer_of
from roughcontact.cli.messages import UsageError, as_typed, note, plain
from roughcontact.cli.option_groups import argument, flag, option
from roughcontact.cli.picture_options import FORMAT, PictureFormat, picture_ending
from roughcontact.cli.report import doing
from roughcontact.cli.unit_options import parse_modulus, parse_number, parse_size, parse_tolerance
from roughcontact.materials import MATERIALS

if TYPE_CHECKING:
    from roughcontact.halfspace.operators.operator import Operator
    from roughcontact.material import Solid
    from roughcontact.surface.surface import Surface

__all__ = [
    "DESPIKE",
    "JSON",
    "LEVEL",
    "OUT",
    "OUTPUT",
    "PERIODIC",
    "Answer",
    "Despike",
    "Elasticity",
    "Levelling",
    "Reading",
    "Source",
    "TwoBodies",
    "only_one",
]

_READING, _ANSWER = "Reading the file", "Answer"
_NAME_THE_BODY = (
    "say how it is pressed: --profile line, as a line contact, or --profile winkler, on the springs of the method of "
    "dimensionality reduction"
)

Levelling = StrEnum("Levelling", ["PLANE", "MEAN", "NONE"])


class Despike(StrEnum):
    """What becomes of the cells of spikes."""

    MISSING = "missing"
    FILLED = "filled"

    def remove(self, surface: Surface) -> Surface:
        """Return the surface without its spikes; say on standard error how many there were."""
        clean = surface.despiked(self.value)
        note("no spikes were found" if clean is surface else clean.provenance[-1])
        return clean


PERIODIC = option(
    "Whether the surface repeats itself (default: what the file says, else free).",
    None,
    "--periodic/--free",
    rich_help_panel=_READING,
)
LEVEL = option("What is removed from the heights (default: a least-squares plane).", rich_help_panel=_READING)
DESPIKE = option(
    "Before levelling: the cells of spikes to missing points, or filled smoothly (default: kept).",
    needs_whole=True,
    rich_help_panel=_READING,
)
OUTPUT = argument("File to write: .npz, .nc, .x3p, .txt, .npy, or .vti for ParaView.", "OUT")
OUT = option("Folder for files and pictures.", "DIR", rich_help_panel=_ANSWER)
JSON = option("One JSON object on standard output, in SI units.", default=False, rich_help_panel=_ANSWER)


@dataclass(frozen=True, slots=True)
class Answer:
    """How good an answer shall be, and where it goes."""

    PANEL: ClassVar = _ANSWER
    tolerance: str = option(
        "Largest residual of the contact conditions: the certificate.", "1e-8", default="1e-8"
    )
    out: Path | None = OUT
    format: PictureFormat | None = FORMAT
    json: bool = JSON

    @property
    def ending(self) -> str:
        """How the names of pictures end."""
        return picture_ending(self.format, self.out)

    @property
    def residual(self) -> float:
        """The tolerance as a number."""
        return parse_tolerance(self.tolerance, "--tolerance")


@dataclass(frozen=True, slots=True)
class Source:
    """A measured file, and what it leaves open."""

    PANEL: ClassVar = _READING
    file: Path = argument("Measured heights: X3P, NumPy, text, ...", "FILE")
    channel: str | None = option("Channel of a file with several.", "NAME")
    unit: str | None = option(
        "Unit of the heights, or metres per unit; it overrides what the file states.", "um"
    )
    size: str | None = option(
        "Side lengths: height x width of the picture, or its width alone (of a profile its length); "
        "they override what the file states.",
        "1 x 2mm",
    )

    def map(self, periodic: bool | None) -> Surface:
        """Return the map of heights as the file holds it."""
        import roughcontact as rc

        slabs = slabs_of_job()
        with as_typed(self.file), doing(f"Reading {self.file.name}"):
            try:
                return rc.read(self.file, **self._keywords(periodic), slabs=slabs)
            except rc.ReadError as error:
                if "read_line" not in str(error.remedy):
                    raise
                raise rc.ReadError(error.file, error.problem, _NAME_THE_BODY) from error

    def line(self, periodic: bool | None) -> Surface:
        """Return the profile as the file holds it.

        Raises
        ------
        UsageError
            If it holds a map.
        """
        import roughcontact as rc

        with as_typed(self.file), doing(f"Reading {self.file.name}"):
            try:
                return rc.read_line(self.file, **self._keywords(periodic))
            except rc.ReadError as error:
                if (points := self._points_of_map()) is None:
                    raise
                raise UsageError(
                    f"{plain(str(self.file))} holds a map of {points} heights",
                    "leave out --profile",
                    place="--profile",
                ) from error

    def map_or_line(self, periodic: bool | None = None) -> Surface:
        """Return the map of heights as the file holds it, or its profile; say so of a profile."""
        from roughcontact.files.read import read_either

        with as_typed(self.file), doing(f"Reading {self.file.name}"):
            surface = read_either(self.file, **self._keywords(periodic))
        if surface.grid.ndim == 1:
            note(f"{plain(str(self.file))} holds a profile of {surface.grid.size} heights")
        return surface

    def _points_of_map(self) -> str | None:
        """Return the rows and columns of the map in the file; None where it holds none."""
        from roughcontact.files.read import channels

        shapes = [channel.shape for channel in channels(self.file) if len(channel.shape) == 2]
        return " x ".join(map(str, shapes[0])) if shapes else None

    def _keywords(self, periodic: bool | None) -> dict[str, Any]:
        size = None if self.size is None else parse_size(self.size, "--size")
        width = size[0] if size is not None and len(size) == 1 else size
        return {"channel": self.channel, "unit": self._unit(), "size": width, "periodic": periodic}

    def _unit(self) -> str | float | None:
        """Return the unit by its name, or as the metres that it is."""
        try:
            return None if self.unit is None else float(self.unit)
        except ValueError:
            return self.unit


@dataclass(frozen=True, slots=True)
class Reading:
    """How to turn a file into the surface to press."""

    source: Source
    periodic: bool | None = PERIODIC
    level: Levelling | None = LEVEL
    despike: Despike | None = DESPIKE
    profile: ProfileBody | None = PROFILE

    def body(self, surface: Surface, modulus: float) -> Operator | None:
        """Return what a profile is pressed against; None for a map, which lies on the half-space."""
        return None if self.profile is None else self.profile.operator(surface, modulus)

    def surface(self) -> Surface:
        """Return the surface to press, read and levelled; say on standard error what was decided unasked.

        Raises
        ------
        UsageError
            If reading it needs more memory than is free.
        """
        read = self.source.map if self.profile is None else self.source.line
        surface = read(self.periodic)
        if slabs_of_job() is not None and not all(surface.grid.periodic):
            raise UsageError(
                "several processes press periodic surfaces only, and this one is free",
                "give --periodic, or start one process",
                place="--periodic",
            )
        if self.despike is not None:
            surface = self.despike.remove(surface)
        level = self.level
        if level is None and self.periodic is None and all(surface.grid.periodic):
            level = Levelling.MEAN
            note(
                "the file says that the surface is periodic, so that it has no tilt: its mean height is removed"
            )
        elif level is None:
            level = Levelling.PLANE
            trend = "plane" if surface.grid.ndim == 2 else "line"
            note(f"the tilt is removed by a least-squares {trend} (--level mean or none for another choice)")
        kind: Any = level.value
        return surface if level is Levelling.NONE else surface.levelled(kind)


@dataclass(frozen=True, slots=True)
class Elasticity:
    """The elastic constants of the two bodies, as the user gave them."""

    PANEL: ClassVar = "The two bodies"
    modulus: str | None = option("Reduced modulus E*.", "110GPa")
    materials: str | None = option(
        f"Both bodies by name, in place of --modulus: {', '.join(MATERIALS)}; or rigid for one of them.",
        "steel,aluminium",
    )
    young: str | None = option("Young's modulus, in place of --modulus.", "210GPa")
    poisson: str | None = option("Poisson's ratio.", "0.3")
    young2: str | None = option("Young's modulus of the other body (default: rigid).", "70GPa")
    poisson2: str | None = option("Poisson's ratio of the other.", "0.33")

    def reduced_modulus(self) -> float:
        """Return the reduced modulus E* [Pa].

        Raises
        ------
        UsageError
            If none of a reduced modulus, two materials and a Young's modulus is given, or several, or half a body.
        """
        import roughcontact as rc

        given = {"modulus": self.modulus, "materials": self.materials, "young": self.young}
        name = only_one(
            given, "the elastic constants, such as --modulus 110GPa or --materials steel,aluminium"
        )
        if name != "young" and any(value is not None for value in (self.poisson, self.young2, self.poisson2)):
            raise UsageError(
                f"--{name} is about the pair", "leave out --poisson, --young2, --poisson2", place=f"--{name}"
            )
        if self.modulus is not None:
            return parse_modulus(self.modulus, "--modulus", "the reduced modulus")
        if self.materials is not None:
            return modulus_of(self.materials)
        first = _solid(self.young, self.poisson, "--young", "--poisson")
        if self.young2 is None and self.poisson2 is None:
            return rc.reduced_modulus(first)
        return rc.reduced_modulus(first, _solid(self.young2, self.poisson2, "--young2", "--poisson2"))


@dataclass(frozen=True, slots=True)
class TwoBodies:
    """The constants of the two bodies, of which the softer may flow."""

    PANEL: ClassVar = Elasticity.PANEL
    elasticity: Elasticity
    hardness: str | None = option(
        "Largest pressure of a cell: there the softer body is perfectly plastic. Or the name of its material.",
        "2GPa",
    )

    def softer(self) -> tuple[float, str] | None:
        """Return the hardness [Pa] of the softer body, and of what it is, if it is given or named by the materials."""
        if self.hardness is not None:
            given = self.yield_pressure()
            return None if given is None else (given, "as given")
        materials = self.elasticity.materials
        return None if materials is None else softer_of(materials)

    def yield_pressure(self) -> float | None:
        """Return the hardness [Pa] that was given, if one was."""
        text = self.hardness
        if text is None:
            return None
        if (material := known_material(text)) is not None:
            return material.hardness
        return parse_modulus(text, "--hardness", "a hardness")


def only_one(given: dict[str, Any], what: str) -> str:
    """Return the name of the one option that was given, of those by their names.

    Raises
    ------
    UsageError
        If none or several were; the message says `what` is needed.
    """
    names = [name for name, value in given.items() if value is not None]
    if not names:
        raise UsageError(f"{what} is missing", f"give {what} ({' or '.join(map(flag, given))})")
    if len(names) > 1:
        raise UsageError(
            f"{' and '.join(map(flag, names))} exclude each other",
            "give one of them",
            place=", ".join(map(flag, names)),
        )
    return names[0]


def _solid(young: str | None, poisson: str | None, young_option: str, poisson_option: str) -> Solid:
    import roughcontact as rc

    if young is None or poisson is None:
        missing = poisson_option if poisson is None else young_option
        raise UsageError(
            f"{young_option} and {poisson_option} belong together: {missing} is missing", place=missing
        )
    modulus = parse_modulus(young, young_option, "Young's modulus")
    ratio = parse_number(poisson, poisson_option, "0.3")
    if not -1 < ratio <= 0.5:
        raise UsageError(
            f"Poisson's ratio lies above -1 and at most at 0.5, not at {poisson!r}", place=poisson_option
        )
    return rc.Solid(modulus, ratio)
