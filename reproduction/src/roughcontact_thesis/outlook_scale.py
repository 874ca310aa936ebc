"""Outlook: the prefactor of the stiffness against the size of the surface, at a given Theta (thesis, eqs 7.1 and 7.2).

The shortest wave is the same for all sizes, as on a real surface. By eq. 7.2 the stiffness at a force is then that
of every size.
"""

from __future__ import annotations

import numpy as np
import xarray
from matplotlib.figure import Figure

from roughcontact_thesis import averaging, drawing
from roughcontact_thesis.averaging import exponential, logarithm
from roughcontact_thesis.outlook_cutoff import studies
from roughcontact_thesis.ruling import VICINITY, exceeds, ranged, ruled_in_middle
from roughcontact_thesis.verdict import Verdict, Verdicts, counted, listed

__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "prefactor of the stiffness against the size of the surface, at a given Theta"
NEAR = 0.1  # of a stiffness: what counts as no difference
WINDOW = (0.02, 0.07)  # forces F/(E* h L) over which the prefactor is averaged
ONE = 0.2  # force F/(E* h L) of the smallest size at which sizes are compared at one force
OCTAVE = 0.5  # the longest waves: those from L down to this part of it
CHOSEN = (
    "the surfaces of outlook-cutoff on their finest grid: one shortest wave, sizes L of 8 to 128 of it (small: to 64)",
    f"zeta, (k/E*) (F/(E* Theta))^(-1/(H + 1)), its geometric mean over forces from {WINDOW[0]:g} to {WINDOW[1]:g} E* "
    f"h L",
    "Theta = h L^-H as in eq. 7.1, with the rms height h of all waves; and, beside it, with that of the longest "
    "octave, which does not know the shortest wave",
)
SIZE = (drawing.PAGE, 6.2)
SHOWN = (0.0, 0.7)


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
    given = averaging.without_parameters(averaging.converged(exported))
    fine = given.isel(row=np.flatnonzero(given["points"] == given["points"].max()))
    fine = fine.assign_coords(row=(1 / fine["short_cutoff"]).round().astype(int).values).rename(row="waves")
    fine = fine.drop_vars(["points", "short_cutoff"])
    loads, hurst, waves = fine["dimensionless_force"], fine["hurst"], fine["waves"]
    # The side cancels: k/(E* L) over (F/(E* h L))^(1/(H+1)).
    zeta = fine["dimensionless_stiffness"] * loads ** (-1 / (hurst + 1))
    inside = np.flatnonzero((loads >= WINDOW[0]) & (loads <= WINDOW[1]))
    log_zeta = logarithm(zeta)
    mean_log = log_zeta.isel(load=inside).mean("load")
    # The rms height of the longest octave over that of all waves, which is 1 on the largest size.
    points, octave_alone = int(exported["points"].max()), xarray.DataArray(OCTAVE)
    every, first = (averaging.rms_heights(points, hurst, each) for each in (1 / waves, octave_alone))
    share = first / every
    octave = mean_log + logarithm(share / share.isel(waves=-1)) / (hurst + 1)
    sizes, forces = logarithm(waves), logarithm(loads.isel(load=inside))
    found = averaging.means(
        zeta_at=zeta,
        same_force=_at_one_force(log_zeta, logarithm(loads)),
        zeta=exponential(mean_log),
        zeta_octave=exponential(octave),
        growth=averaging.slope(mean_log, sizes, "waves"),
        growth_octave=averaging.slope(octave, sizes, "waves"),
        steepness=averaging.slope(log_zeta.isel(load=inside, waves=-1, drop=True), forces, "load"),
    )
    found["force"] = loads * waves.astype(float) ** (hurst + 1)
    found["dimensionless_force"] = loads
    return found.assign_attrs(averaging.counts(exported))


def _at_one_force(log_zeta: xarray.DataArray, log_loads: xarray.DataArray) -> xarray.DataArray:
    """Return ln k less that of the smallest size, at the force F/(E* Theta) of which this bears `ONE` E* h L."""
    # At one F/(E* Theta) the force F/(E* h L) goes as L^-(H+1), and the stiffness as zeta.
    waves = log_zeta["waves"]
    place = np.log(ONE) - (log_zeta["hurst"] + 1) * (logarithm(waves) - float(np.log(waves[0])))
    dims: list[list[str]] = [[], ["load"], ["load"]]
    found: xarray.DataArray = xarray.apply_ufunc(
        np.interp, place, log_loads, log_zeta, input_core_dims=dims, vectorize=True
    )
    return found - found.isel(waves=0, drop=True)


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw the prefactor against the force for two Hurst exponents (a, b), and against the size (c, d)."""
    *curves, third, fourth = drawing.panels(figure, 2, 2)
    force = r"force $F\,/\,(E^* \Theta \lambda_s^{H+1})$"
    for axes, hurst in zip(curves, SHOWN, strict=True):
        drawing.family(axes, averages.sel(hurst=hurst), "waves", {"zeta_at": "-"}, "{}")
        axes.axhline(1.7 / (hurst + 1), color="0.5", linestyle="--", linewidth=1.0, label="1.7/(H + 1)")
        zeta = rf"$(k/E^*)\,(F/E^*\Theta)^{{-1/(H+1)}}$, H = {hurst:g}"
        drawing.label(axes, force, zeta, **drawing.LOG)
        drawing.readable(axes)
        axes.legend(title=r"$L/\lambda_s$")
    fourth.sharey(third)
    for axes, name, theta in (
        (third, "zeta", r"with $\Theta = h L^{-H}$"),
        (fourth, "zeta_octave", r"with $\Theta$ of the longest octave"),
    ):
        drawing.family(axes, averages, "hurst", {name: "o-"}, "H = {:g}", x="waves")
        drawing.named_ticks(axes, averages["waves"].values, "{}")
        drawing.label(axes, r"size $L/\lambda_s$", rf"$\zeta$, {theta}")
        axes.legend()


def verdicts(averages: xarray.Dataset) -> Verdicts:
    """Say how the prefactor goes with the size at each Hurst exponent, and with the force."""
    waves = averages["waves"].values
    told = (
        f"{counted(averages)}, L from {waves[0]} to {waves[-1]} shortest waves, F from {WINDOW[0]:g} to {WINDOW[1]:g} "
        "E* h L"
    )
    growth = listed(averages, "growth", "hurst", "+.3f")
    sizes = {
        int(np.flatnonzero(waves == 4 * waves[0])[0]): "a square of four times the side",
        -1: "the largest square",
    }
    for place, size in sizes.items():
        one = averages.isel(waves=place)
        factor = exponential(one["same_force"])
        error = factor * one["same_force_error"]
        yield Verdict(
            f"at a given Theta and force {size} has the same stiffness",
            "depends on the normal force in a power-law fashion, but does not depend on the system size.",
            "chapter 7, eqs 7.2 and 7.6",
            f"at one force F/(E* Theta), {ONE:g} E* h L of the smallest size, one of {waves[place] / waves[0]:g} times "
            f"its side is stiffer by {ranged(factor - 1, error, NEAR, '+.0%')}; at equal F/(E* h L) d ln zeta/d ln L = "
            f"{growth}; {told}",
            ruled_in_middle(factor - 1, error, NEAR, "+.0%"),
        )
    yield Verdict(
        "one zeta for all forces",
        "k/E* = ζ (F/(E*Θ))^(1/(H + 1))",
        "chapter 7, eq. 7.2",
        f"d ln zeta/d ln F = {listed(averages, 'steepness', 'hurst', '+.2f')}; {told}",
        ruled_in_middle(averages["steepness"], averages["steepness_error"], 0.1, "+.2f"),
    )
    near = averages.isel(hurst=np.flatnonzero(averages["hurst"] <= VICINITY))
    low = near.isel(waves=-1)
    least = int(abs(low["same_force"]).to_numpy().argmin())
    yield Verdict(
        "for small H the prefactor depends on the size",
        "For small values of H it will surely depend on the system size in addition to the other parameters.",
        "chapter 7",
        f"the largest is {listed(low.assign(factor=factor, factor_error=error), 'factor', 'hurst')} times as stiff as "
        f"the smallest at one force F/(E* Theta); {told}",
        exceeds(
            abs(float(low["same_force"][least])),
            float(low["same_force_error"][least]),
            NEAR,
            ".2f",
            "a difference of ln k by more than 0.1",
        ),
        "answer",
    )
    octave = listed(averages, "growth_octave", "hurst", "+.3f")
    whole, part = (float(np.abs(averages[name]).max()) for name in ("growth", "growth_octave"))
    errors = float(averages["growth_error"].max() + averages["growth_octave_error"].max())
    yield Verdict(
        "the normalisation by Theta is the favourable one at small H",
        "In this context it seems favorable to use the normalization according to eq. 7.2.",
        "chapter 7",
        f"d ln zeta/d ln L is {growth}; with Theta of the longest octave in place of all waves {octave}; {told}",
        exceeds(part - whole, errors, 0.0, "+.3f", "a weaker dependence on the size"),
        "answer",
    )
