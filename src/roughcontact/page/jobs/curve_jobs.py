"""What a page shows of a curve: points as they come, a power law at the end, theories beside them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from roughcontact.errors import InputError
from roughcontact.labels.labelled import plain_values
from roughcontact.page.jobs.conducting import conductors_of
from roughcontact.page.jobs.curve_point import columns, point_of
from roughcontact.page.jobs.session_cache import SessionCache, hardness_of, modulus_of
from roughcontact.page.recipe import PageLoads, PageRecipe
from roughcontact.page.server.page_request import PageRequest, Send
from roughcontact.page.statement import stated
from roughcontact.page.stopping import Stopped

if TYPE_CHECKING:
    from roughcontact.contact.compare import Comparison
    from roughcontact.contact.curve import Curve
    from roughcontact.contact.solution import Solution
    from roughcontact.theory.law import LoadingLaw

__all__ = ["compared", "curve", "theories", "whole_curve"]


def curve(request: PageRequest, cache: SessionCache, send: Send) -> None:
    """Send the loads, every point when it is there, and what the curve says as a whole."""
    recipe = replace(request.recipe, load=None, loads=request.recipe.loads or PageLoads())
    if recipe.loads is not None and recipe.loads.ends is None and recipe.loads.values is None:
        send({"type": "doing", "words": "Looking for the loads that suit this surface"})
    loads, notes = cache.loads(recipe, request.files)
    conductors = conductors_of(recipe.bodies)
    send({"type": "loads", "count": len(loads.values), "notes": notes, "columns": columns(conductors)})
    send(_statement(recipe, request))

    def watched(path: Iterator[Solution]) -> Iterator[Solution]:
        done = 0
        try:
            for solution in path:
                send(
                    {
                        "type": "point",
                        "load": float(loads.values[done]),
                        **point_of(solution, conductors),
                        **_judged(solution),
                    }
                )
                done += 1
                yield solution
        except Stopped:
            if not done:  # nothing to keep
                raise

    computed = _collected(watched(cache.path(recipe, loads, request.files)))
    cache.keep_curve(recipe, loads, computed)
    send({"type": "curve", **_whole(computed), "stopped": len(computed) < len(loads.values)})


def theories(request: PageRequest, cache: SessionCache, send: Send) -> None:
    """Send what theories predict at the loads of the curve, and by how much they are off; or why they do not apply."""
    loads = request.recipe.loads or PageLoads()
    found, refused = compared(request, cache)
    for name, why in refused.items():
        send({"type": "theory", "name": name, "refused": why})
    for name, (_, comparison) in found.items():
        send(
            {
                "type": "theory",
                "name": name,
                "label": comparison.name,
                "words": comparison.words(),
                "predicted": {key: plain_values(values) for key, values in comparison.predicted.items()},
            }
        )
    apply = replace(loads, theories=tuple(found))
    send(_statement(replace(request.recipe, load=None, loads=apply), request))


def compared(
    request: PageRequest, cache: SessionCache
) -> tuple[dict[str, tuple[LoadingLaw, Comparison]], dict[str, str]]:
    """Return each theory that the recipe names beside the curve, and why others do not apply."""
    computed, loads = whole_curve(request, cache), request.recipe.loads or PageLoads()
    found: dict[str, tuple[LoadingLaw, Comparison]] = {}
    refused: dict[str, str] = {}
    for name in loads.theories:
        try:
            law = _law(name, request, cache)
            found[name] = law, computed.compare(law)
        except InputError as error:
            refused[name] = str(error)
    return found, refused


def whole_curve(request: PageRequest, cache: SessionCache) -> Curve:
    """Return the curve that the page has, as far as it came; computed again if this worker has not seen it."""
    loads, _ = cache.loads(request.recipe, request.files)
    kept = cache.curve(request.recipe, loads)
    if kept is not None:
        return kept
    computed = _collected(cache.path(request.recipe, loads, request.files))
    cache.keep_curve(request.recipe, loads, computed)
    return computed


def _law(name: str, request: PageRequest, cache: SessionCache) -> LoadingLaw:
    import roughcontact as rc
    from roughcontact.theory.laws import LAWS

    bodies = request.recipe.bodies
    hardness = hardness_of(bodies)
    if hardness is None and name in LAWS and "hardness" in LAWS[name].needs:
        raise InputError(
            "it is about spots that flow", "give the hardness of the softer body, and start the curve again"
        )
    known: dict[str, Any] = {} if hardness is None else {"hardness": hardness}
    [law] = rc.loading_laws(cache.surface(request.recipe, request.files), modulus_of(bodies), name, **known)
    return law


def _statement(recipe: PageRecipe, request: PageRequest) -> Mapping[str, Any]:
    statement = stated(recipe, request.file)
    return {"type": "stated", "command": statement.command, "python": statement.python}


def _collected(path: Iterator[Solution]) -> Curve:
    from roughcontact.contact.curve import collect

    return collect(path)


def _judged(solution: Solution) -> dict[str, Any]:
    converged = solution.status.converged
    return {"resolved": bool(solution.resolved and converged), "status": solution.status.value}


def _whole(computed: Curve) -> dict[str, Any]:
    from roughcontact.contact.curve import REMEDY
    from roughcontact.plot.facts import bend_words, curve_facts

    resolved = int(computed.resolved.sum())
    try:
        law = computed.fit()
    except InputError as error:
        why = str(error).replace(REMEDY, "take loads that suit the surface, or a finer map")
        return {
            "facts": curve_facts(computed, None),
            "notes": [f"No power law: {why}."],
            "resolved": resolved,
        }
    inside = (computed.force >= law.window[0]) & (computed.force <= law.window[1])
    force = computed.force[inside]
    return {
        "facts": curve_facts(computed, law),
        "notes": [] if law.straight else [f"There is {bend_words(law)}."],
        "resolved": resolved,
        "fit": {
            "exponent": float(law.exponent),
            "force": force.tolist(),
            "stiffness": law.stiffness(force).tolist(),
        },
    }
