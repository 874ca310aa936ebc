"""The commands ``adhesion curve`` and ``adhesion loop``: approach and retreat of surfaces that stick, with jumps."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roughcontact.cli import options
from roughcontact.cli.adhesion.adhesion_options import AdhesionLaw, note_long_range, note_unresolved
from roughcontact.cli.load_options import AdhesiveLoads, unit_of_loads
from roughcontact.cli.messages import note, reported
from roughcontact.cli.option_groups import option
from roughcontact.cli.output import output
from roughcontact.cli.path_answer import PathAnswer, collected
from roughcontact.cli.report import ADHESIVE_COLUMNS, adhesive_curve_facts, law_facts
from roughcontact.cli.unit_options import LENGTH, parse

if TYPE_CHECKING:
    from roughcontact.adhesion.attraction import Adhesion
    from roughcontact.solver.loads import Loads

__all__ = ["EXAMPLES", "curve", "loop"]

EXAMPLES = {
    "curve": """
roughcontact adhesion curve part.x3p --depths -20nm:40nm:4,-20nm --modulus 1GPa --work 10mJ/m^2 --range 20nm
roughcontact adhesion curve part.x3p --forces 1mN,0N,-1mN --modulus 1GPa --work 10mJ/m^2 --range 50nm --out result
roughcontact adhesion curve part.x3p --mean-gaps 0.3um,0.2um --periodic --modulus 1GPa --work 10mJ/m^2 --range 20nm
""",
    "loop": """
roughcontact adhesion loop part.x3p --depth 50nm --points 8 --modulus 1GPa --work 10mJ/m^2 --range 20nm --out result
roughcontact adhesion loop part.x3p --depth 20nm --points 5 --modulus 1GPa --work 10mJ/m^2 --range 50nm --json
""",
}

_PANEL = "Loads"
_TURN: str = option(
    "Indentation depth at which the retreat begins; it may be negative.",
    "20nm",
    default=...,
    rich_help_panel=_PANEL,
)
_POINTS: int = option(
    "Even steps in depth of the approach; the retreat has the same steps.",
    "N",
    default=40,
    min=2,
    max=10_000,
    rich_help_panel=_PANEL,
)


def curve(
    reading: options.Reading,
    *,
    loads: AdhesiveLoads,
    elasticity: options.Elasticity,
    law: AdhesionLaw,
    answer: options.Answer,
) -> None:
    """Bring a surface that sticks to one load after the other, up and down: force, area and stiffness, and the jumps.

    States depend on the history: approach and retreat differ. Ctrl-C keeps what is done; a path cannot be resumed.
    """
    with reported(reading.source.file, answer.out, as_json=answer.json):
        wanted = loads.values(reading.profile)
        values = ", ".join(f"{load:g}" for load in wanted.values)
        control = f"{wanted.kind}s {values} {unit_of_loads(wanted, reading.profile)}"
        _answer("curve", reading, elasticity, law.adhesion(), answer, wanted, control)


def loop(
    reading: options.Reading,
    *,
    depth: str = _TURN,
    points: int = _POINTS,
    elasticity: options.Elasticity,
    law: AdhesionLaw,
    answer: options.Answer,
) -> None:
    """Bring a surface that sticks to a depth and back until it is off: pull-off force, jumps and the lost energy.

    The approach begins ten ranges of the attraction apart.
    """
    with reported(reading.source.file, answer.out, as_json=answer.json):
        from roughcontact.adhesion.adhesive_loop import loop_depths
        from roughcontact.solver.loads import Loads

        turn, adhesion = parse(depth, LENGTH, "--depth"), law.adhesion()
        wanted = Loads("depth", loop_depths(adhesion, turn, points))
        control = f"loop to a depth of {turn:g} m in {points} steps"
        _answer("loop", reading, elasticity, adhesion, answer, wanted, control, points)


def _answer(
    command: str,
    reading: options.Reading,
    elasticity: options.Elasticity,
    adhesion: Adhesion,
    asked: options.Answer,
    loads: Loads,
    control: str,
    points: int | None = None,
) -> None:
    """Follow loads, or a loop with `points` on its approach; print what was found, and write it where asked."""
    from roughcontact.adhesion.adhesive_curve import collect_states
    from roughcontact.adhesion.adhesive_loading import followed, states_under
    from roughcontact.adhesion.adhesive_loop import until_off
    from roughcontact.plot.jumps import jump_figure
    from roughcontact.solver.loads import Loads

    with output(asked.out) as folder:
        surface, modulus = reading.surface(), elasticity.reduced_modulus()
        note_long_range(adhesion, surface)
        states = states_under(
            surface, modulus, adhesion, loads, reading.body(surface, modulus), asked.residual
        )
        if points is None:
            states, total = followed(states, loads), loads.values.size
        else:
            states, total, loads = until_off(states, points), None, Loads("depth", loads.values[1:])
        found, whole = collected(states, lambda states: collect_states(states, loads))
        file = reading.source.file
        stem = f"adhesive_{command}"
        path = PathAnswer(command, file, surface, found, whole, stem, f"{stem}_jumps", found.converged)
        if folder is not None:
            path.write(folder, control, jump_figure, asked.ending)
    law = law_facts(adhesion, modulus, surface.grid.spacing)
    path.show(ADHESIVE_COLUMNS, law, adhesive_curve_facts(found), json=asked.json)
    note_unresolved(found.unresolved)
    if found.ambiguous:
        note(
            "a jump is ambiguous: two integrations of the flow after it ended in different states, of which one is "
            "given"
        )
    path.end(folder, asked.ending, total)
