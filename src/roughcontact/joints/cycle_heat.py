"""The heat of a cycle of shear in each cell, from two frictionless contacts."""

from __future__ import annotations

from roughcontact.arrays import namespace
from roughcontact.contact.solution import Solution
from roughcontact.errors import InputError
from roughcontact.joints.shear_law import ShearLaw
from roughcontact.validation import Array

__all__ = ["cycle_heat"]


def cycle_heat(law: ShearLaw, solution: Solution, held: Solution) -> Array:
    """Return the energy that friction dissipates in a cycle in each cell, per area, from two pressed contacts.

    It is ``4 mu^2 C p(x; P) g(x; P - Q/mu)``: in a half of the cycle each cell slips by twice ``mu C`` times the gap
    of the contact at the smaller force, under the traction mu p. Ciavarella, Int. J. Solids Struct. 35, 2349 (1998);
    Jaeger, Arch. Appl. Mech. 68, 27 (1998). Exact where the law is exact.

    Parameters
    ----------
    law : ShearLaw
        The law of the interface: its friction and its ratio E*/G*.
    solution : Solution
        The contact at the normal force P.
    held : Solution
        The contact of the same surface at the force P - Q/mu, which holds while the amplitude Q of the cycle acts.

    Returns
    -------
    array, shape (ny, nx)
        Energy of a cycle per area of the cell [J/m^2]; zero outside the contact.

    Raises
    ------
    ValueError
        If the contacts have different grids, or the second force is larger.

    Examples
    --------
    >>> import roughcontact as rc
    >>> bodies = (rc.Solid(2e9, 0.0), rc.Solid(2e9, 0.0))
    >>> grid = rc.Grid((32, 32), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, short_cutoff=4e-6)
    >>> curve = rc.loading_curve(surface, bodies, pressures=[1e6, 2e6, 4e6, 8e6])
    >>> law = rc.shear_law(curve, bodies, friction=0.3)
    >>> states = [rc.press(surface, bodies, pressure=pressure) for pressure in (8e6, 4e6)]
    >>> f"{rc.cycle_heat(law, *states).mean() * 1e3:.2f} mJ/m^2 at half of the sliding force"
    '6.83 mJ/m^2 at half of the sliding force'
    """
    if held.problem.grid != solution.problem.grid or held.force > solution.force:
        raise InputError(
            "the heat follows from two contacts of the same grid, the second at a force P - Q/mu that is not larger",
            "press the same surface at both forces",
            "solution, held",
        )
    slip: Array = namespace(solution.pressure).where(solution.contact, held.flattened.gap, 0.0)
    return 4 * law.friction**2 * law.ratio * solution.pressure * slip
