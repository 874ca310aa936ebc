"""The results of the ensembles of the law, in sentences that hold for any numbers; see `law.py`."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from law_ensembles import FOLDER, Values, error, law, read, resampled, value
from law_tables import (
    DECADES,
    HIGHEST,
    LIMITS,
    MIDDLE,
    Table,
    between,
    curves,
    e1_laws,
    load_at,
    nested,
    on_grids,
    percent,
    rule,
    told,
)

SIDE, UP = 2, 3  # standard errors within which a difference is none, and beyond which it is one
LOW = 1.2  # H up to which single decades of force are too short


def findings(folder: Path = FOLDER) -> list[str]:
    """Return the results of E1 in sentences."""
    return [*_smooth(folder), *_averages(folder)]


def result_tables(folder: Path = FOLDER) -> dict[str, Table]:
    """Return the results of E1 and E2 in tables."""
    return _exponents(folder) | _grids(folder)


def word(off: float, spread: float, what: str) -> str:
    """Return whether a deviation is one."""
    if not np.isfinite(spread) or SIDE * spread < abs(off) <= UP * spread:
        return f"whether it differs from {what} is not decided"
    return f"within {SIDE} standard errors of {what}" if abs(off) <= SIDE * spread else f"not {what}"


def at(found: Values, samples: int, hurst: float) -> str:
    """Return a relative difference at a Hurst exponent."""
    one = found.sel(hurst=hurst, method="nearest")
    return percent(float(value(one)), float(error(one, samples)))


def _exponents(folder: Path) -> dict[str, Table]:
    """Return how far the exponent is from 1/(H + 1), in the window of the thesis and in decades of force."""
    ensemble = read("e1-surfaces", folder)
    if ensemble is None:
        return {}
    found = e1_laws(ensemble)
    samples, hurst = found.attrs["samples"], found["hurst"]
    force, stiffness, _ = curves(ensemble)
    mean = resampled(stiffness)
    off = found["alpha_mean"] * (hurst + 1) - 1
    decades = [law(force, mean, between(force, *ends))[0] * (hurst + 1) - 1 for ends in DECADES[1:]]
    body = [
        [f"{h:g}", at(off, samples, h), *(at(each, samples, h) if h > LOW else "-" for each in decades)]
        for h in (0.25, 0.7, 1.0, 1.3, 1.6, 1.9)
    ]
    head = ["H", "window of the thesis", *(f"from {low:g} to {high:g}" for low, high in DECADES[1:])]
    return {"results-exponent": (head, body)}


def _smooth(folder: Path) -> Iterator[str]:
    ensemble = read("e1-surfaces", folder)
    if ensemble is None:
        return
    found = e1_laws(ensemble)
    smooth = found["alpha_mean"].sel(hurst=2.95)
    pair = float(value(smooth)), float(error(smooth, found.attrs["samples"]))
    yield (
        f"Smooth surfaces: at H = 2.95 the exponent is {told(*pair)}, "
        f"{word(pair[0] - 1 / 3, pair[1], 'the 1/3 of one smooth crest')}."
    )


def _grids(folder: Path) -> dict[str, Table]:
    """Return how far the stiffness on 512² is from that on the finest grid, at one force and at that of 20 cells."""
    every = nested(on_grids(folder), LIMITS["e2-all"][1])
    if len(every) < 2 or 512 not in every:
        return {}
    finest = max(every)
    force, _, samples = curves(every[finest])
    means = {n: resampled(every[n]["dimensionless_stiffness"]) for n in (512, finest)}
    load = load_at(force, HIGHEST)
    ratio = means[512].isel(load=load) / means[finest].isel(load=load) - 1
    body = [
        [h, at(ratio, samples, float(h)), twenty] for h, n, *_, twenty, _ in rule(every)[1] if n == "512²"
    ]
    return {"results-grid": (["H", f"at {HIGHEST:g} E* h L", "at the stiffness of 20 cells"], body)}


def _averages(folder: Path) -> Iterator[str]:
    ensemble = read("e1-surfaces", folder)
    if ensemble is None:
        return
    found = e1_laws(ensemble).sel(hurst=slice(0.2, 1.8))
    ends = {
        way: value(found[f"zeta_{way}"] / found["zeta_mean"] - 1).to_numpy() for way in ("geometric", "fits")
    }
    levels = {way: value(found[f"k_{way}"] / found["k_mean"] - 1).to_numpy() for way in ("geometric", "fits")}
    spans = {
        name: {way: f"{100 * each.min():+.1f} to {100 * each.max():+.1f} %" for way, each in table.items()}
        for name, table in (("zeta", ends), ("k", levels))
    }
    yield (
        f"Averages: for H from 0.25 to 1.75, geometric means change zeta by {spans['zeta']['geometric']} and means "
        f"of fits by {spans['zeta']['fits']}. The stiffness at {MIDDLE:g} E* h L changes by "
        f"{spans['k']['geometric']} and {spans['k']['fits']}. The changes differ because zeta is the stiffness at "
        "F/(E* h L) = 1, far outside the window."
    )
