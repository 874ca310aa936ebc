"""The program ``roughcontact``: its commands and its version."""

from __future__ import annotations

from typing import Annotated

import typer

from roughcontact import __version__
from roughcontact.cli import (
    averages_command as averages,
    conductance_command as conductance,
    curve_command as curve,
    prepare_command as prepare,
    press_command as press,
    serve_command as serve,
    spectrum_command as spectrum,
    study_command as study,
    surface_command as surface,
    thesis_command as thesis,
)
from roughcontact.cli.option_groups import grouped

__all__ = ["app"]


def _examples(text: str) -> str:
    """Return lines of examples as paragraphs under a heading."""
    lines = text.split("\n")[1:-1]
    return "\n\n".join(["Examples:" if len(lines) > 1 else "Example:", *lines])


app = typer.Typer(
    name="roughcontact",
    help="Elastic contact of rough surfaces: certified pressure, area, stiffness and depth against load.",
    epilog="Quantities carry units: 10N, 110GPa, '1e-6 m'. A bare number is in SI units. "
    "Exit status: 0 every answer met its tolerance, 1 one missed it, 2 bad input, 70 a mistake in this program, "
    "130 interrupted, 143 terminated.",
    no_args_is_help=True,
    add_completion=False,
    # A mistake of ours shows itself as Python shows it.
    pretty_exceptions_enable=False,
    rich_markup_mode="rich",
)
_surface = typer.Typer(help="Look at a surface file, make one, prepare or analyse it.", no_args_is_help=True)
_study = typer.Typer(
    help="Run ensembles that can be stopped, continued and enlarged; average, draw and export them.",
    no_args_is_help=True,
)

app.command(epilog=_examples(press.EXAMPLES))(grouped(press.press))
app.command(epilog=_examples(curve.EXAMPLES))(grouped(curve.curve))
app.command(epilog=_examples(conductance.EXAMPLES))(grouped(conductance.conductance))
app.add_typer(_surface, name="surface")
_surface.command(epilog=_examples(surface.INFO_EXAMPLES))(grouped(surface.info))
_surface.command(epilog=_examples(surface.MAKE_EXAMPLES))(grouped(surface.make))
_surface.command(epilog=_examples(prepare.EXAMPLES))(grouped(prepare.prepare))
_surface.command(epilog=_examples(spectrum.EXAMPLES))(grouped(spectrum.spectrum))
app.add_typer(_study, name="study")
_study.command(epilog=_examples(study.RUN_EXAMPLES))(grouped(study.run))
_study.command(epilog=_examples(study.STATUS_EXAMPLES))(grouped(study.status))
_study.command(epilog=_examples(study.EXPORT_EXAMPLES))(grouped(study.export))
_study.command(epilog=_examples(study.ADD_EXAMPLES))(grouped(study.add))
_study.command(epilog=_examples(averages.AVERAGE_EXAMPLES))(grouped(averages.average))
_study.command(epilog=_examples(averages.PLOT_EXAMPLES))(grouped(averages.plot))
_study.command(epilog=_examples(averages.TABLE_EXAMPLES))(grouped(averages.table))
app.command(epilog=_examples(serve.EXAMPLES))(grouped(serve.serve))
app.command(epilog=_examples(thesis.EXAMPLES))(grouped(thesis.thesis))


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
