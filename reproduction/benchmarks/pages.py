"""Pages about the thesis: its figures computed again, beside its text, and which of its claims hold.

    python reproduction/benchmarks/pages.py                   # draws all figures and writes the pages
    python reproduction/benchmarks/pages.py --collect DIR     # takes over the averages DIR/figN.nc before
    python reproduction/benchmarks/pages.py fig6 fig27        # draws some of them again, and writes the pages

The pages show the files in reproduction/data: averages of ensembles (``figN.nc``, written by ``roughcontact thesis
figN --scale thesis --out DIR``), results of figures that are computed here in seconds (``simple.json``), captions
(``captions.toml``), and the pictures. A file that does not exist is reported as missing.
docs/evidence/reproduction.md holds findings and a dozen claims, reproduction-claims.md beside it all claims, of
docs/data/reproduction/claims.csv, and reproduction-figures.md the figures. reproduction/verdicts.md compares former
verdicts (``first-edition.csv`` and ``former.toml``) with the present ones; ``changed.toml`` has the reasons.
"""

from __future__ import annotations

import argparse
import csv
import io
import json
import sys
import tomllib
from dataclasses import asdict, replace
from functools import cache
from pathlib import Path
from typing import Any, cast

import claim_pages
import law_verdicts
import numpy as np
import page_texts
import xarray
from matplotlib.figure import Figure
from page_texts import Entry, command
from PIL import Image

from roughcontact.files.write import write_netcdf
from roughcontact.study.ranges import Range
from roughcontact.study.study import Study
from roughcontact_thesis.figures import (
    FIGURES,
    EnsembleFigure,
    FigureModule,
    Scale,
    SimpleFigure,
    drawn,
    findings,
    is_ensemble,
    module,
    verdicts,
)
from roughcontact_thesis.ruling import Ruling
from roughcontact_thesis.verdict import Verdict

HOME = Path(__file__).resolve().parent.parent
FOLDER = HOME / "data"
PICTURES = HOME / "pictures"
DOCS = HOME.parent / "docs"
PAGE, CLAIMS_PAGE, FIGURES_PAGE = (
    DOCS / "evidence" / f"reproduction{part}.md" for part in ("", "-claims", "-figures")
)
CLAIMS = DOCS / "data" / "reproduction" / "claims.csv"
CHANGES = HOME / "verdicts.md"
DPI = 160  # of the pictures
FEW = 8  # values that are listed one by one


# What is there


@cache  # every page is written of them, and judging takes seconds
def entries(folder: Path) -> tuple[Entry, ...]:
    """Return what `folder` says about every figure."""
    captions = tomllib.loads((folder / "captions.toml").read_text(encoding="utf-8"))
    found = read_simple(folder)
    larger = law_verdicts.rulings(folder / "law")
    return tuple(
        _by_larger(_entry(name, captions[name], found.get(name), folder), larger) for name in FIGURES
    )


def _by_larger(entry: Entry, larger: list[law_verdicts.Larger]) -> Entry:
    """Return what is said about a figure, with claims that it leaves open judged by larger ensembles."""
    judged = tuple(law_verdicts.judged(verdict, entry.name, larger) for verdict in entry.verdicts)
    finding = entry.finding
    decided = [now for now, own in zip(judged, entry.verdicts, strict=True) if now.word != own.word]
    if finding and decided:
        finding += f' A larger ensemble decides "{decided[0].claim}": {decided[0].word}.'
    return replace(entry, verdicts=judged, finding=finding)


def read_simple(folder: Path) -> dict[str, Any]:
    """Return what the figures without an ensemble found, by name: their seed and verdicts."""
    path = folder / "simple.json"
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}


def _entry(name: str, caption: str, simple: dict[str, Any] | None, folder: Path) -> Entry:
    found, scale, whole, computed, said, finding = module(name), None, True, (), (), ""
    if is_ensemble(found):
        path = folder / f"{name}.nc"
        if path.is_file():
            averages = read(path)
            studies = studies_of(averages)
            scale = scale_of(found, studies)
            whole = not sum(np.sum(averages.attrs[f"cases_{each}"]) for each in ("failed", "missing"))
            computed = (*_told(studies, averages), command(name, scale))
            said, finding = verdicts(found, averages), findings(found, averages)
    elif simple is not None:
        computed = (f"seed {simple['seed']}", command(name, None))
        said = tuple(Verdict(**each | {"ruling": Ruling(**each["ruling"])}) for each in simple["verdicts"])
    words = " ".join(caption.split())
    return Entry(name, found.TITLE, words, found.CHOSEN, computed, scale, whole, said, finding)


def read(path: Path) -> xarray.Dataset:
    """Return averages, in memory."""
    with xarray.open_dataset(path, engine="h5netcdf") as data:
        return data.load()


def studies_of(averages: xarray.Dataset) -> tuple[Study, ...]:
    """Return the studies that averages were made of."""
    return tuple(Study(**tomllib.loads(text)) for text in np.atleast_1d(averages.attrs["studies"]))


def scale_of(found: EnsembleFigure, studies: tuple[Study, ...]) -> str:
    """Return at which scale these are the studies of a figure: thesis, small or other."""
    for scale in ("thesis", "small"):
        named = found.studies(cast("Scale", scale))
        if len(named) == len(studies) and all(map(_covers, studies, named)):
            return scale
    return "other"


def _covers(study: Study, named: Study) -> bool:
    """Return whether a study is the one that is named, or has more samples."""
    return study.samples >= named.samples and dict(study) | {"samples": named.samples} == dict(named)


def _told(studies: tuple[Study, ...], averages: xarray.Dataset) -> tuple[str, ...]:
    """Return a line a study: what was varied, how often, and how much of it is there."""
    done, failed, missing, seconds = (
        np.atleast_1d(averages.attrs[f"cases_{name}"]).tolist()
        for name in ("done", "failed", "missing", "seconds")
    )
    return tuple(
        f"study `{study.name}`: {_table(study)}{study.samples} samples{' of each' if study.table else ''}, case "
        f"`{study.case.split(':')[0].split('.')[-1]}`, seed {study.seed}; {_parameters(study)}. "
        f"{_cases(done[n], failed[n], missing[n])}, {_time(seconds[n])}"
        for n, study in enumerate(studies)
    )


def _table(study: Study) -> str:
    return "".join(f"{name} = {_values(values)}; " for name, values in study.table.items())


def _values(values: Range | tuple[Any, ...]) -> str:
    each = values.values(float) if isinstance(values, Range) else values
    if len(each) > FEW:
        return f"{len(each)} values from {min(each):g} to {max(each):g}"
    return ", ".join(map(_value, each))


def _value(value: Any) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)


def _parameters(study: Study) -> str:
    return ", ".join(f"{name} = {_value(value)}" for name, value in study.parameters.items())


def _cases(done: int, failed: int, missing: int) -> str:
    words = f"{done} of {done + failed + missing} cases"
    lacking = [f"{count} {what}" for count, what in ((failed, "failed"), (missing, "missing")) if count]
    return f"**{words}: {', '.join(lacking)}**" if lacking else words


def _time(seconds: float) -> str:
    for size, unit in ((3600, "hours"), (60, "minutes")):
        if seconds >= 2 * size:
            return f"{seconds / size:.{0 if seconds >= 10 * size else 1}f} {unit} of computing in total"
    return f"{seconds:.0f} seconds of computing in total"


# The pages


def page(folder: Path = FOLDER) -> str:
    """Return the page of the documentation, of what is in `folder`."""
    return claim_pages.page(entries(folder))


def claims(folder: Path = FOLDER) -> str:
    """Return the data file of all claims, of what is in `folder`."""
    return claim_pages.claims_file(entries(folder))


def claims_page(data: Path = CLAIMS) -> str:
    """Return the page of all claims, of their data file."""
    return claim_pages.claims_page(data.read_text(encoding="utf-8"))


def figures_page(folder: Path = FOLDER) -> str:
    """Return the page of the figures, of what `folder` says about them."""
    unjudged = tomllib.loads((folder / "unjudged.toml").read_text(encoding="utf-8"))
    return page_texts.figures_page(entries(folder), unjudged)


def changes(folder: Path = FOLDER) -> str:
    """Return the page about what became of former verdicts."""
    former, changed = (
        tomllib.loads((folder / f"{name}.toml").read_text(encoding="utf-8"))["row"]
        for name in ("former", "changed")
    )
    first = csv.DictReader(io.StringIO((folder / "first-edition.csv").read_text(encoding="utf-8")))
    return page_texts.changes_page(entries(folder), former, [*first], changed)


# What makes it


def collect(source: Path, folder: Path = FOLDER) -> None:
    """Take over the averages figN.nc of `source`."""
    for name in FIGURES:
        path = source / f"{name}.nc"
        if not path.is_file():
            continue
        averages = read(path)
        if "studies" not in averages.attrs:
            sys.exit(f"{path} does not name its studies: write it again, roughcontact thesis {name} --as-is")
        found = module(name)
        assert is_ensemble(found)
        # A command line names folders of one machine.
        averages.attrs.pop("history", None)
        scale = scale_of(found, studies_of(averages))
        write_netcdf(averages, folder / f"{name}.nc", {"command": command(name, scale).strip("`")})
        print(f"{name}: {scale} scale, {(folder / f'{name}.nc').stat().st_size / 1e3:.0f} kB")


def draw(name: str, folder: Path = FOLDER) -> None:
    """Draw a figure, and compute it if it is no ensemble."""
    found: FigureModule = module(name)
    if is_ensemble(found):
        if not (folder / f"{name}.nc").is_file():
            print(f"{name}: its averages are missing")
            return
        data: Any = read(folder / f"{name}.nc")
    else:
        simple = cast("SimpleFigure", found)
        data = simple.case(simple.SEED)
        said = [asdict(verdict) for verdict in verdicts(simple, data)]
        every = read_simple(folder) | {name: {"seed": simple.SEED, "verdicts": said}}
        ordered = {each: every[each] for each in FIGURES if each in every}
        text = json.dumps(ordered, indent=1, ensure_ascii=False)
        (folder / "simple.json").write_text(text + "\n", encoding="utf-8")
    print(f"{name}: {save(drawn(found, data), PICTURES / f'{name}.png') / 1e3:.0f} kB")


def save(picture: Figure, path: Path) -> int:
    """Write a picture in 256 colours, and return its size in bytes."""
    whole = io.BytesIO()
    picture.savefig(whole, format="png", dpi=DPI)
    with Image.open(whole) as image:
        # This way to choose them keeps those of many pixels as they are: greys stay grey.
        few = image.convert("RGB").quantize(method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
        few.save(path, optimize=True)
    return path.stat().st_size


def write() -> None:
    """Write all pages, of what is there."""
    for path, written in (
        (PAGE, page),
        (CLAIMS, claims),
        (CLAIMS_PAGE, claims_page),
        (FIGURES_PAGE, figures_page),
        (CHANGES, changes),
    ):
        path.write_text(written(), encoding="utf-8", newline="\n")


def main() -> None:
    """Draw what is asked for, and write the pages."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("figures", nargs="*", metavar="FIGURE", help="figures to be drawn (default: all)")
    parser.add_argument(
        "--collect", type=Path, metavar="DIR", help="folder with averages figN.nc to take over"
    )
    options = parser.parse_args()
    unknown = set(options.figures) - set(FIGURES)
    if unknown:
        parser.error(f"there is no {', '.join(sorted(unknown))}: choose among {', '.join(FIGURES)}")
    FOLDER.mkdir(exist_ok=True)
    if options.collect is not None:
        collect(options.collect)
    for name in options.figures or FIGURES:
        draw(name)
    write()


if __name__ == "__main__":
    main()
