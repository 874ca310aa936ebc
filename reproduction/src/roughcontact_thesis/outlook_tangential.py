"""Outlook: tangential stiffness, and the largest displacement before gross slip, of rough contacts (eqs 7.4 to 7.7)."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray
from matplotlib.figure import Figure
from scipy.interpolate import CubicHermiteSpline

from roughcontact.theory.joints import mindlin
from roughcontact.theory.stiffness_laws import pohrt_popov
from roughcontact.validation import Array
from roughcontact_thesis import averaging, drawing
from roughcontact_thesis.averaging import RMS
from roughcontact_thesis.figures import Scale, Studies
from roughcontact_thesis.ruling import ruled, ruled_in_middle
from roughcontact_thesis.verdict import Verdict, Verdicts, counted, listed, spanned

__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "tangential stiffness of rough contacts, and how far they move before they slide"
HURST = (0.4, 0.7, 1.0)
POISSON = (0.0, 0.3, 0.5)
SHOWN = 0.7  # Hurst exponent of the paths
FRICTION = 0.3
FORCE = 0.05  # F/(E* h L) of the paths
CHOSEN = (
    f"two equal bodies, free squares of 256 x 256 cells (small: 128 x 128), H = {', '.join(f'{h:g}' for h in HURST)}, "
    f"nu = {', '.join(f'{nu:g}' for nu in POISSON)}, friction {FRICTION:g}; all waves of the grid",
    "9 forces F/(E* h L) from 0.003 to 0.3; 20 samples (small: 10)",
    "k_t: the mean over all directions of the stiffness of the whole contact region without slip",
    "pulled along x in 10 steps from rest to mu F under Coulomb's law in every cell, the pressure held; the traction "
    "may turn",
)
SIZE = (drawing.PAGE, 6.2)
SEED = 14
FAIR = 0.2  # of what goes by a "fairly good approximation" of zeta


def studies(scale: Scale) -> Studies:
    """Return the one study: three Hurst exponents, three Poisson's ratios."""
    points, samples = {"small": (128, 10), "thesis": (256, 20)}[scale]
    forces = {"lowest_force": 3e-3, "highest_force": 0.3, "loads": 9, "pulls": 10}
    return averaging.outlook_studies(
        "tangential",
        scale,
        {"points": points, "friction": FRICTION} | forces,
        case="slip",
        seed=SEED,
        samples=samples,
        table={"hurst": HURST, "poisson_ratio": POISSON},
    )


def averages(exported: xarray.Dataset) -> xarray.Dataset:
    """Return means over samples along ``hurst``, ``poisson_ratio`` and ``load``.

    Returns
    -------
    Dataset
        ``ratio`` k/k_t over that of a disc, C_m, and ``axes`` the larger over the smaller k_t of the two axes;
        ``tangential`` k_t/(E* L) and ``by_7_5`` what eq. 7.5 says with eq. 7.3; ``slip`` the largest displacement
        before gross slip over mu h and ``slip_by_depth`` it over mu C_m d; ``by_7_6`` what eq. 7.6 says over mu h with
        the constants of 7.3, and ``by_7_7`` with those printed; ``path`` (pull) the displacement over mu C_m d at
        the parts ``pulled`` of mu F, ``path_by_depth`` what the normal loading curve says, and ``path_ratio`` the
        former over the latter, sample by sample. ``force`` F/(E* h L); ``resolved`` where k stands above 20 cells.
    """
    given = averaging.without_parameters(averaging.converged(exported))
    disc = given["poisson_ratio"].copy(data=[mindlin.ratio(float(nu)) for nu in given["poisson_ratio"]])
    force, depth = given["dimensionless_force"], given["depth"]
    moved = given["tangential_displacement"] / (FRICTION * disc * depth)
    principal, by_depth = given["principal_stiffness"], _by_depth(given)
    found = averaging.means(
        ratio=given["stiffness"] / given["tangential_stiffness"] / disc,
        axes=principal.isel(principal=1) / principal.isel(principal=0),
        stiffness=given["dimensionless_stiffness"],
        tangential=given["tangential_stiffness"],
        slip=given["tangential_displacement"].isel(pull=-1) / (FRICTION * RMS),
        slip_by_depth=moved.isel(pull=-1),
        path=moved,
        path_by_depth=by_depth,
        path_ratio=moved / by_depth,
    )
    shape = ("hurst", "poisson_ratio", "load")
    for name, values in _laws(given["hurst"].values, disc.values, force.values).items():
        found[name] = shape, values
    found["resolved"] = found["stiffness"] > 20 * averaging.same_for_all(given["cell_stiffness"])
    found["force"], found["pulled"], found["disc"] = force, given["pulled"], disc
    return found.assign_attrs(averaging.counts(exported))


def _by_depth(given: xarray.Dataset) -> xarray.DataArray:
    """Return 1 - d(F - Q/mu)/d(F), of every sample (Jaeger, Ciavarella); NaN below the lowest force.

    Between loads by cubics through the logarithms of depth and force, with the slopes that the stiffness gives.
    """

    def gained(depth: Array, stiffness: Array, force: Array, pulled: Array) -> Array:
        slope = force / (stiffness * depth)
        curve = CubicHermiteSpline(np.log(force), np.log(depth), slope, extrapolate=False)
        held = np.where(pulled < 1, force[:, None] * (1 - pulled), np.nan)
        return np.where(pulled < 1, 1 - np.exp(curve(np.log(held))) / depth[:, None], 1.0)

    along: Any = {"input_core_dims": [*[["load"]] * 3, ["pull"]], "output_core_dims": [["load", "pull"]]}
    curves = [given[name] for name in ("depth", "stiffness", "force", "pulled")]
    path: xarray.DataArray = xarray.apply_ufunc(gained, *curves, vectorize=True, **along)
    return path


def _laws(hursts: Any, discs: Any, forces: Any) -> dict[str, Any]:
    """Return eqs 7.5 and 7.6, the latter with both constants, for every Hurst exponent, Poisson's ratio and force."""
    shape = (len(hursts), len(discs), len(forces))
    laws = {name: np.empty(shape) for name in ("by_7_5", "by_7_6", "by_7_7")}
    load = forces * RMS  # F/(E* L^2)
    for i, hurst in enumerate(hursts):
        theta = float(pohrt_popov.theta(hurst, RMS, 1.0))
        for j, disc in enumerate(discs):
            stiffness = pohrt_popov.stiffness(load, hurst, RMS, 1.0, 1.0)
            laws["by_7_5"][i, j] = mindlin.tangential_stiffness(stiffness, disc)
            for name, constants in (("by_7_6", "consistent"), ("by_7_7", "printed")):
                constant = mindlin.slip_constant(theta, hurst, constants=constants)  # type: ignore[arg-type]
                slip = mindlin.fractal_gross_slip(load, 1.0, hurst, constant, friction=FRICTION, ratio=disc)
                laws[name][i, j] = slip / (FRICTION * RMS)
    return laws


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw k/k_t (a), k_t (b), the largest displacement (c) and the path to it (d)."""
    first, second, third, fourth = drawing.panels(figure, 2, 2)
    shown, middle = averages.sel(hurst=SHOWN), averages.sel(poisson_ratio=0.3)
    ratios = {"ratio": "o-", "axes": "--"}
    bare = shown.drop_vars("axes_error")  # errors of both would cover each other
    drawing.family(first, bare, "poisson_ratio", ratios, r"$\nu$ = {:g}", markersize=3.5)
    drawing.key(first, "o-", r"$(k/k_t)\,/\,C_m$, mean over directions")
    drawing.key(first, "--", "larger $k_t$ of a sample over the smaller")
    drawing.label(first, drawing.FORCE, f"ratio, H = {SHOWN:g}", xscale="log", ylim=(0.96, 1.32))
    sticking = {"by_7_5": "eqs 7.5 and 7.3"}
    sliding = {"by_7_6": "eqs 7.6 and 7.3", "by_7_7": "eqs 7.6 and 7.7"}
    for axes, name, laws, words in (
        (second, "tangential", sticking, r"tangential stiffness $k_t\,/\,(E^* L)$"),
        (third, "slip", sliding, r"largest displacement $u_{max}\,/\,(\mu h)$"),
    ):
        styles = dict(zip(laws, ("-", "--"), strict=False))
        drawing.family(axes, middle, "hurst", {name: "o"} | styles, "H = {:g}", markersize=3.5)
        for law, style in styles.items():
            drawing.key(axes, style, laws[law])
        drawing.label(axes, drawing.FORCE, rf"{words}, $\nu$ = 0.3", **drawing.LOG)
        drawing.readable(axes)
    one = shown.isel(load=_load(shown))
    # One within the other, as all lie on one curve.
    for nu, colour, size in zip(one["poisson_ratio"].values, drawing.COLOURS, (7.5, 5.0, 2.5), strict=False):
        each = one.sel(poisson_ratio=nu)
        given: Any = {"fmt": "o", "markersize": size, "color": colour, "label": rf"$\nu$ = {nu:g}"}
        fourth.errorbar(each["path"], each["pulled"], xerr=each["path_error"], **given)
    by_depth = one["path_by_depth"].isel(poisson_ratio=0)
    fourth.plot(by_depth, one["pulled"], color="0.4", label=r"$1 - d(F - Q/\mu)/d(F)$")
    words = r"displacement $u_x\,/\,(\mu C_m d)$"
    drawing.label(fourth, words, r"tangential force $Q\,/\,(\mu F)$")
    fourth.set_title(rf"F = {float(one['force']):.2g} $E^* h L$, H = {SHOWN:g}", loc="center")
    for axes in (first, second, third, fourth):
        axes.legend()


def _load(averages: xarray.Dataset) -> int:
    """Return the load nearest to the one that is shown."""
    return int(np.argmin(np.abs(np.log(averages["force"].values / FORCE))))


def verdicts(averages: xarray.Dataset) -> Verdicts:
    """Judge eqs 7.4, 7.5, 7.6 and 7.7 where the contact is resolved, and what stands behind 7.6."""
    kept = averages.where(averages["resolved"])
    told = (
        f"H = {', '.join(f'{h:g}' for h in averages['hurst'].values)}, {counted(averages)}, k above 20 cells, forces "
        f"up to {float(averages['force'].max()):g} E* h L"
    )
    at = averages.sel(hurst=SHOWN).isel(load=_load(averages))
    ratios, tilted, slipped = (
        listed(at, name, "poisson_ratio", form, "nu = {:g}")
        for name, form in (("ratio", ".4f"), ("axes", ".3f"), ("slip_by_depth", ".3f"))
    )
    laws = {"by_7_5": "tangential", "by_7_6": "slip", "by_7_7": "slip"}
    off = {law: kept[name] / kept[law] - 1 for law, name in laws.items()}
    errors = {law: kept[f"{name}_error"] / kept[law] for law, name in laws.items()}

    def by_law(claim: str, quote: str, source: str, law: str) -> Verdict:
        each = ((spanned(off[law].sel(hurst=h), "+.0%"), h) for h in off[law]["hurst"].values)
        found = ", ".join(f"{spread} from it at H = {h:g}" for spread, h in each)
        rule = ruled_in_middle(off[law], errors[law], FAIR)
        return Verdict(claim, quote, source, f"{found}; {told}", rule)

    yield Verdict(
        "k/k_t = (2 - nu)/(2(1 - nu)) on rough surfaces",
        "This relation was originally found for circular contact spots [45] and was later confirmed numerically [14] "
        "for isotropic self-affine surfaces.",
        "section 4, eq. 4.5; eq. 7.4",
        f"(k/k_t)/C_m, mean over directions, {ratios}, at F = {float(at['force']):.2g} E* h L and H = {SHOWN:g}; "
        f"{spanned(kept['ratio'], '.4f')} in all; the larger k_t of a sample over the smaller {tilted}; {told}",
        ruled(kept["ratio"] - 1, kept["ratio_error"], 0.02),
    )
    yield by_law(
        "the tangential stiffness follows with zeta = 1.7/(H + 1)",
        "Using 7.2 we directly find",
        "eq. 7.5",
        "by_7_5",
    )
    yield Verdict(
        "the largest displacement before gross slip is mu C_m d",
        "it is shown how eq. 7.2 can be used to estimate the maximum lateral displacement u_x,max of a rough indenter",
        "chapter 7, behind eq. 7.6",
        f"u_max/(mu C_m d) = {slipped}, at F = {float(at['force']):.2g} E* h L and H = {SHOWN:g}; "
        f"{spanned(kept['slip_by_depth'], '.3f')} in all; {told}",
        ruled(kept["slip_by_depth"] - 1, kept["slip_by_depth_error"], 0.05),
    )
    quote = "This simple estimation thus shows that the maximum displacement before macroscopic slip depends on the "
    quote += "normal force in a power-law fashion"
    yield by_law("the largest displacement, Z from zeta = 1.7/(H + 1)", quote, "eqs 7.6 and 7.2", "by_7_6")
    yield by_law("the largest displacement, Z as printed", quote, "eqs 7.6 and 7.7", "by_7_7")
    way = kept["path"] / kept["path_by_depth"]
    # Of the same samples: the error of the ratio is at most the sum of both.
    spread = kept["path_error"] / kept["path"] + kept["path_by_depth_error"] / kept["path_by_depth"]
    if "path_ratio" in kept:
        way, spread = kept["path_ratio"], kept["path_ratio_error"]
    way, spread = (each.sel(poisson_ratio=0.0) for each in (way - 1, spread))
    yield Verdict(
        "the way to gross slip follows from the normal loading curve, u = mu C_m [d(F) - d(F - Q/mu)]",
        "This analogy can be extended from non-slipping contacts to tangentially loaded contacts that are just about "
        "to start slipping [76][7].",
        "chapter 7, behind eq. 7.6",
        f"displacements {spanned(way, '+.1%')} from it at nu = 0, all Hurst exponents, forces and pulls; {told}",
        ruled(way, spread, 0.05),
        "theory",
    )
