"""What a page gives away: tables, fields and pictures as the command line writes them, alone or all in one archive."""

from __future__ import annotations

import re
import tempfile
import zipfile
from collections.abc import Callable
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

from roughcontact.errors import InputError
from roughcontact.page.jobs.conducting import conductors_of
from roughcontact.page.jobs.curve_jobs import compared, whole_curve
from roughcontact.page.jobs.session_cache import SessionCache, modulus_of
from roughcontact.page.recipe import FileSource, PageLoads
from roughcontact.page.server.page_request import PageRequest, Send
from roughcontact.page.statement import Statement, stated

if TYPE_CHECKING:
    from roughcontact.contact.solution import Solution

__all__ = ["export"]

Writers = dict[str, Callable[[Path], None]]  # by the names of their files
_KINDS = ("csv", "nc", "png", "svg", "zip")


def export(request: PageRequest, cache: SessionCache, send: Send) -> None:
    """Send a file of the load or the curve that the recipe states, or an archive of all that belongs to it."""
    kind = request.more.get("kind")
    if kind not in _KINDS:
        raise InputError(f"files are exported as {', '.join(_KINDS)}, not as {kind!r}")
    send({"type": "doing", "words": "Writing files"})
    statement = stated(request.recipe, request.file)
    with tempfile.TemporaryDirectory(prefix="roughcontact-") as name:
        folder = Path(name)
        if kind == "zip":
            _everything(request, cache, statement, folder)
            send({"type": "file", "name": _name(request, "contact", kind)}, _zipped(folder))
            return
        load, loads = request.recipe.load, request.recipe.loads
        if request.more.get("of") == "curve" and loads is not None:
            written, what = _curve_files(request, cache, statement), f"curve-{loads.control}"
        elif request.more.get("of") == "load" and load is not None:
            written = _load_files(cache.solution(request.recipe, request.files), request, statement)
            what = f"{load.control}-{load.text}"
        else:
            raise InputError("there is nothing to export yet", "press the surface, or start the curve")
        file = folder / next(file for file in written if file.endswith(f".{kind}"))
        written[file.name](file)
        send({"type": "file", "name": _name(request, what, kind)}, file.read_bytes())


def _name(request: PageRequest, what: str, ending: str) -> str:
    """Return the name of a file that tells of what surface it is and what it holds."""
    stem = Path(request.file).stem if isinstance(request.recipe.source, FileSource) else "made-surface"
    return re.sub(r"[^\w.-]+", "", f"{stem}-{what}") + f".{ending}"


def _everything(request: PageRequest, cache: SessionCache, statement: Statement, folder: Path) -> None:
    """Write the surface, the load, the curve, and what makes them again, as far as the recipe states them."""
    import roughcontact as rc
    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_json
    from roughcontact.plot.canvas import save, surface_figure

    recipe = request.recipe
    surface = cache.surface(recipe, request.files)
    rc.write(surface, folder / "surface.npz")
    save(surface_figure(surface), folder / "surface.png")
    written: Writers = {}
    if recipe.load is not None:
        written |= _load_files(cache.solution(recipe, request.files), request, statement)
    if recipe.loads is not None:
        written |= _curve_files(request, cache, statement)
    for file, write in written.items():
        write(folder / file)
    (folder / "commands.sh").write_text(statement.command + "\n", encoding="utf-8")
    (folder / "same.py").write_text(statement.python, encoding="utf-8")
    modulus = modulus_of(recipe.bodies) if written else None
    source = provenance(surface, modulus=modulus, command=statement.command)
    write_json({"file": request.file}, folder / "provenance.json", source)


def _load_files(solution: Solution, request: PageRequest, statement: Statement) -> Writers:
    """Return how the files of a load are written, by their names."""
    from roughcontact.contact.dataset import solution_dataset, solution_record
    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_csv, write_json, write_netcdf
    from roughcontact.plot.canvas import save, solution_figure

    problem, load = solution.problem, request.recipe.load
    source = provenance(
        problem.surface,
        modulus=problem.modulus,
        control="" if load is None else f"{load.control} = {load.value!r} {load.unit}",
        tolerance=problem.tolerance,
        command=statement.command,
    )

    def scalars(path: Path) -> None:
        dataset = solution_dataset(solution)
        write_csv(dataset[[name for name, values in dataset.items() if not values.dims]], path, source)

    return {
        "press.csv": scalars,
        "pressure.nc": lambda path: write_netcdf(solution_dataset(solution), path, source),
        "pressure.png": lambda path: save(solution_figure(solution), path),
        "pressure.svg": lambda path: save(solution_figure(solution), path),
        "press.json": lambda path: write_json(solution_record(solution), path, source),
    }


def _curve_files(request: PageRequest, cache: SessionCache, statement: Statement) -> Writers:
    """Return how the files of a curve and of what was asked for beside it are written, by their names."""
    from roughcontact.contact.compare import with_theories
    from roughcontact.contact.dataset import curve_dataset, curve_record
    from roughcontact.evaluation.conduction import with_conductance
    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_csv, write_json, write_netcdf
    from roughcontact.plot.canvas import areal_figure, curve_figure, save

    curve, loads = whole_curve(request, cache), request.recipe.loads or PageLoads()
    theories, _ = compared(request, cache)
    comparisons = {name: comparison for name, (_, comparison) in theories.items()}
    dataset = with_theories(curve_dataset(curve), comparisons)
    conductors = conductors_of(request.recipe.bodies) if loads.conducting else None
    if conductors is not None:
        dataset = with_conductance(dataset, conductors)
    source = provenance(
        cache.surface(request.recipe, request.files),
        modulus=curve.modulus,
        control=f"{len(curve)} {loads.control}s",
        tolerance=1e-8,
        command=statement.command,
    )

    def picture(path: Path) -> None:
        try:
            law = curve.fit()
        except ValueError:
            law = None
        laws = [
            replace(theory, quantities={key: theory.quantities[key] for key in comparison.predicted})
            for theory, comparison in theories.values()
        ]
        per_area = loads.control == "pressure" or all(curve.periodic)
        save((areal_figure if per_area else curve_figure)(curve, law, laws), path)

    record = curve_record(curve) | {
        "theories": {name: each.to_record() for name, each in comparisons.items()}
    }
    return {
        "curve.csv": lambda path: write_csv(dataset, path, source),
        "curve.nc": lambda path: write_netcdf(dataset, path, source),
        "curve.png": picture,
        "curve.svg": picture,
        "curve.json": lambda path: write_json(record, path, source),
    }


def _zipped(folder: Path) -> bytes:
    """Return the files of a folder as an archive."""
    stream = BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for file in sorted(folder.iterdir()):
            archive.write(file, file.name)
    return stream.getvalue()
