"""Figure 34: roll-off and cut-off of a fractal spectrum, and what they make of a line."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact_thesis import drawing
from roughcontact_thesis.ruling import ruled
from roughcontact_thesis.verdict import Verdict, Verdicts

__all__ = ["Roughness", "case", "draw", "verdicts"]

TITLE = "spectra without a limit, with a roll-off and with a cut-off, and lines of each"
HURST = 0.7
POINTS = 2048
LENGTH = 1.0
RMS = 0.05  # of the unrestricted line, over its length
LIMIT = 1 / 16  # wavelength of roll-off and cut-off over the length
SEED = 3
MAXIMA = (512, 32, 10)  # points a side, longest wave in points, and surfaces
CHOSEN = (
    f"H = {HURST:g}, {POINTS} points",
    f"roll-off and cut-off at a wavelength of L/{1 / LIMIT:g}",
    "the same phases and the same short waves on every line",
)
SIZE = (drawing.PAGE, 3.4)

_COLOURS = ("black", "#0072b2", "#d55e00")
_NAMES = ("unrestricted", "roll-off", "cut-off")


@dataclass(frozen=True, slots=True)
class Roughness:
    """A spectrum of the figure and a line that has it."""

    name: str
    spectrum: rc.SelfAffineSpectrum
    line: rc.Surface


def case(seed: int = SEED) -> tuple[Roughness, ...]:
    """Return the spectrum C1D [m^3] without a limit, with a plateau and with a cut, and a line of each."""
    grid = rc.Grid((POINTS,), (LENGTH / POINTS,), periodic=True)
    plain = rc.SelfAffineSpectrum(HURST, dimension=1).scaled(RMS * LENGTH, grid)
    limit = LIMIT * LENGTH
    spectra = plain, replace(plain, rolloff=limit), replace(plain, long_cutoff=limit)
    lines = (rc.synthesise(grid, each, np.random.default_rng(seed)) for each in spectra)
    return tuple(map(Roughness, _NAMES, spectra, lines))


def draw(figure: Figure, data: tuple[Roughness, ...]) -> None:
    """Draw the spectra (a) and the lines (b)."""
    left, right = drawing.panels(figure, 1, 2, width_ratios=(1, 1.35))
    _spectra(left, data)
    _lines(right, data)


def _spectra(axes: Axes, data: tuple[Roughness, ...]) -> None:
    # In units of the longest wave, and of the unrestricted spectrum there.
    q0 = 2 * math.pi / LENGTH
    q = np.geomspace(1, POINTS / 2, 600)
    bend = 1 / LIMIT
    unit = float(data[0].spectrum(np.array([q0]))[0])
    lowest = float(data[0].spectrum(np.array([q0 * POINTS / 2]))[0]) / unit / 3
    widths = (1.0, 2.0, 3.2)
    for each, colour, width, order in zip(data, _COLOURS, widths, (4, 3, 2), strict=True):
        points = np.unique(np.append(q, bend * (1 + 1e-9)))
        density = each.spectrum(points * q0) / unit
        drawn = density > 0
        x, y = points[drawn], density[drawn]
        if not drawn.all():  # the cut: straight down
            x, y = np.append(x[0], x), np.append(lowest, y)
        axes.plot(x, y, color=colour, linewidth=width, zorder=order, label=each.name)
    axes.set(xscale="log", yscale="log", ylim=(lowest, 3), xlim=(0.8, POINTS / 2 * 1.3))
    axes.axvline(bend, color="0.6", linewidth=0.8, linestyle=":", zorder=1)
    axes.set_xlabel(r"wavenumber $q\,/\,q_0$")
    axes.set_ylabel(r"power spectrum $C_{\mathrm{1D}}\,/\,C_{\mathrm{1D}}(q_0)$")
    axes.legend(loc="upper right")


def _lines(axes: Axes, data: tuple[Roughness, ...]) -> None:
    x = (np.arange(POINTS) + 0.5) / POINTS
    base = 0.0
    for each, colour in zip(data, _COLOURS, strict=True):
        heights = each.line.heights / LENGTH
        top = base - 0.03
        base = top - float(heights.max())
        axes.plot(x, heights + base, color=colour, linewidth=0.9)
        axes.text(0.0, top + 0.004, each.name, fontsize=drawing.TICK, color=colour, va="bottom")
        base += float(heights.min())
    # The wavelength of the cut, below the line that has it.
    y = base - 0.02
    drawing.arrow(axes, (0.5, y), (0.5 + LIMIT, y), "<->")
    axes.text(0.5 + LIMIT + 0.015, y, r"$\lambda_c$", va="center")
    axes.set(xlim=(-0.01, 1.01), ylim=(y - 0.03, 0.01))
    axes.set_axis_off()


def verdicts(data: tuple[Roughness, ...]) -> Verdicts:
    """Return whether the maxima of cells as long as the longest wave are distributed exponentially."""
    points, cell, draws = MAXIMA
    grid = rc.Grid((points, points), 1 / points, periodic=True)
    shares = []
    for seed in range(draws):
        surface = rc.self_affine(grid, HURST, 1.0, np.random.default_rng(seed), long_cutoff=cell / points)
        n = points // cell
        tops = np.sort(surface.heights.reshape(n, cell, n, cell).max(axis=(1, 3)).ravel())
        # Above every height an exponential distribution has one mean excess.
        half, tenth = (tops[-round(part * tops.size) :] for part in (0.5, 0.1))
        shares.append((tenth - tenth[0])[1:].mean() / (half - half[0])[1:].mean())
    share, error = float(np.mean(shares)), float(np.std(shares, ddof=1) / np.sqrt(draws))
    yield Verdict(
        "maxima of a surface with a cut-off are distributed exponentially",
        "the height distribution of local maxima follows an exponential distribution",
        "section 5.1",
        f"above the highest tenth of the maxima the mean excess is {share:.2f} ± {error:.2f} of that above their "
        f"median, of an exponential distribution 1; {draws} surfaces of {points // cell}² cells, H = {HURST:g}",
        ruled(share - 1, error, 0.1),
        "assumption",
    )
