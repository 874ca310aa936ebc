"""Files that a page exports: tables, fields and pictures as the command line writes them, singly or in an archive."""

from __future__ import annotations

import json
import re
import tempfile
import zipfile
from collections.abc import Callable, Mapping
from dataclasses import replace
from hashlib import sha256
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

from roughcontact.errors import InputError
from roughcontact.page.jobs.curve_jobs import compared
from roughcontact.page.jobs.session_cache import SessionCache
from roughcontact.page.jobs.shown_curve import shown_curve
from roughcontact.page.server.page_request import PageRequest, Send
from roughcontact.progress.events import task
from roughcontact.recipe.elastic_jobs import CurveJob, PressJob, SurfaceJob
from roughcontact.recipe.job_calls import Call, performed, python_of
from roughcontact.recipe.jobs import calls_of, contact_calls, known_names
from roughcontact.recipe.recipe_fields import given, value_of
from roughcontact.recipe.source import File
from roughcontact.recipe.written import toml_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["export"]

Writers = dict[str, Callable[[Path], None]]  # by the names of their files
_KINDS = ("csv", "nc", "png", "svg", "zip")


def export(request: PageRequest, cache: SessionCache, send: Send) -> None:
    """Send a file of the answer to a job, or an archive of all its files."""
    kind = request.more.get("kind")
    if kind not in _KINDS:
        raise InputError(f"files are exported as {', '.join(_KINDS)}, not as {kind!r}", "choose one of them")
    with task("Writing files"), tempfile.TemporaryDirectory(prefix="roughcontact-") as name:
        folder = Path(name)
        if kind == "zip":
            _everything(request, cache, folder)
            send({"type": "file", "name": _name(request, "contact", kind)}, _zipped(folder))
            return
        if isinstance(request.job, SurfaceJob):
            raise InputError("there is no answer to export yet", "press the surface, or start the curve")
        written = _files(request, cache)
        file = next(file for file in written if file.endswith(f".{kind}"))
        written[file](folder / file)
        send({"type": "file", "name": _name(request, _what(request), kind)}, (folder / file).read_bytes())


def _what(request: PageRequest) -> str:
    """Return the load of one state, or the name of another job."""
    if isinstance(request.job, PressJob):
        [(name, text)] = given(request.job.load).items()
        return f"{name}-{text}"
    return request.job.NAME.replace(" ", "-")


def _name(request: PageRequest, what: str, ending: str) -> str:
    """Return the name of a file: surface, contents, and a mark that is unique for the recipes."""
    source = request.shown.source
    stem = Path(source.file).stem if isinstance(source, File) else "made-surface"
    recipes = [each.recipe for each in (request, request.beside) if each is not None]
    mark = sha256(json.dumps(recipes).encode()).hexdigest()[:6]
    return re.sub(r"[^\w.-]+", "", f"{stem}-{what}-{mark}") + f".{ending}"


def _everything(request: PageRequest, cache: SessionCache, folder: Path) -> None:
    """Write the surface, the answers to the jobs, and their recipes."""
    import roughcontact as rc
    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_json
    from roughcontact.plot.canvas import save, surface_figure

    surface = cache.surface(request.job)
    rc.write(surface, folder / "surface.npz")
    save(surface_figure(surface), folder / "surface.png")
    asked = [request, *([request.beside] if request.beside is not None else [])]
    for each in asked:
        for file, write in ({} if isinstance(each.job, SurfaceJob) else _files(each, cache)).items():
            write(folder / file)
        name = each.job.NAME.replace(" ", "-")
        (folder / f"{name}-job.toml").write_text(toml_of(each.recipe), encoding="utf-8")
    # The part that makes the surface is written once.
    commands = dict.fromkeys(line for each in asked for line in each.statement["command"].splitlines())
    (folder / "commands.sh").write_text("\n".join(commands) + "\n", encoding="utf-8")
    calls = [*calls_of(request.shown), *(call for each in asked[1:] for call in contact_calls(each.shown))]
    (folder / "same.py").write_text(python_of(calls), encoding="utf-8")
    file = request.shown.source.file if isinstance(request.shown.source, File) else ""
    source = provenance(surface, command="\n".join(commands))
    write_json({"file": file}, folder / "provenance.json", source)


def _files(request: PageRequest, cache: SessionCache) -> Writers:
    """Return the writers of the files of an answer, by the names of the files."""
    return _load_files(request, cache) if isinstance(request.job, PressJob) else _curve_files(request, cache)


def _load_files(request: PageRequest, cache: SessionCache) -> Writers:
    from roughcontact.contact.dataset import solution_dataset, solution_record
    from roughcontact.plot.canvas import solution_figure

    assert isinstance(request.job, PressJob)
    solution = cache.solution(request.job)
    [(name, value)] = request.job.load.named(request.job.contact.profile).items()
    dataset = solution_dataset(solution)
    numbers = dataset[[name for name, values in dataset.items() if not values.dims]]
    source = _provenance(request, cache, f"{name} = {value!r}")
    return _writers(
        "pressure",
        dataset,
        solution_record(solution),
        lambda: solution_figure(solution),
        source,
        "press",
        numbers,
    )


def _curve_files(request: PageRequest, cache: SessionCache) -> Writers:
    found = cache.curve(request.job)
    source = _provenance(request, cache, request.job.NAME)
    stem = request.job.NAME.replace(" ", "-")
    if (figure := shown_curve(found).figure) is not None:
        record = found.to_record()
        if (loading := getattr(found, "loading", None)) is not None:  # a loop, as the command writes it
            record = loading.to_record() | {"loop": record}
        return _writers(stem, found.to_dataset(), record, figure, source)
    return _writers(stem, *_beside(request, cache), source)


def _beside(request: PageRequest, cache: SessionCache) -> tuple[Any, dict[str, Any], Callable[[], Figure]]:
    """Return data, record and picture of a curve of increasing loads, with theories, conductance and ultrasound."""
    from roughcontact.contact.compare import with_theories
    from roughcontact.contact.dataset import curve_dataset, curve_record
    from roughcontact.evaluation.conduction import Conductors, with_conductance
    from roughcontact.plot.canvas import areal_figure, curve_figure

    job = request.job
    assert isinstance(job, CurveJob)
    curve = cache.curve(job)
    theories = compared(job, cache)
    comparisons = {name: comparison for name, (_, comparison) in theories.items()}
    dataset = with_theories(curve_dataset(curve), comparisons)
    if named := job.conduction.named():
        conductors = Call("made", (), named).value(known_names() | {"made": Conductors})
        dataset = with_conductance(dataset, conductors, job.conduction.of)
    for call in job.ultrasound.calls("dataset", job.bodies):
        dataset = call.value(known_names() | {"dataset": dataset})
    record = curve_record(curve) | {
        "theories": {name: each.to_record() for name, each in comparisons.items()}
    }

    def drawn() -> Figure:
        try:
            law = curve.fit()
        except InputError:
            law = None
        laws = [
            replace(theory, quantities={key: theory.quantities[key] for key in comparison.predicted})
            for theory, comparison in theories.values()
        ]
        per_area = job.loads.pressures is not None or all(curve.periodic)
        return (areal_figure if per_area else curve_figure)(curve, law, laws)

    return dataset, record, drawn


def _provenance(request: PageRequest, cache: SessionCache, control: str) -> Mapping[str, Any]:
    from roughcontact.files.provenance import provenance
    from roughcontact.materials import as_modulus

    command = request.statement["command"]
    job: Any = request.job  # a job that presses
    given: dict[str, Any] = {"control": control, "command": command, "recipe": request.recipe}
    tolerance = value_of(job.contact, "tolerance")
    modulus = as_modulus(performed(job.bodies.calls(), known_names())["modulus"])
    return provenance(cache.surface(job), modulus=modulus, tolerance=tolerance, **given)


def _writers(
    stem: str,
    dataset: Any,
    record: dict[str, Any],
    figure: Callable[[], Figure],
    source: Mapping[str, Any],
    table: str = "",
    numbers: Any = None,
) -> Writers:
    """Return the writers of an answer in every form; the table of a single state only holds numbers."""
    from roughcontact.files.write import write_csv, write_json, write_netcdf
    from roughcontact.plot.canvas import save

    recipe = {"recipe": json.loads(source["recipe"])}
    return {
        f"{table or stem}.csv": lambda path: write_csv(dataset if numbers is None else numbers, path),
        f"{stem}.nc": lambda path: write_netcdf(dataset, path, source),
        f"{stem}.png": lambda path: save(figure(), path),
        f"{stem}.svg": lambda path: save(figure(), path),
        f"{table or stem}.json": lambda path: write_json(record | recipe, path, source),
    }


def _zipped(folder: Path) -> bytes:
    """Return the files of a folder as an archive."""
    stream = BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for file in sorted(folder.iterdir()):
            archive.write(file, file.name)
    return stream.getvalue()
