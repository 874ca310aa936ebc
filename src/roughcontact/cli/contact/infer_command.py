"""The command ``infer``: the height of a joint from its measured stiffness or closure."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roughcontact.cli.contact_of_job import note_materials
from roughcontact.cli.messages import note, plain
from roughcontact.cli.options import Answer
from roughcontact.cli.output import all_or_none, command_line, output
from roughcontact.cli.report import emit, print_facts, print_table, quantity
from roughcontact.labels.engineering_units import written
from roughcontact.labels.labelled import plain_values
from roughcontact.recipe.job_calls import performed
from roughcontact.recipe.jobs import calls_of, known_names
from roughcontact.recipe.measured.infer_job import InferJob
from roughcontact.recipe.recipe_fields import value_of
from roughcontact.recipe.written import carried

if TYPE_CHECKING:
    from pathlib import Path

    from roughcontact.measurement.joint_inference import JointInference
    from roughcontact.measurement.joint_plan import JointPlan

__all__ = ["EXAMPLES", "infer"]

EXAMPLES = {
    "infer": """
roughcontact infer joint.csv --modulus 115GPa --area 2cm^2 --branch loading --gain 3% --out result
roughcontact infer joint.csv --materials steel,aluminium --area 2cm^2 --branch loading --errors 5% \
--rms 1.2um --rms-error 10% --rolloff 100um --rolloff-error 30%
roughcontact infer closure.csv --modulus 115GPa --area 2cm^2 --branch unloading --quantity closure \
--resolution 10nm --compliance 1e-14m/Pa
roughcontact infer joint.csv --modulus 115GPa --area 2mm^2 --branch loading --plan 8% \
--rms 1.2um --rms-error 50% --rolloff 100um --rolloff-error 30%
roughcontact infer echo.csv --materials steel,aluminium --area 2cm^2 --branch loading --quantity reflection \
--errors 0.005 --frequency 2MHz
""",
}

_NAMES = {"rms": "rms height", "rolloff": "roll-off wavelength", "hurst": "Hurst exponent", "band": "l/l_c"}


def infer(job: InferJob, *, answer: Answer) -> None:
    """Infer the effective height of a joint from its stiffness or closure against pressure.

    K/A0 must be that of the interface only: the compliance of the bodies cannot be seen in the numbers. The exit status
    is 0 also where the answer is that no joint of the model behaves like this one.
    """
    from matplotlib.figure import Figure

    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_csv, write_json, write_netcdf
    from roughcontact.plot.canvas import save
    from roughcontact.plot.joints.inference_plot import joint_inference

    with output(answer.out) as folder:
        note_materials(job.bodies)
        known = performed(calls_of(job), known_names())
        if job.profile.plan is not None:
            _planned(job, known["plan"], folder, answer)
            return
        found: JointInference = known["inference"]
        record = {"command": job.NAME, "file": plain(job.source.file), **found.to_record()}
        record |= {"converged": True, "recipe": carried(job, answer.out)}  # there is nothing to solve
        if folder is not None:
            figure = Figure(figsize=(5.6, 4.2), layout="constrained")
            joint_inference(found, figure.subplots())
            dataset = found.to_dataset()
            source = provenance(modulus=known["modulus"], command=command_line(), recipe=record["recipe"])
            with all_or_none(folder) as aside:
                write_netcdf(dataset, aside / "inference.nc", source)
                write_csv(dataset, aside / "inference.csv")
                write_json(record, aside / "inference.json", source)
                save(figure, aside / f"inference.{answer.ending}")
    if answer.json:
        emit(record)
    else:
        print_facts([("file", record["file"]), *_facts(job, found, known["modulus"])])
        if found.parameters:
            _print(found)
    for text in found.notes:
        note(text)
    names = ("inference.csv", "inference.json", "inference.nc", f"inference.{answer.ending}")
    answer.finish(folder, names, job, found)


def _planned(job: InferJob, plan: JointPlan, folder: Path | None, answer: Answer) -> None:
    """Print the widths of a plan, and which joints reach the wanted one."""
    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_csv, write_json, write_netcdf

    wanted = value_of(job.profile, "plan")
    reached = plan.reaching(wanted)
    dataset = plan.to_dataset()
    columns = {str(name): plain_values(each.to_numpy()) for name, each in dataset.variables.items()}
    record = {"command": job.NAME, "file": plain(job.source.file), **columns, "wanted": wanted}
    record |= {"reached": reached and dict(zip(("area", "number"), reached, strict=True))}
    record |= {"converged": True, "recipe": carried(job, answer.out)}
    if folder is not None:
        rows = dataset[["width"]].stack(row=("area", "number")).reset_index("row").reset_coords()
        source = provenance(command=command_line(), recipe=record["recipe"])
        with all_or_none(folder) as aside:
            write_netcdf(dataset, aside / "inference.nc", source)
            write_csv(rows, aside / "inference.csv", dimension="row")
            write_json(record, aside / "inference.json", source)
    if answer.json:
        emit(record)
    else:
        facts = [("file", record["file"]), ("wanted", f"{wanted:.3g}, standard deviation of ln h_eff")]
        facts.append(("reached with", "none of these" if reached is None else _joints(*reached)))
        print_facts(facts)
        header = ["area", *(f"{number:.0f} joint{'s' if number > 1 else ''}" for number in plan.specimens)]
        widths = zip(plan.areas, plan.width, strict=True)
        print_table(header, [[written(float(area), "m2"), *(f"{w:.3f}" for w in ws)] for area, ws in widths])
        if plan.without.size:
            loads = zip(plan.pressures.tolist(), plan.without, strict=True)
            left = [(quantity("nominal_pressure", p), f"{w:.3f}") for p, w in loads]
            print_table(["without the load of", f"{written(float(plan.areas[0]), 'm2')}, one joint"], left)
    answer.finish(folder, ("inference.csv", "inference.json", "inference.nc"), job, plan)


def _joints(area: float, number: int) -> str:
    return f"{number} joint{'s' * (number > 1)} of {written(area, 'm2')}"


def _facts(job: InferJob, found: JointInference, modulus: float) -> list[tuple[str, str]]:
    """Return the lines about the measurement and about the height."""
    p, error = found.data.pressures, value_of(job.joint, "modulus_error")
    ends = " to ".join(quantity("nominal_pressure", float(each)) for each in (p.min(), p.max()))
    facts = [
        ("measured", f"{job.source.quantity} at {p.size} loads, {ends}, on {job.joint.branch}"),
        ("reduced modulus E*", f"{quantity('modulus', modulus)} with an error of {error:.3g}"),
    ]
    if found.fits:
        facts.append(("effective height h_eff", quantity("rms", found.effective_height)))
        for level in (0.5, 0.9):
            low, high = (quantity("rms", end) for end in found.interval(level))
            facts.append((f"with {level:.0%}", f"{low} to {high}"))
        a = found.exponent
        facts.append(("exponent a", f"{a:.3f}: K ~ p^a, and h_eff = rms^{a:.2f} rolloff^{1 - a:.2f}"))
    if found.departs:
        verdict = "the model fits" if found.fits else f"not this model, by the {found.departs}"
        facts.append(("p value", f"{found.p_value:.2g}: {verdict}"))
    return facts


def _print(found: JointInference) -> None:
    """Print prior beside posterior: a row for each parameter."""
    header = ["parameter", *(f"{of} {share} %" for of in ("prior", "posterior") for share in (5, 50, 95))]
    rows = []
    for each in found.parameters:
        cells = [written(value, each.unit) for value in (*each.prior, *each.posterior)]
        gained = f"{each.nats:.2f}" if each.informed else f"{each.nats:.2f}, no information"
        rows.append([_NAMES.get(each.name, each.name), *cells, gained])
    print_table([*header, "nats"], rows)
