"""What of the thesis holds: its figures computed again, beside its text, as a page of the documentation.

    python benchmarks/reproduction.py                   # draws all figures and writes docs/reproduction.md
    python benchmarks/reproduction.py --collect DIR     # takes over the averages DIR/figN.nc before
    python benchmarks/reproduction.py fig6 fig27        # draws some of them anew, and writes the page

The page says what is found in docs/reproduction: averages of ensembles (``figN.nc``, written by ``roughcontact thesis
figN --scale thesis --out DIR``), what the figures found that are computed here in seconds (``simple.json``), what is
seen in each (``captions.toml``), and the pictures. What is not there is said to be missing.
"""

from __future__ import annotations

import argparse
import io
import json
import sys
import tomllib
from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, cast

import numpy as np
import xarray
from matplotlib.figure import Figure
from PIL import Image

from roughcontact.files.write import write_netcdf
from roughcontact.study.ranges import Range
from roughcontact.study.study import Study
from roughcontact.thesis.figures import (
    FIGURES,
    EnsembleFigure,
    FigureModule,
    Scale,
    SimpleFigure,
    drawn,
    is_ensemble,
    module,
    verdicts,
)
from roughcontact.thesis.verdict import Verdict

FOLDER = Path(__file__).resolve().parent.parent / "docs" / "reproduction"
PAGE = FOLDER.with_suffix(".md")
DPI = 120  # of the pictures
FEW = 8  # values that are listed one by one
REDRAWN = "2026-11-23"  # from then on phases are functions of a key and the wave vector


@dataclass(frozen=True)
class Entry:
    """What the page says about a figure.

    Parameters
    ----------
    name : str
        Such as ``fig27``.
    title, caption : str
        What it is, and what is seen in it.
    chosen : tuple of str
        What the thesis leaves open, and what is taken here.
    computed : tuple of str
        How it was computed, a line each; none where it was not.
    scale : str or None
        Of an ensemble: ``thesis``, ``small``, or ``other`` where it is neither; None without an ensemble.
    whole : bool
        Whether no case failed or is missing.
    verdicts : tuple of Verdict
    """

    name: str
    title: str
    caption: str
    chosen: tuple[str, ...]
    computed: tuple[str, ...]
    scale: str | None
    whole: bool
    verdicts: tuple[Verdict, ...]

    @property
    def short(self) -> str:
        """The number of the figure, or the word of a question of the outlook."""
        return self.name.removeprefix("fig").removeprefix("outlook-")

    @property
    def heading(self) -> str:
        """What its section is called."""
        return f"{'Figure' if self.name.startswith('fig') else 'Outlook,'} {self.short}"

    @property
    def anchor(self) -> str:
        """Where links to its section go."""
        return self.heading.lower().replace(",", "").replace(" ", "-")


# What is there


def entries(folder: Path = FOLDER) -> tuple[Entry, ...]:
    """Return what `folder` says about every figure."""
    captions = tomllib.loads((folder / "captions.toml").read_text(encoding="utf-8"))
    found = read_simple(folder)
    return tuple(_entry(name, captions[name], found.get(name), folder) for name in FIGURES)


def read_simple(folder: Path) -> dict[str, Any]:
    """Return what the figures without an ensemble found, by name: their seed and verdicts."""
    path = folder / "simple.json"
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}


def _entry(name: str, caption: str, simple: dict[str, Any] | None, folder: Path) -> Entry:
    found, scale, whole, computed, said = module(name), None, True, (), ()
    if is_ensemble(found):
        path = folder / f"{name}.nc"
        if path.is_file():
            averages = read(path)
            studies = studies_of(averages)
            scale = scale_of(found, studies)
            whole = not sum(np.sum(averages.attrs[f"cases_{each}"]) for each in ("failed", "missing"))
            computed = (*_told(studies, averages), _command(name, scale))
            said = verdicts(found, averages)
    elif simple is not None:
        computed = (f"seed {simple['seed']}", _command(name, None))
        said = tuple(Verdict(**each) for each in simple["verdicts"])
    return Entry(name, found.TITLE, " ".join(caption.split()), found.CHOSEN, computed, scale, whole, said)


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
    """Return a line a study: what was varied, how often, how much of it is there, and whether it is of old draws."""
    old = averages.attrs.get("date_created", REDRAWN) < REDRAWN
    draws = f", surfaces as they were drawn before {REDRAWN}" if old else ""
    done, failed, missing, seconds = (
        np.atleast_1d(averages.attrs[f"cases_{name}"]).tolist()
        for name in ("done", "failed", "missing", "seconds")
    )
    return tuple(
        f"study `{study.name}`: {_table(study)}{study.samples} samples{' of each' if study.table else ''}, case "
        f"`{study.case.split(':')[0].split('.')[-1]}`, seed {study.seed}; {_parameters(study)}. "
        f"{_cases(done[n], failed[n], missing[n])}, {_time(seconds[n])}{draws}"
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
            return f"{seconds / size:.{0 if seconds >= 10 * size else 1}f} {unit} of computing in all"
    return f"{seconds:.0f} seconds of computing in all"


def _command(name: str, scale: str | None) -> str:
    return (
        f"`roughcontact thesis {name}{f' --scale {scale}' if scale in ('thesis', 'small') else ''} --out DIR`"
    )


# The page

HEAD = """# The thesis, computed again

The figures of R. Pohrt, *Normal Stiffness of Multiscale Rough Surfaces in Elastic Contact* (TU Berlin, 2013), computed
anew with this package, and what is found beside what its text says in numbers: also where the thesis does not hold. Its
other figures are sketches. At the end stand questions of its outlook, put to ensembles. Equations that are wrong as
printed stand in [errata.md](errata.md).

This page is written by `python benchmarks/reproduction.py` from what lies in [reproduction/](reproduction): averages of
ensembles, NetCDF files that also hold the studies they are averages of, and the findings of figures that take seconds.
The single solutions are not kept; the command in each section makes them again, and all of them at once

    roughcontact thesis all --scale thesis --out DIR         # days; stopped at any time it goes on where it was
    python benchmarks/reproduction.py --collect DIR
"""

WORDS = """## Words and symbols

* E\\*: reduced modulus, 1/E\\* = (1 - nu1²)/E1 + (1 - nu2²)/E2. L: side of the square surface, or length of the line.
  h: rms height of its roughness. F, d, k: normal force, depth of indentation, contact stiffness dF/dd.
* F/(E\\* h L) and k/(E\\* L): force and stiffness without dimension. "A force of 0.07" is the former.
* H, D_f: Hurst exponent, and fractal dimension 3 - H. alpha, zeta: exponent and prefactor of the power law
  k/(E\\* L) = zeta (F/(E\\* h L))^alpha. q, C2D, C1D: wavenumber, power spectrum of a surface and of a line.
* Surfaces: rough squares, free at their edges, pressed into a half-space by boundary elements, square cells of constant
  pressure. Rough lines: N points pressed into a row of independent springs, the method of dimensionality reduction.
* 20 cells, 20 springs: twenty times the stiffness of a single one. Below, single ones decide, and nothing is fitted.
* Case: one solution, or one curve over all forces. Sample: one draw of the random phases, the same for all parameters.
  Sizes, rms heights and moduli of studies are bare numbers: what is found does not depend on them.
* Holds: within the tolerance that the module of the figure, `roughcontact.thesis.figN_...`, states. Does not hold:
  outside, for averages by more than three standard errors. Open: outside by less, or the text is no number to judge by.
"""


def page(folder: Path = FOLDER) -> str:
    """Return the page that `folder` makes."""
    every = entries(folder)
    sections = (line for each in every for line in _section(each, folder))
    return "\n".join([HEAD, *_overview(every), WORDS, *sections])


def _overview(every: Sequence[Entry]) -> list[str]:
    words = Counter(verdict.word for each in every for verdict in each.verdicts)
    lines = [
        "## What holds and what does not",
        "",
        f"Of {words.total()} claims {words['holds']} hold, {words['does not hold']} do not, and {words['open']} are "
        "open. What is found is shortened here; the whole stands in the section of the figure.",
        "",
    ]
    for said, chosen in (
        ("**Missing**, not computed yet: {}.", [each for each in every if not each.computed]),
        (
            "On the small scale as yet, fewer samples on smaller grids than the thesis': {}. What these say is "
            "provisional.",
            [each for each in every if each.scale == "small"],
        ),
        (
            "With counts that are neither the thesis' nor small: {}.",
            [each for each in every if each.scale == "other"],
        ),
        ("Cases failed or are missing: {}.", [each for each in every if not each.whole]),
    ):
        if chosen:
            names = ", ".join(f"[{each.short}](#{each.anchor})" for each in chosen)
            lines += [said.format(f"figure{'s' if len(chosen) > 1 else ''} {names}"), ""]
    lines += ["| figure | claim | thesis | found | verdict |", "|---|---|---|---|---|"]
    for each in every:
        mark = {"small": ", small scale", "other": ", other counts"}.get(each.scale or "", "")
        for verdict in each.verdicts:
            word = f"**{verdict.word}**" if verdict.holds is False else verdict.word
            cells = (verdict.claim, verdict.thesis, verdict.found.split("; ")[0])
            lines.append(
                f"| [{each.short}](#{each.anchor}){mark} | {' | '.join(map(_plain, cells))} | {word} |"
            )
    return [*lines, ""]


_SCALES = {
    "thesis": "On the scale of the thesis, with its counts where it states them:",
    "small": "**On the small scale**, fewer samples on smaller grids than the thesis':",
    "other": "**With counts that are not those of the figure now**:",
    None: "Computed in seconds:",
}


def _section(entry: Entry, folder: Path) -> list[str]:
    lines = [f"## {entry.heading}", "", f"**{_plain(entry.title[0].upper() + entry.title[1:])}**", ""]
    if not entry.computed:
        return [*lines, f"**Missing:** not computed yet; {_command(entry.name, 'thesis')} does it.", ""]
    lines += [f"![{entry.title}]({folder.name}/{entry.name}.png)", "", _plain(entry.caption), ""]
    if entry.verdicts:
        lines += [
            f"* **{verdict.word.capitalize()}:** {_plain(verdict.claim)}. *Thesis:* {_plain(verdict.thesis)}. "
            f"*Here:* {_plain(verdict.found)}."
            for verdict in entry.verdicts
        ]
    else:
        lines.append("The text makes no claim in numbers about it.")
    lines += [
        "",
        "Chosen where the thesis leaves it open:",
        "",
        *(f"* {_plain(each)}" for each in entry.chosen),
    ]
    lines += ["", _SCALES[entry.scale], "", *(f"* {each}" for each in entry.computed)]
    if entry.scale is not None:
        lines.append(f"* averages: [{entry.name}.nc]({folder.name}/{entry.name}.nc)")
    return [*lines, ""]


def _plain(words: str) -> str:
    """Return words as they are, whatever Markdown makes of their signs."""
    for sign in "\\|*":
        words = words.replace(sign, f"\\{sign}")
    return words


# What makes it


def collect(source: Path, folder: Path = FOLDER) -> None:
    """Take over the averages figN.nc of `source`."""
    for name in FIGURES:
        path = source / f"{name}.nc"
        if not path.is_file():
            continue
        averages = read(path)
        if "studies" not in averages.attrs:
            sys.exit(
                f"{path} does not say of which studies it is: write it once more, roughcontact thesis {name} --as-is"
            )
        found = module(name)
        assert is_ensemble(found)
        # A command line names folders of one machine.
        averages.attrs.pop("history", None)
        scale = scale_of(found, studies_of(averages))
        write_netcdf(averages, folder / f"{name}.nc", {"command": _command(name, scale).strip("`")})
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
    print(f"{name}: {save(drawn(found, data), folder / f'{name}.png') / 1e3:.0f} kB")


def save(picture: Figure, path: Path) -> int:
    """Write a picture in 256 colours, and return its size in bytes."""
    whole = io.BytesIO()
    picture.savefig(whole, format="png", dpi=DPI)
    with Image.open(whole) as image:
        # Of the ways to choose them this one keeps those of few pixels.
        few = image.convert("RGB").quantize(method=Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
        few.save(path, optimize=True)
    return path.stat().st_size


def main() -> None:
    """Draw what is asked for, and write the page."""
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
    PAGE.write_text(page(), encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
