"""The results of the ensembles of the law, in sentences that hold for any numbers; see `law.py`."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from law_crest import by_cut, laws_of
from law_cut import PERIOD, mean_effect
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
SHOWN_HURST = (0.25, 0.7, 1.3, 1.9, 2.95)


def findings(folder: Path = FOLDER) -> list[str]:
    """Return the results of E8 and E1 in sentences."""
    return [*_interior(folder), *_averages(folder)]


def result_tables(folder: Path = FOLDER) -> dict[str, Table]:
    """Return the results of E2 in tables."""
    return _grids(folder)


def word(off: float, spread: float, what: str) -> str:
    """Return whether a deviation is one."""
    if not np.isfinite(spread) or SIDE * spread < abs(off) <= UP * spread:
        return f"whether it differs from {what} is not decided"
    return f"within {SIDE} standard errors of {what}" if abs(off) <= SIDE * spread else f"not {what}"


def at(found: Values, samples: int, hurst: float) -> str:
    """Return a relative difference at a Hurst exponent."""
    one = found.sel(hurst=hurst, method="nearest")
    return percent(float(value(one)), float(error(one, samples)))


def _interior(folder: Path) -> Iterator[str]:
    """Yield what the law of the surface is, and what the cut of the square changes."""
    ensemble = read("e8-cut", folder)
    if ensemble is None:
        return
    cuts = by_cut(ensemble)
    samples = ensemble.sizes["sample"]
    alphas = {cut: laws_of(one)[0] for cut, one in cuts.items()}
    load = load_at(ensemble["dimensionless_force"], HIGHEST)
    means = [cuts[cut]["mean"].isel(load=load) for cut in ("period", "interior")]
    added = means[0] / means[1] - 1
    listed = ", ".join(f"{at(added, samples, h)} at H = {h:g}" for h in SHOWN_HURST)
    theory = 100 * mean_effect(value(means[1]).to_numpy() / 2, PERIOD)
    yield (
        f"The cut: at {HIGHEST:g} E* h L, a random cut changes the mean stiffness by {listed}. The theory of one "
        f"smooth crest has {theory.min():.1f} to {theory.max():.1f} %."
    )
    smooth = [alphas[cut].sel(hurst=2.95) for cut in ("interior", "period")]
    pairs = [(float(value(one)), float(error(one, samples))) for one in smooth]
    inner = cuts["interior"].sel(hurst=2.95)
    low = law(
        inner["dimensionless_force"], inner["mean"], between(inner["dimensionless_force"], *DECADES[1])
    )[0]
    decade = told(float(value(low)), float(error(low, samples)), 4)
    yield (
        f"Smooth surfaces: at H = 2.95 the interior exponent is {told(*pairs[0])}, "
        f"{word(pairs[0][0] - 1 / 3, pairs[0][1], 'the 1/3 of one smooth crest')}, and {decade} from "
        f"{DECADES[1][0]:g} to {DECADES[1][1]:g} E* h L. With a random cut it is {told(*pairs[1])}."
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
