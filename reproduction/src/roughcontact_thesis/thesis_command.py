"""The command ``thesis``: a figure of the thesis, computed."""

from __future__ import annotations

import shlex
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from roughcontact.cli.messages import UsageError, note, reported
from roughcontact.cli.option_groups import argument, option
from roughcontact.cli.options import PICTURES, picture_ending
from roughcontact.cli.output import all_or_none, command_line, output
from roughcontact.cli.report import print_facts
from roughcontact.cli.resumable import resumable
from roughcontact.progress.events import task
from roughcontact.recipe.texts import Choice, whole

if TYPE_CHECKING:
    import xarray

    from roughcontact.study.study import Study
    from roughcontact_thesis.figures import EnsembleFigure, FigureModule, Scale, SimpleFigure

__all__ = ["EXAMPLES", "thesis"]

EXAMPLES = {
    "thesis": """
roughcontact thesis list
roughcontact thesis fig6 --out figures --seed 2
roughcontact thesis fig27 --out figures --workers 2
roughcontact thesis fig27 --out figures --as-is --format pdf
roughcontact thesis all --scale thesis --out figures
""",
}

_SCALES = ("small", "thesis")
_NAME = argument("A figure, such as fig6; all; or list.", "NAME")


@dataclass(frozen=True, slots=True)
class Wanted:
    """How a figure is to be computed, and where it goes."""

    out: Path = option("Folder for pictures, averages and stores (default: this one).", "DIR", default=Path())
    scale: str = option(
        "Ensembles: small, or with the thesis' own counts: thesis.", default="small", read=Choice(_SCALES)
    )
    seed: int | None = option(
        "Seed of the random numbers (default: the figure's own).", "1", read=whole(0, "the seed")
    )
    workers: int | None = option(
        "Processes for an ensemble (default: one a core).", "N", read=whole(1, "the number of processes")
    )
    as_is: bool = option("Compute nothing: average what the stores hold so far.", default=False)
    format: str | None = option(
        "Format of the pictures, as wide as a journal's column or page (default: png).", read=Choice(PICTURES)
    )

    @property
    def ending(self) -> str:
        """The format of pictures."""
        return picture_ending(self.format, self.out)


def thesis(name: str = _NAME, *, wanted: Wanted) -> None:
    """Compute a figure of the thesis, and say what the thesis leaves open and whether it holds.

    A figure of an ensemble keeps its cases in DIR/studies: stopped at any time, the same command goes on from there.
    """
    with reported(wanted.out):
        from roughcontact_thesis.figures import FIGURES, module

        if name == "list":
            print_facts([(each, module(each).TITLE) for each in FIGURES])
            return
        if name != "all" and name not in FIGURES:
            raise UsageError(
                f"there is no figure {name!r}", f"choose one of {', '.join(FIGURES)}, all or list"
            )
        workers = None if wanted.as_is else wanted.workers or 0
        with output(wanted.out):
            for each in FIGURES if name == "all" else (name,):
                _compute(each, wanted, wanted.seed, workers)


def _compute(name: str, wanted: Wanted, seed: int | None, workers: int | None) -> None:
    """Compute and draw a figure, and print what is to be said about it; `workers` is 0 for one a core."""
    from roughcontact_thesis.figures import is_ensemble, module, verdicts

    found, folder = module(name), wanted.out
    if is_ensemble(found):
        data, more = _ensemble(name, found, folder, (cast("Scale", wanted.scale), seed, workers))
    else:
        simple = cast("SimpleFigure", found)
        first = simple.SEED if seed is None else seed
        with task(f"Computing {name}"):
            data = simple.case(first)
        more = [("seed", str(first))]
    picture = f"{name}.{wanted.ending}"
    _draw(picture, found, data, folder)
    facts = [("file", str(folder / picture)), ("figure", found.TITLE)]
    facts += [("chosen", line) for line in found.CHOSEN] + more
    for verdict in verdicts(found, data):
        part = f"; in part: {verdict.ruling.part}" if verdict.ruling.part else ""
        facts.append((verdict.ruling.word, f"{verdict.claim} ({verdict.source}): here {verdict.found}{part}"))
    print_facts(facts)


def _draw(picture: str, found: FigureModule, data: Any, folder: Path) -> None:
    from roughcontact.plot.canvas import save
    from roughcontact_thesis.figures import drawn

    with task(f"Drawing {picture}"), all_or_none(folder) as aside:
        save(drawn(found, data), aside / picture)


def _ensemble(
    name: str, found: EnsembleFigure, folder: Path, options: tuple[Scale, int | None, int | None]
) -> tuple[xarray.Dataset, list[tuple[str, str]]]:
    """Run the studies of a figure, write their averages beside its picture, and return them."""
    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_netcdf
    from roughcontact_thesis.reproduce import averages_of, planned

    scale, seed, workers = options
    studies = planned(found, scale, seed)
    if workers is not None:
        _run(studies, folder, workers)
    data = averages_of(found, studies, folder)
    write_netcdf(data, folder / f"{name}.nc", provenance(command=command_line()))
    lines = [("averages", str(folder / f"{name}.nc"))]
    counts = zip(studies, data.attrs["cases_done"], data.attrs["cases_missing"], strict=True)
    lines += [
        ("study", f"{each.name}: {done} of {done + missing} cases, seed {each.seed}")
        for each, done, missing in counts
    ]
    return data, lines


def _run(studies: tuple[Study, ...], folder: Path, workers: int) -> None:
    """Run studies."""
    from roughcontact.study import Processes, Serial
    from roughcontact_thesis.reproduce import run_study, store_of

    executor = Serial() if workers == 1 else Processes(workers or None)
    for study in studies:
        with resumable(command_line()):
            summary = run_study(study, folder, executor)
        if summary.failed:
            cases = f"{summary.failed} case{'s' if summary.failed > 1 else ''}"
            command = shlex.join(
                ["roughcontact", "study", "status", str(store_of(folder, study)), "--failed"]
            )
            note(f"{cases} of {study.name} failed; why says: {command}")
