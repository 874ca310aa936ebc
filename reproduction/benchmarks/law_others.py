"""The smaller ensembles of the law, E3 to E7, as tables and in sentences; see `law.py`."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import numpy as np
import xarray
from law_ensembles import (
    CELLS,
    FOLDER,
    STUDIES,
    Values,
    error,
    interpolated,
    law,
    paired,
    read,
    resampled,
    value,
)
from law_tables import (
    HIGHEST,
    MIDDLE,
    Table,
    between,
    counted,
    curves,
    each,
    each_percent,
    load_at,
    resolved,
)

from roughcontact.study.study import Study
from roughcontact.study.task import generator
from roughcontact.theory.spheres_and_punches import rough_sphere
from roughcontact.theory.stiffness_laws import rough_square

PRESSURES = (1e-3, 1e-2, 1e-1)  # p l/(E* h), l the roll-off
SPHERE = {"radius": 0.5, "hurst": 0.7, "rms": 9e-3, "length": 1.0, "modulus": 1.0}
SIZE_FORCE = (0.07, 0.035)  # F/(E* h L) of the smallest size at which sizes are compared


def one(found: Values) -> Values:
    """Return a number of every replicate as the only one of a row."""
    return found.expand_dims("one", 1)


def at_hurst(words: Iterable[str], hurst: Values) -> str:
    """Return what is found at every Hurst exponent, in a row of words."""
    return ", ".join(f"{found} at H = {float(h):g}" for found, h in zip(words, hurst, strict=True))


# E3


def e3(folder: Path = FOLDER) -> dict[str, Table | str]:
    """Return exponents at low H in one window on every grid, and what the finest grid changes."""
    ensemble = read("e3-modes", folder)
    if ensemble is None:
        return {}
    force, stiffness, samples = curves(ensemble)
    mean = resampled(stiffness)
    alpha, _ = law(force, mean, between(force, 0.025, HIGHEST))
    last = alpha.isel(points=-1)
    stiffer = mean.isel(load=-1)
    body = [
        [
            f"{h:g}",
            *(each(one(alpha.isel(hurst=place, points=n)), samples)[0] for n in range(alpha.sizes["points"])),
            each(one((last - alpha.isel(points=0)).isel(hurst=place)), samples, 3, "+")[0],
            each_percent(
                one((stiffer.isel(points=-1) / stiffer.isel(points=0) - 1).isel(hurst=place)), samples
            )[0],
        ]
        for place, h in enumerate(ensemble["hurst"].to_numpy())
    ]
    points = [int(n) for n in ensemble["points"]]
    ends = f"{points[-1]}² less {points[0]}²", f"k at 0.07, {points[-1]}² over {points[0]}²"
    change = at_hurst(each(last - alpha.isel(points=0), samples, 3, "+"), ensemble["hurst"])
    said = (
        f"Number of waves: at low H, in one window of forces, the exponent on {points[-1]}² exceeds that on "
        f"{points[0]}² by {change} ({samples} surfaces)."
    )
    return {"e3": (["H", *(f"{n}²" for n in points), *ends], body), "e3 said": said}


# E4


def e4(folder: Path = FOLDER) -> dict[str, Table | str]:
    """Return what amplitudes and the shape of the band change, at the rms height of each surface."""
    ensemble = read("e4-models", folder)
    if ensemble is None:
        return {}
    force, stiffness, samples = curves(ensemble)
    heights = rms_heights("e4-models", ensemble)
    level = resampled(np.exp(interpolated(np.log(MIDDLE * heights), force, stiffness)))
    nominal = resampled(np.exp(interpolated(np.log(MIDDLE * heights**0), force, stiffness)))
    first = {"row": 0, "amplitudes": 0}
    body = []
    for place, h in enumerate(ensemble["hurst"].to_numpy()):
        for row, shape in enumerate(("square", "disc")):
            for kind, amplitudes in enumerate(("exact", "gaussian")):
                here = {"hurst": place, "row": row, "amplitudes": kind}
                line = [f"{h:g}", f"{shape}, {amplitudes}"]
                line.append(f"{100 * float(heights.isel(here).std('sample')):.1f} %")
                line += each(one(level.isel(here)), samples, 4)
                for k in (level, nominal):
                    ratio = k.isel(here) / k.isel(first | {"hurst": place}) - 1
                    line += each_percent(one(ratio), samples) if row or kind else ["-"]
                body.append(line)
    head = ["H", "waves, amplitudes", "scatter of the rms height", f"k/(E* L) at {MIDDLE:g}"]
    models = {
        "Gaussian amplitudes": {"row": 0, "amplitudes": 1},
        "A disc of wave vectors": {"row": 1, "amplitudes": 0},
    }
    said = "Random model: " + " ".join(
        f"{words} change{'s' * (words[0] == 'A')} the mean stiffness at {MIDDLE:g} E* h L by "
        f"{at_hurst(each_percent(level.isel(place) / level.isel(first) - 1, samples), ensemble['hurst'])}."
        for words, place in models.items()
    )
    said += f" h is the rms height of each surface ({samples} surfaces)."
    return {"e4": ([*head, "k, difference", "k, difference at one h for all"], body), "e4 said": said}


def rms_heights(name: str, ensemble: xarray.Dataset) -> Values:
    """Return the rms height of every surface of a study over that of its parameters; the surfaces are drawn again."""
    study = Study.read(STUDIES / f"{name}.toml")
    shape = ensemble["dimensionless_stiffness"].isel(load=0, drop=True)
    outer = [each_ for each_ in shape.dims if each_ != "sample"]
    samples = ensemble["sample"].to_numpy()
    found = [
        [parameters.roughness(generator(study.seed, int(sample))).rms / parameters.rms for sample in samples]
        for parameters in study.combinations()
    ]
    sizes = [shape.sizes[each_] for each_ in outer]
    dims = (*outer, "sample")
    return Values(np.reshape(found, (*sizes, len(samples))), dims=dims, coords=shape.transpose(*dims).coords)


# E5


def e5(folder: Path = FOLDER) -> dict[str, Table | str]:
    """Return stiffnesses of nominally flat surfaces, free and periodic, and of patches."""
    tables, told = {}, {}
    for name in ("e5-flat", "e5-flat-1024", "e5-flat-2048"):
        ensemble = read(name, folder)
        if ensemble is not None:
            samples = ensemble.sizes["sample"]
            head, body = flat(ensemble)
            tables[name] = counted((head, body), samples)
            told[samples] = flat_words(int(ensemble["points"]), samples, body)
    if told:
        tables["e5 said"] = told[max(told)]
    flat_squares = read("e5-flat-1024", folder)
    if flat_squares is not None:
        tables["law-of-flat"] = law_of_flat(flat_squares)
    patches, whole = read("e5-patches", folder), read("e5-flat-1024", folder)
    if patches is not None:
        tables["e5-patches"] = patched(patches, whole)
    return tables


def flat_words(points: int, samples: int, body: list[list[str]]) -> str:
    """Return in a sentence what a table of `flat` says."""
    grows = ", ".join(f"{line[1]} for l = {line[0]}" for line in body)
    *_, last = body
    return (
        f"Roll-off: on {points}², K of a periodic surface with a roll-off at l grows as the pressure to the power of "
        f"{grows}. The K of a free square of L = 32 l exceeds that of the periodic surface by {last[4]} at "
        f"p l/(E* h) = {PRESSURES[0]:g} and by {last[8]} at {PRESSURES[-1]:g}; its k/K falls from {last[5]} to "
        f"{last[9]} ({samples} surfaces)."
    )


def law_of_flat(ensemble: xarray.Dataset) -> str:
    """Return in words how far the law of squares lies from free squares with a roll-off."""
    hurst, words = float(ensemble["hurst"]), []
    for row, length in enumerate(ensemble["rolloff"].to_numpy()):
        force = ensemble["dimensionless_force"].isel(row=row, periodic=0)
        mean = resampled(ensemble["dimensionless_stiffness"].isel(row=row, periodic=0))
        k = np.exp(interpolated(np.log(xarray.DataArray(MIDDLE)), force, mean))
        off = float(rough_square.stiffness(MIDDLE, hurst, 1.0, 1.0, 1.0, cut="interior")) / k - 1
        words.append(f"{each_percent(one(off), ensemble.sizes['sample'])[0]} for l = L/{1 / length:g}")
    return (
        f"On free squares with a roll-off at l, H = {hurst:g}, the law of the interior exceeds the mean stiffness at "
        f"{MIDDLE:g} E* h L by {', '.join(words)} (E5, {ensemble.sizes['sample']} surfaces)."
    )


def flat(ensemble: xarray.Dataset) -> Table:
    """Return exponents of k and K over the upper two decades of pressure, and how they compare at three pressures."""
    samples = ensemble.sizes["sample"]
    approach, gap = (resampled(ensemble[f"{kind}_stiffness"]) for kind in ("dimensionless", "interfacial"))
    body = []
    for row, rolloff in enumerate(ensemble["rolloff"].to_numpy()):
        force = ensemble["dimensionless_force"].isel(row=row, periodic=0)
        pressure = force * float(rolloff)
        inside = between(pressure, *PRESSURES[::2])
        free, periodic = ({"row": row, "periodic": each_} for each_ in (0, 1))
        least = CELLS * float(ensemble["cell_stiffness"].isel(row=row).max())
        slopes = [
            law(force, k, inside & (value(k) > least))[0]
            for k in (gap.isel(periodic), gap.isel(free), approach.isel(free))
        ]
        line = [each(one(slope), samples)[0] for slope in slopes]
        for at in PRESSURES:
            load = {"load": load_at(pressure, at)}
            both = gap.isel(free | load) / gap.isel(periodic | load) - 1
            share = approach.isel(free | load) / gap.isel(free | load)
            line += [each_percent(one(both), samples)[0], each(one(share), samples, 2)[0]]
        constant = gap.isel(periodic | {"load": load_at(pressure, PRESSURES[1])})
        line.append(each(one(constant / float(force[load_at(pressure, PRESSURES[1])])), samples, 2)[0])
        body.append([f"L/{1 / rolloff:g}", *line])
    compared = [
        words for at in PRESSURES for words in (f"K, free over periodic, at {at:g}", f"k/K, free, at {at:g}")
    ]
    exponents = [f"exponent of {what}" for what in ("K, periodic", "K, free", "k, free")]
    return ["roll-off l", *exponents, *compared, f"K h/F, periodic, at {PRESSURES[1]:g}"], body


def patched(patches: xarray.Dataset, whole: xarray.Dataset | None) -> Table:
    """Return the stiffness K per area of patches over that of the periodic surface that they are cut from."""
    if whole is not None:
        patches, whole = paired(patches, whole)
    samples = patches.sizes["sample"]
    gap, approach = (resampled(patches[f"{kind}_stiffness"]) for kind in ("interfacial", "dimensionless"))
    body = []
    for row, rolloff in enumerate(patches["rolloff"].to_numpy()):
        pressure = patches["dimensionless_force"].isel(row=row) * float(rolloff)
        line = []
        for at in PRESSURES:
            load = load_at(pressure, at)
            found = gap.isel(row=row, load=load)
            if whole is None:
                line.append("-")
            else:
                last = whole.isel(row=-1, periodic=1)
                joint = resampled(last["interfacial_stiffness"]).isel(load=load)
                per_area = found * float(rolloff) / (joint * float(last["rolloff"])) - 1
                line.append(each_percent(one(per_area), samples)[0])
            line.append(each(one(approach.isel(row=row, load=load) / found), samples, 2)[0])
        body.append([f"{1 / rolloff:g} l", *line])
    compared = [
        words for at in PRESSURES for words in (f"K/A0 over the joint's, at {at:g}", f"k/K, at {at:g}")
    ]
    return ["side of the patch", *compared], body


# E6


def e6(folder: Path = FOLDER) -> dict[str, Table | str]:
    """Return the stiffness of rough spheres over the closed form, with the thesis' law and with that of E1."""
    ensemble = read("e6-spheres", folder)
    if ensemble is None:
        return {}
    force, stiffness, samples = curves(ensemble)
    mean = resampled(stiffness)
    forces = force.to_numpy() * SPHERE["rms"]
    closed = rough_sphere.stiffness(forces, **SPHERE)
    found = fitted_roughness(folder)
    own = np.full(forces.shape, np.nan) if found is None else with_law(forces, *found)
    finer = read("e6-spheres-1024", folder)
    grid = None
    if finer is not None:
        fine, coarse = paired(finer, ensemble)
        grid = resampled(fine["dimensionless_stiffness"]) / resampled(coarse["dimensionless_stiffness"]) - 1
    body = []
    for load in range(0, len(forces), 2):
        cells = float(value(mean)[load] / ensemble["cell_stiffness"])
        k = mean.isel(load=load)
        line = [each_percent(one(k / law_ - 1), samples)[0] for law_ in (closed[load], own[load])]
        fine_line = "-" if grid is None else each_percent(one(grid.isel(load=load)), fine.sizes["sample"])[0]
        body.append([f"{forces[load]:.2g}", f"{cells:.0f}", f"{float(value(k)):.4f}", *line, fine_line])
    head = [
        "F/(E* L²)",
        "k over that of a cell",
        "k/(E* L)",
        "over eq. 5.9",
        "with alpha, zeta of E1",
        "1024² over 512²",
    ]
    carried = np.flatnonzero(value(mean) > CELLS * ensemble["cell_stiffness"])
    off = value(mean).to_numpy()[carried] / closed[carried] - 1
    most = float((error(mean, samples) / value(mean))[carried].max())
    said = (
        f"Rough spheres: the mean stiffness of {samples} spheres differs from eq. 5.9 by {100 * off.min():+.1f} to "
        f"{100 * off.max():+.1f} % (± {100 * most:.1f} % or less) where it exceeds that of {CELLS} cells."
    )
    return {"e6": (head, body), "e6 said": said}


def fitted_roughness(folder: Path) -> tuple[float, float] | None:
    """Return exponent and prefactor of E1 at the Hurst exponent of the spheres."""
    ensemble = read("e1-surfaces", folder)
    if ensemble is None:
        return None
    ensemble = ensemble.sel(hurst=SPHERE["hurst"])
    force, stiffness, _ = curves(ensemble)
    mean = resampled(stiffness)
    alpha, zeta = law(force, mean, resolved(ensemble, mean))
    return float(value(alpha)), float(value(zeta))


def with_law(forces: np.ndarray, alpha: float, zeta: float) -> np.ndarray:
    """Return stiffnesses of eq. 5.9 with another power law of the roughness: Hertz' force and that of the law added."""
    k = np.geomspace(1e-4, 2.0, 4000)
    force = k**3 / (6 * SPHERE["radius"]) + SPHERE["rms"] * (k / zeta) ** (1 / alpha)
    return np.exp(np.interp(np.log(forces), np.log(force), np.log(k)))


# E7


def e7(folder: Path = FOLDER) -> dict[str, Table | str]:
    """Return stiffnesses of three sizes of one Theta and one shortest wave, at one force F/(E* Theta)."""
    ensemble = read("e7-sizes", folder)
    if ensemble is None:
        return {}
    force, stiffness, samples = curves(ensemble)
    mean = resampled(stiffness)
    sizes = ensemble["points"] / int(ensemble["points"][0])
    body, words = [], []
    for place, h in enumerate(ensemble["hurst"].to_numpy()):
        for at in SIZE_FORCE:
            # At one F/(E* Theta) the force F/(E* h L) goes as L^-(H+1), and k/E* is k/(E* L) times L.
            places = np.log(at) - (h + 1) * np.log(sizes)
            k = np.exp(interpolated(places, force, mean.isel(hurst=place))) * sizes
            ratio = k / k.isel(points=0) - 1
            cells = np.exp(interpolated(places, force, value(mean).isel(hurst=place))) / ensemble[
                "cell_stiffness"
            ].isel(hurst=place)
            line = [each_percent(one(ratio.isel(points=n)), samples)[0] for n in range(1, sizes.size)]
            body.append([f"{h:g}", f"{at:g}", *line, ", ".join(f"{float(c):.0f}" for c in cells)])
        words.append(body[-len(SIZE_FORCE)][sizes.size])
    names = [f"size {float(size):g} over size 1" for size in sizes[1:]]
    said = (
        f"Size: at the same Theta and the same force, k/E* of a square of {float(sizes[-1]):g} times the side differs "
        f"by {at_hurst(words, ensemble['hurst'])} ({samples} surfaces)."
    )
    return {
        "e7": (["H", "F/(E* h L) of size 1", *names, "cells of stiffness"], body),
        "e7 said": said,
    }
