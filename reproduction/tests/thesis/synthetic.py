"""What studies of loading curves would export if a law held exactly."""

import numpy as np
import xarray

__all__ = ["curves", "lines"]


def curves(exponent, prefactor, hurst, **given):
    """Return curves k = zeta F^alpha of surfaces that scatter, each by a factor of its own.

    Half of the samples are stiffer by the part `scatter` and half softer: the mean is the law, exactly.
    """
    points, samples, scatter = given.get("points", 513), given.get("samples", 10), given.get("scatter", 0.2)
    force = given.get("force", np.geomspace(1e-4, 0.07, 40))
    hurst = np.asarray(hurst, dtype=float)
    alpha, zeta = (np.broadcast_to(each, hurst.shape)[:, None, None] for each in (exponent, prefactor))
    factor = 1 + scatter * (-1.0) ** np.arange(samples)[:, None]
    stiffness = np.minimum(zeta * force**alpha * factor, 1.15)
    every = ("hurst", "sample", "load")
    return xarray.Dataset(
        {
            "dimensionless_force": ("load", force),
            "dimensionless_stiffness": (every, stiffness),
            "stiffness": (every, 7.0 * stiffness),
            "status": (every, np.full(stiffness.shape, "converged")),
            "cell_stiffness": ((), 7.0 * 0.8911 / points),
            "full_contact_stiffness": ((), 7.0 * 1.15),
        },
        {"hurst": hurst, "sample": np.arange(samples), "points": points},
        {"geometry": "surface"},
    )


def lines(exponent, prefactor, hurst, points=(512, 8192), scatter=0.2):
    """Return curves k = zeta F^alpha of rough lines, the same on any number of points."""
    force = np.geomspace(1e-6, 0.7, 60)
    one = curves(exponent, prefactor, hurst, force=force, scatter=scatter)["dimensionless_stiffness"]
    stacked = xarray.concat([one.rename(sample="line").drop_vars(["line", "points"])] * len(points), "points")
    stiffness = stacked.expand_dims(sample=4).transpose("points", "hurst", "sample", "line", "load")
    return xarray.Dataset(
        {"dimensionless_force": ("load", force), "dimensionless_stiffness": stiffness},
        {"points": list(points), "line": np.arange(stiffness.sizes["line"]), "sample": np.arange(4)},
    )
