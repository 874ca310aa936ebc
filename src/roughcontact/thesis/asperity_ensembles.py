"""The asperities that figures 31 to 33 stand on, run once for all three.

The thesis shows data of others there. Here the discrete asperity model of Ciavarella, Delfine and Demelio is run on
surfaces of our own: slopes can be compared, numbers cannot.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from roughcontact import statistics
from roughcontact.grid import Grid
from roughcontact.statistics.fit import fit_power_laws
from roughcontact.statistics.fit_window import force_window
from roughcontact.study.study import Study
from roughcontact.surface.moments import grid_moments
from roughcontact.surface.spectrum import SelfAffineSpectrum
from roughcontact.theory import greenwood_williamson

if TYPE_CHECKING:
    import xarray

    from roughcontact.thesis.figures import Scale

__all__ = ["CHOSEN", "asperity_averages", "asperity_study", "greenwood_williamson_stiffness", "law_exponent"]

HURST = (0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 0.95)
POINTS = {"small": 256, "thesis": 512}
SPOTS = 10.0  # on the average: below, it is the shape of single summits that speaks
HIGHEST = 0.07  # force F/(E* h L)
CHOSEN = (
    "in place of the data of others: summits of surfaces of our own by the inverse Fourier transform, points higher "
    "than their eight neighbours, as spheres of their own curvature that push each other down like point forces",
    f"{POINTS['thesis']} x {POINTS['thesis']} points; on the small scale {POINTS['small']} x {POINTS['small']}",
    f"slopes from {SPOTS:g} summits in contact on the average up to a force of {HIGHEST:g}",
)


def asperity_study(scale: Scale) -> Study:
    """Return the study: 25 surfaces of each of seven fractal dimensions."""
    return Study(
        name={"small": "asperities-small", "thesis": "asperities"}[scale],
        case="asperities",
        samples={"small": 8, "thesis": 25}[scale],
        parameters={
            "points": POINTS[scale],
            "lowest_force": 1e-4,
            "highest_force": 0.1,
            "loads": 25,
        },
        table={"hurst": HURST},
    )


def law_exponent(hurst: float) -> float:
    """Return 1/(4 - D_f) of thesis eq. 4.31 with D_f = 3 - H."""
    return 1 / (1 + hurst)


def asperity_averages(exported: xarray.Dataset) -> xarray.Dataset:
    """Return the stiffness of every realisation, the means and their power laws.

    Returns
    -------
    Dataset
        ``force`` (load); along Hurst exponent, sample and load ``stiffness`` with interaction and ``independent``
        without; ``classical``, that of Greenwood and Williamson; ``spots`` on the average and the part of them that
        is ``merged``; ``exponent``, ``independent_exponent`` and ``classical_exponent`` between ``window_low``
        and ``window_high``.
    """
    import xarray

    force = exported["dimensionless_force"]
    found = xarray.Dataset(
        {
            "force": force,
            "stiffness": exported["dimensionless_stiffness"],
            "independent": exported["independent_stiffness"],
            "spots": statistics.mean(exported["spots"]),
            "merged": statistics.mean(exported["merged"]) / statistics.mean(exported["spots"]),
        }
    )
    laws = [_laws(found.sel(hurst=hurst), int(exported["points"])) for hurst in found["hurst"]]
    return found.merge(xarray.concat(laws, "hurst"))


def greenwood_williamson_stiffness(
    force: np.typing.NDArray[np.float64], hurst: float, points: int
) -> np.typing.NDArray[np.float64]:
    """Return k/(E* L) of independent spheres with the moments of the surfaces (McCool) at forces F/(E* h L)."""
    grid = Grid((points, points), 1 / points, periodic=True)
    moments = grid_moments(grid, SelfAffineSpectrum(hurst).scaled(1.0, grid))
    law = greenwood_williamson.law(moments, 1.0, 1.0)
    return np.asarray(law.quantities["interfacial_stiffness"](force))


def _laws(one: xarray.Dataset, points: int) -> xarray.Dataset:
    """Return the classical curve of one Hurst exponent, and the exponents of all three."""
    import xarray

    force = one["force"].to_numpy()
    classical = greenwood_williamson_stiffness(force, float(one["hurst"]), points)
    low = float(force[np.flatnonzero(one["spots"] >= SPOTS)[0]])
    window = force_window(low, HIGHEST)
    # The same fit of a curve that has no samples.
    curve = xarray.Dataset(
        {
            "dimensionless_force": one["force"],
            "dimensionless_stiffness": (("sample", "load"), classical[None]),
        }
    )
    rng = np.random.default_rng(0)
    laws = xarray.Dataset(
        {
            "classical": ("load", classical),
            "classical_exponent": fit_power_laws(curve, window, rng=rng)["exponent"],
            "window_low": low,
            "window_high": HIGHEST,
        }
    )
    for name, prefix in (("stiffness", ""), ("independent", "independent_")):
        curves = xarray.Dataset({"dimensionless_force": one["force"], "dimensionless_stiffness": one[name]})
        fit = fit_power_laws(curves, window, rng=np.random.default_rng(0))
        for each in ("exponent", "exponent_error"):
            laws[prefix + each] = fit[each]
    return laws.assign_coords(hurst=one["hurst"])
