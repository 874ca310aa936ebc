"""Whole loops of approach and retreat of surfaces that stick."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roughcontact.adhesion.attraction import Adhesion
from roughcontact.adhesion.gradient_flow import REACH
from roughcontact.adhesion.quasi_static import Jump
from roughcontact.contact.loading import loading_path
from roughcontact.contact.problem import Body
from roughcontact.halfspace.operators.operator import Operator
from roughcontact.material import Solid
from roughcontact.validation import Array, Mask, numeric, require, shown, whole

__all__ = ["AdhesiveLoop", "adhesive_loop"]

MOST = 100  # as many points as on the approach, after which a retreat ends


@dataclass(frozen=True, slots=True, eq=False)
class AdhesiveLoop:
    """An approach and a retreat under prescribed depth; made by `adhesive_loop`.

    Attributes
    ----------
    depth : array, shape (n,)
        [m], in the order of the path.
    force : array, shape (n,)
        [N], tension negative; on a line [N/m].
    contact_area : array, shape (n,)
        [m^2]; on a line [m].
    energy : array, shape (n,)
        Elastic and adhesive energy [J].
    residual : array, shape (n,)
        The certificate of each state.
    approach : array of bool, shape (n,)
        Whether the depth was growing.
    jumps : tuple of Jump
        Every instability, in order.
    unresolved : bool
        Whether the attraction varies from cell to cell, so that the lattice traps the states.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings)
    >>> loop = rc.adhesive_loop(ball, 1e8, rc.Adhesion(work=10e-3, range=2.5e-9), depth=10e-9)
    >>> f"pulled off at {loop.pull_off_force * 1e9:.0f} nN, {loop.lost * 1e18:.0f} aJ are lost", loop.ambiguous
    ('pulled off at 495 nN, 478 aJ are lost', False)
    """

    depth: Array
    force: Array
    contact_area: Array
    energy: Array
    residual: Array
    approach: Mask
    jumps: tuple[Jump, ...]
    unresolved: bool

    @property
    def pull_off_force(self) -> float:
        """Largest tension of the retreat [N], positive, at the points and at the jumps."""
        back = self.force[~self.approach]
        jumps = [jump.force_before for jump in self.jumps if not jump.approach]
        return -float(min(0.0, *back.tolist(), *jumps))

    @property
    def jump_in_force(self) -> float:
        """Tension from which the body first jumped on the approach [N], positive; NaN if it never did."""
        return next((-jump.force_before for jump in self.jumps if jump.approach), math.nan)

    @property
    def lost(self) -> float:
        """Energy lost in all jumps [J]: the area of the loop, if it is closed."""
        return math.fsum(jump.lost for jump in self.jumps)

    @property
    def ambiguous(self) -> bool:
        """Whether two integrations of the flow after a jump ended in different states."""
        return any(jump.ambiguous for jump in self.jumps)


@numeric
def adhesive_loop(
    surface: Body,
    modulus: float | Solid | tuple[Solid, Solid],
    adhesion: Adhesion,
    *,
    depth: float,
    points: int = 40,
    operator: Operator | None = None,
    tolerance: float = 1e-8,
) -> AdhesiveLoop:
    """Return a whole loop: from beyond the attraction to a depth, and back until the body is off.

    Parameters
    ----------
    surface : Surface or RadialProfile
        Heights [m], see `press`.
    modulus : float, Solid or pair of Solids
        Reduced modulus E* [Pa], or what it follows from.
    adhesion : Adhesion
        Work, range and law.
    depth : float
        Where the body turns back [m].
    points : int
        Of the approach, from ten ranges of the attraction apart; the retreat has the same steps.
    operator : Operator, optional
        Another body than the half-space on the surface's grid, see `press`.
    tolerance : float
        Largest residual; see `AdhesiveState`.

    Returns
    -------
    AdhesiveLoop
        Numbers of every state, and the jumps. States themselves are not kept, see `loading_path`.

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
    'pull-off 1.62 pi w R'
    """
    count = whole(int(points), "points")
    require(isinstance(adhesion, Adhesion), f"an Adhesion is wanted, not {shown(adhesion)}")
    near = -10 * adhesion.range
    require(depth > near, f"the depth must be above {near:.3g} m, ten ranges of the attraction apart", depth)
    step = (depth - near) / count
    there = [near + step * k for k in range(count)] + [depth]
    back = [depth - step * k for k in range(1, count * MOST)]
    far = -REACH * adhesion.range
    rows: list[tuple[float, ...]] = []
    jumps: list[Jump] = []
    path = loading_path(
        surface,
        modulus,
        depths=[far, *there, *back],
        operator=operator,
        tolerance=tolerance,
        adhesion=adhesion,
    )
    next(path)  # jumps on the way from where nothing attracts count, too
    for k, state in enumerate(path):
        rows.append((state.depth, state.force, state.contact_area, state.energy, state.residual))
        jumps += state.jumps
        off = not state.contact.any() and float(state.gap.min()) > -near
        if k > count and (off or state.depth < 50 * far):
            break
    depths, forces, areas, energies, residuals = np.array(rows).T
    approach = np.arange(len(rows)) <= count
    return AdhesiveLoop(depths, forces, areas, energies, residuals, approach, tuple(jumps), state.unresolved)
