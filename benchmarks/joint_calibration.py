"""How often the intervals of `rc.infer_joint` hold the truth, on joints that the emulator has not seen.

    roughcontact study run examples/joint/calibration.toml --out calibration  # resumes; 20 minutes of a core
    python benchmarks/joint_calibration.py calibration

400 joints of 64 l^2 and more drawn from the prior, all of one area. Each is measured at five pressures over 1.6
decades, with an error of 5 % a load, a gain of 3 % and a discrepancy of 5 %.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
import numpy.typing as npt
import scipy.stats
import xarray

import roughcontact as rc
from roughcontact.measurement.joint_emulator import joint_emulator
from roughcontact.measurement.joint_model import JointModel, discrepancy
from roughcontact.measurement.joint_plan import fisher_width
from roughcontact.measurement.joint_topography import prior_of
from roughcontact.study.export import export
from roughcontact.study.store import Store

DATA = Path(__file__).resolve().parents[1] / "docs" / "data" / "joint"
LOADS = slice(3, 12, 2)  # five of sixteen nodes, two fifths of a decade apart
ERROR, GAIN, MODULUS_ERROR, HARDNESS_ERROR = 0.05, 0.03, 0.02, 0.1
FLOWS = 5.0  # hardness over E* h/l below which flow makes a joint softer by more than the discrepancy
MODULUS, RMS, ROLLOFF = 115e9, 1e-6, 1e-4
SIDE, SPREAD = (
    11.3,
    {"rms": 0.4, "rolloff": 0.17},
)  # of the joint in ROLLOFF, and of the topography's statement
UNKNOWN = 100.0  # error of the Hurst exponent: a prior without information
AREA = (SIDE * ROLLOFF) ** 2
TOPOGRAPHY = rc.JointTopography(RMS, SPREAD["rms"], ROLLOFF, SPREAD["rolloff"], 0.75, UNKNOWN)
SHARES = np.linspace(0.01, 0.99, 99)

Array = npt.NDArray[np.float64]


def specimens(store: Path | None) -> xarray.Dataset:
    """Return the computed joints, from the folder of their study or as kept."""
    if store is None:
        return xarray.load_dataset(DATA / "calibration.nc", engine="h5netcdf").isel(sample=0)
    with Store.open(store) as opened:
        found = export(opened)
    return found[["stiffness_per_area", "pressure"]].isel(sample=0)


def measured(side: float, curve: Array, nodes: Array, rng: np.random.Generator) -> tuple[Array, Array, Array]:
    """Return ln h and ln l of a joint drawn from the prior, its pressures [Pa] and its stiffnesses [Pa/m]."""
    rolloff = SIDE * ROLLOFF / side
    rms = RMS * np.exp(SPREAD["rms"] * rng.standard_normal())
    modulus = MODULUS * np.exp(MODULUS_ERROR * rng.standard_normal())
    p = nodes * modulus * rms / rolloff
    other = rng.multivariate_normal(np.zeros(p.size), discrepancy(np.log(p)))
    error = ERROR * rng.standard_normal(p.size) + GAIN * rng.standard_normal() + other
    return np.log([rms, rolloff]), p, curve * modulus / rolloff * np.exp(error)


def inferred(p: Array, stiffness: Array, **stated: float) -> rc.JointInference:
    """Return the answer for a joint of the calibration."""
    data = rc.JointStiffness(p, stiffness, ERROR, GAIN)
    known = {"modulus": MODULUS, "modulus_error": MODULUS_ERROR, "area": AREA} | stated
    return rc.infer_joint(data, branch="loading", profile=TOPOGRAPHY, **known)


def flowing() -> None:
    """Print how often intervals hold the truth of joints that flow on first loading, with the hardness and without.

    The hardness is stated with an error of 10 %. The loads are those up to a quarter of it.
    """
    with xarray.open_dataset(DATA / "hardness.nc", engine="h5netcdf") as data:
        sides, hard = (data[name].to_numpy() for name in ("side", "hardness"))
        curves = data["stiffness_per_area"].transpose("row", "sample", "load").to_numpy().astype(float)
        nodes = data["pressure"].to_numpy().reshape(-1, curves.shape[-1])[0].astype(float)
    rng = np.random.default_rng(2)
    rows = []
    for k in np.flatnonzero((sides > 8) & (hard < FLOWS)):
        loads = np.flatnonzero(nodes <= hard[k] / 4)[LOADS]
        for curve in curves[k]:
            truth, p, stiffness = measured(float(sides[k]), curve[loads], nodes[loads], rng)
            scale = MODULUS * np.exp(truth[0] - truth[1] + HARDNESS_ERROR * rng.standard_normal())
            row = []
            for stated in ({"hardness": hard[k] * scale, "hardness_error": HARDNESS_ERROR}, {}):
                found = inferred(p, stiffness, **stated)
                weights = np.array([found.exponent, 1 - found.exponent])
                row.append((found.share_below(float(np.exp(weights @ truth))), found.fits))
            rows.append(row)
    for name, values in zip(("with the hardness", "as elastic"), np.array(rows).swapaxes(0, 1), strict=True):
        inside = [(abs(values[:, 0] - 0.5) < share / 2).mean() for share in (0.5, 0.9)]
        print(
            f"{len(rows)} joints that flow, {name}: 50 and 90 % intervals cover {inside[0]:.1%} and {inside[1]:.1%}; "
            f"flagged: {1 - values[:, 1].mean():.1%}"
        )


def is_refused(p: Array, stiffness: Array) -> bool:
    """Return whether a measurement is not taken for a joint of the model."""
    try:
        return not inferred(p, stiffness).fits
    except rc.InputError:
        return True


def wrong(found: rc.JointInference, name: str, p: Array, stiffness: Array) -> Array:
    """Return stiffnesses whose level, slope or curvature departs by three of its predictive standard deviations."""
    at = np.log(p)
    contrasts = np.linalg.qr(np.vander(at - at.mean(), 3, increasing=True))[0].T
    contrast = contrasts[("level", "slope", "curvature").index(name)]
    mean, covariance = found.model.at(found.posterior.weights @ found.posterior.points[None], found.data)
    departure = (np.log(stiffness) - mean[0]) @ contrast
    step = 3 * np.sqrt(contrast @ covariance[0] @ contrast)
    return stiffness * np.exp((np.sign(departure) * step - departure) * contrast)


def main() -> None:
    """Run it."""
    parser = argparse.ArgumentParser()
    parser.add_argument("store", type=Path, nargs="?")
    data = specimens(parser.parse_args().store)
    hursts, sides, bands = (data[name].to_numpy() for name in ("hurst", "side", "band"))
    curves = data["stiffness_per_area"].transpose("row", "load").to_numpy().astype(float)
    nodes = data["pressure"].to_numpy().reshape(-1, curves.shape[1])[0].astype(float)
    rng = np.random.default_rng(1)
    rows = []
    for k in np.flatnonzero(np.isfinite(curves).all(axis=1)):
        truth, p, stiffness = measured(float(sides[k]), curves[k, LOADS], nodes[LOADS], rng)
        found = inferred(p, stiffness)
        weights = np.array([found.exponent, 1 - found.exponent])
        point = np.array([*truth, hursts[k], np.log(bands[k]), np.log(MODULUS)])
        model = JointModel(joint_emulator(), AREA)
        bound = fisher_width(model, found.data, point, prior_of((MODULUS, MODULUS_ERROR), AREA, TOPOGRAPHY))
        rows.append(
            {
                "hurst": hursts[k],
                "rank": found.share_below(float(np.exp(weights @ truth))),
                "flagged": not found.fits,
                "bound": found.width / bound,
                "width": found.width,
                **{each.name: each.nats for each in found.parameters},
                **{name: is_refused(p, wrong(found, name, p, stiffness)) for name in ("slope", "curvature")},
            }
        )
    report(rows)
    flowing()


def report(rows: list[dict[str, float]]) -> None:
    """Print coverage of all and of the quarters of the prior, ranks, and the information gained."""
    table = {name: np.array([row.get(name, np.nan) for row in rows], dtype=float) for name in rows[0]}
    rank = table["rank"]
    print(f"{len(rank)} joints; flagged: {table['flagged'].mean():.1%}")
    for name in ("slope", "curvature"):
        print(f"flagged with a {name} three predictive standard deviations off: {table[name].mean():.1%}")
    for share in (0.5, 0.9):
        inside = abs(rank - 0.5) < share / 2
        quarters = [inside[part].mean() for part in np.array_split(np.argsort(table["hurst"]), 4)]
        print(
            f"{share:.0%} intervals cover {inside.mean():.1%}; in quarters of H",
            np.round(100 * np.array(quarters), 1),
        )
    print(f"ranks uniform: p = {scipy.stats.kstest(rank, 'uniform').pvalue:.2f}")
    print(f"sd of ln h_eff, median: {np.median(table['width']):.3f}; over Fisher's bound:", end=" ")
    print(np.round(np.quantile(table["bound"], [0.5, 0.9, 1]), 2))
    for name in ("rms", "rolloff", "hurst", "band", "modulus"):
        print(f"nats of {name}, median: {np.nanmedian(table[name]):.3f}")


if __name__ == "__main__":
    main()
