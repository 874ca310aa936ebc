"""Figure 24: waves of similar frequency and amplitude, and how fast their heights grow in number below the peak."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughcontact.validation import Array
from roughcontact_thesis import drawing
from roughcontact_thesis.ruling import Ruling, exactly, in_part
from roughcontact_thesis.verdict import Verdict, Verdicts, series

__all__ = ["BeatLines", "Heights", "beat", "case", "draw", "verdicts"]

TITLE = "one, two, four and eight modes of similar frequency, and the heights below their peak"
MODES = (1, 2, 4, 8)
SHOWN = (96, 12, 3, 1)  # frequencies of the picture: a carrier, its beat, the beat's beat
FREQUENCIES = (32769, 1025, 33, 1)  # the same, far apart, for counting heights
PLACES = 2**21
PHASES = 30  # sets of random phases of adjacent harmonics
WINDOW = (0.01, 0.1)  # depths below the peak over the height of the peak
SEED = 24
SPRINGS = 100_000
CHOSEN = (
    "the modes nest: the frequencies of n + 1 cosines, multiplied, are those of 2^n modes of one amplitude, here "
    f"{', '.join(map(str, SHOWN))} waves",
    f"heights are counted where the cosines are far apart: {', '.join(map(str, FREQUENCIES))} waves in one period, "
    f"{PLACES} places",
    f"beside them adjacent harmonics of one line from {FREQUENCIES[0]} waves on, {PHASES} sets of random phases",
    f"powers between depths of {WINDOW[0]:g} and {WINDOW[1]:g} of the peak's height",
)
SIZE = (drawing.PAGE, 4.0)

_FEWEST = 30  # heights, below which a count is mostly chance
_COLOURS = ("black", "#0072b2", "#d55e00", "#009e73")


@dataclass(frozen=True, slots=True)
class Heights:
    """How many heights lie above a depth below the peak.

    Parameters
    ----------
    modes : int
        Number of waves.
    depth : array
        Below the peak, over its height.
    nested, adjacent : array
        Part of the line above this depth: of nested beats, and of adjacent harmonics with random phases.
    """

    modes: int
    depth: Array
    nested: Array
    adjacent: Array

    @property
    def words(self) -> str:
        """How many modes there are, in words."""
        return f"{self.modes} mode{'s' if self.modes > 1 else ''}"

    def exponent(self, part: Array) -> float:
        """Return beta of the density of heights, z^beta (thesis, eq. 4.59)."""
        inside = (self.depth >= WINDOW[0] * (1 - 1e-9)) & (self.depth <= WINDOW[1] * (1 + 1e-9))
        slope, _ = np.polyfit(np.log(self.depth[inside]), np.log(part[inside]), 1)
        return float(slope) - 1


@dataclass(frozen=True, slots=True)
class BeatLines:
    """What the figure shows: the waves, and the heights of each."""

    x: Array
    lines: tuple[Array, ...]
    heights: tuple[Heights, ...]


def beat(x: Array, frequencies: tuple[int, ...]) -> Array:
    """Return the product of cosines, ``2^n`` modes of one amplitude: peak 1, at x = 0."""
    return np.asarray(np.prod([np.cos(2 * math.pi * f * x) for f in frequencies], axis=0))


def case(seed: int = SEED, places: int = PLACES) -> BeatLines:
    """Return lines of one, two, four and eight modes, and the distribution of heights about their peaks."""
    x = np.linspace(-0.5, 0.5, 4001)
    lines = tuple(beat(x, SHOWN[: stage + 1]) for stage in range(len(MODES)))
    rng = np.random.default_rng(seed)
    return BeatLines(x, lines, tuple(_heights(stage, rng, places) for stage in range(len(MODES))))


def _heights(stage: int, rng: np.random.Generator, places: int) -> Heights:
    depth = np.geomspace(1e-3, 1, 61)
    nested = _above(beat(_spread(places), FREQUENCIES[: stage + 1]), 1.0, depth)
    modes = 2**stage
    adjacent = [_adjacent(phases, places // 16) for phases in rng.uniform(0, 2 * math.pi, (PHASES, modes))]
    return Heights(modes, depth, nested, np.mean([_above(*each, depth) for each in adjacent], axis=0))


def _adjacent(phases: Array, places: int) -> tuple[Array, float]:
    """Return a line of adjacent harmonics, one for each phase, and its highest peak."""
    x, turns = _spread(places), np.exp(1j * phases)
    # In numbers that turn once with every harmonic the sum is a polynomial.
    slow = np.exp(2j * math.pi * x)
    line = np.exp(2j * math.pi * FREQUENCIES[0] * x) * np.polynomial.polynomial.polyval(slow, turns)
    # Under so many waves of the carrier the highest peak is that of the envelope.
    envelope = np.abs(np.polynomial.polynomial.polyval(np.exp(2j * math.pi * np.arange(4096) / 4096), turns))
    return np.asarray(line.real), float(envelope.max())


def _spread(places: int) -> Array:
    """Return places all over one period, evenly for every wave: no common measure with any of them."""
    return np.asarray(np.arange(places) * (math.sqrt(5) - 1) / 2 % 1)


def _above(line: Array, peak: float, depth: Array) -> Array:
    """Return the part of a line that lies above depths below its peak, over the peak's height."""
    return np.asarray(np.searchsorted(np.sort(1 - line / peak), depth) / line.size)


def draw(figure: Figure, data: BeatLines) -> None:
    """Draw the waves (a) to (d), and the heights below the peak (e)."""
    table = figure.add_gridspec(len(MODES), 2, width_ratios=(1.5, 1))
    rows = zip("abcd", data.lines, data.heights, _COLOURS, strict=True)
    for place, (letter, line, heights, colour) in enumerate(rows):
        axes = figure.add_subplot(table[place, 0])
        axes.plot(data.x, line, color=colour, linewidth=0.7)
        axes.set(xlim=(data.x[0], data.x[-1]), ylim=(-1.1, 1.1))
        axes.set_title(f"({letter}) {heights.words}", pad=2)
        axes.set_axis_off()
    axes = figure.add_subplot(table[:, 1], title="(e)", xlim=(1e-3, 1), ylim=(1e-6, 1.5), **drawing.LOG)
    _distribution(axes, data.heights)
    axes.set(xlabel="depth below the peak / height of the peak", ylabel="part of the line above it")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2)


def _distribution(axes: Axes, data: tuple[Heights, ...]) -> None:
    window = np.array(WINDOW)
    middle = math.sqrt(WINDOW[0] * WINDOW[1])
    for heights, colour in zip(data, _COLOURS, strict=True):
        counted = heights.nested * PLACES >= _FEWEST
        x, y = heights.depth[counted], heights.nested[counted]
        axes.plot(x, y, color=colour, label=heights.words)
        if heights.modes > 2:  # of two modes both are one
            axes.plot(heights.depth, heights.adjacent, ":", color=colour)
        power = (1 + math.log2(heights.modes)) / 2
        here = math.exp(np.interp(math.log(middle), np.log(x), np.log(y)))
        axes.plot(window, here * (window / middle) ** power, "--", color="0.1", zorder=4)
    drawing.key(axes, ":", "adjacent harmonics")
    drawing.key(axes, "--", "eq. 4.72", color="0.1")


def verdicts(data: BeatLines) -> Verdicts:
    """Compare the powers of the densities with eq. 4.72, and those of the stiffness with eq. 4.63."""
    law = [-0.5 + 0.5 * math.log2(each.modes) for each in data.heights]
    nested = [each.exponent(each.nested) for each in data.heights]
    adjacent = [each.exponent(each.adjacent) for each in data.heights]
    off, other = (float(np.abs(np.subtract(powers, law)).max()) for powers in (nested, adjacent))
    where = f"at depths of {WINDOW[0]:g} to {WINDOW[1]:g} of the peak"
    yield Verdict(
        "heights below the peak of N modes have a density z^(-1/2 + log2(N)/2)",
        "The power β resulting from N modes can thus be expressed as β = -1/2 + 1/2 log2(N)",
        "section 4.5.2, eq. 4.72",
        f"{series(nested, '.2f')} of 1, 2, 4 and 8 modes that are beats of beats, {series(law, '.2f')} by the law; "
        f"{series(adjacent, '.2f')} of adjacent harmonics, as a rough line has them, {where}: the power counts "
        "independent phases, and adjacent harmonics have two",
        _of_modes(off, other),
    )
    powers = [_stiffness_power(beta) for beta in law]
    expected = [(beta + 1) / (beta + 2) for beta in law]
    apart = float(np.abs(np.subtract(powers, expected)).max())
    yield Verdict(
        "a density z^beta makes a stiffness F^((beta + 1)/(beta + 2))",
        "α = (β + 1)/(β + 2)",
        "section 4.5.2, eq. 4.63",
        f"{series(powers)} of {SPRINGS} springs with beta = {series(law, 'g')}, {series(expected)} by the law",
        exactly(apart < 0.005, "0.005", f"largest: {apart:.4f}"),
        "method",
    )


def _of_modes(nested: float, adjacent: float) -> Ruling:
    if nested < 0.1 <= adjacent:
        return in_part("modes that are beats of beats", "0.1", f"{adjacent:.2f} for adjacent harmonics")
    return exactly(max(nested, adjacent) < 0.1, "0.1", f"{max(nested, adjacent):.2f}")


def _stiffness_power(beta: float) -> float:
    """Return alpha of k ~ F^alpha of springs whose heights have a density z^beta (eqs 4.59 to 4.62)."""
    z = ((np.arange(SPRINGS) + 0.5) / SPRINGS) ** (1 / (beta + 1))
    depth = np.geomspace(0.1, 1, 20)
    stiffness = np.searchsorted(z, depth)
    force = depth * stiffness - np.concatenate([[0.0], np.cumsum(z)])[stiffness]
    return float(np.polyfit(np.log(force), np.log(stiffness), 1)[0])
