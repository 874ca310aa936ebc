"""The command ``joint``: the stiffness of a whole joint from the pressure on its face."""

from __future__ import annotations

import typer

from roughcontact.cli.contact_of_job import contact_of, hardness_of_job, name_of
from roughcontact.cli.exits import MISSED
from roughcontact.cli.messages import note, note_all
from roughcontact.cli.options import Answer
from roughcontact.cli.output import command_line, output, write_state
from roughcontact.cli.report import quantity, size_of, tell
from roughcontact.recipe.job_calls import perform
from roughcontact.recipe.joint_job import JointJob
from roughcontact.recipe.recipe_fields import value_of
from roughcontact.recipe.written import carried

__all__ = ["EXAMPLES", "joint"]

EXAMPLES = {
    "joint": """
roughcontact joint tile.npz --materials steel,steel --bolt-force 17kN --head 13mm --hole 9mm --thickness 10mm \
--friction 0.2 --out result
roughcontact joint tile.npz --modulus 110GPa --pressure-field field.csv --conductivity 50W/m/K
roughcontact joint tile.npz --materials steel,steel --bolt-force 17kN --head 13mm --hole 9mm --thickness 10mm \
--leak 0 --viscosity 1mPa*s --drop 1bar
""",
}

_ROUNDING = 1e-9  # of the largest number of a vector, below which 0 is printed


def joint(job: JointJob, *, answer: Answer) -> None:
    """Stiffness of a whole joint: the law of the map under the pressure field of a table or of a bolt.

    Normal, tilting and, with friction, shear and torsional stiffness; on request loss per cycle, conductance and leak.
    The compliance of the bodies is not included.
    """
    import numpy as np

    from roughcontact.contact.notes.curve_notes import curve_notes
    from roughcontact.files.provenance import provenance
    from roughcontact.halfspace.operators.geometry import Geometry
    from roughcontact.labels.engineering_units import written
    from roughcontact.labels.labelled import plain_values, units_of
    from roughcontact.labels.note import Note, Rank
    from roughcontact.labels.variables import VARIABLES
    from roughcontact.plot.joints.joint_maps import joint_figure

    hardness_of_job(job)
    with output(answer.out) as folder:
        known = contact_of(job)
        for call in job.calls():
            perform(call, known)
        found, surface = known["joint"], known["surface"]
        curve = known["loop"].reloading if "loop" in known else known["curve"]
        numbers = {name: known[name] for name in ("joint_loss", "damping", "leak_rate") if name in known}
        numbers |= known.get("conductances", {})
        shown = found.to_record() | numbers
        record = shown | {name: plain_values(value) for name, value in numbers.items()}
        converged = all(status.converged for status in curve.status)
        record |= {
            "command": job.NAME,
            "file": name_of(job.source),
            "surface": list(surface.provenance),
            "units": units_of(record, Geometry.SURFACE),
            "tolerance": value_of(job.contact, "tolerance"),
            "converged": converged,
            "recipe": carried(job, answer.out),
        }
        if folder is not None:
            control = f"pressure field of {found.field.force:g} N, {len(curve)} loads"
            source = provenance(
                surface,
                modulus=curve.modulus,
                control=control,
                tolerance=record["tolerance"],
                command=command_line(),
                recipe=record["recipe"],
            )
            write_state(folder / "joint", found, record, joint_figure(found), answer.ending, source)
    facts = [
        ("surface", size_of(surface.grid)),
        ("face", size_of(found.field.grid).removesuffix(", free")),
        ("largest pressure", quantity("nominal_pressure", float(np.nanmax(found.field.pressure)))),
    ]
    for name, value in shown.items():
        if name in VARIABLES and value is not None:
            column, values = VARIABLES[name], np.atleast_1d(value).ravel()
            size = np.abs(values).max(initial=0.0, where=np.isfinite(values))
            parts = (0.0 if abs(each) < _ROUNDING * size else each for each in values)
            facts.append((column.label, ", ".join(written(each, column.unit, 4) for each in parts)))
    tell(record, facts, as_json=answer.json)
    note_all([*curve_notes(curve), *(Note(Rank.DOUBTFUL, text) for text in found.notes)])
    p = found.field.pressure[found.loaded]
    unresolved = p[np.interp(p, curve.nominal_pressure, curve.resolved) < 1]
    if unresolved.size:
        note(
            f"{unresolved.sum() / p.sum():.0%} of the force lies on pressures that the map does not resolve."
        )
    answer.finish(folder, ("joint.json", "joint.nc", f"joint.{answer.ending}"), job, found, curve, surface)
    if not converged:
        raise typer.Exit(MISSED)
