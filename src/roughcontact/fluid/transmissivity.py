"""The transmissivity of each state of a curve, and the leak rates that follow from it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from roughcontact.contact.measures import MeasuredCurve
from roughcontact.contact.solution import Solution
from roughcontact.errors import InputError, about
from roughcontact.fluid.fluids import Liquid
from roughcontact.fluid.gap_flow import gap_flow
from roughcontact.fluid.open_gap import Missing
from roughcontact.theory.joints.leakage import bruggeman
from roughcontact.validation import Array, Mask, exactly_one, numeric, positive_scalar

__all__ = ["Transmissivity", "leak_rates"]


@dataclass(frozen=True, eq=False)
class Transmissivity:
    """A measure for `loading_curve`: what flows through the gap at each load, in columns of the curve.

    The columns are ``transmissivity`` [m^3], ``hydraulic_gap`` [m], ``flow_factor`` (transmissivity over the cubed mean
    gap, Patir and Cheng), ``percolates`` (1 or 0), ``constriction_cells``, ``constriction_share``,
    ``transmissivity_bruggeman`` [m^3] (theory) and ``flow_residual``. Where no open path leads along the axis, the
    share is NaN and all other columns except the theory are 0. Under a hardness the mean gap counts cells that have
    flowed as negative: where it is not positive, the flow factor is infinite.

    Parameters
    ----------
    axis : {0, 1}, optional
        Axis of the flow: from side to side of a free map; of a periodic map, an axis of its tensor.
    between : tuple of two bool arrays, shape of the grid, optional
        Regions at the higher and at the lower pressure in place of the axis, see `gap_flow`. Their shape is then a part
        of the transmissivity; hydraulic gap, flow factor and theory are NaN.
    missing : {"closed", "open"}
        Whether a cell without a height is closed or wide open.

    Raises
    ------
    ValueError
        If there are not exactly one of the axis, 0 or 1, and the regions; or, at the first load, if `gap_flow` refuses
        the state.

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, rolloff=32e-6, short_cutoff=8e-6)
    >>> curve = rc.loading_curve(surface, 1e9, pressures=[1e6, 4e6, 16e6], measures=[rc.Transmissivity(axis=0)])
    >>> [f"{gap * 1e9:.0f} nm" for gap in curve.measured["hydraulic_gap"]], curve.measured["percolates"].tolist()
    (['100 nm', '14 nm', '0 nm'], [1.0, 1.0, 0.0])
    """

    axis: Literal[0, 1] | None = None
    between: tuple[Mask, Mask] | None = None
    missing: Missing = "closed"

    def __post_init__(self) -> None:
        exactly_one(axis=self.axis, between=self.between)
        if self.axis not in (None, 0, 1):
            raise about("the axis", f"must be 0 or 1, not {self.axis!r}")

    def __call__(self, solution: Solution) -> dict[str, float]:
        """Return the columns of a state by name."""
        between = self.between is not None
        tensor = all(solution.problem.grid.periodic) and not between
        axis = None if tensor else self.axis
        flow = gap_flow(solution, axis=axis, between=self.between, missing=self.missing)
        along = self.axis if tensor and self.axis is not None else 0
        percolates = flow.percolates_along(along)
        place = flow.constriction_along(along) if percolates else None
        kappa = float(flow.transmissivity[along, along]) if percolates else 0.0
        cubed = max(float(solution.mean_gap), 0.0) ** 3
        factor = kappa and (kappa / cubed if cubed > 0 else math.inf)
        return {
            "hydraulic_gap": math.nan if between else math.cbrt(kappa),
            "transmissivity": kappa,
            "flow_factor": math.nan if between else factor,
            "percolates": float(percolates),
            "constriction_cells": 0.0 if place is None else float(place.cells),
            "constriction_share": math.nan if place is None else place.share,
            "transmissivity_bruggeman": math.nan if between else bruggeman(flow.gap**3),
            "flow_residual": flow.residual if percolates else 0.0,
        }


@numeric(drop="Pa", seal_width="m", circumference="m")
def leak_rates(
    curve: MeasuredCurve, fluid: Liquid, *, drop: float, seal_width: float, circumference: float
) -> Array:
    """Return the leak rate of a liquid at each load or time of a curve with the measure `Transmissivity`.

    A gas slips at the walls, which changes the transmissivity: use `leak` at each load.

    Parameters
    ----------
    curve : Curve or ViscoelasticCurve
        With the column ``transmissivity``, along an axis.
    fluid : Liquid
    drop : float
        Drop of pressure [Pa].
    seal_width, circumference : float
        Length of the seal along the flow, and across it [m].

    Returns
    -------
    array, shape (n,)
        Volume flow [m^3/s]; NaN where the drop exceeds the nominal pressure, so that the fluid separates the bodies.

    Raises
    ------
    ValueError
        If the curve has no such column, or the fluid is not a liquid.

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, rolloff=32e-6, short_cutoff=8e-6)
    >>> curve = rc.loading_curve(surface, 1e9, pressures=[1e6, 4e6, 16e6], measures=[rc.Transmissivity(axis=0)])
    >>> rates = rc.leak_rates(curve, rc.Liquid(1e-3), drop=1e5, seal_width=1e-3, circumference=0.1)
    >>> [f"{rate * 6e7:.1e} ml/min" for rate in rates]
    ['5.0e-05 ml/min', '1.3e-07 ml/min', '0.0e+00 ml/min']
    """
    kappa = curve.measured.get("transmissivity")
    if kappa is None or np.isnan(curve.measured["hydraulic_gap"]).any():
        raise InputError(
            "the curve has no transmissivity along an axis",
            "give measures=[rc.Transmissivity(axis=0)] to loading_curve",
            "curve",
        )
    if not isinstance(fluid, Liquid):
        raise InputError(
            f"the transmissivity of a curve is that of a liquid, not of {fluid!r}",
            "take rc.Liquid, or rc.leak at each load for a gas",
            "fluid",
        )
    drop = positive_scalar(drop, "drop [Pa]")
    shape = positive_scalar(circumference, "circumference [m]") / positive_scalar(
        seal_width, "seal_width [m]"
    )
    rates = kappa / (12 * fluid.viscosity) * shape * drop
    return np.where(curve.nominal_pressure >= drop, rates, math.nan)
