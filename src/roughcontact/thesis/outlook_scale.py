"""Outlook: the prefactor of the stiffness against the size of the surface, at a given Theta (thesis, eqs 7.1 and 7.2).

The shortest wave is the same for all sizes, as on a real surface. By eq. 7.2 the stiffness at a force is then that
of every size.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from roughcontact.grid import Grid
from roughcontact.plot.raster import LABEL, TICK
from roughcontact.plot.ticks import readable_ticks
from roughcontact.study.study import Study
from roughcontact.surface.moments import grid_moments
from roughcontact.surface.spectrum import SelfAffineSpectrum
from roughcontact.thesis.outlook_cutoff import cutoff_study
from roughcontact.thesis.sample_means import (
    apart,
    converged,
    exponential,
    logarithm,
    means,
    plus_minus,
    slope,
)
from roughcontact.thesis.stiffness_view import quiet
from roughcontact.thesis.verdict import Verdict, judged

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from roughcontact.thesis.figures import Scale

__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "prefactor of the stiffness against the size of the surface, at a given Theta"
WINDOW = (0.02, 0.07)  # forces F/(E* h L) over which the prefactor is averaged
ONE = 0.2  # force F/(E* h L) of the smallest size at which sizes are compared at one force
OCTAVE = 0.5  # the longest waves: those from L down to this part of it
CHOSEN = (
    "the surfaces of outlook-cutoff on their finest grid: one shortest wave, sizes L of 8 to 128 of it (small: to 64)",
    "zeta, (k/E*) (F/(E* Theta))^(-1/(H + 1)), its geometric mean over forces from "
    f"{WINDOW[0]:g} to {WINDOW[1]:g} E* h L",
    "Theta = h L^-H as in eq. 7.1, with the rms height h of all waves; and, beside it, with that of the longest "
    "octave, which does not know the shortest wave",
)
SIZE = (8.8, 7.2)
SHOWN = (0.0, 0.7)
_COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00")


def studies(scale: Scale) -> tuple[Study, ...]:
    """Return the study of outlook-cutoff."""
    return (cutoff_study(scale),)


def averages(exported: xarray.Dataset) -> xarray.Dataset:
    """Return means over samples along ``hurst``, ``waves`` (L over the shortest wave) and ``load``.

    Returns
    -------
    Dataset
        ``zeta_at``, the prefactor at every load; ``force``, F/(E* Theta l^(H+1)), l the shortest wave; ``zeta``, its
        mean over the window, ``zeta_octave``, the same with Theta of the longest octave, of equal size with all
        waves; ``growth`` and ``growth_octave``, d ln zeta/d ln L over all sizes; ``steepness``, d ln zeta/d ln F in the
        window with all waves; ``same_force``, the logarithm of the stiffness over that of the smallest size at one
        force.
    """
    given = apart(converged(exported.drop_vars("case_seconds", errors="ignore")))
    fine = given.isel(row=np.flatnonzero(given["points"] == given["points"].max()))
    fine = fine.assign_coords(row=(1 / fine["short_cutoff"]).round().astype(int).values).rename(row="waves")
    fine = fine.drop_vars(["points", "short_cutoff"])
    loads, hurst, waves = fine["dimensionless_force"], fine["hurst"], fine["waves"]
    # The side cancels: k/(E* L) over (F/(E* h L))^(1/(H+1)).
    zeta = fine["dimensionless_stiffness"] * loads ** (-1 / (hurst + 1))
    inside = np.flatnonzero((loads >= WINDOW[0]) & (loads <= WINDOW[1]))
    log_zeta = logarithm(zeta)
    mean_log = log_zeta.isel(load=inside).mean("load")
    octave = mean_log + logarithm(_octave(exported)) / (hurst + 1)
    sizes, forces = logarithm(waves), logarithm(loads.isel(load=inside))
    values = {
        "zeta_at": zeta,
        "same_force": _at_one_force(log_zeta, logarithm(loads)),
        "zeta": exponential(mean_log),
        "zeta_octave": exponential(octave),
        "growth": slope(mean_log, sizes, "waves"),
        "growth_octave": slope(octave, sizes, "waves"),
        "steepness": slope(log_zeta.isel(load=inside, waves=-1, drop=True), forces, "load"),
    }
    found = means(values)
    found["force"] = loads * waves.astype(float) ** (hurst + 1)
    found["dimensionless_force"] = loads
    return found.assign_attrs(surfaces=exported.sizes["sample"], cells=int(given["points"].max()))


def _at_one_force(log_zeta: xarray.DataArray, log_loads: xarray.DataArray) -> xarray.DataArray:
    """Return ln k less that of the smallest size, at the force F/(E* Theta) of which this bears `ONE` E* h L."""
    import xarray

    # At one F/(E* Theta) the force F/(E* h L) goes as L^-(H+1), and the stiffness as zeta.
    waves = log_zeta["waves"]
    place = np.log(ONE) - (log_zeta["hurst"] + 1) * (logarithm(waves) - float(np.log(waves[0])))
    found: xarray.DataArray = xarray.apply_ufunc(
        np.interp,
        place,
        log_loads,
        log_zeta,
        input_core_dims=[[], ["load"], ["load"]],
        vectorize=True,
    )
    return found - found.isel(waves=0, drop=True)


def _octave(exported: xarray.Dataset) -> xarray.DataArray:
    """Return the rms height of the longest octave over that of all waves, that of the last row being 1."""
    import xarray

    points = int(exported["drawn_on"])
    grid = Grid((points, points), 1 / points)

    def part(hurst: float, shortest: float) -> float:
        longest, every = (
            grid_moments(grid, SelfAffineSpectrum(hurst, short_cutoff=each)).rms_height
            for each in (OCTAVE, shortest)
        )
        return longest / every

    waves = np.unique((1 / exported["short_cutoff"].values).round().astype(int))
    rows = [[part(hurst, 1 / each) for each in waves] for hurst in exported["hurst"].values]
    found = xarray.DataArray(
        rows, dims=("hurst", "waves"), coords={"hurst": exported["hurst"].values, "waves": waves}
    )
    return found / found.isel(waves=-1)


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw the prefactor against the force for two Hurst exponents (a, b), and against the size (c, d)."""
    (first, second), (third, fourth) = figure.subplots(2, 2)
    for axes, hurst in zip((first, second), SHOWN, strict=True):
        one = averages.sel(hurst=hurst)
        for waves, colour in zip(one["waves"].values, _COLOURS, strict=False):
            each = one.sel(waves=waves)
            axes.errorbar(
                each["force"],
                each["zeta_at"],
                each["zeta_at_error"],
                color=colour,
                linewidth=1.3,
                elinewidth=0.7,
                label=f"{waves}",
            )
        axes.axhline(1.7 / (hurst + 1), color="0.5", linestyle="--", linewidth=1.0, label="1.7/(H + 1)")
        axes.set(xscale="log", yscale="log")
        low, high = axes.get_ylim()
        readable_ticks(axes.yaxis, high / low)
        axes.set_xlabel(r"force $F\,/\,(E^* \Theta \lambda_s^{H+1})$", fontsize=LABEL)
        axes.set_ylabel(rf"$(k/E^*)\,(F/E^*\Theta)^{{-1/(H+1)}}$, H = {hurst:g}", fontsize=LABEL)
        axes.legend(fontsize=TICK, frameon=False, title=r"$L/\lambda_s$", title_fontsize=TICK)
    _sizes(third, averages, "zeta", r"$\zeta$, with $\Theta = h L^{-H}$")
    _sizes(fourth, averages, "zeta_octave", r"$\zeta$, with $\Theta$ of the longest octave")
    limits = [
        min(each.get_ylim()[0] for each in (third, fourth)),
        max(each.get_ylim()[1] for each in (third, fourth)),
    ]
    for axes in (third, fourth):
        axes.set_ylim(*limits)
    for letter, axes in zip("abcd", (first, second, third, fourth), strict=True):
        axes.set_title(f"({letter})", fontsize=TICK + 1, loc="left")
        quiet(axes)


def _sizes(axes: Axes, averages: xarray.Dataset, name: str, label: str) -> None:
    for hurst, colour in zip(averages["hurst"].values, _COLOURS, strict=False):
        one = averages.sel(hurst=hurst)
        axes.errorbar(
            one["waves"],
            one[name],
            one[f"{name}_error"],
            fmt="o-",
            color=colour,
            markersize=4,
            linewidth=1.2,
            label=f"H = {hurst:g}",
        )
    axes.set(xscale="log")
    axes.set_xticks(averages["waves"].values, [f"{waves}" for waves in averages["waves"].values])
    axes.minorticks_off()
    axes.set_xlabel(r"size $L/\lambda_s$", fontsize=LABEL)
    axes.set_ylabel(label, fontsize=LABEL)
    axes.legend(fontsize=TICK, frameon=False)


def verdicts(averages: xarray.Dataset) -> tuple[Verdict, ...]:
    """Say how the prefactor goes with the size at each Hurst exponent, and with the force."""
    waves = averages["waves"].values
    told = (
        f"{averages.attrs['surfaces']} samples of {averages.attrs['cells']}² cells, L from {waves[0]} to {waves[-1]} "
        f"shortest waves, F from {WINDOW[0]:g} to {WINDOW[1]:g} E* h L"
    )
    sizes = tuple(_size(averages.sel(hurst=hurst), told) for hurst in averages["hurst"].values)
    each = [averages.sel(hurst=hurst) for hurst in averages["hurst"].values]
    octave = ", ".join(
        f"{plus_minus(one, 'growth_octave', '+.3f')} at H = {float(one['hurst']):g}" for one in each
    )
    steep = ", ".join(
        f"{plus_minus(one, 'steepness', '+.2f')} at H = {float(one['hurst']):g}" for one in each
    )
    worst = float(np.abs(averages["growth"]).max()), float(np.abs(averages["growth_octave"]).max())
    return (
        *sizes,
        Verdict(
            "the normalisation by Theta is the favourable one at small H (Outlook)",
            "favourable",
            f"with Theta of the longest octave in place of all waves d ln zeta/d ln L is {octave}; at most "
            f"{worst[1]:.3f} in place of {worst[0]:.3f}; {told}",
            worst[0] < worst[1],
        ),
        Verdict(
            "the stiffness goes as F^(1/(H + 1)), with one zeta for all forces (eq. 7.2)",
            "0",
            f"d ln zeta/d ln F = {steep}; {told}",
            judged(averages["steepness"], averages["steepness_error"], 0.05),
        ),
    )


def _size(one: xarray.Dataset, told: str) -> Verdict:
    """Return the verdict on the size at one Hurst exponent."""
    first, last = one.isel(waves=0), one.isel(waves=-1)
    factor = float(np.exp(last["same_force"]))
    error = factor * float(last["same_force_error"])
    small = float(one["hurst"]) < 0.5
    found = (
        f"at one force F/(E* Theta), {ONE:g} E* h L of the smallest size, the largest is {factor:.2f} ± {error:.2f} "
        f"times as stiff; at equal F/(E* h L) zeta goes from {plus_minus(first, 'zeta')} to "
        f"{plus_minus(last, 'zeta')}, d ln zeta/d ln L = {plus_minus(one, 'growth', '+.3f')}; {told}"
    )
    independent = judged(factor - 1, error, 0.1)
    if small:
        return Verdict(
            f"at a given Theta the prefactor depends on the size for small H (Outlook), H = {float(one['hurst']):g}",
            "surely",
            found,
            None if independent is None else not independent,
        )
    return Verdict(
        f"at a given Theta the size is not in the stiffness (eq. 7.2), H = {float(one['hurst']):g}",
        "0",
        found,
        independent,
    )
