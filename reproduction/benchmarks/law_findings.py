"""The results of the ensembles of the law, in sentences that hold for any numbers; see `law.py`."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from law_ensembles import CELLS, FOLDER, Values, error, law, read, resampled, value
from law_tables import (
    DECADES,
    HIGHEST,
    LIMITS,
    MIDDLE,
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


def findings(folder: Path = FOLDER) -> list[str]:
    """Return the results of E1 and E2."""
    return [*_exponents(folder), *_grids(folder), *_averages(folder)]


def word(off: float, spread: float, what: str) -> str:
    """Return whether a deviation is one."""
    if not np.isfinite(spread) or SIDE * spread < abs(off) <= UP * spread:
        return f"whether it differs from {what} is not decided"
    return f"within {SIDE} standard errors of {what}" if abs(off) <= SIDE * spread else f"not {what}"


def at(found: Values, samples: int, hurst: float, ratio: bool = False) -> str:
    one = found.sel(hurst=hurst, method="nearest")
    pair = float(value(one)), float(error(one, samples))
    return percent(*pair) if ratio else told(*pair)


def _exponents(folder: Path) -> Iterator[str]:
    ensemble = read("e1-surfaces", folder)
    if ensemble is None:
        return
    found = e1_laws(ensemble)
    samples, hurst = found.attrs["samples"], found["hurst"]
    alpha = found["alpha_mean"]
    off = alpha * (hurst + 1) - 1
    yield (
        f"Exponent: in the window of the thesis (more than {CELLS} cells of 512², forces up to {HIGHEST:g} E* h L) the "
        f"exponent of {samples} rough squares differs from 1/(H + 1) by "
        + ", ".join(f"{at(off, samples, h, True)} at H = {h:g}" for h in (0.25, 0.7, 1.0, 1.3, 1.6, 1.9))
        + "."
    )
    force, stiffness, _ = curves(ensemble)
    mean = resampled(stiffness)
    low, high = (law(force, mean, between(force, *decade))[0] * (hurst + 1) - 1 for decade in DECADES[1:])
    above = (1.3, 1.6, 1.9)
    yield (
        "Window: above H = 1.2 this difference depends on the range of forces. From "
        f"{DECADES[1][0]:g} to {DECADES[1][1]:g} it is "
        + ", ".join(f"{at(low, samples, h, True)} at H = {h:g}" for h in above)
        + f". From {DECADES[2][0]:g} to {DECADES[2][1]:g} it is "
        + ", ".join(at(high, samples, h, True) for h in above)
        + "."
    )
    smooth = alpha.sel(hurst=2.95)
    pair = float(value(smooth)), float(error(smooth, samples))
    yield (
        f"Smooth surfaces: at H = 2.95 the exponent is {told(*pair)}, "
        f"{word(pair[0] - 1 / 3, pair[1], 'the 1/3 of one smooth crest')}."
    )


def _grids(folder: Path) -> Iterator[str]:
    every = nested(on_grids(folder), LIMITS["e2-all"][1])
    if len(every) < 2 or 512 not in every:
        return
    finest = max(every)
    force, _, samples = curves(every[finest])
    means = {n: resampled(every[n]["dimensionless_stiffness"]) for n in (512, finest)}
    load = load_at(force, HIGHEST)
    ratio = means[512].isel(load=load) / means[finest].isel(load=load) - 1
    yield (
        f"Grid: at {HIGHEST:g} E* h L the stiffness of {samples} surfaces on 512² differs from that of the same "
        f"surfaces on {finest}², each with all waves of its grid, by "
        + ", ".join(f"{at(ratio, samples, h, True)} at H = {h:g}" for h in (0.25, 0.4, 0.7, 1.3, 1.9))
        + "."
    )
    twenty = ", ".join(f"{line[4]} at H = {line[0]}" for line in rule(every)[1] if line[1] == "512²")
    yield (
        "Rule of twenty cells: on 512², at the force at which the mean stiffness is that of 20 cells, the stiffness "
        f"differs from that of the same surfaces on {finest}² by {twenty}."
    )


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
        f"of fits by {spans['zeta']['fits']}. They change the stiffness at {MIDDLE:g} E* h L by only "
        f"{spans['k']['geometric']} and {spans['k']['fits']}, because zeta is the value at F/(E* h L) = 1, far "
        "outside the window."
    )
