"""What a page asks for, from the file to the load: plain values that say it all, checked once at the border.

Texts with units stand as the user wrote them, so that page, command and Python take the same numbers.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any, Literal

from roughcontact.errors import InputError, placed
from roughcontact.files.quantity import FORCE, LENGTH, PRESSURE, Kind, parse, parse_with_unit

if TYPE_CHECKING:
    from pydantic import TypeAdapter

__all__ = [
    "Bodies",
    "FileSource",
    "MadeSource",
    "PageLoad",
    "PageLoads",
    "PagePreparation",
    "PageRecipe",
    "as_recipe",
]

Form = Literal["sphere", "cylinder", "2", "3", "4", "5", "6", "7", "8", "9", "10", "11", "12"]
_KINDS: dict[str, Kind] = {"force": FORCE, "pressure": PRESSURE, "depth": LENGTH}


@dataclass(frozen=True, slots=True)
class FileSource:
    """A measured file, by the name under which the server keeps it, and what it leaves open."""

    kind: Literal["file"]
    file: str
    channel: str | None = None
    unit: str | None = None
    width: str | None = None
    height: str | None = None
    periodic: bool | None = None

    @property
    def size(self) -> float | tuple[float, float] | None:
        """Side lengths [m] as `roughcontact.read` takes them."""
        if self.width is None:
            if self.height is not None:
                with placed("width"):
                    raise InputError("the length of the map is given and its width is not", "give both")
            return None
        width = _side(self.width, "width")
        return width if self.height is None else (_side(self.height, "height"), width)

    @property
    def heights_in(self) -> str | float | None:
        """Unit of the heights by its name, or as the metres that it is."""
        try:
            return None if self.unit is None else float(self.unit)
        except ValueError:
            return self.unit


@dataclass(frozen=True, slots=True)
class MadeSource:
    """A self-affine surface, made as ``roughcontact surface make`` does."""

    kind: Literal["made"]
    hurst: str
    rms: str
    size: str
    points: int
    seed: int = 1
    rolloff: str | None = None
    periodic: bool = False


@dataclass(frozen=True, slots=True)
class PagePreparation:
    """What is done with the heights, in the order of ``roughcontact surface prepare``.

    Parameters
    ----------
    crop : tuple of four int or None
        First row, end of the rows, first column, end of the columns.
    """

    crop: tuple[int, int, int, int] | None = None
    despike: Literal["missing", "filled"] | None = None
    level: Literal["none", "mean", "plane", "quadratic"] = "plane"
    form: Form | None = None
    fill: bool = False
    short_cutoff: str | None = None
    long_cutoff: str | None = None
    downsample: int | None = None


@dataclass(frozen=True, slots=True)
class Bodies:
    """The elastic constants: two materials by name, a reduced modulus, or Young's moduli and Poisson's ratios."""

    materials: tuple[str, str] | None = None
    modulus: str | None = None
    young: str | None = None
    poisson: str | None = None
    young2: str | None = None
    poisson2: str | None = None
    hardness: str | None = None


@dataclass(frozen=True, slots=True)
class PageLoad:
    """One load: what is prescribed, and its value with a unit."""

    control: Literal["force", "pressure", "depth"]
    text: str

    @property
    def value(self) -> float:
        """The load in its SI unit."""
        return parse(self.text, _KINDS[self.control])

    @property
    def unit(self) -> str:
        """That SI unit."""
        return _KINDS[self.control].unit


@dataclass(frozen=True, slots=True)
class PageLoads:
    """The loads of a curve: from, to and how many, evenly spaced in the logarithm; or each by its number in SI.

    Parameters
    ----------
    theories : tuple of str
        What is laid over the curve.
    conducting : bool
        Whether what two named materials conduct belongs to it.
    """

    control: Literal["force", "pressure", "depth"] = "force"
    start: str | None = None
    end: str | None = None
    count: int = 24
    values: tuple[float, ...] | None = None
    theories: tuple[str, ...] = ()
    conducting: bool = False

    @property
    def ends(self) -> tuple[float, float] | None:
        """First and last load in SI; None where they are to be found."""
        if self.start is None and self.end is None:
            return None
        if self.start is None or self.end is None:
            raise InputError(
                "one end of the loads is missing",
                "give both ends of the loads, or neither: then loads that suit the surface are found",
            )
        with placed("count"):
            if not 2 <= self.count <= 1000:
                raise InputError(f"a curve has 2 to 1000 loads, not {self.count}", place="count")
        with placed("from"):
            low = parse(self.start, _KINDS[self.control])
        with placed("to"):
            high = parse(self.end, _KINDS[self.control])
            if not 0 < low < high:
                raise InputError(f"the loads rise from above zero, not from {self.start} to {self.end}")
        return low, high


@dataclass(frozen=True, slots=True)
class PageRecipe:
    """All that an answer follows from."""

    source: FileSource | MadeSource
    preparation: PagePreparation = PagePreparation()
    bodies: Bodies = Bodies(modulus="100GPa")
    load: PageLoad | None = None
    loads: PageLoads | None = None


def as_recipe(plain: Any) -> PageRecipe:
    """Return the recipe that plain values from the page state.

    Raises
    ------
    ValueError
        If they state none.
    """
    from pydantic import ValidationError

    try:
        return _adapter().validate_python(plain)
    except ValidationError as error:
        wrong = error.errors()
        # Of a source that is a file or made, the errors of the other kind say nothing.
        others = {each["loc"][:-1] for each in wrong if each["loc"][-1] == "kind"}
        first = next((each for each in wrong if each["loc"][:2] not in others), wrong[0])
        place = ".".join(str(part) for part in first["loc"])
        raise InputError(f"the request is wrong at {place}: {first['msg']}", place=place) from error


def _side(text: str, field: str) -> float:
    """Return a side length [m] that the user wrote in a field."""
    with placed(field):
        length = parse_with_unit(text, LENGTH)
        if length <= 0:
            raise InputError(f"{text!r} is not positive", "write a length above zero, such as 500um")
        return length


@cache
def _adapter() -> TypeAdapter[PageRecipe]:
    from pydantic import TypeAdapter

    return TypeAdapter(PageRecipe)
