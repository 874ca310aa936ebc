"""The source of heights: a file, a random surface, a shape, an example, or the gap between two of these."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, TypeAlias

from roughcontact.errors import InputError, within
from roughcontact.files.length_units import length_factor
from roughcontact.files.quantity import LENGTH
from roughcontact.recipe.grid_of_source import PERIODIC, POINTS, SEED, SIZE, grid_call
from roughcontact.recipe.job_calls import Call, Name
from roughcontact.recipe.recipe_fields import check, described, value_of
from roughcontact.recipe.specified import Specified
from roughcontact.recipe.texts import Amount, Choice, PureNumber, band, sha256, size, word

if TYPE_CHECKING:
    from roughcontact.surface.surface import Surface

__all__ = ["SOURCES", "Combined", "Example", "File", "InPython", "SelfAffine", "SmoothBody", "Source"]

_WAVE = Amount(LENGTH, "a wavelength")


def _unit(text: str) -> str | float:
    """Return a unit of length, given by name or as a number of metres."""
    try:
        unit: str | float = float(text)
    except ValueError:
        unit = text
    length_factor(unit)
    return unit


@dataclass(frozen=True, slots=True, kw_only=True)
class File:
    """A measured file, and facts that the file may lack."""

    KIND: ClassVar = "file"
    TITLE: ClassVar = "Reading the file"
    file: str = described(
        "Measured heights: X3P, NumPy, text, ... - is standard input, as .npz; x3p:- as X3P.",
        "FILE",
        read=word,
        default=...,
        everyday=True,
        positional=True,
    )
    channel: str | None = described("Channel of a file with several.", "NAME", read=word)
    unit: str | None = described(
        "Unit of the heights, or metres per unit; it overrides the unit in the file.",
        "um",
        read=_unit,
        everyday=True,
    )
    size: str | None = described(
        "Side lengths: height x width of the picture, or only the width (for a profile its length); "
        "they override those in the file.",
        "1 x 2mm",
        read=size,
        everyday=True,
    )
    periodic: bool | None = described(
        "Whether the surface repeats itself (default: as stated in the file, otherwise free).",
        everyday=True,
        opposite="free",
    )
    sha256: str | None = described(
        "Fingerprint of the file: a different file of the same name is refused.",
        "HEX",
        read=sha256,
        option=False,
    )

    def __post_init__(self) -> None:
        check(self)

    def calls(self, *, line: bool) -> Iterator[Call]:
        """Yield the call that reads the file, as a map or as a profile."""
        sides = value_of(self, "size")
        width = sides[0] if sides is not None and len(sides) == 1 else sides
        named = {
            "channel": self.channel,
            "unit": value_of(self, "unit"),
            "size": width,
            "periodic": self.periodic,
        }
        named = {name: value for name, value in named.items() if value is not None}
        function = "rc.read_line" if line else "rc.read"
        yield Call(function, (self.file,), named, result="surface", place="source", doing="Reading the file")


@dataclass(frozen=True, slots=True, kw_only=True)
class SelfAffine:
    """A self-affine random surface."""

    KIND: ClassVar = "self-affine"
    TITLE: ClassVar = "Self-affine surface"
    hurst: str = described(
        "Hurst exponent, from -1 to 3.",
        "0.8",
        read=PureNumber(-1, 3, "the Hurst exponent", "0.8"),
        default=...,
        everyday=True,
    )
    rms: str = described(
        "Root mean square height.", "1um", read=Amount(LENGTH, "the rms height"), default=..., everyday=True
    )
    rms_band: str | None = described(
        "Band (longest and shortest wave) that has the rms height (default: all waves); use it for one "
        "surface on several grids.",
        "1mm:10um",
        read=band,
    )
    size: str = SIZE
    points: str = POINTS
    seed: str = SEED
    rolloff: str | None = described(
        "Roll-off: the spectrum of longer waves is constant.", "100um", read=_WAVE
    )
    long_cutoff: str | None = described("Longer waves are absent.", "500um", read=_WAVE)
    short_cutoff: str | None = described("Shorter waves are absent.", "5um", read=_WAVE)
    periodic: bool = PERIODIC
    nodal: bool = described(
        "Repeat the first row and column at the end: grids of 2^m + 1 points.", default=False
    )

    def __post_init__(self) -> None:
        check(self)
        longest, shortest = value_of(self, "long_cutoff"), value_of(self, "short_cutoff")
        if longest is not None and shortest is not None and shortest > longest:
            raise InputError(
                "`short_cutoff` is longer than `long_cutoff`, so that no waves are left",
                "exchange them",
                "short_cutoff, long_cutoff",
            )
        if self.nodal and self.periodic:
            raise InputError(
                "`nodal` repeats the first row at the end, so that a `periodic` surface would contain it twice",
                "leave out one of them",
                "nodal",
            )

    def calls(self, *, line: bool) -> Iterator[Call]:
        """Yield the calls that make the surface."""
        named = {
            name: value
            for name in ("rms_band", "rolloff", "long_cutoff", "short_cutoff")
            if (value := value_of(self, name)) is not None
        }
        if self.nodal:
            named["nodal"] = True
        generator = Call("np.random.default_rng", (value_of(self, "seed"),))
        yield grid_call(self, line=line)
        yield Call(
            "rc.self_affine",
            (Name("grid"), value_of(self, "hurst"), value_of(self, "rms"), generator),
            named,
            result="surface",
            place="source",
            doing="Adding up the waves",
        )


# The shapes, each with the fields below that it takes, in the order of its arguments.
_SHAPES = {
    "paraboloid": ("radius",),
    "sphere": ("radius",),
    "cylinder": ("radius",),
    "cone": ("slope",),
    "wave": ("amplitude", "wavelength"),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class SmoothBody:
    """A body without roughness, with its crest in the middle."""

    KIND: ClassVar = "shape"
    TITLE: ClassVar = "Shape"
    shape: str = described("Name of the shape.", read=Choice(tuple(_SHAPES)), default=..., everyday=True)
    radius: str | None = described(
        "Radius of curvature.", "5mm", read=Amount(LENGTH, "the radius"), everyday=True
    )
    slope: str | None = described(
        "Slope of a cone's flank.", "0.1", read=PureNumber(1e-6, 1e6, "the slope", "0.1")
    )
    amplitude: str | None = described("Amplitude of a wave.", "1um", read=Amount(LENGTH, "the amplitude"))
    wavelength: str | None = described("Length of a wave.", "0.1mm", read=_WAVE)
    size: str = SIZE
    points: str = POINTS
    periodic: bool = PERIODIC

    def __post_init__(self) -> None:
        check(self)
        takes = _SHAPES[self.shape]
        for name in ("radius", "slope", "amplitude", "wavelength"):
            if (getattr(self, name) is None) == (name in takes):
                verb = "give" if name in takes else "leave out"
                raise InputError(f"a {self.shape} takes {' and '.join(takes)}", f"{verb} `{name}`", name)

    def calls(self, *, line: bool) -> Iterator[Call]:
        """Yield the calls that make the surface."""
        yield grid_call(self, line=line)
        numbers = [value_of(self, name) for name in _SHAPES[self.shape]]
        yield Call(f"rc.shapes.{self.shape}", (Name("grid"), *numbers), result="surface", place="source")


@dataclass(frozen=True, slots=True, kw_only=True)
class Example:
    """A map that comes with the package."""

    KIND: ClassVar = "example"
    TITLE: ClassVar = "Example map"
    example: str = described(
        "Name of the map.", read=Choice(("ground", "blasted", "turned")), default=..., everyday=True
    )

    def __post_init__(self) -> None:
        check(self)

    def calls(self, *, line: bool) -> Iterator[Call]:
        """Yield the call that returns the map."""
        if line:
            raise InputError(
                "an example is a map of heights, not a profile", "leave out `profile`", "example"
            )
        yield Call("rc.examples.surface", (self.example,), result="surface", place="source")


@dataclass(frozen=True, slots=True, kw_only=True)
class Combined:
    """The gap between two rough bodies, as one surface; each body has its own source."""

    KIND: ClassVar = "combined"
    TITLE: ClassVar = "Two surfaces"
    lower: Source
    upper: Source
    turned_about: str = described(
        "The axis about which the upper body is turned over onto the lower one.",
        read=Choice(("x", "y")),
        default="y",
    )

    def __post_init__(self) -> None:
        check(self)

    def calls(self, *, line: bool) -> Iterator[Call]:
        """Yield the calls that make both and join them."""
        for name, source in (("lower", self.lower), ("upper", self.upper)):
            with within(name):
                yield from source.calls(line=line)
            yield Call("surface.levelled", ("auto",), result=name, place=f"source.{name}", doing="Levelling")
        given = {} if self.turned_about == "y" else {"turned_about": self.turned_about}
        yield Call("rc.combined", (Name("lower"), Name("upper")), given, result="surface", place="source")


@dataclass(frozen=True, slots=True, kw_only=True)
class InPython:
    """Heights that were made in Python: recorded by fingerprint and history, and not made again."""

    KIND: ClassVar = "python"
    TITLE: ClassVar = "Made in Python"
    surface_sha256: str = described("Fingerprint of heights and grid.", "HEX", read=sha256, default=...)
    history: tuple[str, ...] = described("History of the heights, line by line.", default=())

    def __post_init__(self) -> None:
        check(self)

    @classmethod
    def of(cls, surface: Surface) -> InPython:
        """Return fingerprint and history of a surface; equal heights on equal grids have equal fingerprints.

        Examples
        --------
        >>> import roughcontact as rc
        >>> from roughcontact.recipe.source import InPython
        >>> ball = rc.shapes.sphere(rc.Grid((4, 4), 1e-6), radius=1e-3)
        >>> InPython.of(ball).surface_sha256[:8], InPython.of(ball).history
        ('436783b0', ('sphere, radius 0.001 m',))
        """
        from roughcontact.files.provenance import surface_hash  # late, with NumPy

        return cls(surface_sha256=surface_hash(surface), history=surface.provenance)

    def calls(self, *, line: bool) -> Iterator[Call]:
        """Raise an error, because the heights cannot be made again.

        Raises
        ------
        InputError
            Always.
        """
        raise InputError(
            f"the heights were made in Python ({'; '.join(self.history) or 'no history is kept'})",
            "write them by rc.write, and name the file as the source",
        )


Source: TypeAlias = File | SelfAffine | Specified | SmoothBody | Example | Combined | InPython
SOURCES: tuple[type[Any], ...] = (File, SelfAffine, Specified, SmoothBody, Example, Combined, InPython)
