"""The command ``adhesion press``: the end of an approach of surfaces that attract each other."""

from __future__ import annotations

from typing import TYPE_CHECKING

import typer

from roughcontact.cli.adhesion.adhesion_notes import note_long_range
from roughcontact.cli.contact_of_job import best_state, contact_of, name_of
from roughcontact.cli.exits import MISSED
from roughcontact.cli.messages import note
from roughcontact.cli.options import Answer
from roughcontact.cli.output import output, source_of, write_state
from roughcontact.cli.pressed import Pressed
from roughcontact.cli.report import adhesive_facts, emit, print_facts
from roughcontact.progress.events import task
from roughcontact.recipe.adhesive_jobs import AdhesivePressJob
from roughcontact.recipe.job_calls import perform
from roughcontact.recipe.prescribed_loads import kinds_of
from roughcontact.recipe.written import carried

if TYPE_CHECKING:
    from roughcontact.adhesion.adhesive_state import AdhesiveState

__all__ = ["EXAMPLES", "press"]

EXAMPLES = {
    "press": """
roughcontact adhesion press part.x3p --depth -2nm --modulus 1GPa --work 10mJ/m^2 --range 20nm --law dugdale --out result
roughcontact adhesion press part.x3p --force 1mN --modulus 1GPa --work 10mJ/m^2 --range 20nm
roughcontact adhesion press part.x3p --mean-gap 0.2um --periodic --modulus 1GPa --work 10mJ/m^2 --range 20nm
""",
}


def press(job: AdhesivePressJob, *, answer: Answer) -> None:
    """Bring an adhesive surface to one load: map of pressure and tension, area, stiffness and stability.

    The approach begins beyond the range of the attraction. For a tensile force, use 'adhesion curve'.
    """
    from roughcontact.plot.tension import state_figure

    with output(answer.out) as folder:
        known = contact_of(job)
        law, call = job.calls()
        perform(law, known)
        note_long_range(known["adhesion"], known["surface"])
        pressed = Pressed.of(known["surface"], known["modulus"], None)
        state: AdhesiveState = best_state(call, known)
        with task("Stability and files"):
            record = {
                "command": job.NAME,
                "file": name_of(job.source),
                "surface": list(known["surface"].provenance),
                "kind": pressed.kind.value,
                **state.to_record(),
                "converged": state.status.converged,
            }
            if answer.json or answer.out is not None:
                record["recipe"] = carried(job, answer.out)
            if folder is not None:
                [(name, value)] = job.load.named(job.contact.profile).items()
                control = f"{name.replace('_', ' ')} = {value!r} {kinds_of(job.contact.profile)[name].unit}"
                source = source_of(state.problem, record["recipe"], control)
                path = folder / "adhesive_state"
                write_state(path, state, record, state_figure(state), answer.ending, source)
    if answer.json:
        emit(record)
    else:
        size, *others = adhesive_facts(state)
        print_facts([size, *pressed.facts(), *others])
    for line in state.notes:
        note(line)
    files = ("adhesive_state.json", "adhesive_state.nc", f"adhesive_state.{answer.ending}")
    answer.finish(folder, files, job, state)
    if not state.status.converged:
        raise typer.Exit(MISSED)
