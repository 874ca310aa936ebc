"""The law of rough squares: ensembles of surfaces and lines, and what they say, as a page of the documentation.

    python benchmarks/law.py                     # writes the tables and pictures of docs/law.md
    python benchmarks/law.py --collect DIR       # takes over the studies DIR/NAME before
    python benchmarks/law_check.py               # one member of each, by another solver

The studies are those of examples/law: ``roughcontact study run examples/law/NAME.toml --out DIR/NAME``. They can be
collected at any time, as far as they are. The stiffness of every surface lies in docs/reproduction/law, from which the
page is made; its words between the tables are written by hand.
"""

from __future__ import annotations

import argparse
import re
import tomllib
from pathlib import Path

from law_check import check
from law_ensembles import FOLDER, ROOT, STUDIES, collect, read
from law_findings import findings
from law_formula import formula
from law_others import e3, e4, e5, e6, e7
from law_pictures import pictures
from law_tables import e1, e2, markdown
from reproduction import save

PAGE = ROOT / "docs" / "law.md"
PARTS = (findings, formula, e1, e2, e3, e4, e5, e6, e7)
_PLACE = re.compile(r"(<!-- table (\S+) -->\n).*?(<!-- end -->)", re.DOTALL)


def runs(folder: Path = FOLDER) -> str:
    """Return a table of the ensembles: what they are, how many samples they have, and what that took."""
    rows = []
    for path in sorted(STUDIES.glob("*.toml")):
        text = path.read_text(encoding="utf-8")
        asked = tomllib.loads(text)["samples"]
        words = " ".join(line.lstrip("# ") for line in text.split("\nname")[0].splitlines())
        words = re.split(r"[.:] ", words.partition(": ")[2])[0].rstrip(".")
        found = read(path.stem, folder)
        done = ("0", "-") if found is None else (str(found.sizes["sample"]), f"{found.attrs['hours']:.1f}")
        name = f"[`{path.stem}`](../examples/law/{path.name})"
        rows.append([name, words, str(asked), *done])
    return markdown((["study", "what", "samples wanted", "done", "hours of one core"], rows))


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
    found = {"runs": runs(folder)}
    for each in PARTS:
        found |= each(folder)
    return found


def filled(text: str, found: dict[str, str]) -> str:
    """Return a page with its tables; one whose ensemble was not computed says so."""
    return _PLACE.sub(lambda place: f"{place[1]}{found.get(place[2], 'Not computed yet.')}\n{place[3]}", text)


def main() -> None:
    """Take over what is asked for, write the tables into the page, and draw."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--collect", type=Path, metavar="DIR", help="folder with the folders of the studies")
    options = parser.parse_args()
    if options.collect is not None:
        collect(options.collect)
    text = PAGE.read_text(encoding="utf-8")
    PAGE.write_text(filled(text, tables() | {"check": checked()}), encoding="utf-8", newline="\n")
    for name, picture in pictures():
        print(f"{name}: {save(picture, FOLDER / f'{name}.png') / 1e3:.0f} kB")


if __name__ == "__main__":
    main()
