"""The program ``roughcontact``: its commands and its version."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from roughcontact.cli.added_commands import added_commands, refuse_missing
from roughcontact.cli.commands import ADHESION, ALONE, STUDY, SURFACE
from roughcontact.cli.late_group import late_group
from roughcontact.version import __version__

if TYPE_CHECKING:  # bundlers of programs follow imports that are written out
    from roughcontact.cli import (
        doctor_command as doctor_command,
        run_command as run_command,
        serve_command as serve_command,
    )
    from roughcontact.cli.adhesion import (
        adhesive_curve_command as adhesive_curve_command,
        adhesive_press_command as adhesive_press_command,
        detachment_command as detachment_command,
    )
    from roughcontact.cli.contact import (
        conductance_command as conductance_command,
        curve_command as curve_command,
        press_command as press_command,
        theory_command as theory_command,
    )
    from roughcontact.cli.study import (
        averages_command as averages_command,
        study_command as study_command,
        study_from_command as study_from_command,
        table_command as table_command,
    )
    from roughcontact.cli.surface import (
        prepare_command as prepare_command,
        spectrum_command as spectrum_command,
        surface_command as surface_command,
    )

__all__ = ["app"]

app = typer.Typer(
    name="roughcontact",
    cls=late_group(ALONE, added_commands, refuse_missing),
    help="Elastic contact of rough surfaces: certified pressure, area, stiffness and depth against load.",
    epilog="Quantities carry units: 10N, 110GPa, '1e-6 m'. A bare number is in SI units. "
    "Exit status: 0 every answer met its tolerance, 1 one missed it, 2 bad input, 70 a mistake in this program, "
    "130 interrupted, 143 terminated.",
    no_args_is_help=True,
    # A mistake of ours shows itself as Python shows it.
    pretty_exceptions_enable=False,
    rich_markup_mode="rich",
)
app.add_typer(
    typer.Typer(
        cls=late_group(ADHESION),
        help="Press surfaces that attract each other, elastic and without friction: states, curves, loops, detachment.",
        no_args_is_help=True,
    ),
    name="adhesion",
)
app.add_typer(
    typer.Typer(
        cls=late_group(SURFACE),
        help="Look at a surface file, make one, prepare or analyse it.",
        no_args_is_help=True,
    ),
    name="surface",
)
app.add_typer(
    typer.Typer(
        cls=late_group(STUDY),
        help="Run ensembles that can be stopped, continued and enlarged; average, draw and export them.",
        no_args_is_help=True,
    ),
    name="study",
)


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
