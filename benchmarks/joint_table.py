"""Fit the emulator of the stiffness of joints to its ensembles, and hold it against unseen ones.

    python benchmarks/joint_table.py --take FOLDER   # from the folders of the studies, docs/data/joint/*.nc
    python benchmarks/joint_table.py                 # from these files the table of the package

With the inflation of the covariance, the squared distances of unseen specimens have the 90 % quantile of the
chi-squared distribution.
"""

from __future__ import annotations

import argparse
import dataclasses
import json
from pathlib import Path

import numpy as np
import numpy.typing as npt
import scipy.stats
import xarray

from roughcontact.files.write import write_netcdf
from roughcontact.measurement.joint_emulator import JointEmulator, flow_terms, terms
from roughcontact.study.export import export
from roughcontact.study.store import Store

ROOT = Path(__file__).resolve().parents[1]
DATA = ROOT / "docs" / "data" / "joint"
TABLE = ROOT / "src" / "roughcontact" / "measurement" / "joint_table.json"
SMALL = 0.01  # standard error below which an ensemble of joints that flow counts no more

Array = npt.NDArray[np.float64]


def take(source: Path) -> None:
    """Keep the curves of the studies in a folder, for the samples whose designs are all done."""
    DATA.mkdir(parents=True, exist_ok=True)
    for name in ("design", "validation", "calibration", "large", "hardness"):
        if not (source / name / "study.toml").is_file():
            continue
        with Store.open(source / name) as store:
            found = export(store, seconds=True)
        if "stiffness_per_area" not in found:  # none is done
            continue
        whole = (found["case_status"] == "done").all("row")
        kept = found[["stiffness_per_area", "fraction", "pressure"]].isel(sample=whole.to_numpy())
        hours = float(found["case_seconds"].sum()) / 3600
        failed = int((found["case_status"] == "failed").sum())
        converged = float(found["converged"].where(whole).mean())
        kept.attrs.update(hours=hours, failed=failed)
        write_netcdf(kept.astype(np.float32), DATA / f"{name}.nc", {})
        print(f"{name}: {kept.sizes}, {hours:.2f} hours, {failed} failed, {converged:.4f} met the tolerance")


def ensemble(name: str) -> tuple[Array, Array, Array]:
    """Return hurst, side, band of each row, shape (rows, 3), nodes, shape (n,), and ln K, shape (rows, samples, n)."""
    with xarray.open_dataset(DATA / f"{name}.nc", engine="h5netcdf") as data:
        points = np.stack([data[axis].to_numpy() for axis in ("hurst", "side", "band")], axis=1)
        curves = np.log(
            data["stiffness_per_area"].transpose("row", "sample", "load").to_numpy().astype(float)
        )
        nodes = np.log(data["pressure"].to_numpy().reshape(-1, curves.shape[-1])[0].astype(float))
    return points, nodes, curves


def fitted(points: Array, nodes: Array, curves: Array) -> JointEmulator:
    """Return the emulator of an ensemble, without the misfit and the inflation that unseen ones decide."""
    known = terms(*points.T)
    means = curves.mean(axis=1)
    deviations = curves.std(axis=1, ddof=1)
    standard = (curves - means[:, None]) / deviations[:, None]
    weights = 1 / deviations
    mean = np.stack(
        [
            np.linalg.lstsq(known * w[:, None], m * w, rcond=None)[0]
            for m, w in zip(means.T, weights.T, strict=True)
        ],
        axis=1,
    )
    deviation = np.linalg.lstsq(known, np.log(deviations), rcond=None)[0]
    rows, samples, n = curves.shape
    correlation = np.einsum("rsi,rsj->ij", standard, standard) / (rows * (samples - 1))
    step = np.diff(nodes).mean()
    at, none = nodes[0] + step * np.arange(n), np.zeros(n)
    known = (at, mean, deviation, correlation, none, none, np.zeros(4), 0.0)
    return JointEmulator(*known, freedom=rows * (samples - 1), inflation=1.0)


def misfit(emulator: JointEmulator, points: Array, curves: Array) -> Array:
    """Return the standard deviation of the true means about the fitted ones, by the means of unseen ensembles."""
    mean, _ = emulator.at(*points.T, np.broadcast_to(emulator.nodes, (len(points), emulator.nodes.size)))
    scatter = curves.var(axis=1, ddof=1) / curves.shape[1]
    return np.sqrt(np.maximum(((curves.mean(axis=1) - mean) ** 2 - scatter).mean(axis=0), 0))


def distances(emulator: JointEmulator, points: Array, curves: Array, nodes: slice) -> Array:
    """Return the squared distances of specimens from their means in the covariance, shape (rows, samples)."""
    at = np.broadcast_to(emulator.nodes[nodes], (len(points), emulator.nodes[nodes].size))
    mean, covariance = emulator.at(*points.T, at)
    residual = curves[:, :, nodes] - mean[:, None]
    return np.einsum("rsi,rij,rsj->rs", residual, np.linalg.inv(covariance), residual)


def larger(emulator: JointEmulator) -> Array:
    """Return how far the mean of joints beyond the largest of the design is from that of independent pieces."""
    points, nodes, curves = ensemble("large")
    mean, covariance = emulator.at(*points.T, np.broadcast_to(nodes, (len(points), nodes.size)))
    deviation = np.sqrt(np.diagonal(covariance[0]))
    count = curves.shape[1]
    print(
        f"{count} joints of {points[0, 1] ** 2:.0f} l^2, every third load from p l/(E* h) = {np.exp(nodes[0]):.2g} on:"
    )
    print("  mean of ln K over that of the law", np.round((curves[0].mean(axis=0) - mean[0])[::3], 3))
    print("  with a standard error of         ", np.round((deviation / np.sqrt(count))[::3], 3))
    ratio = curves[0].std(axis=0, ddof=1) / deviation
    ends = np.sqrt(scipy.stats.chi2.ppf([0.025, 0.975], count - 1) / (count - 1))
    print(
        "  sd over that of the law", np.round(ratio[::3], 2), f"95 % between {ends[0]:.2f} and {ends[1]:.2f}"
    )
    return np.asarray(curves[0].mean(axis=0) - mean[0])


def flowing(emulator: JointEmulator) -> tuple[Array, float]:
    """Return how far the mean on first loading of joints that flow is from that of elastic ones, and the misfit.

    The misfit is that of ensembles left out of the fit, one at a time, without their own scatter, relative to the mean
    effect.
    """
    points, nodes, curves = ensemble("hardness")
    with xarray.open_dataset(DATA / "hardness.nc", engine="h5netcdf") as data:
        hardness = np.log(data["hardness"].to_numpy().astype(float))
    mean, _ = emulator.at(*points.T, np.broadcast_to(nodes, (len(points), nodes.size)))
    effect = curves.mean(axis=1) - mean
    scatter = curves.var(axis=1, ddof=1) / curves.shape[1]
    kept = np.isfinite(effect)
    known = flow_terms(np.broadcast_to(nodes, effect.shape), hardness[:, None])
    weights = 1 / np.sqrt(scatter + SMALL**2)

    def fit(rows: Array) -> Array:
        chosen = kept & rows[:, None]
        w = weights[chosen]
        return np.asarray(np.linalg.lstsq(known[chosen] * w[:, None], effect[chosen] * w, rcond=None)[0])

    every = np.arange(len(points))
    unseen = np.stack([known[k] @ fit(every != k) for k in every])
    excess = ((effect - unseen) ** 2 - scatter)[kept].mean()
    relative = float(np.sqrt(max(excess, 0) / (unseen[kept] ** 2).mean()))
    print("effect of flow on ln K for p over hardness up to 0.5, at a hardness over E* h/l of")
    for low, high in ((0.6, 1.2), (1.2, 3.0), (3.0, 8.0), (8.0, 20.0)):
        chosen = kept & ((np.exp(hardness) >= low) & (np.exp(hardness) < high))[:, None]
        ends = np.quantile(effect[chosen], [0.05, 0.5, 0.95])
        missed = np.sqrt(((effect - unseen)[chosen] ** 2).mean())
        print(f"  {low} to {high}:", np.round(ends, 3), f"missed by {missed:.3f}")
    print(f"misfit of ensembles left out, relative: {relative:.3f}")
    return fit(every >= 0), relative


def main() -> None:
    """Run it."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--take", type=Path)
    chosen = parser.parse_args()
    if chosen.take:
        take(chosen.take)
    points, nodes, curves = ensemble("design")
    unseen, _, others = ensemble("validation")
    first = fitted(points, nodes, curves)
    spread = misfit(first, unseen, others)
    names = ("nodes", "mean", "deviation", "correlation")
    values = {name: getattr(first, name) for name in names} | {"misfit": spread, "freedom": first.freedom}
    plain = dataclasses.replace(first, misfit=spread)
    every = slice(0, None, 3)
    measured = distances(plain, unseen, others, every).ravel()
    d = plain.nodes[every].size
    inflation = float(np.quantile(measured, 0.9) / scipy.stats.chi2.ppf(0.9, d))
    flow, flow_misfit = flowing(plain)
    departure = larger(dataclasses.replace(plain, inflation=inflation))
    values |= {"departure": departure, "flow": flow, "flow_misfit": flow_misfit}
    table = {name: np.round(value, 6).tolist() for name, value in values.items()} | {
        "inflation": round(inflation, 4)
    }
    TABLE.write_text(json.dumps(table, separators=(",", ":")) + "\n", encoding="utf-8")
    print("misfit of means [%]", np.round(100 * spread, 1))
    print("sd of ln K at 16, 64, 256 l^2, H = 0.8, band 6 (every third load)")
    for side in (4.0, 8.0, 16.0):
        _, covariance = plain.at(np.array([0.8]), np.array([side]), np.array([6.0]), plain.nodes[None, :])
        print(side, np.round(np.sqrt(np.diagonal(covariance[0]))[::3], 3))
    for share in (0.5, 0.9, 0.95):
        covered = (measured <= inflation * scipy.stats.chi2.ppf(share, d)).mean()
        print(
            f"{share:.0%} regions cover {covered:.3f} of {measured.size} unseen specimens, inflation {inflation:.3f}"
        )


if __name__ == "__main__":
    main()
