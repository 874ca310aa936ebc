"""The quantities of one load that a curve can show: their names, units and values."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from roughcontact.contact.measures import StateMeasure, measured_at
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.adhesive_columns import ADHESIVE_CURVE
from roughcontact.labels.column import Column, shown_in
from roughcontact.labels.contact_columns import (
    CERTIFICATES,
    CONDUCTION,
    CONDUCTION_PER_AREA,
    POINTS,
    REFLECTION,
    STATE_NAMES,
)
from roughcontact.labels.flow_columns import FLOW_OF_CURVE
from roughcontact.labels.flux_columns import HEAT_PARTS
from roughcontact.labels.labelled import plain_values, values_of
from roughcontact.recipe.elastic_jobs import CurveJob
from roughcontact.recipe.job_calls import Call, Name
from roughcontact.recipe.jobs import Job, known_names

__all__ = ["columns_of", "point_of"]

_SHOWN = shown_in("page", (*POINTS, *CERTIFICATES))
_STICKING = shown_in("path", [each for each in ADHESIVE_CURVE[("load",)] if each.unit])
_MEASURED = {  # by the function of a measure
    "rc.ConductanceParts": shown_in("page", HEAT_PARTS),
    "rc.Transmissivity": shown_in("page", FLOW_OF_CURVE),
}
_GEOMETRIES = {None: Geometry.SURFACE, "line": Geometry.LINE, "winkler": Geometry.FOUNDATION}


def columns_of(job: Any) -> list[dict[str, str]]:
    """Return the quantities of a point of the curve of a job, with the words and units of pictures."""
    from roughcontact.labels.engineering_units import pretty

    shown: Sequence[Column] = _STICKING
    if isinstance(job, CurveJob):
        measured = (each for call in job.measures() for each in _MEASURED[call.function])
        shown = (*_SHOWN, *_conducted(job), *measured, *_reflected(job))
    units = {each.name: pretty(each.unit_on(_GEOMETRIES[job.contact.profile])) for each in shown}
    return [{"name": each.name, "label": each.label, "unit": units[each.name]} for each in shown]


def point_of(state: Any, job: Job | None = None, measures: Sequence[StateMeasure] = ()) -> dict[str, Any]:
    """Return the quantities of a state in SI units, those of the curve of a job; None where one is infinite."""
    shown = _SHOWN if job is None or isinstance(job, CurveJob) else _STICKING
    point = {each.name: value for each, value in values_of(state, shown, STATE_NAMES).items()}
    if isinstance(job, CurveJob) and (conducted := _conducted(job)):
        named = job.conduction.named() | {"of": job.conduction.of}
        found = Call("rc.conductance", (Name("state"),), named).value(known_names() | {"state": state})
        point |= {each.name: float(found[each.name]) for each in conducted}
    if isinstance(job, CurveJob):
        for call in job.ultrasound.calls("state", job.bodies):
            found = call.value(known_names() | {"state": state})
            point |= {each.name: float(found[each.name]) for each in _reflected(job)}
    point |= measured_at(state, measures, tuple(point))
    return {name: plain_values(value) for name, value in point.items()}


def _conducted(job: CurveJob) -> list[Column]:
    """Return the conductances of a job: of the interface per nominal area, or total."""
    electrical, _, thermal, _ = CONDUCTION_PER_AREA if job.conduction.of == "interface" else CONDUCTION
    columns = {"resistivities": electrical, "conductivities": thermal}
    return [columns[name] for name in job.conduction.named()]


def _reflected(job: CurveJob) -> tuple[Column, ...]:
    """Return the columns of ultrasound, if a job names a frequency."""
    return () if job.ultrasound.frequency is None else shown_in("page", REFLECTION)
