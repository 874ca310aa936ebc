"""The law of rough squares: ensembles of surfaces and lines, and what they say, as a page of the documentation.

    python reproduction/benchmarks/law.py                     # writes the tables and pictures of docs/law.md
    python reproduction/benchmarks/law.py --collect DIR       # takes over the studies DIR/NAME before
    python reproduction/benchmarks/law.py --cost              # seconds of a processor a curve on every grid
    python reproduction/benchmarks/law_check.py               # one member of each, by another solver

The studies are those of examples/law: ``roughcontact study run examples/law/NAME.toml --out DIR/NAME``. They can be
collected at any time, as far as they are. The stiffness of every surface lies in reproduction/data/law, from which the
page is made; its words between the tables are written by hand.
"""

from __future__ import annotations

import argparse
import re
import time
from pathlib import Path

from law_check import check
from law_counts import counts, runs
from law_ensembles import FOLDER, ROOT, STUDIES, collect
from law_findings import findings
from law_formula import formula
from law_others import e3, e4, e5, e6, e7
from law_pictures import pictures
from law_tables import e1, e2, markdown
from pages import PICTURES, save, write

from roughcontact.study.cases.curve_case import CASE
from roughcontact.study.study import Study
from roughcontact.study.task import generator

PAGE = ROOT / "docs" / "law.md"
PARTS = (formula, e1, e2, e3, e4, e5, e6, e7)
_PLACE = re.compile(r"(<!-- table (\S+) -->\n).*?(<!-- end -->)", re.DOTALL)


def checked() -> str:
    """Return what another solver says about one member of every ensemble."""
    head = [
        "ensemble",
        "cells",
        "k/(E\\* L)",
        "the same by the other",
        "largest difference of k, K and depth",
    ]
    return markdown((head, check()))


def tables(folder: Path = FOLDER) -> dict[str, str]:
    """Return every table by its name."""
    found = {"runs": runs(folder), "counts": counts(folder)}
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


def filled(text: str, found: dict[str, str]) -> str:
    """Return a page with its tables; one whose ensemble was not computed says so."""
    return _PLACE.sub(lambda place: f"{place[1]}{found.get(place[2], 'Not computed yet.')}\n{place[3]}", text)


def main() -> None:
    """Take over what is asked for, write the tables into the page, and draw."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--collect", type=Path, metavar="DIR", help="folder with the folders of the studies")
    parser.add_argument(
        "--cost", action="store_true", help="say how long curves take on every grid, and no more"
    )
    options = parser.parse_args()
    if options.cost:
        cost()
        return
    if options.collect is not None:
        collect(options.collect)
    text = PAGE.read_text(encoding="utf-8")
    PAGE.write_text(filled(text, tables() | {"check": checked()}), encoding="utf-8", newline="\n")
    for name, picture in pictures():
        print(f"{name}: {save(picture, PICTURES / 'law' / f'{name}.png') / 1e3:.0f} kB")
    write()  # some of the thesis' claims are judged by these ensembles


if __name__ == "__main__":
    main()
