"""What the ensembles of the law say, in sentences that hold whatever the numbers are; see `law.py`."""

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
    """Return what E1 and E2 say."""
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
        f"In the window of the thesis (above {CELLS} cells of 512², up to {HIGHEST:g} E\\* h L) the exponent of "
        f"{samples} rough squares is off 1/(H + 1) by "
        + ", ".join(f"{at(off, samples, h, True)} at H = {h:g}" for h in (0.25, 0.7, 1.0, 1.3, 1.6, 1.9))
        + "."
    )
    force, stiffness, _ = curves(ensemble)
    mean = resampled(stiffness)
    low, high = (law(force, mean, between(force, *decade))[0] * (hurst + 1) - 1 for decade in DECADES[1:])
    above = (1.3, 1.6, 1.9)
    yield (
        f"Above H = 1.2 that depends on the window: over forces from {DECADES[1][0]:g} to {DECADES[1][1]:g} it is "
        + ", ".join(f"{at(low, samples, h, True)} at H = {h:g}" for h in above)
        + f", and {', '.join(at(high, samples, h, True) for h in above)} over the decade above."
    )
    smooth = alpha.sel(hurst=2.95)
    pair = float(value(smooth)), float(error(smooth, samples))
    yield f"At H = 2.95 it is {told(*pair)}, {word(pair[0] - 1 / 3, pair[1], 'the 1/3 of one smooth crest')}."


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
        f"What cells do: on 512² the stiffness of the same {samples} surfaces at {HIGHEST:g} E\\* h L, all waves that "
        f"each grid holds, is off that on {finest}² by "
        + ", ".join(f"{at(ratio, samples, h, True)} at H = {h:g}" for h in (0.25, 0.4, 0.7, 1.3, 1.9))
        + "."
    )
    twenty = ", ".join(f"{line[4]} at H = {line[0]}" for line in rule(every)[1] if line[1] == "512²")
    yield (
        f"The rule of twenty cells: there, on 512², the stiffness is off that of the same surfaces on {finest}² by "
        f"{twenty}."
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
        f"For H from 0.25 to 1.75 geometric means move zeta by {spans['zeta']['geometric']} and means of fits by "
        f"{spans['zeta']['fits']}, but the stiffness at {MIDDLE:g} E\\* h L by {spans['k']['geometric']} and "
        f"{spans['k']['fits']}: zeta is read off at a force far outside of the window."
    )
