"""What a page gives away: tables, fields and pictures as the command line writes them, alone or all in one archive."""

from __future__ import annotations

import tempfile
import zipfile
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

from roughcontact.page.curve_jobs import whole_curve
from roughcontact.page.order import Order, Send
from roughcontact.page.statement import Statement, stated
from roughcontact.page.workbench import Workbench, modulus_of

if TYPE_CHECKING:
    from roughcontact.contact.solution import Solution

__all__ = ["export"]

_KINDS = ("csv", "nc", "png", "svg", "zip")


def export(order: Order, bench: Workbench, send: Send) -> None:
    """Send a file of the load or the curve that the recipe states, or an archive of all that belongs to it."""
    kind = order.more.get("kind")
    if kind not in _KINDS:
        raise ValueError(f"files are exported as {', '.join(_KINDS)}, not as {kind!r}")
    send({"type": "doing", "words": "Writing files"})
    statement = stated(order.recipe, order.file)
    with tempfile.TemporaryDirectory(prefix="roughcontact-") as name:
        folder = Path(name)
        if kind == "zip":
            _everything(order, bench, statement, folder)
            send({"type": "file", "name": "roughcontact.zip"}, _zipped(folder))
            return
        if order.more.get("of") == "curve":
            written = _curve_files(order, bench, statement)
        elif order.more.get("of") == "load":
            written = _load_files(bench.solution(order.recipe, order.files), order, statement)
        else:
            raise ValueError("a load or a curve is exported: say which")
        file = folder / next(file for file in written if file.endswith(f".{kind}"))
        written[file.name](file)
        send({"type": "file", "name": file.name}, file.read_bytes())


def _everything(order: Order, bench: Workbench, statement: Statement, folder: Path) -> None:
    """Write the surface, the load, the curve, and what makes them again, as far as the recipe states them."""
    import roughcontact as rc
    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_json
    from roughcontact.plot.canvas import save, surface_figure

    recipe = order.recipe
    surface = bench.surface(recipe, order.files)
    rc.write(surface, folder / "surface.npz")
    save(surface_figure(surface), folder / "surface.png")
    written: dict[str, Callable[[Path], None]] = {}
    if recipe.load is not None:
        written |= _load_files(bench.solution(recipe, order.files), order, statement)
    if recipe.loads is not None:
        written |= _curve_files(order, bench, statement)
    for file, write in written.items():
        write(folder / file)
    (folder / "commands.sh").write_text(statement.command + "\n", encoding="utf-8")
    (folder / "same.py").write_text(statement.python, encoding="utf-8")
    modulus = modulus_of(recipe.bodies) if written else None
    source = provenance(surface, modulus=modulus, command=statement.command)
    write_json({"file": order.file}, folder / "provenance.json", source)


def _load_files(solution: Solution, order: Order, statement: Statement) -> dict[str, Callable[[Path], None]]:
    """Return how the files of a load are written, by their names."""
    from roughcontact.contact.dataset import solution_dataset, solution_record
    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_csv, write_json, write_netcdf
    from roughcontact.plot.canvas import save, solution_figure

    problem, load = solution.problem, order.recipe.load
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


def _curve_files(order: Order, bench: Workbench, statement: Statement) -> dict[str, Callable[[Path], None]]:
    """Return how the files of a curve are written, by their names."""
    from roughcontact.contact.dataset import curve_dataset, curve_record
    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_csv, write_json, write_netcdf
    from roughcontact.plot.canvas import curve_figure, save

    curve, surface = whole_curve(order, bench), bench.surface(order.recipe, order.files)
    loads = order.recipe.loads
    control = f"{len(curve)} {'force' if loads is None else loads.control}s"
    source = provenance(
        surface, modulus=curve.modulus, control=control, tolerance=1e-8, command=statement.command
    )

    def picture(path: Path) -> None:
        try:
            law = curve.fit()
        except ValueError:
            law = None
        save(curve_figure(curve, law), path)

    return {
        "curve.csv": lambda path: write_csv(curve_dataset(curve), path, source),
        "curve.nc": lambda path: write_netcdf(curve_dataset(curve), path, source),
        "curve.png": picture,
        "curve.svg": picture,
        "curve.json": lambda path: write_json(curve_record(curve), path, source),
    }


def _zipped(folder: Path) -> bytes:
    """Return the files of a folder as an archive."""
    stream = BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for file in sorted(folder.iterdir()):
            archive.write(file, file.name)
    return stream.getvalue()
