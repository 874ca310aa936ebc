"""What the recipes of a page stand for: surfaces, loads and curves, of which the last few are kept."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Hashable, Iterator, Mapping
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from roughcontact.errors import InputError, placed
from roughcontact.files.file_errors import SurfaceWarning
from roughcontact.files.length_units import length_factor
from roughcontact.files.quantity import LENGTH, Kind, parse, parse_number, parse_with_unit
from roughcontact.page.preparation_calls import calls_of
from roughcontact.page.recipe import Bodies, FileSource, MadeSource, PageLoads, PageRecipe

if TYPE_CHECKING:
    from roughcontact.contact.curve import Curve
    from roughcontact.contact.solution import Solution
    from roughcontact.material import Solid
    from roughcontact.solver.loads import Loads
    from roughcontact.surface.surface import Surface

__all__ = ["SessionCache", "UploadedFile", "hardness_of", "modulus_of", "without_loads"]

T = TypeVar("T")
_KEPT = 2  # of each: the one that is looked at, and the one before it
_MODULUS, _HARDNESS = Kind("a modulus", "Pa", "100GPa"), Kind("a hardness", "Pa", "2GPa")
_MOST_POINTS = 4096  # a side of a surface that is made: more is for the command line


@dataclass(frozen=True, slots=True)
class UploadedFile:
    """Where a file lies, and how its user calls it."""

    path: Path
    name: str


@dataclass(frozen=True, slots=True)
class SessionCache:
    """What was computed last, by what it follows from; all of it can be computed again."""

    kept: dict[str, dict[Hashable, Any]] = field(default_factory=dict)

    def read(
        self, source: FileSource | MadeSource, files: Mapping[str, UploadedFile]
    ) -> tuple[Surface, list[str]]:
        """Return the surface as the file holds it, or as it is made, and what the reader warns of."""
        return self._once("read", source, lambda: _read(source, files))

    def surface(self, recipe: PageRecipe, files: Mapping[str, UploadedFile]) -> Surface:
        """Return the surface after its preparation."""

        def prepared() -> Surface:
            surface, _ = self.read(recipe.source, files)
            for call in calls_of(recipe.preparation):
                surface = call.apply(surface)
            return surface

        return self._once("surface", (recipe.source, recipe.preparation), prepared)

    def warnings(
        self, source: FileSource | MadeSource, files: Mapping[str, UploadedFile]
    ) -> list[dict[str, Any]]:
        """Return what looks suspicious in the heights before any preparation."""

        def made() -> list[dict[str, Any]]:
            from roughcontact.plot.preparation_warnings import preparation_warnings

            _, found = preparation_warnings(self.read(source, files)[0])
            return [asdict(warning) for warning in found]

        return self._once("warnings", source, made)

    def solution(self, recipe: PageRecipe, files: Mapping[str, UploadedFile]) -> Solution:
        """Return the loaded state; where the tolerance was missed, the best that was reached."""
        import roughcontact as rc

        load = recipe.load
        if load is None:
            raise InputError("no load is given", place="load")

        def pressed() -> Solution:
            surface = self.surface(recipe, files)
            modulus, hardness = modulus_of(recipe.bodies), hardness_of(recipe.bodies)
            with placed("load"):
                given: dict[str, Any] = {load.control: load.value}
                try:
                    return rc.press(surface, modulus, **given, hardness=hardness)
                except rc.ConvergenceError as error:
                    best: Solution = error.solution
                    return best

        return self._once("solution", replace(recipe, loads=None), pressed)

    def span(
        self, recipe: PageRecipe, files: Mapping[str, UploadedFile]
    ) -> dict[str, tuple[float, float, float]]:
        """Return between which loads a slider goes [Pa, N, m], and where it begins: a scale of numbers, no answer."""
        surface = self.surface(recipe, files)
        slope = self._once("slope", (recipe.source, recipe.preparation), lambda: _slope(surface))
        stress, height = modulus_of(recipe.bodies) * slope, surface.rms
        if not (stress > 0 and height > 0):
            return {}
        pressures = (1e-6 * stress, 2 * stress, 1e-2 * stress)
        low, high, start = pressures
        area = surface.grid.area
        return {
            "pressure": pressures,
            "force": (low * area, high * area, start * area),
            "depth": (1e-3 * height, 10 * height, height),
        }

    def path(self, recipe: PageRecipe, loads: Loads, files: Mapping[str, UploadedFile]) -> Iterator[Solution]:
        """Return the states of rising loads, each of which is computed when it is asked for."""
        from roughcontact.contact.loading import solutions_along

        hardness = hardness_of(recipe.bodies)
        surface, modulus = self.surface(recipe, files), modulus_of(recipe.bodies)
        return solutions_along(surface, modulus, loads, hardness=hardness)

    def loads(self, recipe: PageRecipe, files: Mapping[str, UploadedFile]) -> tuple[Loads, tuple[str, ...]]:
        """Return the loads of a curve in SI, found where they are not given, and what a reader should know of them."""
        import numpy as np

        import roughcontact as rc
        from roughcontact.solver.loads import Loads

        wanted = recipe.loads or PageLoads()
        if wanted.values is not None:
            return Loads(wanted.control, np.array(wanted.values)), ()
        if wanted.ends is not None:
            return Loads(wanted.control, np.geomspace(*wanted.ends, wanted.count)), ()

        def found() -> tuple[Loads, tuple[str, ...]]:
            suitable = rc.load_range(
                self.surface(recipe, files), modulus_of(recipe.bodies), hardness=hardness_of(recipe.bodies)
            )
            return Loads("force", suitable.forces), suitable.notes

        return self._once("loads", without_loads(recipe), found)

    def keep_curve(self, recipe: PageRecipe, loads: Loads, curve: Curve) -> None:
        """Keep a curve, which may have ended early, for what is asked of it next."""
        self._keep("curve", (without_loads(recipe), loads.kind, tuple(loads.values[: len(curve)])), curve)

    def curve(self, recipe: PageRecipe, loads: Loads) -> Curve | None:
        """Return the curve of a surface, its bodies and loads, if it is kept."""
        return self.kept.get("curve", {}).get((without_loads(recipe), loads.kind, tuple(loads.values)))

    def _once(self, kind: str, key: Hashable, make: Callable[[], T]) -> T:
        shelf = self.kept.setdefault(kind, {})
        if key not in shelf:
            self._keep(kind, key, make())
        found: T = shelf[key]
        return found

    def _keep(self, kind: str, key: Hashable, value: object) -> None:
        shelf = self.kept.setdefault(kind, {})
        shelf.pop(key, None)
        shelf[key] = value
        while len(shelf) > _KEPT:
            del shelf[next(iter(shelf))]


def without_loads(recipe: PageRecipe) -> PageRecipe:
    """Return what a curve follows from but for its loads."""
    return replace(recipe, load=None, loads=None)


def modulus_of(bodies: Bodies) -> float:
    """Return the reduced modulus [Pa]."""
    import roughcontact as rc

    if bodies.materials is not None:
        rigid = rc.Solid(math.inf, 0.0)
        first, second = (rigid if name == "rigid" else rc.handbook(name).solid for name in bodies.materials)
        with placed("second"):
            return rc.reduced_modulus(first, second)
    if bodies.modulus is not None:
        return _stiff(bodies.modulus, "modulus")
    first = _solid(bodies.young, bodies.poisson, "")
    if bodies.young2 is None and bodies.poisson2 is None:
        return rc.reduced_modulus(first)
    return rc.reduced_modulus(first, _solid(bodies.young2, bodies.poisson2, "2"))


def hardness_of(bodies: Bodies) -> float | None:
    """Return the hardness [Pa], if one is given: a number, or the name of a material."""
    import roughcontact as rc

    if bodies.hardness is None:
        return None
    if bodies.hardness[:1].isalpha():
        with placed("hardness"):
            return rc.handbook(bodies.hardness).hardness
    return _stiff(bodies.hardness, "hardness")


def _solid(young: str | None, poisson: str | None, which: str) -> Solid:
    """Return the elastic constants of a body that the user wrote."""
    import roughcontact as rc

    with placed(f"young{which}"):
        if young is None:
            raise InputError("Young's modulus is missing", "give that of the body, such as 210 GPa")
    modulus = _stiff(young, f"young{which}")
    with placed(f"poisson{which}"):
        if poisson is None:
            raise InputError("Poisson's ratio is missing", "give that of the body, such as 0.3")
        return rc.Solid(modulus, parse_number(poisson, "0.3"))


def _slope(surface: Surface) -> float:
    """Return the rms slope; 0 where no two neighbours are measured."""
    import roughcontact as rc

    try:
        return float(rc.surface_moments(surface).rms_slope)
    except ValueError:
        return 0.0


def _stiff(text: str, field: str) -> float:
    """Return the modulus or hardness [Pa] of a field."""
    with placed(field):
        kind = _HARDNESS if field == "hardness" else _MODULUS
        value = parse_with_unit(text, kind)
        if value <= 0:
            raise InputError(
                f"{text!r} is not positive", f"write {kind.name} above zero, such as {kind.example}"
            )
        return value


def _read(source: FileSource | MadeSource, files: Mapping[str, UploadedFile]) -> tuple[Surface, list[str]]:
    import roughcontact as rc

    if isinstance(source, MadeSource):
        return _made(source), []
    if source.file not in files:
        raise InputError("the server has no such file any more", "drop it again")
    with placed("unit"):
        if source.heights_in is not None:
            length_factor(source.heights_in)
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("ignore")
        warnings.simplefilter("always", SurfaceWarning)
        surface = rc.read(
            files[source.file].path,
            channel=source.channel,
            unit=source.heights_in,
            size=source.size,
            periodic=source.periodic,
        )
    return surface, [str(each.message) for each in said]


def _made(source: MadeSource) -> Surface:
    """Return a self-affine surface, the one that ``surface make`` makes."""
    import numpy as np

    import roughcontact as rc

    if not 3 <= source.points <= _MOST_POINTS:  # of two a side no wave is free
        raise InputError(f"a surface has 3 to {_MOST_POINTS} points a side here, not {source.points}")
    if source.seed < 0:
        raise InputError(f"the seed must be a whole number from 0 up, not {source.seed}")
    grid = rc.Grid(
        (source.points, source.points), parse(source.size, LENGTH) / source.points, periodic=source.periodic
    )
    return rc.self_affine(
        grid,
        parse_number(source.hurst, "0.8"),
        parse(source.rms, LENGTH),
        np.random.default_rng(source.seed),
        rolloff=None if source.rolloff is None else parse(source.rolloff, LENGTH),
    )
