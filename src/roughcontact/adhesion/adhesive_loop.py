"""Whole loops of approach and retreat of adhesive surfaces."""

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

BEGIN = 10.0  # ranges of the attraction: gap at which the recorded approach begins
MOST = 100  # times the points of the approach: a retreat ends after as many at the latest


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
    """Return a whole loop: from beyond the attraction to a depth, and back until the bodies are apart.

    Parameters
    ----------
    surface : Surface or RadialProfile
        Heights [m], see `adhesive_state`.
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or the bodies that it follows from.
    adhesion : Adhesion
        Work, range and law.
    depth : float
        Depth at which the retreat begins [m].
    points : int
        Number of steps of the approach, from a gap of ten ranges of the attraction to the depth, which is an additional
        point; the retreat has the same steps.
    operator : Operator, optional
        A body other than the half-space on the surface's grid, see `press`; not a foundation.
    tolerance : float
        Largest residual; see `AdhesiveState`.

    Returns
    -------
    AdhesiveCurve
        The numbers of every state, and the jumps. Fields are not kept, see `adhesive_path`.

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
    """Return the depths of an approach and of a retreat by the same steps, farther than any retreat goes [m].

    The first depth is beyond the attraction, so that no jump is missed; it is not a point of the loop.

    Raises
    ------
    ValueError
        If the approach has no points, or would begin beyond its end.
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
    """Yield the states of a loop along `loop_depths` except the first, until the retreat has separated the bodies."""
    with task("Approach and retreat", unit="states") as loop:
        for k, state in enumerate(islice(path, 1, None)):
            if loop is not None:
                loop.advance()
            yield state
            reach = state.problem.adhesion.range
            off = not state.contact.any() and float(state.gap.min()) > BEGIN * reach
            if k > points and (off or state.depth < -50 * REACH * reach):
                break
