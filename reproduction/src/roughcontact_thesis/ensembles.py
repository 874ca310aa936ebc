"""The rough surfaces that figures 18, 21, 26 to 28, 30 and 37 stand on, run once for all of them.

The counts are the thesis' own where it states them. Lengths and moduli are without meaning: all answers go with
E* h L and E* L.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray

from roughcontact.statistics.ensemble_mean import Mean
from roughcontact.statistics.fit import fit_power_laws
from roughcontact.statistics.fit_window import CELLS, FULL_CONTACT_SHARE, Window, window_of
from roughcontact.statistics.samples import count
from roughcontact.study.ranges import Range
from roughcontact.study.study import Study
from roughcontact_thesis.averaging import (
    converged,
    curve_statistics,
    exponential,
    logarithm,
    means,
    slope,
    surface_study,
    without_parameters,
)
from roughcontact_thesis.figures import Scale, Studies
from roughcontact_thesis.line_ensembles import WINDOWED, line_averages, line_fits

__all__ = [
    "HURST",
    "coarse_square_study",
    "curve_averages",
    "curve_fits",
    "full_contact_study",
    "laws",
    "other_means",
    "resolution_studies",
    "sphere_study",
    "square_study",
]

HURST = Range(start=-0.5, stop=2.95, count=24)
_FEW_HURST = Range(start=-0.5, stop=2.8, count=12)  # every other one
LOW_HURST = (-1.0, -0.75, -0.5, -0.25, 0.0, 0.2)
RADIUS, SPHERE_HURST, SPHERE_RMS = 0.5, 0.7, 9e-3  # of figure 37, over the side
FORCES = (1e-6, 1e-2)  # of figure 37, over E* L^2
SEED = 1
_ROUND = 1e-9
_LAWS = (
    *WINDOWED,
    *("prefactor", "prefactor_error", "prefactor_low", "prefactor_high", "correlation", "misfit", "samples"),
)


def square_study(scale: Scale) -> Study:
    """Return the study of figures 18, 27, 28 and 30: stiffness against force for all Hurst exponents."""
    if scale == "thesis":
        return _study("squares", 50, {"points": 513, "loads": 100}, {"hurst": HURST})
    return _study("squares-small", 10, {"points": 257, "loads": 50}, {"hurst": _FEW_HURST})


def coarse_square_study(scale: Scale) -> Study:
    """Return the same study on half as many cells a side, for curves; exponents want more."""
    if scale == "thesis":
        return _study("squares-257", 50, {"points": 257, "loads": 100}, {"hurst": HURST})
    return _study("squares-small-129", 10, {"points": 129, "loads": 50}, {"hurst": _FEW_HURST})


def full_contact_study(scale: Scale) -> Study:
    """Return the study of figure 21: from the first cells to full contact, fractal dimensions 2 to 3."""
    table = {"hurst": Range(start=0.0, stop=1.0, step=0.2)}
    forces = {"lowest_force": 1e-4, "highest_force": 300.0, "loads": 27, "tolerance": 1e-6}
    if scale == "thesis":
        return _study("saturation", 3, forces | {"points": 1025}, table)
    return _study("saturation-small", 6, forces | {"points": 129}, table)


def resolution_studies(scale: Scale) -> Studies:
    """Return the studies of figure 26: low Hurst exponents on several numbers of cells."""
    forces = {"lowest_force": 1e-3, "loads": 40}
    small, thesis = {257: 20, 513: 20}, {257: 500, 513: 500, 1025: 200}
    name, counts = {"small": ("resolution-small", small), "thesis": ("resolution", thesis)}[scale]
    return tuple(
        _study(f"{name}-{points}", samples, forces | {"points": points}, {"hurst": LOW_HURST})
        for points, samples in counts.items()
    )


def sphere_study(scale: Scale) -> Study:
    """Return the study of figure 37: a paraboloid with roughness."""
    forces = {"lowest_force": FORCES[0] / SPHERE_RMS, "highest_force": FORCES[1] / SPHERE_RMS, "loads": 33}
    parameters = {"hurst": SPHERE_HURST, "rms": SPHERE_RMS, "radius": RADIUS} | forces
    if scale == "thesis":
        return _study("rough-sphere", 50, parameters | {"points": 513}, {})
    return _study("rough-sphere-small", 20, parameters | {"points": 257}, {})


def curve_averages(exported: xarray.Dataset) -> xarray.Dataset:
    """Return the mean stiffness of surfaces, its standard error and its scatter, along what varies and the load.

    Loads that missed their tolerance have no part in it. ``resolved`` says where the mean stiffness is above 20 cells
    and below 90 % of the full-contact stiffness. The attributes ``cells`` and ``surfaces`` count cells a side and
    samples.
    """
    stiffness = converged(exported)["dimensionless_stiffness"]
    low, high = window_of(exported, ("sample",), "load").stiffness
    found = curve_statistics(exported["dimensionless_force"], stiffness).assign(samples=count(stiffness))
    found["resolved"] = (found["stiffness"] > low) & (found["stiffness"] < high)
    for name, values, words in (
        ("cell_stiffness", low / CELLS, "k/(E* L) of one cell"),
        ("full_contact_stiffness", high / FULL_CONTACT_SHARE, "k/(E* L) of all cells"),
    ):
        found[name] = values.assign_attrs(long_name=words, units="1")
    return found.assign_attrs(cells=int(exported["points"]), surfaces=int(found["samples"].max()))


def curve_fits(
    exported: xarray.Dataset, *, window: Window | None = None, mean: Mean = "arithmetic"
) -> xarray.Dataset:
    """Return the power laws of the mean stiffness of surfaces, with intervals; see `fit_power_laws`."""
    return fit_power_laws(exported, window, rng=np.random.default_rng(0), mean=mean)


def laws(squares: xarray.Dataset, lines: xarray.Dataset) -> xarray.Dataset:
    """Return what figures 27 and 28 show: power laws of rough surfaces and, named ``line_...``, of rough lines.

    Parameters
    ----------
    squares, lines : Dataset
        What `square_study` and the study of lines export.

    Returns
    -------
    Dataset
        Along ``hurst``, the lines also along ``points``; NaN where only the others were computed. Of surfaces also
        by other means, see `other_means`.
    """
    surfaces = without_parameters(curve_fits(squares)[list(_LAWS)])
    surfaces = surfaces.assign(other_means(squares, surfaces).data_vars)
    reduced = without_parameters(line_fits(lines)[list(_LAWS)].rename({n: f"line_{n}" for n in _LAWS}))
    found = xarray.merge([surfaces, reduced], join="outer", combine_attrs="drop")
    return found.assign_attrs(curve_averages(squares).attrs | {"lines": line_averages(lines).attrs["lines"]})


def other_means(exported: xarray.Dataset, fits: xarray.Dataset) -> xarray.Dataset:
    """Return power laws by other ways to average than the mean stiffness: ``..._geometric`` and ``..._of_fits``.

    The former are those of geometric means, the latter means over the samples of the laws of each, in the window of
    `fits`; both with their standard errors.
    """
    names = [f"{name}{end}" for name in ("exponent", "prefactor") for end in ("", "_error")]
    geometric = without_parameters(curve_fits(exported, mean="geometric")[names])
    curves = without_parameters(converged(exported))
    force = curves["dimensionless_force"]
    inside = (force >= fits["window_low"] * (1 - _ROUND)) & (force <= fits["window_high"] * (1 + _ROUND))
    stiffness = logarithm(curves["dimensionless_stiffness"].where(inside))
    places = logarithm(force).where(stiffness.notnull())
    exponent = slope(stiffness, places, "load")
    prefactor = exponential(stiffness.mean("load") - exponent * places.mean("load"))
    each = means(exponent_of_fits=exponent, prefactor_of_fits=prefactor)
    renamed = {
        name: f"{name.removesuffix('_error')}_geometric{'_error' * name.endswith('_error')}" for name in names
    }
    return geometric.rename(renamed).assign(each.data_vars)


def _study(name: str, samples: int, parameters: dict[str, Any], table: dict[str, Any]) -> Study:
    return surface_study(name, parameters, case="curve", seed=SEED, samples=samples, table=table)
