"""The command ``sliding``: hysteretic friction of a viscoelastic body against speed."""

from __future__ import annotations

import typer

from roughcontact.cli.contact_of_job import contact_of, name_of
from roughcontact.cli.exits import INTERRUPTED, MISSED
from roughcontact.cli.messages import note_all
from roughcontact.cli.options import Answer
from roughcontact.cli.output import all_or_none, command_line, output, writing
from roughcontact.cli.path_answer import collected, compute_rest
from roughcontact.cli.report import emit, load_table, print_facts, print_table, quantity, size_of
from roughcontact.errors import InputError
from roughcontact.progress.events import task
from roughcontact.recipe.in_time.sliding_job import SlidingJob
from roughcontact.recipe.recipe_fields import value_of
from roughcontact.recipe.written import carried

__all__ = ["EXAMPLES", "sliding"]

EXAMPLES = {
    "sliding": """
roughcontact sliding tile.npz --material rubber.toml --pressure 0.1MPa --speeds 1mm/s:10m/s:20
roughcontact sliding tile.npz --material rubber.toml --force 10N --speeds 1mm/s,1cm/s --direction 30deg --out result
""",
}

_COLUMNS = (
    *("sliding_speed", "friction_coefficient", "persson_friction_coefficient"),
    *("persson_friction_coefficient_half", "friction_across", "contact_fraction", "persson_contact_fraction"),
    *("mean_gap", "dissipation", "residual", "solves", "status"),
)


def sliding(job: SlidingJob, *, answer: Answer) -> None:
    """Slide a rough rigid surface steadily over a viscoelastic body: hysteretic friction and contact against speed.

    The map must be periodic. Persson's theory stands beside the friction. Tractions on the contact and adhesion are not
    part of it.
    """
    from matplotlib.figure import Figure

    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_csv, write_json, write_netcdf
    from roughcontact.labels.labelled import plain_values
    from roughcontact.labels.note import Note, Rank
    from roughcontact.plot.canvas import save
    from roughcontact.viscoelastic.friction_curve import along_speeds, collect_speeds
    from roughcontact.viscoelastic.sliding_theory import DOMAIN, with_persson

    with output(answer.out) as folder:
        known = contact_of(job)
        [call] = job.calls()
        (surface, material), named = call.arguments(known)
        speeds = [float(speed) for speed in named["speeds"]]
        curve, whole = collected(along_speeds(surface, material, **named), collect_speeds)
        dataset, notes = curve.to_dataset(), list(curve.state_notes)
        try:
            dataset = with_persson(dataset, surface, material)
            notes.append(Note(Rank.USUAL, DOMAIN))
        except InputError as error:
            notes.append(Note(Rank.LIMITED, f"Persson's theory is left out: {error}"))
        if not whole:
            words = compute_rest("speeds", len(curve), speeds[len(curve) :], answer.out, "speeds")
            notes.insert(0, Note(Rank.WRONG, words))
        converged = all(status.converged for status in curve.status)
        record = {
            "command": job.NAME,
            "file": name_of(job.source),
            "surface": list(surface.provenance),
            **curve.to_record(),
            **{name: plain_values(dataset[name].to_numpy()) for name in _COLUMNS if name in dataset},
            "tolerance": value_of(job.contact, "tolerance"),
            "converged": converged,
            "whole": whole,
            "recipe": carried(job, answer.out),
        }
        if folder is not None:
            figure = Figure(figsize=(6.4, 4.2), layout="constrained")
            curve.plot(figure.subplots(), theory=dataset)
            source = provenance(
                surface,
                modulus=material.equilibrium,
                control=f"nominal pressure {curve.nominal_pressure:g} Pa, {len(curve)} speeds",
                tolerance=record["tolerance"],
                command=command_line(),
                recipe=record["recipe"],
            )
            with task("Writing files"), writing(), all_or_none(folder) as aside:
                write_netcdf(dataset, aside / "sliding.nc", source)
                write_csv(dataset, aside / "sliding.csv")
                save(figure, aside / f"sliding.{answer.ending}")
                write_json(record, aside / "sliding.json", source)
    if answer.json:
        emit(record)
    else:
        ends = (quantity("modulus", each) for each in (material.equilibrium, material.instantaneous))
        print_facts(
            [
                ("surface", size_of(surface.grid)),
                ("E*, relaxed to instantaneous", " to ".join(ends)),
                ("nominal pressure", quantity("nominal_pressure", curve.nominal_pressure)),
                ("direction (x, y)", ", ".join(f"{part:.4g}" for part in curve.direction)),
            ]
        )
        print_table(*load_table(dataset, _COLUMNS))
        k = int(curve.friction_coefficient.argmax())
        at = quantity("sliding_speed", curve.speed[k])
        print_facts([("largest friction coefficient", f"{curve.friction_coefficient[k]:.4g} at {at}")])
    note_all(notes)
    answer.finish(
        folder,
        ("sliding.csv", "sliding.json", "sliding.nc", f"sliding.{answer.ending}"),
        job,
        curve,
        surface,
    )
    if not whole:
        raise typer.Exit(INTERRUPTED)
    if not converged:
        raise typer.Exit(MISSED)
