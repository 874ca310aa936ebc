"""The law of an interface under shear as a table: cycles at given pressures and amplitudes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.joints.shear_law import ShearLaw
from roughcontact.labels.labelled import dataset_of, variable
from roughcontact.labels.shear_columns import BY_SLIP, SHEAR, SHEAR_SCALES
from roughcontact.validation import Array, numeric, positive, require

if TYPE_CHECKING:
    import xarray

    from roughcontact.joints.slip_cycle import SlipCycle

__all__ = ["shear_dataset"]

_ROUNDING = 1e-12  # of a pressure that exceeds the law by rounding


@numeric(pressures="Pa")
def shear_dataset(
    law: ShearLaw,
    pressures: ArrayLike,
    amplitudes: Sequence[float] | Array,
    *,
    cycles: Sequence[SlipCycle] = (),
) -> xarray.Dataset:
    """Return stiffness, displacement, loss and damping of cycles at every pressure and every amplitude.

    Parameters
    ----------
    law : ShearLaw
    pressures : array, shape (p,)
        Nominal pressures [Pa].
    amplitudes : array, shape (a,)
        Amplitudes of the tangential traction as shares of mu p, up to 1.
    cycles : sequence of SlipCycle, optional
        Computed cycles at some of these pressures and amplitudes, to compare with the law.

    Returns
    -------
    xarray.Dataset
        Variables with units and long names along ``load``: p x a cycles, with all amplitudes at the first pressure
        first. The loss is NaN if only single cells slip.

    Raises
    ------
    ValueError
        If a pressure or an amplitude is out of range.

    Examples
    --------
    >>> import roughcontact as rc
    >>> curve = rc.loading_curve(rc.examples.surface("ground"), ("steel", "steel"), pressures=[1e6, 1e7, 3e7, 1e8])
    >>> found = rc.shear_dataset(rc.shear_law(curve, ("steel", "steel"), friction=0.2), [3e7, 5e7], [0.5, 0.9])
    >>> found.sizes["load"], found["cycle_loss"].attrs["units"]
    (4, 'J m-2')
    """
    given = positive(pressures, "the nominal pressure [Pa]"), positive(amplitudes, "the amplitude")
    p, share = (each.ravel() for each in np.meshgrid(*given, indexing="ij"))
    end = law.normal.highest
    require(
        p <= end * (1 + _ROUNDING),
        f"the law of this curve ends at {end:g} Pa",
        "give lower pressures",
        place="pressures",
        value=p,
    )
    traction = share * law.friction * p
    displacement, stiffness = law.displacement(traction, p), law.stiffness(p)
    loss = np.full_like(p, math.nan)
    for k, (pressure, tau) in enumerate(zip(p.tolist(), traction.tolist(), strict=True)):
        if share[k] >= law.smallest_share(pressure):
            loss[k] = law.loss(pressure, traction=tau)
    damping = loss / (2 * math.pi * traction * displacement)
    normal = law.normal.stiffness_at(p)
    values = (p, normal, stiffness, law.gross_slip(p), share, displacement, loss, damping)
    found = dict(zip(SHEAR, values, strict=True))
    by_slip = np.full((len(BY_SLIP), len(p)), math.nan)
    for cycle in cycles:
        k = int(np.argmin(abs(p / cycle.pressure - 1) + abs(traction / cycle.loop.traction[0] - 1)))
        computed = np.array(
            [cycle.tangential_stiffness_per_area, cycle.loop.displacement[0], cycle.loop.loss]
        )
        by_law = np.array([stiffness[k], displacement[k], loss[k]])
        by_slip[:, k] = [*computed, *(by_law / computed - 1), cycle.slip_fraction]
    if cycles:
        found |= dict(zip(BY_SLIP, by_slip, strict=True))
    data = {column.name: variable(column.name, ("load",), each) for column, each in found.items()}
    scales = zip(SHEAR_SCALES, (law.friction, law.ratio), strict=True)
    data |= {column.name: variable(column.name, (), each) for column, each in scales}
    notes = list(law.notes)
    if few := int(np.isnan(loss).sum()):
        notes.append(
            f"{few} of {len(p)} cycles have no loss: at their amplitudes, only single cells of the map slip."
        )
    title = "cycles of an interface under shear, per nominal area"
    return dataset_of(data, {}, title, Geometry.SURFACE).assign_attrs(notes="\n".join(notes))
