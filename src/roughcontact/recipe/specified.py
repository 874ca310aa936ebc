"""A joint given by rms height and slope: as numbers for theories, or as a random surface with these numbers."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from roughcontact.errors import InputError
from roughcontact.files.quantity import LENGTH, Kind
from roughcontact.recipe.grid_of_source import PERIODIC, POINTS, SEED, SIZE, grid_call
from roughcontact.recipe.job_calls import Call, Name
from roughcontact.recipe.recipe_fields import check, described, specs, value_of, with_fields_of
from roughcontact.recipe.texts import Amount, PureNumber

if TYPE_CHECKING:
    from roughcontact.surface.generation.specification import SurfaceSpecification

__all__ = ["Specified", "SpecifiedJoint", "specification"]


@dataclass(frozen=True, slots=True)
class _OfFaces:
    """Reads a number for both faces together, or one for each face."""

    read: Amount | PureNumber

    @property
    def kind(self) -> Kind | None:
        """The kind of quantity, if it has a unit."""
        return getattr(self.read, "kind", None)

    def __call__(self, text: str) -> float | tuple[float, float]:
        """Return the number, or the pair, in a text."""
        first, *others = values = [self.read(part.strip()) for part in text.split(",")]
        if len(others) > 1:
            raise InputError(
                f"{text!r} contains {len(values)} numbers for two faces", "give one or two numbers"
            )
        return (first, others[0]) if others else first


_HEIGHT, _WAVE = _OfFaces(Amount(LENGTH, "a height")), Amount(LENGTH, "a wavelength")
_RATIO = PureNumber(1, 1000, "the ratio of Rz and Ra", "6")
_MEAN_SLOPE = _OfFaces(PureNumber(0, 100, "the slope", "0.12", ends=False))
_EXPONENT = PureNumber(0, 1, "the Hurst exponent", "0.8")
_BANDWIDTH = PureNumber(1.5, 1e9, "Nayak's parameter", "20", ends=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class SpecifiedJoint:
    """A joint by its numbers: heights, slope, and the bandwidth of the roughness."""

    TITLE: ClassVar = "Specification"
    ONE_OF: ClassVar = ("sigma", "ra", "rz")
    sigma: str | None = described(
        "Rms height of both faces together, or that of each face (1um,2um).",
        "1.2um",
        read=_HEIGHT,
        everyday=True,
    )
    ra: str | None = described(
        "Ra in place of sigma: for Gaussian heights sigma is 1.2533 Ra.", "1um", read=_HEIGHT, everyday=True
    )
    rz: str | None = described("Rz in place of sigma; needs the ratio of Rz and Ra.", "6um", read=_HEIGHT)
    rz_over_ra: str | None = described(
        "Ratio of Rz and Ra, as measured on such faces.", "6", read=_RATIO, needs="rz"
    )
    slope: str | None = described(
        "Mean absolute slope m of a profile, of both faces or of each: 0.80 times the rms slope of a "
        "profile (Rdq), 0.56 times that of a surface (Sdq).",
        "0.12",
        read=_MEAN_SLOPE,
        everyday=True,
    )
    hurst: str | None = described(
        "Hurst exponent. It determines the spectrum together with two of slope, nayak and the lengths.",
        "0.8",
        read=_EXPONENT,
        everyday=True,
    )
    nayak: str | None = described("Nayak's parameter m0 m4/m2^2: the bandwidth.", "20", read=_BANDWIDTH)
    rolloff: str | None = described(
        "Roll-off: the spectrum of longer waves is constant.", "100um", read=_WAVE, everyday=True
    )
    correlation_length: str | None = described(
        "Lag at which the autocorrelation falls to 1/e, instead of rolloff.", "20um", read=_WAVE
    )
    short_cutoff: str | None = described("Shorter waves are absent.", "5um", read=_WAVE)

    def __post_init__(self) -> None:
        check(self)
        _known(self)


@dataclass(frozen=True, slots=True, kw_only=True)
@with_fields_of(SpecifiedJoint)
class Specified:
    """A random surface with the rms height and the slope of a specification."""

    KIND: ClassVar = "specified"
    TITLE: ClassVar = "Specified surface"
    ONE_OF: ClassVar = SpecifiedJoint.ONE_OF
    size: str = SIZE
    points: str = POINTS
    seed: str = SEED
    periodic: bool = PERIODIC

    def __post_init__(self) -> None:
        check(self)
        _ = _known(self).spectrum

    def calls(self, *, line: bool) -> Iterator[Call]:
        """Yield the calls that make the surface."""
        if line:
            raise InputError(
                "a specification makes a map of heights, not a profile",
                "leave out `profile`",
                "sigma",
            )
        generator = Call("np.random.default_rng", (value_of(self, "seed"),))
        yield grid_call(self, line=False)
        yield specification(self)
        yield Call(
            "joint.surface",
            (Name("grid"), generator),
            result="surface",
            place="source",
            doing="Adding up the waves",
        )


def specification(part: SpecifiedJoint | Specified) -> Call:
    """Return the call that makes the specification."""
    names = [each.name for each, _ in specs(SpecifiedJoint)]
    named = {name: value for name in names if (value := value_of(part, name)) is not None}
    return Call("rc.specified", (), named, result="joint", place="source")


def _known(part: SpecifiedJoint | Specified) -> SurfaceSpecification:
    from roughcontact.surface.generation.specification import specified  # late, with NumPy

    found: Any = specified(**specification(part).named)
    return found  # type: ignore[no-any-return]
