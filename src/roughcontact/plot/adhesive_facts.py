"""The main numbers of adhesive surfaces, line by line, for a screen and a notebook."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from roughcontact.labels.adhesive_columns import ADHESIVE_CURVE
from roughcontact.labels.column import names_of, shown_in
from roughcontact.plot.facts import closed_gap, quantity, size_of

if TYPE_CHECKING:
    from roughcontact.adhesion.adhesive_curve import AdhesiveCurve
    from roughcontact.adhesion.adhesive_state import AdhesiveState
    from roughcontact.adhesion.attraction import Adhesion
    from roughcontact.adhesion.quasi_static import Jump
    from roughcontact.halfspace.operators.geometry import Geometry

__all__ = ["ADHESIVE_COLUMNS", "adhesive_curve_facts", "adhesive_facts", "jump_facts", "law_facts", "tension"]

ADHESIVE_COLUMNS = names_of(shown_in("path", ADHESIVE_CURVE[("load",)]))
_JUMPS = 12  # listed one by one: those that lost most energy


def law_facts(
    adhesion: Adhesion, modulus: float, spacing: Sequence[float], summit_radius: float
) -> list[tuple[str, str]]:
    """Return the law of adhesion, Irwin's length with its number of cells, and Tabor's number."""
    zone = adhesion.process_zone(modulus)
    work = (
        "the work of each cell"
        if np.ndim(adhesion.work)
        else quantity("work_of_adhesion", float(adhesion.work))
    )
    stiff = ("reduced modulus E*", quantity("modulus", modulus))
    length = quantity("adhesion_range", adhesion.range)
    strength = quantity("pressure", adhesion.strength)
    return [
        stiff,
        ("adhesion", f"{adhesion.law}, {work} over {length}: at most {strength}"),
        ("Irwin's length", f"{quantity('spacing', zone)}, {zone / max(spacing):.3g} cells"),
        (
            "radius of the highest summit",
            f"{quantity('summit_radius', summit_radius)} (fitted paraboloid), Tabor's number "
            f"{adhesion.tabor(summit_radius, modulus):.2g}",
        ),
    ]


def adhesive_facts(state: AdhesiveState) -> list[tuple[str, str]]:
    """Return the main numbers of a state of adhesive surfaces, line by line."""
    problem, kind = state.problem, state.geometry
    grid = problem.operator.grid
    met = "met" if state.status.converged else "MISSED"
    energies = [quantity(name, getattr(state, name), kind) for name in ("elastic_energy", "adhesive_energy")]
    return [
        ("surface", size_of(grid)),
        *law_facts(problem.adhesion, problem.modulus, grid.spacing, state.summit_radius),
        ("force", quantity("force", state.force, kind)),
        ("nominal pressure", quantity("pressure", state.nominal_pressure, kind)),
        ("largest pressure", quantity("pressure", state.max_pressure, kind)),
        ("largest tension", quantity("pressure", state.max_tension, kind)),
        ("depth", quantity("depth", state.depth, kind)),
        ("stiffness along the branch", quantity("stiffness", state.stiffness, kind)),
        ("stiffness, attraction fixed", quantity("stiffness", state.contact_stiffness, kind)),
        ("contact area", quantity("contact_area", state.contact_area, kind)),
        ("relative contact area A/A0", f"{state.contact_fraction:.4g}"),
        ("mean gap", quantity("mean_gap", float(closed_gap(state.mean_gap, state.depth)), kind)),
        ("elastic and adhesive energy", " and ".join(energies)),
        (
            "stability",
            f"at most {state.stability:.3g}, residual {state.stability_residual:.0e} "
            "(1 without attraction, 0 at a jump)",
        ),
        ("certificate", f"{state.residual:.1e} (tolerance {problem.tolerance:.0e}: {met})"),
    ]


def adhesive_curve_facts(loop: AdhesiveCurve) -> list[tuple[str, str]]:
    """Return the main numbers of a path of adhesive surfaces, line by line."""
    kind = loop.geometry
    facts = []
    if not math.isnan(loop.jump_in_force):
        facts.append(("jump-in force", tension(loop.jump_in_force, kind)))
    if not loop.approach.all():
        words = "pull-off force" if loop.contact_area[-1] == 0 else "largest tension on retreat"
        at = loop.pull_off_point
        depth = "" if at is None else f" at a depth of {quantity('depth', loop.lowest_force_depth[at], kind)}"
        facts.append((words, tension(loop.pull_off_force, kind) + depth))
    lost = math.fsum(jump.lost for jump in loop.jumps if math.isfinite(jump.lost))
    facts.append(("energy lost in jumps", quantity("lost_energy", lost, kind)))
    return [
        *facts,
        *jump_facts(loop.jumps, kind),
        ("largest certificate", f"{loop.residual.max():.1e}"),
    ]


def tension(force: float, kind: Geometry) -> str:
    """Return the size of a force [N], positive in tension, with the word for its sign."""
    return f"{quantity('pull_off_force', abs(force), kind)} in {'compression' if force < 0 else 'tension'}"


def jump_facts(jumps: Sequence[Jump], kind: Geometry) -> list[tuple[str, str]]:
    """Return one line for each of the jumps that lost most energy, in their order, and the number of the others."""
    if not jumps:
        return [("jumps", "none")]
    listed = sorted(sorted(range(len(jumps)), key=lambda k: -jumps[k].lost)[:_JUMPS])
    lines = [_jump_line(jumps[k], kind) for k in listed]
    if others := len(jumps) - len(listed):
        lines.append(f"{others} that lost less")
    return [
        ("" if k else f"{len(jumps)} jump{'s' if len(jumps) > 1 else ''}", line)
        for k, line in enumerate(lines)
    ]


def _jump_line(jump: Jump, kind: Geometry) -> str:
    at = f"{'in' if jump.approach else 'out'} at {quantity('depth', jump.depth)}"
    before = quantity("force", jump.force_before, kind)
    if math.isnan(jump.depth_after):
        return f"off at {quantity('depth', jump.depth)}, {before}: nothing stops it"
    to = quantity("force", jump.force_after, kind)
    if abs(jump.depth_after - jump.depth) > 2 * jump.bracket:  # under a force
        words = f"{at} to {quantity('depth', jump.depth_after)}, under {before}"
    else:
        words = f"{at}, {before} to {to}"
    return f"{words}, {quantity('jump_lost', jump.lost, kind)} lost" + (
        ", ambiguous" if jump.ambiguous else ""
    )
