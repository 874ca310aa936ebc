"""The commands of the program and their modules; a job is done by the command of the same name."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from roughcontact.recipe.command import command_name

if TYPE_CHECKING:
    from roughcontact.cli.options import Answer
    from roughcontact.recipe.jobs import Job

__all__ = ["ADHESION", "ALONE", "STUDY", "SURFACE", "do"]

ALONE = {
    name: f"contact.{name}_command"
    for name in (
        "press",
        "leak",
        "shear",
        "joint",
        "curve",
        "creep",
        "sliding",
        "conductance",
        "theory",
        "infer",
    )
}
ALONE |= {name: f"{name}_command" for name in ("run", "serve", "doctor")}
ADHESION = {
    "press": "adhesion.adhesive_press_command",
    "curve": "adhesion.adhesive_curve_command",
    "loop": "adhesion.adhesive_curve_command",
    "detach": "adhesion.detachment_command",
}
SURFACE = {
    "info": "surface.surface_command",
    "make": "surface.surface_command",
    "specified": "surface.surface_command",
    "prepare": "surface.prepare_command",
    "spectrum": "surface.spectrum_command",
    "measurements": "surface.measurements_command",
}
STUDY = {
    "from": "study.study_from_command",
    "run": "study.study_command",
    "status": "study.study_command",
    "export": "study.study_command",
    "add": "study.study_command",
    "average": "study.averages_command",
    "plot": "study.averages_command",
    "table": "study.table_command",
}


def do(job: Job, answer: Answer) -> None:
    """Do a job of any kind: print the answer, write the files that `answer` names, and end with its status.

    Raises
    ------
    InputError
        If the job cannot be done; the place of the error is a field of the job.
    typer.Exit
        If a load missed its tolerance, or the work was interrupted.
    """
    group, _, name = command_name(job).rpartition(" ")
    module = {"": ALONE, "adhesion": ADHESION, "surface": SURFACE}[group][name]
    vars(import_module(f"roughcontact.cli.{module}"))[name](job, answer=answer)
