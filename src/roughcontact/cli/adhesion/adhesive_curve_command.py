"""The commands ``adhesion curve`` and ``adhesion loop``: approach and retreat of adhesive surfaces, with jumps."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from roughcontact.cli.adhesion.adhesion_notes import note_long_range
from roughcontact.cli.contact_of_job import contact_of
from roughcontact.cli.options import Answer
from roughcontact.cli.output import output
from roughcontact.cli.path_answer import PathAnswer, collected
from roughcontact.cli.report import adhesive_curve_facts, law_facts
from roughcontact.recipe.adhesive_jobs import AdhesiveCurveJob, AdhesiveLoopJob
from roughcontact.recipe.job_calls import perform
from roughcontact.recipe.prescribed_loads import kinds_of
from roughcontact.recipe.recipe_fields import value_of

if TYPE_CHECKING:
    from roughcontact.adhesion.attraction import Adhesion
    from roughcontact.solver.loads import Loads

__all__ = ["EXAMPLES", "curve", "loop"]

EXAMPLES = {
    "curve": """
roughcontact adhesion curve part.x3p --depths -20nm:40nm:4,-20nm --modulus 1GPa --work 10mJ/m^2 --range 20nm
roughcontact adhesion curve part.x3p --forces 1mN,0N,-1mN --modulus 1GPa --work 10mJ/m^2 --range 50nm --out result
roughcontact adhesion curve part.x3p --mean-gaps 0.3um,0.2um --periodic --modulus 1GPa --work 10mJ/m^2 --range 20nm
""",
    "loop": """
roughcontact adhesion loop part.x3p --depth 50nm --points 8 --modulus 1GPa --work 10mJ/m^2 --range 20nm --out result
roughcontact adhesion loop part.x3p --depth 20nm --points 5 --modulus 1GPa --work 10mJ/m^2 --range 50nm --json
""",
}


def curve(job: AdhesiveCurveJob, *, answer: Answer) -> None:
    """Load and unload an adhesive surface: force, area, stiffness and jumps.

    States depend on the history: approach and retreat differ. Ctrl-C keeps the computed states; a path cannot be
    resumed.
    """
    from roughcontact.solver.loads import Loads

    named = job.loads.named(job.contact.profile)
    loads = Loads.of(**named)
    values = ", ".join(f"{load:g}" for load in loads.values)
    unit = kinds_of(job.contact.profile)[loads.kind.replace(" ", "_")].unit
    _follow(job, answer, lambda adhesion: loads, f"{loads.kind}s {values} {unit}")


def loop(job: AdhesiveLoopJob, *, answer: Answer) -> None:
    """Press an adhesive surface to a depth and retract it until it detaches: pull-off force, jumps and lost energy.

    The approach begins at a distance of ten ranges of the attraction.
    """
    from roughcontact.adhesion.adhesive_loop import loop_depths
    from roughcontact.solver.loads import Loads

    turn, points = value_of(job.turn, "depth"), value_of(job.turn, "points")
    control = f"loop to a depth of {turn:g} m in {points} steps"
    _follow(
        job, answer, lambda adhesion: Loads("depth", loop_depths(adhesion, turn, points)), control, points
    )


def _follow(
    job: AdhesiveCurveJob | AdhesiveLoopJob,
    answer: Answer,
    loads_for: Callable[[Adhesion], Loads],
    control: str,
    points: int | None = None,
) -> None:
    """Follow loads, or a loop with `points` on its approach; print the answer and write its files."""
    from roughcontact.adhesion.adhesive_curve import collect_states
    from roughcontact.adhesion.adhesive_loading import followed, states_under
    from roughcontact.adhesion.adhesive_loop import until_off
    from roughcontact.plot.adhesive_facts import ADHESIVE_COLUMNS
    from roughcontact.plot.jumps import jump_figure
    from roughcontact.solver.loads import Loads

    with output(answer.out) as folder:
        known = contact_of(job)
        for call in job.adhesion.calls():
            perform(call, known)
        surface, modulus, adhesion = (known[name] for name in ("surface", "modulus", "adhesion"))
        note_long_range(adhesion, surface)
        loads, tolerance = loads_for(adhesion), value_of(job.contact, "tolerance")
        states = states_under(surface, modulus, adhesion, loads, known.get("operator"), tolerance)
        if points is None:
            states, total = followed(states, loads), loads.values.size
        else:
            states, total, loads = until_off(states, points), None, Loads("depth", loads.values[1:])
        found, whole = collected(states, lambda states: collect_states(states, loads))
        stem = f"adhesive_{job.NAME.rpartition(' ')[2]}"
        path = PathAnswer(job, surface, found, whole, stem, f"{stem}_jumps", found.converged, answer)
        if folder is not None:
            path.write(folder, control, jump_figure)
    law = law_facts(found.adhesion, found.modulus, found.spacing, found.summit_radius)
    path.show(ADHESIVE_COLUMNS, law, adhesive_curve_facts(found))
    path.end(folder, total)
