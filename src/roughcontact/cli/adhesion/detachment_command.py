"""The command ``adhesion detach``: a surface that was pressed, has stuck, and is retracted."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roughcontact.cli.contact_of_job import best_state, contact_of
from roughcontact.cli.options import Answer
from roughcontact.cli.output import output
from roughcontact.cli.path_answer import PathAnswer, collected
from roughcontact.recipe.adhesive_jobs import DetachJob
from roughcontact.recipe.prescribed_loads import kinds_of
from roughcontact.recipe.recipe_fields import value_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from roughcontact.adhesion.detachment_curve import DetachmentCurve

__all__ = ["EXAMPLES", "detach"]

EXAMPLES = {
    "detach": """
roughcontact adhesion detach part.x3p --force 10mN --modulus 1GPa --work 10mJ/m^2 --out result
roughcontact adhesion detach part.x3p --depth 100nm --depths 50nm:-50nm:11 --modulus 1GPa --work 10mJ/m^2
""",
}


def detach(job: DetachJob, *, answer: Answer) -> None:
    """Press a surface by one load, and retract it as if it had stuck: pull-off force and the cells that detach.

    This is the limit of zero range (Johnson, Kendall and Roberts). Nothing attracts the surface while it is pressed.
    For an attraction with a range, use 'adhesion loop'.
    """
    from roughcontact.adhesion.detachment_curve import collect_detachments
    from roughcontact.adhesion.detachment_path import states_drawn_back
    from roughcontact.plot.detachment_plot import DETACHMENT_COLUMNS, detachment_facts
    from roughcontact.solver.loads import Loads

    profile = job.contact.profile
    loads = Loads.given(**job.retreat.named(profile))
    total = 3 if loads is None else loads.values.size
    with output(answer.out) as folder:
        known = contact_of(job)
        preload = best_state(next(job.calls()), known)
        states = states_drawn_back(preload, value_of(job.adhesion, "work"), loads)
        found, whole = collected(states, lambda states: collect_detachments(states, loads))
        converged = preload.status.converged and found.converged
        path = PathAnswer(job, known["surface"], found, whole, "detachment", "detachments", converged, answer)
        if folder is not None:
            [(name, value)] = job.load.named(profile).items()
            control = f"drawn back from {name} = {value!r} {kinds_of(profile)[name].unit}"
            path.write(folder, control, _drawn)
    path.show(DETACHMENT_COLUMNS, (), detachment_facts(found))
    path.end(folder, total)


def _drawn(found: DetachmentCurve) -> Figure:
    from matplotlib.figure import Figure

    from roughcontact.plot.detachment_plot import detachment_force

    figure = Figure(figsize=(5.6, 4.2), layout="constrained")
    detachment_force(found, figure.subplots())
    return figure
