"""The command ``press`` of surfaces that stick: the end of an approach, with tension."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import typer

from roughcontact.cli.exits import MISSED
from roughcontact.cli.messages import plain
from roughcontact.cli.output import all_or_none, command_line, output
from roughcontact.cli.pressed import Pressed
from roughcontact.cli.profile_options import kinds_of
from roughcontact.cli.report import adhesive_facts, doing, emit, note_files, print_facts

if TYPE_CHECKING:
    from roughcontact.adhesion.adhesive_state import AdhesiveState
    from roughcontact.cli import options
    from roughcontact.cli.adhesion_options import Sticking

__all__ = ["press_sticking"]


def press_sticking(
    reading: options.Reading,
    given: Mapping[str, float],
    elasticity: options.Elasticity,
    sticking: Sticking,
    answer: options.Answer,
) -> None:
    """Press a surface that sticks to one depth or force; print it, and write it where a folder is given."""
    modulus, adhesion, tolerance = elasticity.reduced_modulus(), sticking.adhesion(), answer.residual
    [(name, value)] = given.items()
    with output(answer.out) as folder:
        surface = reading.surface()
        pressed = Pressed.of(surface, modulus, None)
        limits = {"operator": reading.body(surface, modulus), "tolerance": tolerance, "adhesion": adhesion}
        state = _press(surface, modulus, **given, **limits)
        with doing("Stability and files"):
            record = {
                "command": "press",
                "file": plain(str(reading.source.file)),
                "surface": list(surface.provenance),
                "kind": pressed.kind.value,
                **state.to_record(),
                "converged": state.status.converged,
            }
            if folder is not None:
                from roughcontact.files.provenance import provenance
                from roughcontact.files.write import write_json, write_netcdf
                from roughcontact.plot.canvas import save
                from roughcontact.plot.tension import state_figure

                unit = kinds_of(reading.profile)[name].unit
                source = provenance(
                    surface,
                    modulus=modulus,
                    control=f"{name} = {value!r} {unit}",
                    tolerance=tolerance,
                    command=command_line(),
                )
                with all_or_none(folder) as aside:
                    write_netcdf(state.to_dataset(), aside / "pressure.nc", source)
                    save(state_figure(state), aside / f"pressure.{answer.ending}")
                    write_json(record, aside / "press.json", source)
    if answer.json:
        emit(record)
    else:
        size, *others = adhesive_facts(state)
        print_facts([size, *pressed.facts(), *others])
    sticking.remark(unresolved=state.unresolved, ambiguous=any(jump.ambiguous for jump in state.jumps))
    note_files(folder, ("press.json", "pressure.nc", f"pressure.{answer.ending}"))
    if not state.status.converged:
        raise typer.Exit(MISSED)


def _press(surface: Any, modulus: float, **given: Any) -> AdhesiveState:
    """Return the state, the best that was reached where the tolerance was missed."""
    import roughcontact as rc

    cells = " x ".join(str(n) for n in surface.grid.shape)
    with doing(f"Pressing {cells} cells that stick"):
        try:
            state: AdhesiveState = rc.press(surface, modulus, **given)
        except rc.ConvergenceError as error:
            state = error.solution
    return state
