"""What the larger ensembles of the law say about claims that the figures' own leave open; see `pages.py`."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import xarray
from law_crest import by_cut, laws_of
from law_ensembles import CELLS, FOLDER, Values, error, interpolated, law, read, resampled, value
from law_others import PRESSURES, SIZE_FORCE, SPHERE
from law_tables import HIGHEST, between, curves, e1_laws, each, resolved

from roughcontact.theory.spheres_and_punches import rough_sphere
from roughcontact_thesis import (
    fig21_stiffness_of_surfaces as fig21,
    fig26_exponent_by_cells as fig26,
    fig27_exponent as fig27,
    fig28_prefactor as fig28,
    fig37_stiffness_of_sphere as fig37,
    outlook_flat,
    outlook_scale,
)
from roughcontact_thesis.ruling import VICINITY, Ruling, ranged, ruled, ruled_in_middle, undecided
from roughcontact_thesis.verdict import Verdict, spanned

SMOOTH = slice(2 + VICINITY, None)  # Hurst exponents


@dataclass(frozen=True)
class Larger:
    """A claim judged by a larger ensemble.

    Parameters
    ----------
    figure, claim : str
        Whose claim it is.
    found : str
        What is found.
    ruling : Ruling
    """

    figure: str
    claim: str
    found: str
    ruling: Ruling


def judged(verdict: Verdict, figure: str, larger: list[Larger]) -> Verdict:
    """Return a verdict, by a larger ensemble where the figure's own does not decide it and there is one."""
    for one in larger:
        if (one.figure, one.claim) == (figure, verdict.claim) and verdict.ruling.word == "not decided":
            found = f"{verdict.found}. By the larger ensemble of law.md: {one.found}"
            ranges = verdict.ruling.ranges | one.ruling.ranges
            return replace(verdict, found=found, ruling=replace(one.ruling, ranges=ranges))
    return verdict


def rulings(folder: Path = FOLDER) -> list[Larger]:
    """Return what the ensembles say that are there, with the tolerances of the figures."""
    every = {
        "e1-surfaces": _squares,
        "e3-modes": _scales,
        "e5-flat-1024": _flat,
        "e6-spheres": _spheres,
        "e7-sizes": _sizes,
        "e8-cut": _shape,
    }
    found = ((read(name, folder), judge) for name, judge in every.items())
    return [one for ensemble, judge in found if ensemble is not None for one in judge(ensemble, folder)]


def _by(
    claim: tuple[str, str],
    off: Values,
    tolerance: float,
    told: tuple[int, str],
    form: str = "+.1%",
    *,
    rule: Callable[..., Ruling] = ruled_in_middle,
) -> Larger:
    """Return the ruling on the deviations of every replicate, from so many samples of a kind."""
    away, spread = value(off), error(off, told[0])
    found, counts = rule(away, spread, tolerance, form), f"{told[0]} {told[1]}"
    words = ranged(away, spread, tolerance, form) or f"{spanned(away, form)}"
    ruling = replace(found, trigger=f"{found.trigger}, {counts}")
    return Larger(*claim, f"{words}; {counts}", ruling)


def _squares(ensemble: xarray.Dataset, folder: Path) -> Iterator[Larger]:
    laws = e1_laws(ensemble)
    samples, hurst = laws.attrs["samples"], laws["hurst"]
    told = samples, f"surfaces of {int(ensemble['points'])}² cells"
    alpha, zeta = laws["alpha_mean"], laws["zeta_mean"]
    smooth = 3 * alpha.sel(hurst=SMOOTH) - 1
    yield _by(("fig27", "alpha = 1/(H + 1) for surfaces"), alpha * (hurst + 1) - 1, fig27.NEAR, told)
    hertz = "fig27", "the exponent of Hertz for surfaces above H = 2"
    yield _by(hertz, smooth, fig27.NEAR, told, rule=ruled)
    fair = "fig28", "zeta = 1.7/(H + 1) is a fairly good approximation"
    yield _by(fair, zeta * (hurst + 1) / 1.7 - 1, fig28.FAIR, told)
    force, stiffness, _ = curves(ensemble)
    mean = resampled(stiffness)
    at = xarray.DataArray(list(fig28.FORCES), dims="force", coords={"force": list(fig28.FORCES)})
    k = np.exp(interpolated(np.log(at), force, mean))
    k = k.where(value(k) > CELLS * ensemble["cell_stiffness"]).transpose("replicate", "hurst", "force")
    exponents = {"measured": alpha, "law": 1 / (hurst + 1)}
    for name, claim, *_ in fig28.LAWS:
        off = (k / (1.7 / (hurst + 1) * at ** exponents[name]) - 1).transpose(*k.dims)
        yield _by(("fig28", claim), off, fig28.FAIR, told)
    only = "fig28", "only above H = 2 does the stiffness not depend on H"
    yield _by(only, fig28.changes(k), fig28.NEAR, told, rule=ruled)
    ways = [laws[f"zeta_{way}"] / zeta - 1 for way in ("geometric", "fits")]
    average = "fig28", "the way to average does not move the prefactor"
    yield _by(average, xarray.concat(ways, "way"), fig28.NEAR, told)
    bent = (mean / (zeta * force**alpha) - 1).where(resolved(ensemble, mean))
    yield _by(("fig21", "a power law for smaller forces"), bent, fig21.BENT, told, rule=ruled)
    lines = read("e1-lines", folder)
    if lines is not None:
        yield _lines(laws, lines, told)


def _lines(laws: xarray.Dataset, lines: xarray.Dataset, told: tuple[int, str]) -> Larger:
    """Return whether exponents of surfaces are those of lines, in the windows of the surfaces."""
    force, stiffness, count = curves(lines.isel(points=-1))
    alpha, _ = law(force, resampled(stiffness), between(force, laws["lowest"], HIGHEST))
    surfaces = laws["alpha_mean"]
    away = value(surfaces) - value(alpha)
    spread = np.hypot(error(surfaces, told[0]), error(alpha, count))
    form, counts = "+.3f", f"{told[0]} {told[1]}"
    rule = ruled(away.sel(hurst=fig27.MATCHED), spread.sel(hurst=fig27.MATCHED), fig27.MATCH, form)
    rule = replace(
        rule,
        trigger=f"{rule.trigger}, {counts}",
        ranges=ruled(away, spread, fig27.MATCH, form).ranges,
    )
    claim = "exponents of surfaces and of lines match"
    return Larger("fig27", claim, f"{ranged(away, spread, fig27.MATCH, form)}; {counts}", rule)


def _scales(ensemble: xarray.Dataset, folder: Path) -> Iterator[Larger]:
    """Yield what more waves do to the exponent at H = 0, in the window of figure 26."""
    force, stiffness, samples = curves(ensemble.sel(hurst=0))
    alpha, _ = law(force, resampled(stiffness), between(force, *fig26.COMMON))
    ends = alpha.isel(points=[0, -1])
    apart = ends.diff("points").isel(points=0)
    words = " and ".join(
        f"{one} on {int(points)}²" for one, points in zip(each(ends, samples), ends["points"], strict=True)
    )
    found = f"{words} cells at H = 0, in one window; {samples} surfaces"
    rule = fig26.grown(float(value(apart)), float(error(apart, samples)))
    rule = replace(rule, trigger=f"{rule.trigger} at H = 0, {samples} surfaces")
    yield Larger("fig26", "it depends on the number of scales, not on the forces of the fit", found, rule)
    steep = undecided(f"{words} cells at H = 0; no limit is visible", "what is missing, on ever finer grids")
    yield Larger("fig32", "it is too steep because of the resolution", f"{found}; 1 by the law", steep)


def _flat(ensemble: xarray.Dataset, folder: Path) -> Iterator[Larger]:
    """Yield the exponents of surfaces with a roll-off, for the pressures of E5."""
    samples, rolloff = ensemble.sizes["sample"], ensemble["rolloff"]
    force, gap = ensemble["dimensionless_force"], resampled(ensemble["interfacial_stiffness"])
    pressure = force * rolloff
    alpha, many = (
        law(force, gap, between(pressure, low, PRESSURES[-1]))[0].rename(row="long")
        for low in (PRESSURES[0], outlook_flat.MANY * rolloff**2)
    )
    lengths = (1 / rolloff.to_numpy()).round().astype(int)
    off = (alpha - 0.9).assign_coords(long=lengths).transpose("replicate", "long", "periodic")
    told = samples, f"surfaces of {int(ensemble['points'])}² cells"
    claim = "outlook-flat", "with a roll-off the exponent is about 0.9"
    one = _by(claim, off, outlook_flat.NEAR, told, "+.3f", rule=ruled)
    periodic = each(alpha.sel(periodic=True), samples)
    words = ", ".join(f"{found} at L/{n}" for found, n in zip(periodic, lengths, strict=True))
    first = each(many.sel(periodic=True).isel(long=[0]), samples)[0]
    yield replace(
        one,
        found=f"{words}, periodic, at pressures p l/(E* h) from {PRESSURES[0]:g} to {PRESSURES[-1]:g}; at "
        f"L/{lengths[0]} few cells carry at the lower end: {first} from {outlook_flat.MANY:g} E* h l on; "
        f"{told[0]} {told[1]}",
    )


def _spheres(ensemble: xarray.Dataset, folder: Path) -> Iterator[Larger]:
    force, stiffness, samples = curves(ensemble)
    mean = resampled(stiffness)
    closed = rough_sphere.stiffness(force.to_numpy() * SPHERE["rms"], **SPHERE)
    kept = value(mean) > CELLS * ensemble["cell_stiffness"]
    off = (mean / xarray.DataArray(closed, dims="load") - 1).where(kept)
    told = samples, f"spheres of {int(ensemble['points'])}² cells"
    one = _by(("fig37", "sphere and roughness act as their forces added"), off, fig37.NEAR, told, rule=ruled)
    most = spanned(error(off, samples), ".1%")
    yield replace(
        one,
        found=f"{spanned(value(off), '+.1%')} from eq. 5.9 where resolved, errors {most}; {told[0]} {told[1]}",
    )


def _sizes(ensemble: xarray.Dataset, folder: Path) -> Iterator[Larger]:
    """Yield how k/E* of four times the side differs, at one Theta, one shortest wave and one force."""
    force, stiffness, samples = curves(ensemble)
    sizes = ensemble["points"] / int(ensemble["points"][0])
    # At one F/(E* Theta) the force F/(E* h L) goes as L^-(H+1), and k/E* is k/(E* L) times L.
    places = np.log(SIZE_FORCE[0]) - (ensemble["hurst"] + 1) * np.log(sizes)
    k = np.exp(interpolated(places, force, resampled(stiffness))) * sizes
    claim = "at a given Theta and force a square of four times the side has the same stiffness"
    off = k.isel(points=-1, drop=True) / k.isel(points=0, drop=True) - 1
    told = (
        samples,
        f"surfaces of {' and '.join(str(int(ensemble['points'][end])) for end in (0, -1))} cells a side",
    )
    yield _by(("outlook-scale", claim), off, outlook_scale.NEAR, told)


def _shape(ensemble: xarray.Dataset, folder: Path) -> Iterator[Larger]:
    """Yield the exponents of squares around their highest crest, and what a cut at random does to the stiffness."""
    cuts, force = by_cut(ensemble), ensemble["dimensionless_force"].to_numpy()
    told = ensemble.sizes["sample"], f"surfaces of {int(ensemble['points'])}² cells"
    drawn, middle = cuts["period"], cuts["interior"]
    kept = drawn["inside"] & resolved(middle, middle["mean"])
    off = (drawn["mean"] / middle["mean"] - 1).where(kept).assign_coords(load=force).rename(load="force")
    alpha, _ = laws_of(middle)
    central, hertz = (("fig27", claim) for claim, *_ in fig27.CENTRED)
    yield _by(central, alpha * (alpha["hurst"] + 1) - 1, fig27.NEAR, told)
    yield _by(hertz, 3 * alpha.sel(hurst=SMOOTH) - 1, fig27.NEAR, told, rule=ruled)
    claim = "fig21", "the shape of the square plays no role at low loads"
    one = _by(claim, off, fig21.SHAPE, told, rule=ruled)
    words = f"cut at random over the crest in the middle, {one.found}"
    yield replace(
        one, found=words, ruling=replace(one.ruling, tolerance=f"{fig21.SHAPE:.0%} of the mean stiffness")
    )
