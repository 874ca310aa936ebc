"""States under one load after the other, as they are computed: of curves, loops and adhesive paths."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache, partial
from typing import TYPE_CHECKING, Any

from roughcontact.errors import within
from roughcontact.recipe.job_calls import Call, perform

if TYPE_CHECKING:
    from roughcontact.contact.measures import StateMeasure
    from roughcontact.materials import Modulus
    from roughcontact.solver.loads import Loads

__all__ = ["Followed", "collected", "follow", "up_to_path"]


@dataclass(frozen=True, slots=True, eq=False)
class Followed:
    """A path of loads.

    Parameters
    ----------
    states : iterator
        The states; each is computed when the iterator is advanced.
    loads : Loads
        The prescribed loads in their order; a path may end before the last.
    collect : function
        Turns the states into the answer.
    branches : sequence of str
        The branch of each load; empty if there is only one branch.
    count : int or None
        The number of states, if it is known.
    notes : tuple of str
        Notes on the loads.
    measures : sequence of functions
        They return further numbers of a state by name. Each keeps those of the last state, which is measured once.
    parts : bool
        Whether the first states without the rest are an answer.
    measured : function
        Returns further numbers of a state by name.
    """

    states: Iterator[Any]
    loads: Loads
    collect: Callable[[Iterable[Any]], Any]
    branches: Sequence[str] = ()
    count: int | None = None
    notes: tuple[str, ...] = ()
    parts: bool = True
    measures: Sequence[StateMeasure] = ()


def collected(followed: Followed) -> Any:
    """Return the answer of a path."""
    return followed.collect(followed.states)


def follow(calls: Iterable[Call], known: dict[str, Any]) -> Followed:
    """Make the calls up to the one that follows loads, and return the states that it yields."""
    *before, last = up_to_path(calls)
    for call in before:
        perform(call, known)
    with within(last.place):
        given, named = last.arguments(known)
        return _FOLLOWED[last.function](*given, **named)


def up_to_path(calls: Iterable[Call]) -> Iterator[Call]:
    """Yield calls up to the one that follows loads."""
    for call in calls:
        yield call
        if call.function in _FOLLOWED:
            return


def _curve(surface: Any, modulus: Modulus, **named: Any) -> Followed:
    import roughcontact as rc
    from roughcontact.contact.curve import collect

    measures = [lru_cache(maxsize=1)(each) for each in named.pop("measures", ())]
    loads, notes = _rising(surface, modulus, named)
    states = rc.loading_path(surface, modulus, **named)
    collecting = partial(collect, measures=measures)
    return Followed(states, loads, collecting, count=len(loads.values), notes=notes, measures=measures)


def _loop(surface: Any, modulus: Modulus, **named: Any) -> Followed:
    import roughcontact as rc
    from roughcontact.contact.loop import BRANCHES, collect_loop, loads_of_loop

    rising, notes = _rising(surface, modulus, named)
    loads, count = loads_of_loop(rising), len(rising.values)
    named[f"{loads.kind}s"] = loads.values
    states = rc.loading_path(surface, modulus, **named)
    branches = [name for name in BRANCHES for _ in range(count)]
    return Followed(
        states, loads, lambda path: collect_loop(iter(path), count), branches, 3 * count, notes, False
    )


def _rising(surface: Any, modulus: Modulus, named: dict[str, Any]) -> tuple[Loads, tuple[str, ...]]:
    """Return the named loads; otherwise forces that suit the surface, with notes on them."""
    import roughcontact as rc
    from roughcontact.solver.loads import Loads

    names = ("forces", "pressures", "depths")
    if (loads := Loads.given(**{name: named.get(name) for name in names})) is not None:
        return loads, ()
    found = rc.load_range(surface, modulus, operator=named.get("operator"), hardness=named.get("hardness"))
    named["forces"] = found.forces
    return Loads("force", found.forces), found.notes


def _adhesive_curve(surface: Any, modulus: Modulus, adhesion: Any, **named: Any) -> Followed:
    import roughcontact as rc
    from roughcontact.adhesion.adhesive_curve import collect_states
    from roughcontact.solver.loads import Loads

    loads = Loads.of(**{name: values for name, values in named.items() if name.endswith("s")})
    states = rc.adhesive_path(surface, modulus, adhesion, **named)
    return Followed(states, loads, lambda path: collect_states(path, loads), _ways(loads), len(loads.values))


def _adhesive_loop(
    surface: Any, modulus: Modulus, adhesion: Any, *, depth: float, points: int, **named: Any
) -> Followed:
    import roughcontact as rc
    from roughcontact.adhesion.adhesive_curve import collect_states
    from roughcontact.adhesion.adhesive_loop import loop_depths, until_off
    from roughcontact.solver.loads import Loads

    depths = loop_depths(adhesion, depth, points)
    states = until_off(rc.adhesive_path(surface, modulus, adhesion, depths=depths, **named), points)
    loads = Loads("depth", depths[1:])
    return Followed(states, loads, lambda path: collect_states(path, loads), _ways(loads))


def _ways(loads: Loads) -> list[str]:
    from roughcontact.adhesion.adhesive_curve import approaches

    return ["approach" if grows else "retreat" for grows in approaches(loads.approach)]


def _adhesive_state(surface: Any, modulus: Modulus, adhesion: Any, **named: Any) -> Followed:
    import roughcontact as rc
    from roughcontact.solver.loads import Loads

    def states() -> Iterator[Any]:
        try:
            state = rc.adhesive_state(surface, modulus, adhesion, **named)
        except rc.ConvergenceError as error:
            state = error.solution
        yield state

    loads = Loads.of(**{name: named.get(name) for name in ("force", "pressure", "depth", "mean_gap")})
    return Followed(states(), loads, lambda path: next(iter(path)), count=1)


def _detachment(solution: Any, work: float, **named: Any) -> Followed:
    import roughcontact as rc
    from roughcontact.adhesion.detachment_curve import collect_detachments
    from roughcontact.solver.loads import Loads

    loads = Loads.given(**named)
    states = rc.detachment_path(solution, work, **named)
    shown, parts = (Loads.of(depths=[0.0] * 3), False) if loads is None else (loads, True)
    collect = partial(collect_detachments, loads=loads)
    return Followed(states, shown, collect, count=len(shown.values), parts=parts)


_FOLLOWED: dict[str, Callable[..., Followed]] = {
    "rc.loading_curve": _curve,
    "rc.loading_loop": _loop,
    "rc.adhesive_curve": _adhesive_curve,
    "rc.adhesive_loop": _adhesive_loop,
    "rc.detachment_curve": _detachment,
    "rc.adhesive_state": _adhesive_state,
}
