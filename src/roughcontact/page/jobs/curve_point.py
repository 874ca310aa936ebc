"""The numbers of one load that can stand on a curve: their names, units and values."""

from __future__ import annotations

from typing import Any

from roughcontact.labels.adhesive_columns import ADHESIVE_CURVE
from roughcontact.labels.column import shown_in
from roughcontact.labels.contact_columns import CERTIFICATES, CONDUCTION_PER_AREA, POINTS, STATE_NAMES
from roughcontact.labels.labelled import plain_values, values_of
from roughcontact.recipe.elastic_jobs import CurveJob
from roughcontact.recipe.job_calls import Call, Name
from roughcontact.recipe.jobs import Job, known_names

__all__ = ["columns_of", "point_of"]

_SHOWN = shown_in("page", (*POINTS, *CERTIFICATES))
_STICKING = shown_in("path", [each for each in ADHESIVE_CURVE[("load",)] if each.unit])
_CONDUCTED = {
    "resistivities": shown_in("page", CONDUCTION_PER_AREA[:2]),
    "conductivities": shown_in("page", CONDUCTION_PER_AREA[2:]),
}


def columns_of(job: Job) -> list[dict[str, str]]:
    """Return the quantities of a point of the curve of a job, with the words and units of pictures."""
    from roughcontact.plot.drawing.engineering_units import pretty

    shown = _STICKING
    if isinstance(job, CurveJob):
        shown = (*_SHOWN, *(each for name in job.conduction.named() for each in _CONDUCTED[name]))
    return [{"name": each.name, "label": each.label, "unit": pretty(each.unit)} for each in shown]


def point_of(state: Any, job: Job | None = None) -> dict[str, Any]:
    """Return the quantities of a state in SI units, those of the curve of a job; None where one is infinite."""
    if job is None or not isinstance(job, CurveJob):
        shown, conducted = _SHOWN if job is None else _STICKING, {}
    else:
        shown, conducted = _SHOWN, _conducted(job, state)
    point = {each.name: value for each, value in values_of(state, shown, STATE_NAMES).items()} | conducted
    return {name: plain_values(value) for name, value in point.items()}


def _conducted(job: CurveJob, state: Any) -> dict[str, float]:
    """Return what a loaded state conducts, if its job asks for that."""
    named = job.conduction.named()
    if not named:
        return {}
    call = Call("rc.conductance", (Name("state"),), named | {"of": job.conduction.of})
    found = call.value(known_names() | {"state": state})
    return {each.name: float(found[each.name]) for name in named for each in _CONDUCTED[name]}
