"""The verb ``thesis``: a figure of the thesis, computed."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from roughcontact.cli.errors import UsageError, reported
from roughcontact.cli.output import all_or_none, output
from roughcontact.cli.quantity import parse_seed
from roughcontact.cli.report import print_facts, screen

__all__ = ["EXAMPLES", "thesis"]

EXAMPLES = """Examples:

roughcontact thesis list

roughcontact thesis fig6 --out figures --seed 2
"""

NameArgument = Annotated[str, typer.Argument(metavar="NAME", help="A figure, such as fig6, or list.")]
FolderOption = Annotated[
    Path, typer.Option(metavar="DIR", help="Folder for the picture (default: this one).")
]
SeedOption = Annotated[
    str | None, typer.Option(metavar="1", help="Seed of the random numbers (default: the figure's own).")
]


def thesis(name: NameArgument, *, out: FolderOption = Path(), seed: SeedOption = None) -> None:
    """Compute a figure of the thesis and say what the thesis leaves open."""
    with reported(out):
        from roughcontact.thesis.figures import FIGURES, module

        if name == "list":
            print_facts([(each, module(each).TITLE) for each in FIGURES])
            return
        if name not in FIGURES:
            raise UsageError(f"there is no figure {name!r}: choose one of {', '.join(FIGURES)}, or list")
        found = module(name)
        chosen = found.SEED if seed is None else parse_seed(seed, "--seed")
        path = out / f"{name}.png"
        with output(out):
            _write(name, chosen, out)
        facts = [("file", str(path)), ("figure", found.TITLE), *(("chosen", line) for line in found.CHOSEN)]
        print_facts([*facts, ("seed", str(chosen))])


def _write(name: str, seed: int, folder: Path) -> None:
    from roughcontact.plot.figures import save
    from roughcontact.thesis.figures import figure

    with screen().status(f"Computing {name} ..."), all_or_none(folder) as aside:
        save(figure(name, seed), aside / f"{name}.png")
