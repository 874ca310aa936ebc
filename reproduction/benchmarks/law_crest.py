"""E8: what the law of rough squares owes to the place where the square is cut out of its surface; see `law.py`."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import xarray
from law_cut import LARGER, PERIOD, mean_effect
from law_ensembles import FOLDER, Values, error, law, read, resampled, value
from law_tables import (
    DECADES,
    MIDDLE,
    Table,
    between,
    curves,
    each,
    each_percent,
    load_at,
    percent,
    resolved,
    told,
)

BORDER = 0.05  # share of the force at the border, above which a load is not called interior
CUTS = ("period", "interior")  # rows of e8-cut.toml: cut at random, and with the crest in the middle
RANGE = (0.05, 0.95)  # quantiles of single surfaces
HALF = 0.5  # of the effect of a border that was not computed: its error
SHOWN = (7e-4, 7e-3, MIDDLE, 7e-2)


def by_cut(ensemble: xarray.Dataset) -> dict[str, xarray.Dataset]:
    """Return the ensemble of each cut, with the loads that belong to its law.

    They are those of the window of the thesis; for the interior those at which, on the average of the surfaces, at most
    `BORDER` of the force lies within the contact radius of the border. A patch has the interior's stiffness with the
    effect of the border of the period, surface by surface, times the ratio of both effects for a smooth crest.
    """
    period, interior = (ensemble.isel(row=row, drop=True) for row in range(2))
    k, middle = (each_["dimensionless_stiffness"] for each_ in (period, interior))
    width = middle.mean("sample") / 2
    ratio = width.copy(data=mean_effect(width.to_numpy(), LARGER) / mean_effect(width.to_numpy(), PERIOD))
    patch = interior.assign(dimensionless_stiffness=middle + ratio * (k - middle))
    found = {"interior": interior, "period": period, "patch": patch}
    found = {cut: one.assign(mean=resampled(one["dimensionless_stiffness"])) for cut, one in found.items()}
    found = {cut: one.assign(inside=resolved(one, one["mean"])) for cut, one in found.items()}
    inner = found["interior"]["inside"] & (interior["border_share"].mean("sample") <= BORDER)
    return found | {"interior": found["interior"].assign(inside=inner)}


def laws_of(one: xarray.Dataset) -> tuple[Values, Values]:
    """Return the exponents and the stiffnesses at `MIDDLE` of one cut, of all surfaces and of surfaces drawn again."""
    alpha, zeta = law(one["dimensionless_force"], one["mean"], one["inside"])
    return alpha, zeta * MIDDLE**alpha


def misfit(one: xarray.Dataset) -> Values:
    """Return the largest deviation of the mean curve from its power law, in its window."""
    alpha, level = (value(each_) for each_ in laws_of(one))
    fitted = level * (one["dimensionless_force"] / MIDDLE) ** alpha
    return abs(value(one["mean"]) / fitted - 1).where(one["inside"]).max("load")


def e8(folder: Path = FOLDER) -> dict[str, Table | str]:
    """Return exponents and stiffnesses of both cuts, their difference, and the shares of the border."""
    ensemble = read("e8-cut", folder)
    if ensemble is None:
        return {}
    cuts = by_cut(ensemble)
    return {
        "e8": _exponents(cuts),
        "e8-levels": _levels(cuts),
        "e8-decades": _decades(cuts),
        "e8-share": _shares(cuts),
        "e8-cut": _effects(cuts),
        **_border(folder),
    }


def _exponents(cuts: dict[str, xarray.Dataset]) -> Table:
    interior, period = cuts["interior"], cuts["period"]
    samples, hurst, force = interior.sizes["sample"], interior["hurst"], interior["dimensionless_force"]
    inner = laws_of(interior)[0]
    # The random cut at the loads of the interior, so that the difference is one of the cut.
    same = law(force, period["mean"], interior["inside"])[0]
    whole = laws_of(period)[0]
    expected = 1 / (hurst + 1)
    ends = [force.where(interior["inside"]).reduce(each_, "load") for each_ in (np.nanmin, np.nanmax)]
    lines = [
        [f"{float(h):g}" for h in hurst],
        [f"{float(h):.3f}" for h in expected],
        [f"{float(a):.2g} to {float(b):.2g}" for a, b in zip(*ends, strict=True)],
        each(inner, samples),
        each_percent(inner / expected - 1, samples),
        each_percent((same - inner) / expected, samples),
        each(whole, samples),
        each_percent(whole / expected - 1, samples),
    ]
    head = [
        *("H", "1/(H + 1)", "interior: forces", "alpha, interior", "over 1/(H + 1)", "a random cut adds"),
        *("alpha, random cut, to 0.07", "random cut over 1/(H + 1)"),
    ]
    return head, [list(line) for line in zip(*lines, strict=True)]


def _levels(cuts: dict[str, xarray.Dataset]) -> Table:
    samples, hurst = cuts["interior"].sizes["sample"], cuts["interior"]["hurst"]
    thesis = 1.7 / (hurst + 1) * MIDDLE ** (1 / (hurst + 1))
    columns = [[f"{float(h):g}" for h in hurst]]
    for cut in CUTS[::-1]:
        level = laws_of(cuts[cut])[1]
        columns += [each(level, samples, 4), each_percent(level / thesis - 1, samples)]
        columns.append([percent(float(one), np.nan).lstrip("+") for one in misfit(cuts[cut])])
    head = ["H"]
    for words in ("interior", "random cut"):
        head += [f"kappa, {words}", f"over the thesis' law at {MIDDLE:g}, {words}", f"misfit, {words}"]
    return head, [list(line) for line in zip(*columns, strict=True)]


def _decades(cuts: dict[str, xarray.Dataset]) -> Table:
    """Return exponents of decades of force in which all loads of a cut belong to its law."""
    body = []
    for place, h in enumerate(cuts["interior"]["hurst"].to_numpy()):
        for low, high in DECADES:
            line = []
            for cut in CUTS[::-1]:
                one = cuts[cut].isel(hurst=place)
                chosen = between(one["dimensionless_force"], low, high)
                found = law(one["dimensionless_force"], one["mean"], chosen)[0]
                whole = bool(one["inside"].where(chosen, other=True).all())
                line.append(each(found.where(whole).expand_dims("one", 1), one.sizes["sample"])[0])
            if set(line) != {"-"}:
                body.append([f"{h:g}", f"{low:g} to {high:g}", *line, f"{1 / (h + 1):.3f}"])
    return ["H", "F/(E* h L)", "interior", "random cut", "1/(H + 1)"], body


def _shares(cuts: dict[str, xarray.Dataset]) -> Table:
    """Return the mean share of the force at the border at each load above the stiffness of twenty cells."""
    force = cuts["interior"]["dimensionless_force"].to_numpy()
    body = []
    for place, h in enumerate(cuts["interior"]["hurst"].to_numpy()):
        for cut in CUTS[::-1]:
            one = cuts[cut].isel(hurst=place)
            shares = one["border_share"].mean("sample").where(resolved(one, one["mean"]))
            body.append(
                [f"{h:g}", cut, *("-" if np.isnan(s) else f"{100 * s:.1f} %" for s in shares.to_numpy())]
            )
    kept = [n for n in range(2, 2 + force.size) if any(line[n] != "-" for line in body)]
    head = ["H", "cut", *(f"{force[n - 2]:.2g}" for n in kept)]
    return head, [[*line[:2], *(line[n] for n in kept)] for line in body]


def _effects(cuts: dict[str, xarray.Dataset]) -> Table:
    """Return how much stiffer the random cut is on the same surfaces, beside the theory of one smooth crest."""
    interior, period = cuts["interior"], cuts["period"]
    samples, force = interior.sizes["sample"], interior["dimensionless_force"]
    loads = [load_at(force, at) for at in SHOWN]
    body = []
    for place, h in enumerate(interior["hurst"].to_numpy()):
        line = [f"{h:g}"]
        for load in loads:
            at = {"hurst": place, "load": load}
            middle = interior["mean"].isel(at)
            ratio = (period["mean"].isel(at) / middle - 1).where(
                bool(resolved(interior, interior["mean"]).isel(at))
            )
            line += [each_percent(ratio.expand_dims("one", 1), samples)[0]]
            expected = float(mean_effect(value(middle).to_numpy() / 2, PERIOD))
            line += [percent(expected, np.nan) if line[-1] != "-" else "-"]
        body.append(line)
    head = ["H", *(words for at in SHOWN for words in (f"at {at:g}", f"theory at {at:g}"))]
    return head, body


def effects(ensemble: xarray.Dataset) -> xarray.Dataset:
    """Return 4 a/L of the interior and the relative effect of the random cut with its error, for all resolved loads."""
    cuts = by_cut(ensemble)
    interior, period = cuts["interior"], cuts["period"]
    ratio = period["mean"] / interior["mean"] - 1
    seen = resolved(interior, interior["mean"])
    return xarray.Dataset(
        {
            "width": (2 * value(interior["mean"])).where(seen),
            "effect": value(ratio).where(seen),
            "spread": error(ratio, interior.sizes["sample"]),
        }
    )


def at_border(
    ensemble: xarray.Dataset, border: xarray.Dataset, hurst: float
) -> tuple[list[float], list[float], list[float]]:
    """Return c/a, k over that in the middle, and two standard errors, of E8's crests near a border."""
    kept = sorted({*border["sample"].to_numpy().tolist()} & {*ensemble["sample"].to_numpy().tolist()})
    near = border.sel(sample=kept, hurst=hurst)["dimensionless_stiffness"]
    whole = ensemble.isel(row=1).sel(sample=kept, hurst=hurst)
    middle = resampled(whole["dimensionless_stiffness"])
    seen = np.flatnonzero(resolved(whole, middle))
    rows = []
    for crest in border["crest"].to_numpy():
        ratio = resampled(near.sel(crest=crest)) / middle
        for load in seen:
            place = 2 * float(crest) / float(value(middle)[load])
            rows.append((place, float(value(ratio)[load]), 2 * float(error(ratio, len(kept))[load])))
    places, ratios, bars = (list(each_) for each_ in zip(*rows, strict=True))
    return places, ratios, bars


def _border(folder: Path) -> dict[str, Table]:
    """Return the stiffness with the crest at a distance from the border over that in the middle, for each load."""
    near, middle = read("e8-border", folder), read("e8-cut", folder)
    if near is None or middle is None:
        return {}
    kept = sorted({*near["sample"].to_numpy().tolist()} & {*middle["sample"].to_numpy().tolist()})
    force, _, samples = curves(near.sel(sample=kept))
    whole = middle.isel(row=1).sel(sample=kept)
    body = []
    for h in near["hurst"].to_numpy():
        reference = resampled(whole["dimensionless_stiffness"].sel(hurst=h))
        one = whole.sel(hurst=h)
        for load in (load_at(force, at) for at in SHOWN):
            at = {"load": load}
            if not bool(resolved(one, reference).isel(at)):
                continue
            line = [f"{h:g}", f"{float(force[load]):.2g}"]
            for crest in near["crest"].to_numpy():
                k = resampled(near["dimensionless_stiffness"].sel(crest=crest, hurst=h, sample=kept)).isel(at)
                distance = float(crest) / (float(value(reference.isel(at))) / 2)
                ratio = (k / reference.isel(at) - 1).expand_dims("one", 1)
                line += [told(distance, np.nan, 2), each_percent(ratio, samples)[0]]
            body.append(line)
    head = ["H", "F/(E* h L)"]
    for crest in near["crest"].to_numpy():
        words = "0" if crest == 0 else f"L/{1 / crest:g}"
        head += [f"c/a, c = {words}", f"k, c = {words}"]
    return {"e8-border": (head, body)}


def table(ensemble: xarray.Dataset) -> dict[str, list[tuple[float, ...]]]:
    """Return the rows of the law of the library, for each cut; see `roughcontact.theory.rough_square`."""
    cuts = by_cut(ensemble)
    samples, rows = ensemble.sizes["sample"], {}
    for cut, one in cuts.items():
        alpha, level = laws_of(one)
        logs = np.log(level)
        off = misfit(one)
        if cut == "patch":
            change = (
                abs(value(one["mean"]) / value(cuts["interior"]["mean"]) - 1).where(one["inside"]).max("load")
            )
            off = np.hypot(off, HALF * change)
        single = one["dimensionless_stiffness"]
        scatter = law(one["dimensionless_force"], single, one["inside"])[0].std("sample", ddof=1)
        parts = (single / single.mean("sample")).quantile(RANGE, "sample")
        force = one["dimensionless_force"]
        found = []
        for place, h in enumerate(one["hurst"].to_numpy()):
            here = np.flatnonzero(one["inside"].isel(hurst=place))
            ends = [parts.isel(hurst=place, load=load).to_numpy() for load in (here[0], here[-1])]
            pair = [each_.isel(hurst=place) for each_ in (alpha, logs)]
            correlation = float(np.corrcoef(*(each_[1:] for each_ in pair))[0, 1])
            found.append(
                (
                    round(float(h), 4),
                    round(float(force[here[-1]]), 5),
                    round(float(value(pair[0])), 5),
                    round(float(error(pair[0], samples)), 5),
                    round(float(np.exp(value(pair[1]))), 6),
                    round(float(error(pair[1], samples)), 5),
                    round(correlation, 2),
                    round(float(off.isel(hurst=place)), 4),
                    *(round(float(each_), 3) for each_ in (*ends[0], *ends[1])),
                    round(float(scatter.isel(hurst=place)), 4),
                )
            )
        rows[cut] = found
    return rows
