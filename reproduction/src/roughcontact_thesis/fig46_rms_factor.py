"""Figure 46: the factor between the spectra of a line and of a surface, for equal rms heights on a grid."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.mdr.lines.equivalent_line import line_spectrum
from roughcontact.mdr.lines.lattice_sums import lambda_rms
from roughcontact.plot.drawing.level import level
from roughcontact.validation import Array
from roughcontact_thesis import drawing
from roughcontact_thesis.ruling import exactly
from roughcontact_thesis.verdict import Verdict, Verdicts

__all__ = ["case", "draw", "verdicts"]

TITLE = "factor of the spectrum of a line for the rms height of a discrete surface, against H"
HURST = np.linspace(0, 2, 81)
MODES = (2, 8, 64, 1024, None)  # None: the limit
SEED = 0
CHOSEN = (
    "H from 0 to 2; N = 2, 8, 64, 1024 waves to a side, and the limit of many",
    "eq. A.76 without its factor 1/2; as printed it gives the lowest curve in the limit",
)
SIZE = (drawing.COLUMN, 3.2)

_COLOURS = ("#b0508a", "#a67500", "#009e73", "#2f8fcf", "#0072b2")


def case(seed: int = SEED) -> Array:
    """Return lambda for `MODES` and `HURST`, shape (5, 81); nothing is random, the seed is not used."""
    return np.array([[lambda_rms(float(h), modes) for h in HURST] for modes in MODES])


def draw(figure: Figure, data: Array) -> None:
    """Draw lambda against H for growing numbers of waves, beside pi."""
    axes = figure.subplots()
    for modes, curve, colour in zip(MODES, data, _COLOURS, strict=True):
        name = "limit" if modes is None else f"$N$ = {modes}"
        axes.plot(HURST, curve, color=colour, linewidth=1.8 if modes is None else 1.2, label=name)
    axes.plot(HURST, data[-1] / 2, ":", color="0.35", label="limit of eq. A.76 as printed")
    level(axes, math.pi, r"$\pi$", ha="right")
    words = r"$\lambda = C_{\mathrm{1D}}\,/\,(q\,C_{\mathrm{2D}})$"
    drawing.label(axes, "Hurst exponent $H$", words, xlim=(HURST[0], HURST[-1]), ylim=(1, 3.4))
    drawing.legend_below(axes, 3)


def verdicts(data: Array) -> Verdicts:
    """Return where lambda is pi, and what variance a line has with the factor and with the printed half of it."""
    at = {h: int(np.argmin(np.abs(HURST - h))) for h in (0.0, 1.0)}
    limit = data[-1]
    points = 129
    surface, own = rc.SelfAffineSpectrum(1.0), lambda_rms(1.0, (points - 1) // 2)
    variance = rc.grid_moments(rc.Grid((points, points), 1 / points), surface).m0
    lines = (line_spectrum(surface, factor) for factor in (own, own / 2))
    shares = [rc.grid_moments(rc.Grid(points, 1 / points), line).m0 / variance for line in lines]
    yield Verdict(
        "lambda approaches pi at H = 1 only",
        "It only approaches π for H = 1 and a large number of grid points N.",
        "section A.2, fig. 46",
        f"{limit[at[1.0]]:.4f} at H = 1; {limit[at[0.0]]:.4f} at H = 0, where 1024 waves to a side give "
        f"{data[-2, at[0.0]]:.4f}",
        exactly(
            bool(abs(limit[at[1.0]] / math.pi - 1) < 1e-3), "0.1%", f"{limit[at[1.0]] / math.pi - 1:+.0%}"
        ),
        "misprint",
    )
    yield Verdict(
        "the factor with which line and surface have one rms height, H = 1",
        f"{own / 2:.4f} on {points} points",
        "eq. A.76",
        f"{own:.4f}; with it the line has {shares[0]:.6f} of the variance of the surface, with the printed one "
        f"{shares[1]:.6f}",
        exactly(bool(abs(shares[1] - 1) < 1e-3), "0.1%", "a factor of 2"),
        "misprint",
    )
