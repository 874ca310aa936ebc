"""What the larger ensembles of the law say about claims that the figures' own leave open; see `pages.py`."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import xarray
from law_ensembles import CELLS, FOLDER, Values, error, interpolated, read, resampled, value
from law_others import SPHERE
from law_tables import curves, e1_laws

from roughcontact.theory.spheres_and_punches import rough_sphere
from roughcontact_thesis import fig27_exponent, fig28_prefactor, fig37_stiffness_of_sphere
from roughcontact_thesis.ruling import VICINITY, Ruling, middle, ranged, ruled
from roughcontact_thesis.verdict import Verdict, spanned


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
            return replace(verdict, found=found, ruling=one.ruling)
    return verdict


def rulings(folder: Path = FOLDER) -> list[Larger]:
    """Return what E1 and E6 say, with the tolerances of the figures."""
    return [*_squares(folder), *_spheres(folder)]


def _squares(folder: Path) -> Iterator[Larger]:
    ensemble = read("e1-surfaces", folder)
    if ensemble is None:
        return
    laws = e1_laws(ensemble)
    samples, hurst = laws.attrs["samples"], laws["hurst"]
    told = f"{samples} surfaces of {int(ensemble['points'])}² cells"
    alpha, zeta = laws["alpha_mean"], laws["zeta_mean"]

    def larger(figure: str, claim: str, off: Values, tolerance: float, above: float | None = None) -> Larger:
        away, spread = value(off), error(off, samples)
        if above is not None:
            away, spread = (each.sel(hurst=slice(above, None)) for each in (away, spread))
        pair = (away, spread) if above is not None else (middle(away), middle(spread))
        ruling = ruled(*pair, tolerance)
        ruling = replace(ruling, trigger=f"{ruling.trigger}, {told}")
        return Larger(figure, claim, f"{ranged(away, spread, tolerance)}; {told}", ruling)

    near, fair = fig27_exponent.NEAR, fig28_prefactor.FAIR
    yield larger("fig27", "alpha = 1/(H + 1) for surfaces", alpha * (hurst + 1) - 1, near)
    yield larger("fig27", "the exponent of Hertz for surfaces above H = 2", 3 * alpha - 1, near, 2 + VICINITY)
    yield larger(
        "fig28", "zeta = 1.7/(H + 1) is a fairly good approximation", zeta * (hurst + 1) / 1.7 - 1, fair
    )
    force, stiffness, _ = curves(ensemble)
    at = xarray.DataArray(
        list(fig28_prefactor.FORCES), dims="force", coords={"force": list(fig28_prefactor.FORCES)}
    )
    k = np.exp(interpolated(np.log(at), force, resampled(stiffness)))
    k = k.where(value(k) > CELLS * ensemble["cell_stiffness"])
    exponents = {"measured": alpha, "law": 1 / (hurst + 1)}
    for name, claim, *_ in fig28_prefactor.LAWS:
        if name in exponents:
            off = (k / (1.7 / (hurst + 1) * at ** exponents[name]) - 1).transpose(
                "replicate", "hurst", "force"
            )
            yield larger("fig28", claim, off, fair)


def _spheres(folder: Path) -> Iterator[Larger]:
    ensemble = read("e6-spheres", folder)
    if ensemble is None:
        return
    force, stiffness, samples = curves(ensemble)
    mean = resampled(stiffness)
    closed = rough_sphere.stiffness(force.to_numpy() * SPHERE["rms"], **SPHERE)
    kept = value(mean) > CELLS * ensemble["cell_stiffness"]
    off = (mean / xarray.DataArray(closed, dims="load") - 1).where(kept)
    away, spread = value(off), error(off, samples)
    told = f"{samples} spheres of {int(ensemble['points'])}² cells"
    ruling = ruled(away, spread, fig37_stiffness_of_sphere.NEAR)
    yield Larger(
        "fig37",
        "sphere and roughness act as their forces added",
        f"{spanned(away, '+.1%')} from eq. 5.9 where resolved, errors {spanned(spread, '.1%')}; {told}",
        replace(ruling, trigger=f"{ruling.trigger}, {told}"),
    )
