"""Power laws of the mean stiffness of ensembles, one for every combination of parameters, with intervals."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from roughcontact.errors import InputError
from roughcontact.solver.control import Status
from roughcontact.statistics.bootstrap import counts_of, interval, resampled_laws
from roughcontact.statistics.ensemble_fit import fit_ensemble, law_error
from roughcontact.statistics.ensemble_mean import Mean, mean_over_samples
from roughcontact.statistics.fit_window import Window, window_of
from roughcontact.statistics.power_law import ROUNDING
from roughcontact.statistics.samples import dimensions
from roughcontact.validation import Array, Mask, RngLike, as_generator, number, require

if TYPE_CHECKING:
    import xarray

__all__ = ["fit_power_laws", "law_at"]

# A load belongs to a fit if this part of the samples has a result: a mean over few belongs to other surfaces.
COMPLETE = 0.9
_LEAST = 3  # points: two points always lie on a line
_FORCE, _STIFFNESS = "dimensionless_force", "dimensionless_stiffness"
_CONVERGED = [status.value for status in Status if status.converged]
_NUMBERS = ("count", "samples")

_WORDS: Mapping[str, str] = MappingProxyType(
    {
        "exponent": "exponent alpha of the mean stiffness, k ~ F^alpha",
        "prefactor": "prefactor zeta, the law's k/(E* L) at a dimensionless force of 1",
        "exponent_error": "standard error of the exponent, from resampled curves",
        "prefactor_error": "standard error of the prefactor, from resampled curves",
        "exponent_low": "lower limit of the exponent",
        "exponent_high": "upper limit of the exponent",
        "prefactor_low": "lower limit of the prefactor",
        "prefactor_high": "upper limit of the prefactor",
        "correlation": "correlation of exponent and logarithm of the prefactor",
        "exponent_sandwich_error": "standard error of the exponent, from what each sample adds",
        "prefactor_sandwich_error": "standard error of the prefactor, from what each sample adds",
        "misfit": "standard deviation of ln k of the means about the law",
        "window_low": "lowest dimensionless force of the fit",
        "window_high": "highest dimensionless force of the fit",
        "count": "number of forces in the fit",
        "samples": "number of samples in the fit",
    }
)


def fit_power_laws(
    dataset: xarray.Dataset,
    window: Window | None = None,
    *,
    rng: RngLike,
    mean: Mean = "arithmetic",
    samples: str | Sequence[str] = "sample",
    replicates: int = 1000,
    level: float = 0.95,
) -> xarray.Dataset:
    """Return the power law k/(E* L) = zeta (F/(E* h L))^alpha (thesis, eq. 4.53) of every ensemble of a study.

    A straight line through the logarithm of the mean over samples, by least squares. Points that did not converge are
    ignored, and so are forces at which fewer than nine tenths of the samples have a result.

    Parameters
    ----------
    dataset : Dataset
        As `roughcontact.study.export` makes it: ``dimensionless_force`` and ``dimensionless_stiffness`` along
        the samples and ``load`` (or, from `on_common`, ``dimensionless_force``); ``status`` of each point if there is
        one. All other dimensions distinguish ensembles.
    window : Window, optional
        For example from `force_window` or `resolved_window`. By default that of the thesis: mean stiffness above 20
        cells and below 90 % of the full-contact stiffness, force up to 0.07. A curve that is not exactly a power law
        has another exponent in another window.
    rng : int, numpy.random.Generator, SeedSequence, BitGenerator or None
        Source of the resampling. All ensembles get the same draws, because their samples are paired.
    mean : {"arithmetic", "geometric"}
        Which mean over the samples.
    samples : str or sequence of str
        Dimensions of independent samples.
    replicates : int
        Number of times that whole curves are drawn again; the window stays that of the full mean.
    level : float
        Confidence level of the intervals.

    Returns
    -------
    Dataset
        Along the dimensions of the ensembles. With fewer than three forces in the window the law is NaN, and ``count``
        holds their number; a single sample has a law without errors and intervals.

    Raises
    ------
    ValueError
        If a variable is missing, samples have different forces (see `roughcontact.statistics.on_common`), or window,
        mean or level is invalid.

    Examples
    --------
    >>> import numpy as np
    >>> import xarray
    >>> import roughcontact as rc
    >>> force = np.geomspace(1e-3, 1e-1, 7)
    >>> stiffness = ("sample", "load"), np.outer([0.9, 1.0, 1.1], force**0.6)
    >>> curves = xarray.Dataset({"dimensionless_force": ("load", force), "dimensionless_stiffness": stiffness})
    >>> window = rc.statistics.force_window(1e-3, 1e-1)
    >>> laws = rc.statistics.fit_power_laws(curves, window, rng=np.random.default_rng(1))
    >>> laws["exponent"].round(6).item(), laws["prefactor_error"].round(3).item()
    (0.6, 0.048)
    """
    require(0 < level < 1, f"the level of an interval lies between 0 and 1, not {level}", place="level")
    import xarray

    over = dimensions(samples)
    stiffness, force, points = _curves(dataset, over)
    window = window_of(dataset, over, points) if window is None else window
    size = math.prod(stiffness.sizes[d] for d in over)
    fit = _fitting(window.force, mean, as_generator(rng).random((replicates, size)), level)
    found = xarray.apply_ufunc(
        fit,
        force,
        stiffness,
        *window.stiffness,
        input_core_dims=[[*over, points], [*over, points], [], []],
        output_core_dims=[[] for _ in _WORDS],
        output_dtypes=[np.int64 if name in _NUMBERS else np.float64 for name in _WORDS],
        vectorize=True,
    )
    laws = {
        name: values.assign_attrs(long_name=words, units="1")
        for (name, words), values in zip(_WORDS.items(), found, strict=True)
    }
    settings = {"mean": mean, "window": window.rule, "level": level, "replicates": replicates}
    return xarray.Dataset(laws, attrs={"title": "power laws of mean stiffness over samples"} | settings)


def law_at(fits: xarray.Dataset, force: float | npt.ArrayLike) -> xarray.Dataset:
    """Return the stiffness of fitted laws at given forces, and its standard error.

    Exponent and prefactor are strongly correlated, because zeta is the value at a force far outside the window.
    Compare laws by their stiffness at a force inside it.

    Parameters
    ----------
    fits : Dataset
        As `fit_power_laws` makes it.
    force : float or array
        Dimensionless forces F/(E* h L).

    Returns
    -------
    Dataset
        ``stiffness``, k/(E* L), and ``stiffness_error``, along the ensembles and the forces.

    Examples
    --------
    >>> import numpy as np
    >>> import xarray
    >>> import roughcontact as rc
    >>> force = np.geomspace(1e-3, 1e-1, 7)
    >>> stiffness = ("sample", "load"), np.outer([0.9, 1.0, 1.1], force**0.6)
    >>> curves = xarray.Dataset({"dimensionless_force": ("load", force), "dimensionless_stiffness": stiffness})
    >>> window = rc.statistics.force_window(1e-3, 1e-1)
    >>> laws = rc.statistics.fit_power_laws(curves, window, rng=np.random.default_rng(1))
    >>> found = rc.statistics.law_at(laws, 0.01)
    >>> f"{found['stiffness'].item():.4f} +- {found['stiffness_error'].item():.4f}"
    '0.0631 +- 0.0030'
    """
    import xarray

    values = np.asarray(number(force, "force"))
    at = xarray.DataArray(values, dims=("dimensionless_force",)[: values.ndim], name="dimensionless_force")
    at = at.assign_coords(dimensionless_force=at)
    stiffness = fits["prefactor"] * at ** fits["exponent"]
    errors = (fits["exponent_error"], fits["prefactor_error"] / fits["prefactor"], fits["correlation"])
    relative = xarray.apply_ufunc(law_error, np.log(at), *errors)
    return xarray.Dataset(
        {
            "stiffness": stiffness.assign_attrs(long_name="k/(E* L) of the law", units="1"),
            "stiffness_error": (stiffness * relative).assign_attrs(long_name="its standard error", units="1"),
        }
    )


def _curves(
    dataset: xarray.Dataset, samples: Sequence[str]
) -> tuple[xarray.DataArray, xarray.DataArray, str]:
    """Return k/(E* L) where it converged, F/(E* h L), and the name of their common dimension."""
    if missing := [name for name in (_FORCE, _STIFFNESS) if name not in dataset]:
        raise InputError(f"these are no loading curves: {' and '.join(missing)} is missing")
    points = _FORCE if _FORCE in dataset.dims else "load"
    force, stiffness = dataset[_FORCE], dataset[_STIFFNESS]
    for name, values in ((_FORCE, force), (_STIFFNESS, stiffness)):
        if points not in values.dims:
            raise InputError(f"{name} does not lie along 'load': these are no loading curves")
    if absent := [d for d in samples if d not in dataset.sizes]:
        raise InputError(
            f"there are no samples along {absent[0]!r}; there are {', '.join(map(str, dataset.sizes))}"
        )
    if "status" in dataset and points in dataset["status"].dims:
        stiffness = stiffness.where(dataset["status"].isin(_CONVERGED))
    stiffness, force = (
        values.expand_dims({d: dataset.sizes[d] for d in samples if d not in values.dims})
        for values in (stiffness, force)
    )
    return stiffness, force, points


def _fitting(
    forces: tuple[float, float], mean: Mean, uniform: Array, level: float
) -> Callable[..., tuple[float, ...]]:
    """Return the function that fits one ensemble; all ensembles use the same draws."""
    drawn: dict[bytes, Array] = {}  # draws for each set of present samples: all samples, for most ensembles

    def fit(force: Array, stiffness: Array, lowest: float, highest: float) -> tuple[float, ...]:
        curves = stiffness.reshape(-1, stiffness.shape[-1])
        common = _common(force.reshape(curves.shape))
        inside = _inside(common, curves, forces, (lowest, highest), mean)
        count = int(inside.sum())
        there = np.asarray((~np.isnan(curves[:, inside] if count else curves)).any(axis=1))
        laws = dict.fromkeys(_WORDS, math.nan) | {"count": count, "samples": int(there.sum())}
        if count >= _LEAST:
            if there.tobytes() not in drawn:
                drawn[there.tobytes()] = counts_of(uniform, there)[:, there]
            force, kept = common[inside], curves[np.ix_(there, inside)]
            laws |= _law(force, kept, mean)
            laws |= _spread(resampled_laws(np.log(force), kept, drawn[there.tobytes()], mean), laws, level)
        return tuple(laws[name] for name in _WORDS)

    return fit


def _common(force: Array) -> Array:
    """Return the forces of all samples, NaN where no sample has a value."""
    with np.errstate(invalid="ignore"):
        common = np.asarray(np.fmin.reduce(force, axis=0))
        if (np.abs(force / common - 1) > ROUNDING).any():
            raise InputError(
                "the samples have different forces", "use roughcontact.statistics.on_common first"
            )
    return common


def _inside(
    force: Array, stiffness: Array, forces: tuple[float, float], limits: tuple[float, float], mean: Mean
) -> Mask:
    """Return the points of the window."""
    means = mean_over_samples(stiffness, mean)
    there = ~np.isnan(stiffness)
    complete = there.sum(axis=0) >= COMPLETE * there.any(axis=1).sum()
    with np.errstate(invalid="ignore"):
        inside = (force > 0) & (force >= forces[0] * (1 - ROUNDING)) & (force <= forces[1] * (1 + ROUNDING))
        return np.asarray(inside & complete & (means > limits[0]) & (means < limits[1]))


def _law(force: Array, stiffness: Array, mean: Mean) -> dict[str, float]:
    """Return the law of one ensemble, and its errors from the contributions of the samples."""
    fit = fit_ensemble(force, stiffness, (1.0, 1.0), mean)
    return {
        "exponent": fit.exponent,
        "prefactor": fit.prefactor,
        "exponent_sandwich_error": fit.exponent_error,
        "prefactor_sandwich_error": fit.prefactor_error,
        "misfit": fit.law.scatter,
        "window_low": fit.law.window[0],
        "window_high": fit.law.window[1],
    }


def _spread(replicates: Array, law: Mapping[str, float], level: float) -> dict[str, float]:
    """Return errors and intervals of the law of one ensemble from the alpha and ln zeta of its replicates."""
    samples = int(law["samples"])
    said = replicates[np.isfinite(replicates).all(axis=1)]
    if samples < 2 or len(said) < 2:
        return {}
    alpha, ln_zeta = said.std(axis=0, ddof=1)
    covariance = np.cov(said, rowvar=False)[0, 1]
    low, high = interval(said, level, samples)
    return {
        "exponent_error": float(alpha),
        "prefactor_error": float(law["prefactor"] * ln_zeta),
        "exponent_low": float(low[0]),
        "exponent_high": float(high[0]),
        "prefactor_low": math.exp(low[1]),
        "prefactor_high": math.exp(high[1]),
        "correlation": float(covariance / (alpha * ln_zeta)) if alpha * ln_zeta > 0 else 0.0,
    }
