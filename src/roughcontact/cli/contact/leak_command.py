"""The command ``leak``: one load, and the flow of a fluid through the gap."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import typer

from roughcontact.cli.contact_of_job import best_state, contact_of, hardness_of_job, name_of
from roughcontact.cli.exits import MISSED
from roughcontact.cli.messages import note, note_all, remark
from roughcontact.cli.options import Answer
from roughcontact.cli.output import output, source_of, write_state
from roughcontact.cli.report import emit, print_facts
from roughcontact.errors import InputError, within
from roughcontact.progress.events import task
from roughcontact.recipe.job_calls import perform
from roughcontact.recipe.leak_job import LeakJob
from roughcontact.recipe.written import carried

if TYPE_CHECKING:
    from roughcontact.fluid.leak import Leak

__all__ = ["EXAMPLES", "leak"]

EXAMPLES = {
    "leak": """
roughcontact leak part.x3p --materials steel,steel --pressure 20MPa --viscosity 1mPa*s --drop 1bar --out result
roughcontact leak part.x3p --modulus 1GPa --pressure 9MPa --gas air,20degC --upstream 2bar --downstream 0
roughcontact leak tile.npz --modulus 1GPa --pressure 1MPa --viscosity 1mPa*s --drop 1bar --seal-width 1mm \
--circumference 0.1m
""",
}

_QUICK = 2**16  # cells up to which the interval takes about a second
_FEWEST = 16  # cells along an axis whose half still has a gap worth a flow
_CHANGE = 0.1  # relative change on half the cells above which a note is printed
_HALF = "half the cells"


def leak(job: LeakJob, *, answer: Answer) -> None:
    """Press a rough surface by one load: the leak rate of a liquid or gas.

    The fluid does not press on the bodies: its drop of pressure must be below the nominal pressure. A periodic map is a
    sample of a seal, whose width and circumference must be given.
    """
    from roughcontact.contact.notes.solution_notes import notes_on
    from roughcontact.fluid.flow_notes import notes_on_leak
    from roughcontact.fluid.leak import shape_factor
    from roughcontact.labels.engineering_units import written
    from roughcontact.plot.facts import leak_facts, rate_words
    from roughcontact.plot.flows.gap_flow_map import flow_figure
    from roughcontact.theory import leakage

    hardness_of_job(job.pressed)
    with output(answer.out) as folder:
        known = contact_of(job)
        grid, seal = known["surface"].grid, job.seal.named()
        with within("seal"):  # before the work
            shape_factor(grid, seal["axis"], seal.get("seal_width"), seal.get("circumference"))
        found = _leak_of(job, known)
        flow, solution = found.flow, known["solution"]
        with task("Bounds and half the cells"):
            others = dict(_others(job, known))
            quick = flow.percolates and grid.size <= _QUICK
            interval = [each.tolist() for each in flow.interval] if quick else None
        if flow.percolates and not quick:
            remark(f"no interval of the flow on more than {_QUICK} cells; in Python: leak.flow.interval")
        converged = solution.status.converged and flow.residual <= flow.tolerance
        record = {
            "command": job.NAME,
            "file": name_of(job.source),
            "surface": list(known["surface"].provenance),
            **found.to_record(),
            "interval": interval,
            "bruggeman": leakage.bruggeman(flow.gap**3),
            "others": {name: each.to_record() for name, each in others.items()},
            "tolerance": solution.problem.tolerance,
            "converged": bool(converged),
        }
        if answer.json or answer.out is not None:
            record["recipe"] = carried(job, answer.out)
        if folder is not None:
            source, figure = source_of(solution.problem, record["recipe"]), flow_figure(flow, found.direction)
            write_state(folder / "leak", found, record, figure, answer.ending, source)
    if answer.json:
        emit(record)
    else:
        facts = [("file", record["file"]), *leak_facts(found)]
        if interval is not None:
            low, high = (written(each[found.direction][found.direction], "m3", 4) for each in interval)
            facts.append(
                ("interval along the drop", f"{low} to {high} for a gap that is constant in each cell")
            )
        facts.append(
            ("transmissivity, theory", f"{written(record['bruggeman'], 'm3', 4)} (Bruggeman, without slip)")
        )
        print_facts([*facts, *((f"leak rate, {name}", rate_words(each)) for name, each in others.items())])
    note_all([*notes_on(solution), *notes_on_leak(found)])
    if (half := others.get(_HALF)) is not None and abs(half.volume - found.volume) > _CHANGE * found.volume:
        note(
            f"on half as many cells along each axis, the leak rate differs by more than {_CHANGE:.0%}: the grid does "
            "not resolve the gap. Use smaller cells."
        )
    answer.finish(folder, ("leak.json", "leak.nc", f"leak.{answer.ending}"), job, solution)
    if not converged:
        raise typer.Exit(MISSED)


def _leak_of(job: LeakJob, known: dict[str, Any]) -> Leak:
    """Return the leak of a surface; `known` holds its solution, fluid and leak afterwards."""
    press, *flow = job.calls()
    known["solution"] = best_state(press, known)
    for call in flow:
        perform(call, known)
    found: Leak = known["leak"]
    return found


def _others(job: LeakJob, known: dict[str, Any]) -> Iterator[tuple[str, Leak]]:
    """Yield the leaks that are printed beside the leak: of other missing cells, and of the map on half the cells."""
    import roughcontact as rc
    from roughcontact.surface.preparation.halving import halved

    if known["solution"].missing:
        missing = "open" if job.seal.missing == "closed" else "closed"
        seal = job.seal.named() | {"missing": missing}
        yield f"missing cells {missing}", rc.leak(known["solution"], known["fluid"], **seal)
    if min(known["surface"].grid.shape) >= _FEWEST:
        try:
            yield _HALF, _leak_of(job, known | {"surface": halved(known["surface"])})
        except InputError as error:
            note(f"on half as many cells there is no leak rate: {error}")
