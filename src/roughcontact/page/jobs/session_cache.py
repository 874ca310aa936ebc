"""Results of the jobs of a page: the last few surfaces, states and curves."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Hashable, Iterable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from roughcontact.errors import InputError
from roughcontact.files.file_errors import SurfaceWarning
from roughcontact.page.jobs.followed import Followed, collected, follow, up_to_path
from roughcontact.recipe.job_calls import Call, performed
from roughcontact.recipe.jobs import Job, contact_calls, known_names, surface_calls
from roughcontact.recipe.source import SelfAffine, SmoothBody
from roughcontact.recipe.specified import Specified
from roughcontact.recipe.texts import points

if TYPE_CHECKING:
    from roughcontact.contact.solution import Solution
    from roughcontact.plot.preparation_warnings import PreparationWarning
    from roughcontact.surface.preparation.spikes import Spikes
    from roughcontact.surface.surface import Surface

__all__ = ["SessionCache", "UploadedFile"]

T = TypeVar("T")
_KEPT = 2  # of each kind: the current one and the one before it
_MOST_POINTS = 4096  # per side of a surface that is made; the command line allows more


@dataclass(frozen=True, slots=True)
class UploadedFile:
    """The path of a file, and its name for the user."""

    path: Path
    name: str


@dataclass(frozen=True, slots=True)
class SessionCache:
    """The latest results, by the calls that compute them; each can be computed again."""

    kept: dict[str, dict[Hashable, Any]] = field(default_factory=dict)

    def read(self, job: Job) -> tuple[Surface, list[str]]:
        """Return the surface as it is read or made, and the warnings of the reader."""
        calls = _calls_of_source(job)

        def made() -> tuple[Surface, list[str]]:
            if (
                isinstance(job.source, SelfAffine | Specified | SmoothBody)
                and max(points(job.source.points)) > _MOST_POINTS
            ):
                raise InputError(
                    f"a surface on the page has at most {_MOST_POINTS} points a side, not {job.source.points}",
                    "give fewer, or use the command line",
                    "source.points",
                )
            with warnings.catch_warnings(record=True) as said:
                warnings.simplefilter("ignore")
                warnings.simplefilter("always", SurfaceWarning)
                found = performed(calls, known_names())["surface"]
            return found, [str(each.message) for each in said]

        return self._once("read", _key(calls), made)

    def surface(self, job: Job) -> Surface:
        """Return the surface after its preparation; an added step starts from the stored surface."""
        calls, first = list(surface_calls(job)), len(_calls_of_source(job))
        shelf = self.kept.setdefault("surface", {})

        def prepared() -> Surface:
            done = next((n for n in range(len(calls), first, -1) if _key(calls[:n]) in shelf), first)
            begun = self.read(job)[0] if done == first else shelf[_key(calls[:done])]
            found: Surface = performed(calls[done:], {"surface": begun})["surface"]
            return found

        return self._once("surface", _key(calls), prepared)

    def warnings(self, job: Job) -> list[dict[str, Any]]:
        """Return suspicious features of the heights before preparation, and whether they remain after it."""
        from roughcontact.plot.preparation_warnings import preparation_warnings

        found = self._once(
            "warnings", _key(_calls_of_source(job)), lambda: preparation_warnings(self.read(job)[0])[1]
        )
        left = {warning.kind for warning in self._looked_at(job)[1]}
        return [asdict(warning) | {"left": warning.kind in left} for warning in found]

    def spikes(self, job: Job) -> Spikes:
        """Return the spikes of the prepared heights."""
        return self._looked_at(job)[0]

    def _looked_at(self, job: Job) -> tuple[Spikes, list[PreparationWarning]]:
        from roughcontact.plot.preparation_warnings import preparation_warnings

        calls = _key(list(surface_calls(job)))
        return self._once("looked at", calls, lambda: preparation_warnings(self.surface(job)))

    def solution(self, job: Job) -> Solution:
        """Return the loaded state; if it misses the tolerance, the best state."""
        import roughcontact as rc

        def pressed() -> Solution:
            try:
                found: Solution = performed(contact_calls(job), self._known(job))["solution"]
            except rc.ConvergenceError as error:
                found = error.solution
            return found

        return self._once("solution", _key([*surface_calls(job), *contact_calls(job)]), pressed)

    def span(self, job: Any) -> dict[str, tuple[float, float, float]]:
        """Return the ends of the slider of loads and its start [Pa, N, m], by estimates."""
        from roughcontact.materials import as_modulus

        surface, bodies = self.surface(job), getattr(job, "bodies", None)
        if bodies is None:
            return {}
        slope = self._once("slope", _key(surface_calls(job)), lambda: _slope(surface))
        modulus, height = as_modulus(performed(bodies.calls(), known_names())["modulus"]), surface.rms
        # The force per length of a spring is the modulus times its depth.
        stress = modulus * (height if job.contact.profile == "winkler" else slope)
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

    def followed(self, job: Job) -> Followed:
        """Return the states of a job of many loads; each is computed when the iterator is advanced."""
        return follow(contact_calls(job), self._known(job))

    def keep_curve(self, job: Job, curve: object) -> None:
        """Keep a curve for later requests."""
        self._keep("curve", _key_of_curve(job), curve)

    def curve(self, job: Job) -> Any:
        """Return the curve, the loop or the path of a job; computed again if this worker does not hold it."""
        return self._once("curve", _key_of_curve(job), lambda: collected(self.followed(job)))

    def _known(self, job: Job) -> dict[str, Any]:
        return known_names() | {"surface": self.surface(job)}

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


def _calls_of_source(job: Job) -> list[Call]:
    steps = [call for call in surface_calls(job) if call.place.startswith("preparation")]
    calls = list(surface_calls(job))
    return calls[: len(calls) - len(steps)]


def _key(calls: Iterable[Call]) -> tuple[str, ...]:
    return tuple(map(str, calls))


def _key_of_curve(job: Job) -> tuple[str, ...]:
    """Return the calls that a curve depends on, without theories and tables."""
    return _key([*surface_calls(job), *up_to_path(contact_calls(job))])


def _slope(surface: Surface) -> float:
    """Return the rms slope; 0 if no two neighbouring points are measured."""
    import roughcontact as rc

    try:
        return float(rc.surface_moments(surface).rms_slope)
    except InputError:
        return 0.0
