"""The program ``roughcontact``: its verbs, its version, its way out."""

from __future__ import annotations

import io
import sys
from typing import Annotated

import typer

from roughcontact import __version__
from roughcontact.cli import curve, press, surface
from roughcontact.cli.errors import INTERRUPTED

__all__ = ["app", "run"]

app = typer.Typer(
    name="roughcontact",
    help="Elastic contact of rough surfaces: certified pressure, area, stiffness and depth against load.",
    epilog="Quantities carry units: 10N, 110GPa, '1e-6 m'. A bare number is in SI units. "
    "Exit status: 0 every answer met its tolerance, 1 one missed it, 2 bad input, 130 interrupted.",
    no_args_is_help=True,
    add_completion=False,
    # A mistake of ours shows itself as Python shows it.
    pretty_exceptions_enable=False,
    rich_markup_mode="rich",
)
_surface = typer.Typer(help="Look at a surface file, or make one.", no_args_is_help=True)

app.command(epilog=press.EXAMPLES)(press.press)
app.command(epilog=curve.EXAMPLES)(curve.curve)
app.add_typer(_surface, name="surface")
_surface.command(epilog=surface.INFO_EXAMPLES)(surface.info)
_surface.command(epilog=surface.MAKE_EXAMPLES)(surface.make)


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"roughcontact {__version__}")
        raise typer.Exit


@app.callback()
def _main(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Show the version and exit.")
    ] = False,
) -> None:
    pass


def run() -> None:
    """Run the program."""
    for stream in (sys.stdout, sys.stderr):
        # A terminal or pipe that cannot show a letter gets a question mark, not a crash.
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")
    try:
        app(prog_name="roughcontact")
    except KeyboardInterrupt:  # between two verbs' worth of imports
        sys.exit(INTERRUPTED)
