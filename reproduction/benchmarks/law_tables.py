"""The ensembles of the law as tables; see `law.py`."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np
import xarray
from law_ensembles import (
    CELLS,
    FOLDER,
    Values,
    error,
    force_at,
    grid,
    interpolated,
    law,
    paired,
    read,
    resampled,
    value,
)
from numpy.typing import NDArray

from roughcontact.mdr.lines.lattice_sums import lambda_rms
from roughcontact_thesis.line_match import Ensemble, match

HIGHEST = 0.07  # F/(E* h L), where the fits of the thesis end
ROUND = 1e-9
FEWEST = 3  # samples of a grid: fewer would leave too few to all others
MIDDLE = 0.02  # force at which laws are compared: there the errors of exponent and prefactor hardly matter
DECADES = ((7e-5, 7e-4), (7e-4, 7e-3), (7e-3, 7e-2))
ALL = None  # no cut-off: all waves of the grid
Array = NDArray[np.float64]
Table = tuple[Sequence[str], list[list[str]]]


# Words


def markdown(table: Table) -> str:
    head, rows = table
    lines = [list(head), ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def comma_separated(table: Table) -> str:
    """Return a table as a data file, in which a cell without a number is empty."""
    text = io.StringIO()
    lines = (["" if each == "-" else each for each in line] for line in table[1])
    csv.writer(text, lineterminator="\n").writerows([table[0], *lines])
    return text.getvalue()


def counted(table: Table, samples: int) -> Table:
    """Return a table with a last column that holds the number of surfaces."""
    return [*table[0], "surfaces"], [[*line, str(samples)] for line in table[1]]


def told(found: float, spread: float, digits: int = 3, sign: str = "") -> str:
    if not np.isfinite(found):
        return "-"
    return f"{found:{sign}.{digits}f}" + (f" ± {spread:.{digits}f}" if np.isfinite(spread) else "")


def percent(found: float, spread: float) -> str:
    if not np.isfinite(found):
        return "-"
    return f"{100 * found:+.1f}" + (f" ± {100 * spread:.1f}" if np.isfinite(spread) else "") + " %"


def each(found: Values, samples: int, digits: int = 3, sign: str = "") -> list[str]:
    pairs = zip(value(found).to_numpy(), error(found, samples).to_numpy(), strict=True)
    return [told(float(one), float(spread), digits, sign) for one, spread in pairs]


def each_percent(found: Values, samples: int) -> list[str]:
    pairs = zip(value(found).to_numpy(), error(found, samples).to_numpy(), strict=True)
    return [percent(float(one), float(spread)) for one, spread in pairs]


def rows(hurst: Values, *columns: Iterable[str]) -> list[list[str]]:
    return [[f"{float(h):g}", *line] for h, line in zip(hurst, zip(*columns, strict=True), strict=True)]


# What several ensembles ask for


def curves(ensemble: xarray.Dataset) -> tuple[Values, Values, int]:
    """Return forces, stiffnesses k/(E* L) of every surface, and how many surfaces there are."""
    stiffness = ensemble["dimensionless_stiffness"]
    return ensemble["dimensionless_force"], stiffness, stiffness.sizes["sample"]


def resolved(ensemble: xarray.Dataset, mean: Values) -> Values:
    """Return the window of the thesis: mean stiffness above 20 cells, forces up to 0.07."""
    return (value(mean) > CELLS * ensemble["cell_stiffness"]) & (
        ensemble["dimensionless_force"] <= HIGHEST * (1 + ROUND)
    )


def load_at(force: Values, wanted: float) -> int:
    """Return the load whose force is nearest to the one that is wanted."""
    return int(np.argmin(np.abs(np.log(force.to_numpy() / wanted))))


def between(force: Values, low: float, high: float) -> Values:
    return (force >= low * (1 - ROUND)) & (force <= high * (1 + ROUND))


# E1


def e1_laws(ensemble: xarray.Dataset) -> xarray.Dataset:
    """Return exponents, prefactors and stiffnesses at `MIDDLE` of rough squares, by three ways to average."""
    force, stiffness, samples = curves(ensemble)
    mean = resampled(stiffness)
    inside = resolved(ensemble, mean)
    found: dict[str, Values] = {}
    laws = {
        "mean": law(force, mean, inside),
        "geometric": law(force, resampled(stiffness, "geometric"), inside),
    }
    alpha, zeta = law(force, stiffness, inside)  # of every surface
    laws["fits"] = resampled(alpha), resampled(zeta)
    for name, (exponent, prefactor) in laws.items():
        found[f"alpha_{name}"], found[f"zeta_{name}"] = exponent, prefactor
        found[f"k_{name}"] = prefactor * MIDDLE**exponent
    found["k_fits"] = resampled(zeta * MIDDLE**alpha)
    found["lowest"] = force.where(inside).min("load")
    return xarray.Dataset(found, attrs={"samples": samples})


def e1(folder: Path = FOLDER) -> dict[str, Table]:
    """Return the exponents and prefactors of surfaces, the ways to average, and lines beside them."""
    ensemble = read("e1-surfaces", folder)
    if ensemble is None:
        return {}
    found = e1_laws(ensemble)
    samples, hurst = found.attrs["samples"], found["hurst"]
    alpha, zeta = found["alpha_mean"], found["zeta_mean"]
    head = [
        "H",
        "from F/(E* h L)",
        "alpha",
        "over 1/(H + 1)",
        "zeta",
        "over 1.7/(H + 1)",
        f"k/(E* L) at {MIDDLE:g}",
    ]
    expected = 1 / (hurst + 1)
    law_rows = rows(
        hurst,
        [f"{float(low):.2g}" for low in found["lowest"]],
        each(alpha, samples),
        each_percent(alpha / expected - 1, samples),
        each(zeta, samples),
        each_percent(zeta / (1.7 * expected) - 1, samples),
        each(found["k_mean"], samples, 4),
    )
    ways = [
        "H",
        *(f"{what}, {way}" for what in ("alpha", "zeta") for way in ("of geometric means", "mean of fits")),
    ]
    way_rows = rows(
        hurst,
        *(
            each(found[f"{what}_{way}"] - found[f"{what}_mean"], samples, 3, "+")
            if what == "alpha"
            else each_percent(found[f"{what}_{way}"] / found[f"{what}_mean"] - 1, samples)
            for what in ("alpha", "zeta")
            for way in ("geometric", "fits")
        ),
    )
    parts = local({int(ensemble["points"]): ensemble})
    tables = {"e1": (head, law_rows), "e1-local": parts, "e1-ways": (ways, way_rows)}
    lines = read("e1-lines", folder)
    return tables if lines is None else tables | {"e1-lines": e1_lines(lines, ensemble)}


def e1_lines(lines: xarray.Dataset, surfaces: xarray.Dataset) -> Table:
    """Return the exponents of lines in the windows of the surfaces, and lambda, by which both are equally stiff."""
    force, stiffness, _ = curves(lines)
    mean = resampled(stiffness)
    window = e1_laws(surfaces)["lowest"]
    body = []
    points, finest = int(surfaces["points"]), lines.isel(points=-1)
    for place, h in enumerate(surfaces["hurst"].to_numpy()):
        inside = between(force, float(window[place]), HIGHEST)
        exponent, prefactor = law(force, mean.isel(hurst=place), inside)
        pair = [
            Ensemble.of(each, cell)
            for each, cell in (
                (finest.isel(hurst=place), 1 / int(finest["points"])),
                (surfaces.isel(hurst=place), float(surfaces["cell_stiffness"].isel(hurst=place))),
            )
        ]
        found = match(*pair, 0.05)
        same = lambda_rms(float(h), (points - 1) // 2)
        factor = same * found.ratio**2
        batches = lines.sizes["sample"]
        body.append(
            [
                f"{h:g}",
                *each(exponent, batches),
                each(prefactor, batches)[-1],
                told(factor, 2 * found.error * factor, 2),
                f"{same:.2f}",
            ]
        )
    names = [f"alpha, {int(n)} springs" for n in lines["points"]]
    return ["H", *names, f"zeta, {int(finest['points'])} springs", "lambda", "lambda_rms"], body


# E2


def on_grids(folder: Path = FOLDER) -> list[xarray.Dataset]:
    """Return the nested ensembles that are there."""
    found = (read(name, folder) for name in ("e2-grids", "e2-grids-2048", "e2-grids-4096"))
    return [each for each in found if each is not None]


def nested(
    ensembles: list[xarray.Dataset], wanted: Sequence[tuple[int, float | None]]
) -> dict[int, xarray.Dataset]:
    """Return the same surfaces on several grids, (points, short cut-off), by their number of points."""
    enough = [one for one in ensembles if one.sizes["sample"] >= FEWEST]
    there = {n: found for n, cut in wanted for one in enough if (found := grid(one, n, cut)) is not None}
    return dict(zip(there, paired(*there.values()), strict=True)) if there else {}


# Few surfaces are on 4096 cells: what is paired with them stands alone, so that the others keep all of theirs.
_MOST, _EVERY = (256, 512, 1024, 2048), (256, 512, 1024, 2048, 4096)
LIMITS = {
    "e2-band": ("a band down to L/32", [(n, 1 / 32) for n in (128, *_MOST[:3])]),
    "e2-band-128": ("a band down to L/128", [(n, 1 / 128) for n in _MOST[1:]]),
    "e2-wide": ("8 cells to the shortest wave", [(n, 8 / n) for n in _MOST]),
    "e2-wide-4096": ("8 cells to the shortest wave", [(n, 8 / n) for n in _EVERY]),
    "e2-all": ("all waves", [(n, ALL) for n in _MOST]),
    "e2-all-4096": ("all waves", [(n, ALL) for n in _EVERY]),
}


def e2(folder: Path = FOLDER) -> dict[str, Table]:
    """Return what grids do to the stiffness of one set of surfaces, to the rule of twenty cells and to exponents."""
    ensembles = on_grids(folder)
    tables = {}
    for name, (_, wanted) in LIMITS.items():
        same = nested(ensembles, wanted)
        if len(same) == len(wanted):
            tables[name] = counted(convergence(same), surfaces(same))
    every, finer = (nested(ensembles, LIMITS[name][1]) for name in ("e2-all", "e2-all-4096"))
    if len(every) >= 2:
        tables["e2-rule"] = counted(rule(every), surfaces(every))
        tables["e2-local"] = counted(local(every), surfaces(every))
    if 4096 in finer:
        tables["e2-local-4096"] = counted(local(finer), surfaces(finer))
    return tables


def surfaces(same: dict[int, xarray.Dataset]) -> int:
    """Return the number of surfaces of a table."""
    return next(iter(same.values())).sizes["sample"]


def convergence(same: dict[int, xarray.Dataset]) -> Table:
    """Return stiffnesses at three forces over that of the finest grid."""
    finest = max(same)
    first = same[finest]
    force, _, samples = curves(first)
    means = {points: resampled(each["dimensionless_stiffness"]) for points, each in same.items()}
    body = []
    for place, h in enumerate(first["hurst"].to_numpy()):
        for at in (7e-4, 7e-3, HIGHEST):
            load = load_at(force, at)
            k = {points: mean.isel(hurst=place, load=load) for points, mean in means.items()}
            cell = {p: float(each["cell_stiffness"].isel(hurst=place)) for p, each in same.items()}
            kept = {p: one.where(float(value(one)) > 5 * cell[p]) for p, one in k.items()}
            if sum(np.isfinite(float(value(one))) for one in kept.values()) < 3:
                continue
            ratio = [
                each_percent((kept[p] / kept[finest] - 1).expand_dims("one", 1), samples)[0]
                for p in k
                if p != finest
            ]
            body.append([f"{h:g}", f"{at:g}", *ratio])
    others = [f"{p}²" for p in same if p != finest]
    return ["H", "F/(E* h L)", *others], body


def rule(same: dict[int, xarray.Dataset]) -> Table:
    """Return how far stiffnesses of 5, 10, 20 and 40 cells are from those of the finest grid."""
    finest = same[max(same)]
    force, stiffness, samples = curves(finest)
    fine = resampled(stiffness)
    body = []
    for points, one in same.items():
        if points == max(same):
            continue
        mean = resampled(one["dimensionless_stiffness"])
        off = {}
        for cells in (5, 10, 20, 40):
            wanted = np.log(cells * one["cell_stiffness"])
            at = force_at(wanted, force, value(mean))
            off[cells] = np.exp(interpolated(at, force, mean) - interpolated(at, force, fine)) - 1
        for place, h in enumerate(one["hurst"].to_numpy()):
            found = [each_percent(values.isel(hurst=[place]), samples)[0] for values in off.values()]
            body.append([f"{h:g}", f"{points}²", *found])
    return ["H", "cells", *(f"k = {m} cells" for m in (5, 10, 20, 40))], body


def local(same: dict[int, xarray.Dataset]) -> Table:
    """Return exponents in decades of the force, where all their means are above 20 cells, on every grid."""
    body = []
    for place, h in enumerate(next(iter(same.values()))["hurst"].to_numpy()):
        for low, high in DECADES:
            line = []
            for one in same.values():
                force, stiffness, samples = curves(one.isel(hurst=place))
                mean = resampled(stiffness)
                inside = between(force, low, high)
                found, _ = law(force, mean, inside)
                whole = bool(resolved(one.isel(hurst=place), mean).where(inside, other=True).all())
                line.append(each(found.where(whole).expand_dims("one", 1), samples)[0])
            if set(line) != {"-"}:
                body.append([f"{h:g}", f"{low:g} to {high:g}", *line, f"{1 / (h + 1):.3f}"])
    return ["H", "F/(E* h L)", *(f"{n}²" for n in same), "1/(H + 1)"], body
