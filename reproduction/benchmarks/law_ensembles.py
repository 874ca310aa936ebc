"""The ensembles of the law: taken over from the folders of their studies, and what resampling says of them."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, cast

import numpy as np
import xarray

from roughcontact.files.write import write_netcdf
from roughcontact.statistics.bootstrap import counts_of
from roughcontact.statistics.ensemble_mean import Mean, mean_over_samples
from roughcontact.study.export import export
from roughcontact.study.store import Store
from roughcontact_thesis.averaging import converged

ROOT = Path(__file__).resolve().parents[2]
STUDIES = ROOT / "examples" / "law"
FOLDER = ROOT / "reproduction" / "data" / "law"
REPLICATES = 400
CELLS = 20  # of the rule of section 4.3
_ALONG = ("dimensionless_stiffness", "interfacial_stiffness")  # of surfaces of unit side and modulus
_AT_BORDER = ("contact_area", "border_share", "crest_distance")  # of E8
_KEPT = (*_ALONG, *_AT_BORDER)
_DIGITS = {"dimensionless_stiffness": 15, "border_share": 8}  # binary, of E8: by 3e-5 and 0.4 % off at most
_SAME = ("dimensionless_force", "cell_stiffness", "full_contact_stiffness")

Values = xarray.DataArray


# What is kept


def collect(source: Path, folder: Path = FOLDER) -> None:
    """Take over the stiffness of every surface of the studies in `source`, one folder each, as far as they are."""
    folder.mkdir(parents=True, exist_ok=True)
    for path in sorted(STUDIES.glob("*.toml")):
        if not (source / path.stem / "study.toml").is_file():
            continue
        with Store.open(source / path.stem) as store:
            exported = export(store, seconds=True)
        if not whole(exported).any():
            continue
        found = kept(exported)
        write_netcdf(found, folder / path.name.replace(".toml", ".nc"), {})
        print(f"{path.stem}: {found.sizes['sample']} whole samples, {found.attrs['hours']:.2f} hours")


def whole(exported: xarray.Dataset) -> Values:
    """Return which samples have all their cases done."""
    status = exported["case_status"]
    return (status == "done").all([d for d in status.dims if d != "sample"])


def kept(exported: xarray.Dataset) -> xarray.Dataset:
    """Return the stiffnesses of an export, in single precision, for the samples whose cases are all done."""
    hours = float(exported["case_seconds"].sum()) / 3600
    failed = int((exported["case_status"] == "failed").sum())
    curves = converged(exported) if "status" in exported else exported
    curves = curves.isel(sample=np.flatnonzero(whole(exported)))
    found = xarray.Dataset(
        {name: curves[name].astype(np.float32) for name in _KEPT if _wanted(name, curves)},
        attrs={"study": exported.attrs["study"], "hours": hours, "failed": failed},
    )
    if "border_share" in found:
        found = found.assign({name: rounded(found[name], digits) for name, digits in _DIGITS.items()})
    if "line" in found.dims:
        found = found.mean("line", keep_attrs=True)
    for name in _SAME:
        if name in curves:
            same = curves[name]
            found[name] = (
                same.isel(sample=0, drop=True) if "sample" in same.dims and same.sizes["sample"] else same
            )
    return found.drop_vars([name for name, each in found.coords.items() if each.dtype.kind not in "fibU"])


def rounded(values: Values, digits: int) -> Values:
    """Return numbers with so many binary digits, which are compressed to fewer bytes."""
    part, power = np.frexp(values)
    found: Values = np.ldexp(np.round(part * 2.0**digits), power - digits).astype(values.dtype)
    return found


def _wanted(name: str, curves: xarray.Dataset) -> bool:
    """Return whether a variable is kept: K of nominally flat surfaces only, columns of the border of E8 only."""
    if name in _AT_BORDER:
        return "border_share" in curves
    return name in curves and (name == _ALONG[0] or "rolloff" in curves.coords)


def read(name: str, folder: Path = FOLDER) -> xarray.Dataset | None:
    """Return an ensemble in memory, None where it was not computed."""
    path = folder / f"{name}.nc"
    return _loaded(path, path.stat().st_mtime_ns).copy() if path.is_file() else None


@cache  # many tables take the same ensembles
def _loaded(path: Path, _time: int) -> xarray.Dataset:
    with xarray.open_dataset(path, engine="h5netcdf") as data:
        found = data.load()
    found = found.assign({each: found[each].astype(np.float64) for each in _KEPT if each in found})
    if "cell_stiffness" in found:  # kept once where it is the same for all
        other = found[_ALONG[0]].isel(sample=0, load=0, drop=True)
        found["cell_stiffness"] = found["cell_stiffness"].broadcast_like(other)
    return found


def grid(ensemble: xarray.Dataset, points: int, short_cutoff: float | None = None) -> xarray.Dataset | None:
    """Return the surfaces on one grid, with all its waves or with those above a cut-off; None where there are none."""
    if "row" not in ensemble.dims:
        fits = int(ensemble["points"].max()) == points or "points" in ensemble.dims
        return (ensemble.sel(points=points) if "points" in ensemble.dims else ensemble) if fits else None
    cells = ensemble["points"] == points
    cut = ensemble["short_cutoff"]
    wanted = cut.isnull() if short_cutoff is None else abs(cut / (short_cutoff or 1) - 1) < 1e-9
    place = np.flatnonzero((cells & wanted).broadcast_like(ensemble["row"]))
    return ensemble.isel(row=int(place[0]), drop=True) if place.size else None


# Resampling


def resampled(values: Values, mean: Mean = "arithmetic") -> Values:
    """Return means over the samples along ``replicate``: the first is of all, the others of samples drawn again.

    Ensembles of as many samples are drawn alike, so that surfaces stay paired between grids and Hurst exponents.
    """
    first = values.transpose("sample", ...)
    size = first.sizes["sample"]
    drawn = counts_of(np.random.default_rng(0).random((REPLICATES, size)), np.ones(size, bool))
    table = first.to_numpy().reshape(size, -1)
    found = mean_over_samples(table, mean, np.concatenate([np.ones((1, size)), drawn]))
    rest = first.isel(sample=0, drop=True)
    laid = found.reshape(REPLICATES + 1, *rest.shape)
    coords = {name: each for name, each in rest.coords.items() if set(each.dims) <= set(rest.dims)}
    return Values(laid, dims=("replicate", *rest.dims), coords=coords, attrs={"samples": size})


def paired(*ensembles: xarray.Dataset) -> list[xarray.Dataset]:
    """Return ensembles with the samples that all of them have."""
    same = set.intersection(*({*each["sample"].to_numpy().tolist()} for each in ensembles))
    return [each.sel(sample=sorted(same)) for each in ensembles]


def value(found: Values) -> Values:
    """Return what all samples say."""
    return found.isel(replicate=0, drop=True)


def error(found: Values, samples: int) -> Values:
    """Return the standard error; replicates scatter less than ensembles by sqrt(1 - 1/n)."""
    if samples < 2:
        return value(found) * np.nan
    return found.isel(replicate=slice(1, None)).std("replicate", ddof=1) * (samples / (samples - 1)) ** 0.5


def law(force: Values, stiffness: Values, inside: Values) -> tuple[Values, Values]:
    """Return exponent and prefactor of straight lines through ln k over ln F, by least squares."""
    x = logged(force).where(inside)
    y = logged(stiffness).where(inside)
    away = x - x.mean("load")
    alpha = (y * away).sum("load", min_count=2) / (away**2).sum("load")
    return alpha, cast("Values", np.exp(y.mean("load") - alpha * x.mean("load")))


def logged(values: Values) -> Values:
    """Return the natural logarithm, NaN of what is not above zero."""
    return cast("Values", np.log(values.where(values > 0)))


def interpolated(places: Values, force: Values, stiffness: Values) -> Values:
    """Return ln k at ln F `places`, on straight lines between neighbouring loads; NaN beyond them."""

    def between(at: Any, x: Any, y: Any) -> Any:
        return np.interp(at, x, y, left=np.nan, right=np.nan)

    found: Values = _along_load(between, places, logged(force), logged(stiffness))
    return found


def force_at(places: Values, force: Values, stiffness: Values) -> Values:
    """Return ln F at which ln k has reached `places`; NaN beyond the loads."""

    def where(at: Any, x: Any, y: Any) -> Any:
        return np.interp(at, np.maximum.accumulate(y), x, left=np.nan, right=np.nan)

    found: Values = _along_load(where, places, logged(force), logged(stiffness))
    return found


def _along_load(function: Callable[..., Any], places: Values, x: Values, y: Values) -> Any:
    dims: list[list[str]] = [[], ["load"], ["load"]]
    return xarray.apply_ufunc(function, places, x, y, input_core_dims=dims, vectorize=True)
