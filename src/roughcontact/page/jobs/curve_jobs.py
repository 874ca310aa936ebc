"""A curve on a page: points as they are computed, then its law, jumps or flow, and theories."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import is_dataclass, replace
from typing import TYPE_CHECKING, Any

from roughcontact.errors import InputError
from roughcontact.labels.labelled import plain_values
from roughcontact.labels.note import in_order
from roughcontact.page.jobs.curve_point import columns_of, point_of
from roughcontact.page.jobs.followed import Followed, collected
from roughcontact.page.jobs.session_cache import SessionCache
from roughcontact.page.jobs.shown_curve import shown_curve
from roughcontact.page.refusal import on_the_page
from roughcontact.page.server.page_request import PageRequest, Send, send_map
from roughcontact.page.stopping import Stopped, uninterrupted
from roughcontact.recipe.elastic_jobs import CurveJob
from roughcontact.recipe.job_calls import performed
from roughcontact.recipe.jobs import Job, known_names
from roughcontact.recipe.recipe_fields import given

if TYPE_CHECKING:
    from roughcontact.contact.compare import Comparison
    from roughcontact.theory.law import LoadingLaw

__all__ = ["compared", "curve", "theories"]


def curve(request: PageRequest, cache: SessionCache, send: Send) -> None:
    """Send the loads, each point when it is computed, and the results of the whole curve."""
    job, done, stopped = request.job, 0, False
    path = cache.followed(job)
    loads = path.loads.values
    notes = [on_the_page(note) for note in path.notes]
    send({"type": "loads", "count": path.count, "notes": notes, "columns": columns_of(job)})
    send({"type": "stated", **request.statement})

    def watched() -> Iterator[Any]:
        nonlocal done, stopped
        try:
            for state in path.states:
                send({"type": "point", "load": float(loads[done]), **_point(state, job, path, done)})
                done += 1
                with uninterrupted():  # a state is collected whole, or not at all
                    yield state
        except Stopped:
            if not done or not path.parts:  # no answer that could be kept
                raise
            stopped = True

    found = collected(replace(path, states=watched()))
    reached, part = _as_far(job, path, done) if stopped else (job, {})
    if reached is not None:
        cache.keep_curve(reached, found)
    answer = shown_curve(found)
    answer = replace(answer, notes=(*answer.notes, *_on_waves(job, found)))
    send(
        {
            **{
                "type": "curve",
                "count": done,
                "stopped": stopped,
                "part": part,
                "again": reached is not None,
            },
            **answer.shown(),
        }
    )
    for name, field, grid, unit in answer.maps:
        send_map(send, name, field, grid, request.whole("pixels", 1024, 4096), unit)


def theories(request: PageRequest, cache: SessionCache, send: Send) -> None:
    """Send predictions of theories at the loads of the curve and their errors, or why a theory does not apply."""
    found: dict[str, tuple[LoadingLaw, Comparison]] = {}
    for name in request.more.get("theories") or ():
        try:
            found |= compared(_with_theories(request.job, [name]), cache)
        except InputError as error:
            send({"type": "theory", "name": name, "refused": on_the_page(str(error))})
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
    shown = replace(request, shown=_with_theories(request.shown, list(found)))
    send({"type": "stated", **shown.statement})


def compared(job: CurveJob, cache: SessionCache) -> dict[str, tuple[LoadingLaw, Comparison]]:
    """Return each theory that a job names, evaluated at the loads of its curve.

    Raises
    ------
    InputError
        If a theory does not apply.
    """
    computed = cache.curve(job)
    computed = getattr(computed, "loading", computed)
    known = performed(job.bodies.calls(), known_names() | {"surface": cache.surface(job)})
    asked = [call for call in job.calls() if call.result == "theories"]
    laws = performed(asked, known)["theories"] if asked else []
    return {name: (law, computed.compare(law)) for name, law in zip(job.theories.names(), laws, strict=True)}


def _with_theories(job: Job, names: Sequence[str]) -> CurveJob:
    """Return the same job with these theories."""
    assert isinstance(job, CurveJob)
    theory = {"theory": ",".join(names)} if names else {}
    return replace(job, theories=type(job.theories)(**(given(job.theories) | theory)))


def _on_waves(job: Job, found: Any) -> Iterator[str]:
    """Yield the notes on the reflection of ultrasound by a curve, or by the first loading of a loop."""
    from roughcontact.evaluation.reflection import reflection_notes

    known = known_names() | {"curve": getattr(found, "loading", found)}
    calls = job.ultrasound.calls("curve", job.bodies) if isinstance(job, CurveJob) else ()
    for call in calls:
        yield from in_order(reflection_notes(call.value(known), call.given[-1]))


def _as_far(job: Job, path: Followed, done: int) -> tuple[Job | None, dict[str, Any]]:
    """Return the job of only the loads that were reached, and the part that differs; None if no such job exists."""
    name = next((name for name in ("loads", "retreat") if is_dataclass(getattr(job, name, None))), None)
    if name is None:
        return None, {}
    text = ",".join(map(repr, path.loads.values[:done].tolist()))
    part = {f"{path.loads.kind.replace(' ', '_')}s": text}
    changed: Any = {name: type(getattr(job, name))(**part)}
    return replace(job, **changed), {name: part}


def _point(state: Any, job: Job, path: Followed, at: int) -> dict[str, Any]:
    converged = state.status.converged
    return {
        **point_of(state, job, path.measures),
        "branch": path.branches[at] if path.branches else "",
        "resolved": bool(getattr(state, "resolved", True) and converged),
        "status": state.status.value,
    }
