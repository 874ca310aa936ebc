"""The program ``roughcontact``: its commands and its version."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from roughcontact.cli.added_commands import added_commands, refuse_missing
from roughcontact.cli.commands import ADHESION, ALONE, STUDY, SURFACE
from roughcontact.cli.late_group import late_group
from roughcontact.cli.option_groups import HELP_ALL_OPTION
from roughcontact.version import __version__

if TYPE_CHECKING:  # tools that bundle programs follow only imports that are written out
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
        creep_command as creep_command,
        curve_command as curve_command,
        infer_command as infer_command,
        joint_command as joint_command,
        leak_command as leak_command,
        press_command as press_command,
        shear_command as shear_command,
        sliding_command as sliding_command,
        theory_command as theory_command,
    )
    from roughcontact.cli.study import (
        averages_command as averages_command,
        study_command as study_command,
        study_from_command as study_from_command,
        table_command as table_command,
    )
    from roughcontact.cli.surface import (
        measurements_command as measurements_command,
        prepare_command as prepare_command,
        spectrum_command as spectrum_command,
        surface_command as surface_command,
    )

__all__ = ["app"]

app = typer.Typer(
    name="roughcontact",
    cls=late_group(ALONE, added_commands, refuse_missing),
    help="Elastic contact of rough surfaces: certified pressure, area, stiffness and depth against load.",
    epilog="Quantities carry units: 10N, 110GPa, '1e-6 m'. A bare number is in SI units, except --at of a study. "
    "Exit status: 0 every answer met its tolerance, 1 an answer missed it, 2 bad input, 70 a mistake in this program, "
    "130 interrupted, 143 terminated.",
    no_args_is_help=True,
    context_settings={"help_option_names": ["--help", "-h"]},
    # Python prints the traceback of a defect of ours.
    pretty_exceptions_enable=False,
    rich_markup_mode="rich",
)
_GROUPS = (
    (
        "adhesion",
        ADHESION,
        "Press adhesive surfaces, elastic and without friction: states, curves, loops, detachment.",
    ),
    ("surface", SURFACE, "Inspect, make, prepare or analyse a surface file."),
    (
        "study",
        STUDY,
        "Run ensembles that can be stopped, continued and enlarged; average, draw and export them.",
    ),
)


def _group(help_all: bool = HELP_ALL_OPTION) -> None:
    pass


for _name, _commands, _help in _GROUPS:
    app.add_typer(
        typer.Typer(cls=late_group(_commands), callback=_group, help=_help, no_args_is_help=True), name=_name
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
    help_all: bool = HELP_ALL_OPTION,
) -> None:
    pass
