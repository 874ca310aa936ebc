"""The command ``curve``: stiffness, area and depth against load."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from functools import lru_cache
from itertools import islice
from typing import TYPE_CHECKING, Any

import typer

from roughcontact.cli.contact.conductance_command import conductors_of
from roughcontact.cli.contact.curve_answer import CurveAnswer
from roughcontact.cli.contact.curve_theories import theories_of
from roughcontact.cli.contact.interface_files import write_tables
from roughcontact.cli.contact.load_errors import errors_of, require_errors
from roughcontact.cli.contact.loop_files import write_loop
from roughcontact.cli.contact_of_job import contact_of, hardness_of_job, softer_of
from roughcontact.cli.exits import INTERRUPTED, MISSED
from roughcontact.cli.job import slabs_of_job
from roughcontact.cli.messages import UsageError, note, remark
from roughcontact.cli.options import Answer
from roughcontact.cli.output import output, writing
from roughcontact.cli.parsing.several import Cells
from roughcontact.cli.path_answer import compute_rest
from roughcontact.cli.pressed import Pressed
from roughcontact.cli.report import quantity
from roughcontact.progress.events import task
from roughcontact.recipe.elastic_jobs import CurveJob
from roughcontact.recipe.jobs import known_names
from roughcontact.recipe.prescribed_loads import kinds_of, numbers
from roughcontact.recipe.recipe_fields import given, value_of

if TYPE_CHECKING:
    from pathlib import Path

    from roughcontact.cli.contact.stored_loads import StoredLoads
    from roughcontact.contact.curve import Curve
    from roughcontact.contact.loop import Loop
    from roughcontact.contact.solution import Solution
    from roughcontact.halfspace.operators.operator import Operator
    from roughcontact.labels.note import Note
    from roughcontact.materials import Modulus
    from roughcontact.solver.loads import Loads
    from roughcontact.surface.surface import Surface
    from roughcontact.validation import Array

__all__ = ["CELLS", "EXAMPLES", "curve"]

EXAMPLES = {
    "curve": """
roughcontact curve part.x3p --modulus 110GPa
roughcontact curve part.x3p --forces 1N:100N:30 --modulus 110GPa --out result
roughcontact curve part.x3p --depths 0.1um,0.2um,0.5um --young 210GPa --poisson 0.3
roughcontact curve part.x3p --modulus 110GPa --theory persson,gw,power-law --resistivity 17nohm*m --out result
roughcontact curve part.x3p --pressures 1kPa:10MPa:40 --modulus 110GPa --unit-pressure MPa --unit-stiffness N/um/mm^2
roughcontact curve part.x3p other.x3p --pressures 1kPa:10MPa:40 --modulus 110GPa --out results
roughcontact curve part.x3p --modulus 110GPa --errors --shortest-wave 5um
roughcontact curve scan.csv --profile line --forces 1N/mm:100N/mm:12 --modulus 110GPa
roughcontact curve part.x3p --materials steel,aluminium --theory mikic,cmy --hardness aluminium
roughcontact curve part.x3p --materials steel,aluminium --hardness aluminium --loop --out result
roughcontact curve part.x3p --modulus 110GPa --pressures 1MPa:300MPa:12 --leak 0 --out result
roughcontact curve joint.npz --modulus 110GPa --conductivity 50W/m/K --gas air,1bar,20degC,alpha=0.9 --out result
roughcontact curve joint.npz --modulus 110GPa --conductivity steel,aluminium --table abaqus-mm,csv --out result
roughcontact curve joint.npz --materials steel,aluminium --frequency 5MHz
""",
}

CELLS: dict[str, Cells] = {
    "curve": {
        "kind of surface": lambda record: str(record["kind"]),
        "loads": lambda record: str(len(record["force"])),
        "resolved": lambda record: str(sum(record["resolved"])),
        "from": lambda record: _shown(record, "force", 0),
        "to": lambda record: _shown(record, "force", -1),
        "exponent of k": lambda record: "-" if record["fit"] is None else f"{record['fit']['exponent']:.3f}",
        "stiffness k": lambda record: _shown(record, "stiffness", -1),
        "K/A0": lambda record: _shown(record, "interfacial_stiffness_per_area", -1),
        "A/A0": lambda record: _shown(record, "contact_fraction", -1),
    }
}
_FEWEST = 3  # resolved loads that a power law needs


def curve(job: CurveJob, *, answer: Answer) -> None:
    """Press a rough surface by increasing loads: stiffness, area and more against force, or per area against pressure.

    Numbers per area hold for a joint of any size: they are printed for a periodic map, with --pressures, and where
    you name such a unit. If you only know rms height and slope, use 'surface specified' to make a map, or 'theory'.
    """
    if job.tables.table is not None and answer.out is None:
        raise UsageError("--table writes files", "say where by --out", "tables.table")
    import numpy as np

    from roughcontact.cli.contact.stored_loads import can_be_continued, stored_loads
    from roughcontact.labels.note import Note, Rank
    from roughcontact.solver.loads import Loads

    profile, plastic, in_slabs = job.contact.profile, job.plastic, slabs_of_job() is not None
    more: tuple[str, ...] = ()
    hardness, conductors = hardness_of_job(job), conductors_of(job.conduction)
    with output(answer.out) as folder:
        loads = _named_loads(job)
        known = contact_of(job)
        surface, modulus, operator = known["surface"], known["modulus"], known.get("operator")
        require_errors(job.errors, surface)
        pressed = Pressed.of(surface, modulus, softer_of(job))
        theories = theories_of(job.theories, surface, modulus, hardness)
        if loads is None:
            loads = _suggested(surface, modulus, pressed, operator=operator, hardness=hardness)
        elif loads.kind != "depth" and not in_slabs:
            _look_ahead(surface, modulus, loads, operator)
        limits = {
            "tolerance": value_of(job.contact, "tolerance"),
            "hardness": hardness,
            "operator": operator,
            "flow": plastic.flow or "removed",
        }
        stored = None if in_slabs else stored_loads(job, loads, answer.out)
        computed, done, outer, loop = _computed(surface, modulus, loads, limits, stored, job)
        notes: tuple[Note, ...] = ()
        left = np.setdiff1d(loads.values, done)
        if left.size:
            resumes = answer.out is not None and not in_slabs and can_be_continued(job)
            notes += (Note(Rank.LIMITED, _rest(loads, left, answer.out, resumes=resumes)),)
        if job.errors.errors and not outer:
            note("no errors: no load is resolved")
        if plastic.loop and loop is None:
            text = "stopped: the loop is not closed; only the computed loads of first loading are kept"
            notes += (Note(Rank.LIMITED, text),)
        per_area = loads.kind == "pressure" or all(surface.grid.periodic) or bool(given(job.units))
        errors = errors_of(job.errors, outer)
        beside = (theories, conductors, per_area, errors, pressed, Loads(loads.kind, done), answer.out, loop)
        found = CurveAnswer(job, computed, surface, notes, *beside)
        if answer.out is not None:  # by all processes of a job, each of which holds some rows
            unit = kinds_of(profile)[loads.kind].unit
            source = found.source(
                f"{loads.kind}s from {done[0]:g} to {done[-1]:g} {unit}, {done.size} of them"
            )
        if folder is not None:
            with task("Writing files"), writing():
                more = found.write(folder, source, answer.ending)
                more += write_tables(job, folder, computed, surface)
                if loop is not None:
                    more += write_loop(loop, folder, source, answer.ending)
    found.tell(answer.json)
    files = ("curve.csv", "curve.json", "curve.nc", f"{found.picture}.{answer.ending}", *more)
    answer.finish(folder, files, job, computed, surface)
    if left.size or (plastic.loop and loop is None):
        raise typer.Exit(INTERRUPTED)
    if not found.converged:
        raise typer.Exit(MISSED)


def _shown(record: Mapping[str, Any], name: str, at: int) -> str:
    """Return a number of the first or last load, with its unit."""
    from roughcontact.halfspace.operators.geometry import Geometry

    value = record[name][at] if name in record else None
    return "-" if value is None else quantity(name, value, Geometry(record["geometry"]))


def _computed(
    surface: Surface,
    modulus: Modulus,
    loads: Loads,
    limits: dict[str, Any],
    stored: StoredLoads | None,
    job: CurveJob,
) -> tuple[Curve, Array, list[Solution], Loop | None]:
    """Return what `_load` returns, for computed and stored loads together, and these loads."""
    import numpy as np

    from roughcontact.contact.join_curves import joined
    from roughcontact.solver.loads import Loads

    if stored is None:
        curve, outer, loop = _load(surface, modulus, loads, limits, job, loop=job.plastic.loop)
        return curve, loads.values[: len(curve)], outer, loop
    new = np.setdiff1d(loads.values, stored.values)
    if not new.size:
        return stored.curve, stored.values, [], None
    curve, outer, _ = _load(surface, modulus, Loads(loads.kind, new), limits, job, loop=False)
    done = np.union1d(stored.values, new[: len(curve)])
    return joined(stored.curve, curve), done, outer, None


def _rest(loads: Loads, left: Array, out: Path | None, *, resumes: bool) -> str:
    """Return how to compute the loads that are missing because the curve was stopped."""
    done = loads.values.size - left.size
    if resumes:
        return (
            f"stopped: {done} of {loads.values.size} loads are computed; the same command computes the others"
        )
    return compute_rest(f"{loads.kind}s", done, left.tolist(), out)


def _named_loads(job: CurveJob) -> Loads | None:
    """Return the named loads; None where they must be found, which only a single process can do."""
    from roughcontact.solver.loads import Loads

    named = job.loads.named(job.contact.profile)
    if not named and slabs_of_job() is not None:
        raise UsageError(
            "several processes do not look for loads", "name them, such as --pressures 1kPa:1MPa:20"
        )
    return Loads.given(**{name: numbers({name: loads}) for name, loads in named.items()})


def _suggested(
    surface: Surface, modulus: Modulus, pressed: Pressed, *, operator: Operator | None, hardness: float | None
) -> Loads:
    """Return forces [N] that suit a surface, and print a remark with their range."""
    from roughcontact.contact.loads.load_outlook import load_outlook
    from roughcontact.contact.loads.load_range import load_range
    from roughcontact.halfspace.operators.geometry import Geometry
    from roughcontact.halfspace.operators.operator import geometry_of
    from roughcontact.solver.loads import Loads

    found = load_range(surface, modulus, operator=operator, hardness=hardness)
    loads, end = Loads("force", found.forces), found.reasons[1]
    kind = Geometry.SURFACE if operator is None else geometry_of(operator)
    low, high = (quantity("force", float(load), kind) for load in loads.values[[0, -1]])
    below = found.below
    if kind is Geometry.LINE:  # forces of line contacts are not searched for
        below = load_outlook(surface, modulus, loads, operator).below
    small = "below what the grid resolves"
    if kind is Geometry.SURFACE:  # the stiffness may be resolved at these forces
        small = (
            "so light that single cells set their area and pressure (not resolved where also their stiffness)"
        )
    remark(
        f"the map is {pressed.words}; no loads are named: {loads.values.size} forces from {low} to {high}, to {end}, "
        f"{below} of them {small} (--forces for others)"
    )
    for line in found.notes:
        note(line)
    return loads


def _look_ahead(surface: Surface, modulus: Modulus, loads: Loads, operator: Operator | None) -> None:
    """Print a note before the work if the grid resolves none of the named loads, or too few for a power law."""
    from roughcontact.contact.loads.load_outlook import load_outlook

    name = f"{loads.kind}s"
    ahead = load_outlook(surface, modulus, loads, operator)
    if ahead.resolved >= min(_FEWEST, ahead.count):
        return
    ends = ((ahead.below, "too small: the cells set the stiffness"), (ahead.above, "near full contact"))
    why = ", ".join(f"{count} {words}" for count, words in ends if count)
    note(
        f"{ahead.resolved or 'none'} of the {ahead.count} {name} can be resolved by this grid ({why}): leave out "
        f"--{name}, and forces that suit the map are found"
    )


def _load(
    surface: Surface, modulus: Modulus, loads: Loads, limits: dict[str, Any], job: CurveJob, *, loop: bool
) -> tuple[Curve, list[Solution], Loop | None]:
    """Return the curve, the first and last load that are resolved, and the whole loop.

    With `loop`, unloading and reloading follow. Ctrl-C ends the curve with the loads that are done.
    """
    from roughcontact.contact.curve import collect
    from roughcontact.contact.loading import solutions_along
    from roughcontact.contact.loop import closed_loop, loads_of_loop
    from roughcontact.contact.measures import measured_at

    every, count = loads_of_loop(loads) if loop else loads, loads.values.size
    # Each keeps the numbers of its last state: Ctrl-C while one is measured ends the curve before this state.
    measures = [lru_cache(maxsize=1)(call.value(known_names())) for call in job.measures()]
    path = solutions_along(surface, modulus, every, **limits)
    ends: list[Solution] = []
    last: list[Solution] = []

    def watched(path: Iterator[Solution]) -> Iterator[Solution]:
        try:
            for solution in islice(path, count):
                resolved = solution.resolved and solution.status.converged  # which takes as long as the load
                measured_at(solution, measures, ())
                last[:] = [solution]
                if resolved:
                    ends[1 if ends else 0 :] = [solution]
                yield solution
        except KeyboardInterrupt:
            if not last:  # nothing to keep
                raise

    curve = collect(watched(path), measures)
    closed = None
    if loop and len(curve) == count:
        with suppress(KeyboardInterrupt):
            closed = closed_loop(curve, last[0], path)
    return curve, ends, closed
