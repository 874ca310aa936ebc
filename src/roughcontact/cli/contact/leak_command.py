"""The command ``leak``: one load, and the flow of a fluid through the gap."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from roughcontact.cli.contact_of_job import best_state, contact_of, hardness_of_job, name_of
from roughcontact.cli.exits import MISSED
from roughcontact.cli.messages import note, note_all, remark
from roughcontact.cli.options import Answer
from roughcontact.cli.output import all_or_none, command_line, output
from roughcontact.cli.report import emit, print_facts
from roughcontact.errors import InputError
from roughcontact.progress.events import task
from roughcontact.recipe.job_calls import perform
from roughcontact.recipe.leak_job import LeakJob
from roughcontact.recipe.written import carried

if TYPE_CHECKING:
    from roughcontact.fluid.leak import Leak
    from roughcontact.labels.note import Note

__all__ = ["EXAMPLES", "leak"]

EXAMPLES = {
    "leak": """
roughcontact leak part.x3p --materials steel,steel --pressure 20MPa --viscosity 1mPa*s --drop 1bar --out result
roughcontact leak part.x3p --modulus 1GPa --pressure 9MPa --gas air --temperature 20degC --upstream 2bar --downstream 0
roughcontact leak tile.npz --modulus 1GPa --pressure 1MPa --viscosity 1mPa*s --drop 1bar --seal-width 1mm \
--circumference 0.1m
""",
}

_QUICK = 2**16  # cells up to which the interval takes about a second
_FEWEST = 16  # cells along an axis whose half still has a gap worth a flow
_CHANGE = 0.1  # relative change on half the cells above which a note is printed


def leak(job: LeakJob, *, answer: Answer) -> None:
    """Press a rough surface by one load: the leak rate of a liquid or gas.

    The fluid does not press on the bodies: its drop of pressure must be below the nominal pressure. A periodic map is a
    sample of a seal, whose width and circumference must be given.
    """
    from roughcontact.contact.notes.solution_notes import notes_on
    from roughcontact.fluid.flow_notes import notes_on_leak
    from roughcontact.theory import leakage

    hardness_of_job(job.pressed)
    with output(answer.out) as folder:
        known = contact_of(job)
        _require_seal(job, known)
        found = _pressed_and_flown(job, known)
        solution, flow = found.flow.solution, found.flow
        with task("Bounds and half the cells"):
            other = _with_other_missing(job, known) if solution.missing else None
            half = _on_half_the_cells(job, known)
            quick = flow.percolates and solution.problem.grid.size <= _QUICK
            interval = flow.interval if quick else None
        if flow.percolates and not quick:
            remark(f"no interval of the flow on more than {_QUICK} cells; in Python: leak.flow.interval")
        converged = solution.status.converged and flow.residual <= flow.tolerance
        surface = solution.problem.surface
        record = {
            "command": job.NAME,
            "file": name_of(job.source),
            "surface": list(surface.provenance) if surface is not None else [],
            **found.to_record(),
            "eigenvalues": flow.eigenvalues.tolist(),
            "interval": None if interval is None else [each.tolist() for each in interval],
            "other_missing": None if other is None else {"missing": _other(job), **_rates(other)},
            "bruggeman": leakage.bruggeman(flow.gap**3),
            "half_grid": None if half is None else _rates(half),
            "tolerance": solution.problem.tolerance,
            "converged": bool(converged),
        }
        if answer.json or answer.out is not None:
            record["recipe"] = carried(job, answer.out)
        if folder is not None:
            _write(job, found, record, folder, answer.ending)
    if answer.json:
        emit(record)
    else:
        _print(job, found, record["bruggeman"], interval, other, half)
    note_all([*notes_on(solution), *notes_on_leak(found), *_notes(found, half)])
    answer.finish(folder, ("leak.json", "leak.nc", f"leak.{answer.ending}"), job, solution)
    if not converged:
        raise typer.Exit(MISSED)


def _require_seal(job: LeakJob, known: dict[str, Any]) -> None:
    """Raise an error before the work if the seal and the map do not fit."""
    from roughcontact.errors import within
    from roughcontact.fluid.leak import shape_factor

    named = job.seal.named()
    with within("seal"):
        shape_factor(
            known["surface"].grid, named["axis"], named.get("seal_width"), named.get("circumference")
        )


def _pressed_and_flown(job: LeakJob, known: dict[str, Any]) -> Leak:
    """Return the leak of a surface; `known` holds its solution afterwards."""
    press, *flow = job.calls()
    known["solution"] = best_state(press, known)
    return _flown(flow, known)


def _flown(calls: list[Any], known: dict[str, Any]) -> Leak:
    for call in calls:
        perform(call, known)
    found: Leak = known["leak"]
    return found


def _other(job: LeakJob) -> str:
    return "open" if job.seal.missing == "closed" else "closed"


def _with_other_missing(job: LeakJob, known: dict[str, Any]) -> Leak:
    changed = replace(job, seal=replace(job.seal, missing=_other(job)))
    return _flown(list(changed.calls())[1:], dict(known))


def _on_half_the_cells(job: LeakJob, known: dict[str, Any]) -> Leak | None:
    """Return the leak of the same map, pressed on half as many cells along each axis; None if it cannot be computed."""
    from roughcontact.surface.preparation.halving import halved

    surface = known["surface"]
    if min(surface.grid.shape) < _FEWEST:
        return None
    try:
        return _pressed_and_flown(job, known | {"surface": halved(surface)})
    except InputError as error:
        note(f"on half as many cells there is no leak rate: {error}")
        return None


def _rates(leak: Leak) -> dict[str, Any]:
    record = leak.to_record()
    names = ("leak_rate", "throughput", "mass_rate", "hydraulic_gap", "contact_fraction", "percolates")
    return {name: record[name] for name in names}


def _change(leak: Leak, half: Leak) -> float:
    """Return the relative difference of two leak rates; infinite if only the first is zero."""
    if leak.volume == 0:
        return 0.0 if half.volume == 0 else float("inf")
    return half.volume / leak.volume - 1


def _notes(leak: Leak, half: Leak | None) -> list[Note]:
    from roughcontact.labels.note import Note, Rank

    if half is None or abs(change := _change(leak, half)) <= _CHANGE:
        return []
    words = f"On half as many cells along each axis, the leak rate differs by {change:+.0%}: "
    return [Note(Rank.DOUBTFUL, f"{words}the grid does not resolve the gap. Use smaller cells.")]


def _print(
    job: LeakJob, found: Leak, bruggeman: float, interval: Any, other: Leak | None, half: Leak | None
) -> None:
    from roughcontact.plot.leak_facts import leak_facts, rate_words

    facts = [("file", name_of(job.source)), *leak_facts(found)]
    if interval is not None:
        low, high = (float(each[found.direction, found.direction]) for each in interval)
        words = f"{low:.4g} to {high:.4g} m³ for a gap that is constant in each cell"
        facts.append(("interval of the transmissivity", words))
    theory = (
        f"{bruggeman:.4g} m³, from the distribution of the gaps only (Bruggeman, isotropic, without slip)"
    )
    facts.append(("transmissivity by theory", theory))
    if other is not None:
        facts.append((f"leak rate, missing cells {_other(job)}", rate_words(other)))
    if half is not None:
        facts.append(("leak rate, half the cells", f"{rate_words(half)} ({_change(found, half):+.1%})"))
    print_facts(facts)


def _write(job: LeakJob, found: Leak, record: dict[str, Any], folder: Path, ending: str) -> None:
    import matplotlib.figure

    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_json, write_netcdf
    from roughcontact.plot.canvas import save

    problem = found.flow.solution.problem
    source = provenance(
        problem.surface,
        modulus=problem.modulus,
        tolerance=problem.tolerance,
        command=command_line(),
        recipe=record["recipe"],
    )
    height, width = problem.grid.lengths
    size = 6.4, min(max(1.0 + 4.2 * height / width, 2.6), 9.0)
    figure = matplotlib.figure.Figure(figsize=size, layout="constrained")
    found.flow.plot(figure.subplots(), direction=found.direction)
    with all_or_none(folder) as aside:
        write_netcdf(found.to_dataset(), aside / "leak.nc", source)
        write_json(record, aside / "leak.json", source)
        save(figure, aside / f"leak.{ending}")
