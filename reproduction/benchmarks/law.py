"""The law of rough squares: ensembles of surfaces and lines, and their results, as pages of the documentation.

    python reproduction/benchmarks/law.py                     # writes results, tables and pictures of docs/law*.md
    python reproduction/benchmarks/law.py --collect DIR       # takes over the studies DIR/NAME before
    python reproduction/benchmarks/law.py --cost              # seconds of a processor a curve on every grid
    python reproduction/benchmarks/law_run.py NAME --out DIR  # runs studies in batches, and collects each batch
    python reproduction/benchmarks/law_check.py               # one member of each, by another solver
    python reproduction/benchmarks/law_cut.py                 # a smooth crest that the border cuts

The studies are those of examples/law: ``roughcontact study run examples/law/NAME.toml --out DIR/NAME``. They can be
collected at any time, as far as they are. The stiffness of every surface lies in reproduction/data/law, from which the
pages are made; their words between the tables are written by hand. A table that has a place in a page is written there,
all others as data files into docs/data/law.
"""

from __future__ import annotations

import argparse
import re
import time
from pathlib import Path

from law_check import check
from law_counts import counts, runs
from law_crest import e8
from law_ensembles import FOLDER, ROOT, STUDIES, collect
from law_findings import findings, result_tables
from law_formula import formula
from law_others import e3, e4, e5, e6, e7
from law_pictures import pictures
from law_tables import Table, comma_separated, e1, e2, markdown
from pages import PICTURES, save, write

from roughcontact.study.cases.curve_case import CASE
from roughcontact.study.study import Study
from roughcontact.study.task import generator

DOCS = ROOT / "docs"
PAGES = tuple(DOCS / "evidence" / f"{name}.md" for name in ("law", "law-ensembles", "law-grids", "law-cut"))
DATA = DOCS / "data" / "law"
PARTS = (result_tables, formula, e1, e2, e3, e4, e5, e6, e7, e8)
_PLACE = re.compile(r"(<!-- table (\S+) -->\n).*?(<!-- end -->)", re.DOTALL)


def checked() -> Table:
    """Return the stiffness of one member of every ensemble, by this and by another solver."""
    head = [
        "ensemble",
        "cells",
        "k/(E* L)",
        "k/(E* L), other solver",
        "largest difference of k, K and depth",
    ]
    return head, check()


def tables(folder: Path = FOLDER) -> dict[str, Table | str]:
    """Return every table, and every paragraph of results, by its name."""
    found = {"runs": runs(folder)} | ({"counts": each} if (each := counts(folder)) else {})
    for each in PARTS:
        found |= each(folder)
    said = findings(folder) + [found.pop(name) for name in [*found] if name.endswith(" said")]
    return found | {"findings": "\n".join(f"{number}. {words}" for number, words in enumerate(said, 1))}


def cost() -> None:
    """Print the seconds of a processor that one curve of E2 takes on every grid."""
    for name in ("e2-grids", "e2-grids-2048", "e2-grids-4096"):
        for parameters in Study.read(STUDIES / f"{name}.toml").combinations():
            if parameters.hurst in (0.25, 1.3, 2.95) and parameters.short_cutoff is None:
                start = time.process_time()
                CASE.run(parameters, generator(27, 0))
                print(f"{parameters.points}², H = {parameters.hurst:g}: {time.process_time() - start:.2f} s")


def filled(text: str, found: dict[str, Table | str]) -> str:
    """Return a page with its tables and results, or a remark that an ensemble is not computed yet."""

    def put(place: re.Match[str]) -> str:
        one = found.get(place[2], "Not computed yet.")
        words = one if isinstance(one, str) else markdown(one)
        return place[1] + words.replace("*", r"\*") + "\n" + place[3]

    return _PLACE.sub(put, text)


def write_pages(found: dict[str, Table | str]) -> None:
    """Write results and tables into the pages, and the other tables as data files."""
    texts = {path: path.read_text(encoding="utf-8") for path in PAGES}
    placed = {place[2] for text in texts.values() for place in _PLACE.finditer(text)}
    for path, text in texts.items():
        path.write_text(filled(text, found), encoding="utf-8", newline="\n")
    for name, one in found.items():
        if name not in placed and not isinstance(one, str):
            (DATA / f"{name}.csv").write_text(comma_separated(one), encoding="utf-8", newline="\n")


def main() -> None:
    """Take over what is asked for, write the pages and their data, and draw."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--collect", type=Path, metavar="DIR", help="folder with the folders of the studies")
    parser.add_argument(
        "--cost", action="store_true", help="print how long a curve takes on every grid, and stop"
    )
    options = parser.parse_args()
    if options.cost:
        cost()
        return
    if options.collect is not None:
        collect(options.collect)
    write_pages(tables() | {"check": checked()})
    for name, picture in pictures():
        print(f"{name}: {save(picture, PICTURES / 'law' / f'{name}.png') / 1e3:.0f} kB")
    write()  # some of the thesis' claims are judged by these ensembles


if __name__ == "__main__":
    main()
