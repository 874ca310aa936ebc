"""Whole loops of approach and retreat of surfaces that stick."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import islice

import numpy as np

from roughcontact.adhesion.adhesive_curve import AdhesiveCurve, collect_states
from roughcontact.adhesion.adhesive_loading import states_under
from roughcontact.adhesion.adhesive_state import AdhesiveState
from roughcontact.adhesion.attraction import REACH, Adhesion
from roughcontact.contact.problem import Body
from roughcontact.halfspace.operators.operator import Operator
from roughcontact.materials import Modulus
from roughcontact.progress.events import task
from roughcontact.solver.loads import Loads
from roughcontact.validation import Array, numeric, require, whole

__all__ = ["adhesive_loop", "loop_depths", "until_off"]

BEGIN = 10.0  # ranges of the attraction, from which an approach is recorded
MOST = 100  # as many points as on the approach, after which a retreat ends


@numeric(modulus="Pa", depth="m")
def adhesive_loop(
    surface: Body,
    modulus: Modulus,
    adhesion: Adhesion,
    *,
    depth: float,
    points: int = 40,
    operator: Operator | None = None,
    tolerance: float = 1e-8,
) -> AdhesiveCurve:
    """Return a whole loop: from beyond the attraction to a depth, and back until the body is off.

    Parameters
    ----------
    surface : Surface or RadialProfile
        Heights [m], see `adhesive_state`.
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or what it follows from.
    adhesion : Adhesion
        Work, range and law.
    depth : float
        Where the body turns back [m].
    points : int
        Steps of the approach, from ten ranges of the attraction apart to the depth, which is a point of its own; the
        retreat has the same steps.
    operator : Operator, optional
        Another body than the half-space on the surface's grid, see `press`; no foundation.
    tolerance : float
        Largest residual; see `AdhesiveState`.

    Returns
    -------
    AdhesiveCurve
        Numbers of every state, and the jumps. States themselves are not kept, see `adhesive_path`.

    Raises
    ------
    ValueError
        If the input makes no sense.

    Examples
    --------
    >>> import math
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-rings.radii**2 / 2e-5, rings)
    >>> adhesion = rc.Adhesion(work=10e-3, range=4e-9)
    >>> loop = rc.adhesive_loop(ball, 1e8, adhesion, depth=10e-9)
    >>> f"pull-off {loop.pull_off_force / (math.pi * 10e-3 * 1e-5):.2f} pi w R"
    'pull-off 1.63 pi w R'
    """
    loads = Loads("depth", loop_depths(adhesion, depth, points))
    path = states_under(surface, modulus, adhesion, loads, operator, tolerance)
    return collect_states(until_off(path, points), Loads("depth", loads.values[1:]))


def loop_depths(adhesion: Adhesion, depth: float, points: int) -> Array:
    """Return the depths of an approach and of a retreat by the same steps, further than any retreat goes [m].

    The first, where nothing attracts, is no point of the loop: from there on every jump is met.

    Raises
    ------
    ValueError
        If the approach has no point, or would begin beyond its end.
    """
    count, begin = whole(int(points), "points"), -BEGIN * adhesion.range
    require(
        depth > begin,
        f"the depth must be above {begin:.3g} m, ten ranges of the attraction apart",
        value=depth,
        place="depth",
    )
    step = (depth - begin) / count
    there = [-REACH * adhesion.range, *(begin + step * k for k in range(count)), depth]
    return np.array(there + [depth - step * k for k in range(1, count * MOST)])


def until_off(path: Iterable[AdhesiveState], points: int) -> Iterator[AdhesiveState]:
    """Yield the states of a loop along `loop_depths` but the first, until its body is off on the retreat."""
    with task("Approach and retreat", unit="states") as loop:
        for k, state in enumerate(islice(path, 1, None)):
            if loop is not None:
                loop.advance()
            yield state
            reach = state.problem.adhesion.range
            off = not state.contact.any() and float(state.gap.min()) > BEGIN * reach
            if k > points and (off or state.depth < -50 * REACH * reach):
                break
