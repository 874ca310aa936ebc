"""How far the ensembles of the law are, and what error is left by counts that are smaller than wanted; see `law.py`."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import cast

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
from law_others import PRESSURES
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
)

WANTED = {"alpha": 0.005, "zeta": 0.015}  # standard errors
Found = tuple[Values, int, str]  # replicates, samples, format of an error


def _alpha(found: xarray.Dataset, _: Path) -> Found:
    laws = e1_laws(found)
    return laws["alpha_mean"], laws.attrs["samples"], ".4f"


def _lines(found: xarray.Dataset, _: Path) -> Found:
    force, stiffness, samples = curves(found.isel(points=-1))
    return law(force, resampled(stiffness), between(force, *DECADES[-1]))[0], samples, ".4f"


def _grid(coarse: int, fine: int, limit: str) -> Callable[[xarray.Dataset, Path], Found]:
    def ratio(_: xarray.Dataset, folder: Path) -> Found:
        same = nested(on_grids(folder), LIMITS[limit][1])
        force, _, samples = curves(same[fine])
        ends = (resampled(same[n]["dimensionless_stiffness"]) for n in (coarse, fine))
        first, second = (each.isel(load=load_at(force, HIGHEST)) for each in ends)
        return first / second, samples, ".2%"

    return ratio


def _modes(found: xarray.Dataset, _: Path) -> Found:
    force, stiffness, samples = curves(found)
    alpha, _ = law(force, resampled(stiffness), between(force, 0.025, HIGHEST))
    return alpha.isel(points=-1) - alpha.isel(points=0), samples, ".3f"


def _models(found: xarray.Dataset, _: Path) -> Found:
    force, stiffness, samples = curves(found)
    k = resampled(stiffness).isel(row=0, load=load_at(force, MIDDLE))
    return k.sel(amplitudes="gaussian") / k.sel(amplitudes="exact"), samples, ".1%"


def _flat(found: xarray.Dataset, _: Path) -> Found:
    gap = resampled(found["interfacial_stiffness"]).isel(periodic=1)
    force = found["dimensionless_force"].isel(periodic=0)
    slopes = [
        law(force.isel(row=row), gap.isel(row=row), between(force.isel(row=row) * length, *PRESSURES[::2]))[0]
        for row, length in enumerate(found["rolloff"].to_numpy())
    ]
    table = np.stack([each.to_numpy() for each in slopes], axis=1)
    return Values(table, dims=("replicate", "row")), found.sizes["sample"], ".3f"


def _patches(found: xarray.Dataset, folder: Path) -> Found:
    whole = read("e5-flat-1024", folder)
    assert whole is not None
    patches, joint = paired(found, whole.isel(row=-1, periodic=1))
    pressure = patches["dimensionless_force"].isel(row=0) * float(patches["rolloff"][0])
    load = {"load": load_at(pressure, PRESSURES[1])}
    parts, all_ = (resampled(each["interfacial_stiffness"]).isel(load) for each in (patches, joint))
    return parts / all_, patches.sizes["sample"], ".1%"


def _spheres(found: xarray.Dataset, _: Path) -> Found:
    _, stiffness, samples = curves(found)
    mean = resampled(stiffness)
    return (mean / value(mean)).where(value(mean) > CELLS * found["cell_stiffness"]), samples, ".1%"


def _finer_spheres(found: xarray.Dataset, folder: Path) -> Found:
    coarse = read("e6-spheres", folder)
    assert coarse is not None
    fine, coarse = paired(found, coarse)
    ends = [resampled(each["dimensionless_stiffness"]) for each in (fine, coarse)]
    kept = value(ends[1]) > CELLS * coarse["cell_stiffness"]
    return (ends[0] / ends[1]).where(kept), fine.sizes["sample"], ".1%"


def _sizes(found: xarray.Dataset, _: Path) -> Found:
    force, stiffness, samples = curves(found)
    sizes = found["points"] / int(found["points"][0])
    # Ln F/(E* h L) of one force F/(E* Theta) on every size; the ratio of sizes has no error.
    places = np.log(HIGHEST) - (found["hurst"] + 1) * np.log(sizes)
    # K/E* over that of the smallest.
    log_k = interpolated(places, force, resampled(stiffness)) + np.log(sizes)
    return np.exp(log_k.isel(points=-1) - log_k.isel(points=0)), samples, ".1%"


def _crest(found: xarray.Dataset, folder: Path) -> Found:
    return _alpha(found.isel(row=1), folder)


def _border(found: xarray.Dataset, _: Path) -> Found:
    force, stiffness, samples = curves(found)
    k = resampled(stiffness).isel(load=load_at(force, DECADES[1][0]))
    return k.isel(crest=0) / k.isel(crest=-1), samples, ".1%"


DECIDING = {
    "e1-lines": ("alpha of one decade", _lines),
    "e1-surfaces": ("alpha", _alpha),
    "e2-grids": (f"k on 512² over 2048² at {HIGHEST:g}", _grid(512, 2048, "e2-all")),
    "e2-grids-2048": (f"k on 1024² over 2048² at {HIGHEST:g}", _grid(1024, 2048, "e2-all")),
    "e2-grids-4096": (f"k on 2048² over 4096² at {HIGHEST:g}", _grid(2048, 4096, "e2-all-4096")),
    "e3-modes": ("alpha on 2048² less 256²", _modes),
    "e4-models": ("k of Gaussian over exact amplitudes", _models),
    "e5-flat": ("exponent of K, periodic", _flat),
    "e5-flat-1024": ("exponent of K, periodic", _flat),
    "e5-flat-2048": ("exponent of K, periodic", _flat),
    "e5-patches": (f"K of a patch over the joint's, at {PRESSURES[1]:g}", _patches),
    "e6-spheres": ("k", _spheres),
    "e6-spheres-1024": ("k on 1024² over 512²", _finer_spheres),
    "e7-sizes": (f"k of size 4 over size 1 at {HIGHEST:g}", _sizes),
    "e8-border": (f"k of a crest at 0 over L/16, at {DECADES[1][0]:g}", _border),
    "e8-cut": ("alpha, crest in the middle", _crest),
}


def runs(folder: Path = FOLDER) -> Table:
    """Return a table of the ensembles: what they are, how far they are, what error is left, and what is to come."""
    rows = []
    for path in sorted(STUDIES.glob("*.toml")):
        text = path.read_text(encoding="utf-8")
        asked = tomllib.loads(text)["samples"]
        words = " ".join(line.lstrip("# ") for line in text.split("\nname")[0].splitlines())
        words = re.split(r"[.:] ", words.partition(": ")[2])[0].rstrip(".")
        found = read(path.stem, folder)
        name = f"[`{path.stem}`](../../examples/law/{path.name})"
        rows.append([name, words, str(asked), *_far(path.stem, found, asked, folder)])
    head = ["study", "content", "samples planned", "done", "hours", "hours left"]
    return [*head, "quantity with the largest standard error", "its error now", "with all samples"], rows


def _far(name: str, found: xarray.Dataset | None, asked: int, folder: Path) -> list[str]:
    """Return how many samples are done, in how many hours, those to come, and the error now and with all of them."""
    what, replicates = DECIDING.get(name, ("", None))
    if found is None or not found.sizes["sample"]:
        return ["0", "-", "-", what or "-", "-", "-"]
    done, hours = found.sizes["sample"], found.attrs["hours"]
    line = [str(done), f"{hours:.1f}", f"{hours * max(asked / done - 1, 0):.1f}"]
    if replicates is None or done < 2:
        return [*line, what or "-", "-", "-"]
    values, samples, form = replicates(found, folder)
    largest = float(cast("Values", error(values, samples)).max())
    return [*line, what, f"{largest:{form}}", f"{largest * (samples / max(asked, samples)) ** 0.5:{form}}"]


def counts(folder: Path = FOLDER) -> Table | None:
    """Return a table of how single surfaces of E1 scatter, and how many of them the errors take that are wanted."""
    ensemble = read("e1-surfaces", folder)
    if ensemble is None:
        return None
    laws = e1_laws(ensemble)
    samples = laws.attrs["samples"]
    scatter = [error(laws[f"{name}_mean"], samples) * samples**0.5 for name in WANTED]
    rows = [
        [
            f"{float(h):g}",
            *(f"{one:.2f}" for one in pair),
            *(f"{(one / wanted) ** 2:.0f}" for one, wanted in zip(pair, WANTED.values(), strict=True)),
        ]
        for h, *pair in zip(laws["hurst"], *(each.to_numpy() for each in scatter), strict=True)
    ]
    names = [f"surfaces for {name} to {wanted:g}" for name, wanted in WANTED.items()]
    return ["H", *(f"scatter of {name}" for name in WANTED), *names], rows
