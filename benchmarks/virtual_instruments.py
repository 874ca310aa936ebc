"""How often intervals from maps of imperfect instruments hold the truth: docs/concepts/many-maps.md.

In each repetition a new surface of one spectrum is measured at four places by virtual instruments: an optical one whose
resolution is stated 20 % wrong, one with noise, a blunt tip, one that adds spikes, and one that tilts its maps. The
maps go through `rc.Measurements`, `combined_spectrum` and `rc.press_draws`. The truth is pressed without an instrument:
the mean of many surfaces whose waves end at the end of the band, and one more of them as the next specimen. Beside it
stand the maps pressed as they are, with the interval by Student's t from their own spread. Their truth is the mean of
the same places without an instrument, pressed alike.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
import scipy.fft
from scipy.stats import t

import roughcontact as rc
from roughcontact.validation import Array

CELLS, STEP = 256, 1.5e-6  # of a map; the surface has twice as many, and repeats itself
RMS, ROLLOFF, FINEST = 2e-7, 64e-6, 4.5e-6  # of the surface [m]
MODULUS, PRESSURE, SIZE = 1e11, 1e8, 48e-6  # of the joint; side of the specimen
RESOLUTION, TIP, NOISE, SLOPE = 5e-6, 2e-5, 4e-8, 0.02  # of the instruments [m], and tilt
SPIKES, HEIGHT = 32, (5, 20)  # of a map, in rms heights
DRAWS, AT_ONCE, TRUE = 39, 3, 1000
NUMBERS = {
    "contact_fraction": "A/A0",
    "interfacial_stiffness_per_area": "K/A0",
    "mean_gap": "mean gap",
}
LAW = rc.SelfAffineSpectrum(0.8, ROLLOFF, None, FINEST).scaled(rms=RMS)

Maps = dict[str, rc.Surface]
Random = np.random.Generator


@dataclass(frozen=True)
class View:
    """What a user has of a surface: maps by name, what is stated of the instrument, and which maps show one place."""

    maps: Maps
    stated: rc.Instrument = field(default_factory=rc.Instrument)
    repeats: Sequence[Sequence[str]] = ()
    spiked: bool = False

    def spectrum(self) -> rc.CombinedSpectrum:
        """Return the spectrum as the page says; spikes are removed first."""
        maps = {name: each.despiked("filled") if self.spiked else each for name, each in self.maps.items()}
        instruments = dict.fromkeys(maps, self.stated)
        return rc.Measurements.of(maps, instruments=instruments, repeats=self.repeats).combined_spectrum()


def places(true: rc.Surface, change: Callable[[Array], Array] = np.copy, again: str = "") -> Maps:
    """Return the four quarters of a surface as maps, each changed by an instrument."""
    starts = [(i, j) for i in (0, CELLS) for j in (0, CELLS)]
    quarters = [true.heights[i : i + CELLS, j : j + CELLS] for i, j in starts]
    return {f"{k}{again}": rc.Surface(change(part), STEP) for k, part in enumerate(quarters)}


def blur(true: rc.Surface, rng: Random) -> View:
    """Return maps of an optical instrument whose resolution is stated 20 % too large or too small."""
    q = [2 * math.pi * scipy.fft.fftfreq(n, STEP) for n in true.shape]
    square = (q[0][:, None] ** 2 + q[1] ** 2) * (RESOLUTION / 2 / math.pi) ** 2
    seen = scipy.fft.ifft2(scipy.fft.fft2(true.heights) * 2.0**-square).real
    stated = RESOLUTION * rng.choice([0.8, 1.2])
    return View(places(rc.Surface(seen, true.grid)), rc.Instrument("optical", resolution=stated))


def noise(true: rc.Surface, rng: Random) -> View:
    """Return two maps of each place with white noise, of which nothing is stated."""

    def noisy(heights: Array) -> Array:
        return heights + rng.normal(0, NOISE, heights.shape)

    first, second = places(true, noisy), places(true, noisy, "again")
    return View(first | second, repeats=list(zip(first, second, strict=True)))


def tip(true: rc.Surface, rng: Random) -> View:
    """Return maps by a tip of known radius."""
    return View(places(true.scanned(TIP)), rc.Instrument("tip", tip_radius=TIP))


def spikes(true: rc.Surface, rng: Random) -> View:
    """Return maps with outliers in single cells."""

    def spiked(heights: Array) -> Array:
        found = heights.copy()
        cells = rng.choice(heights.size, SPIKES, replace=False)
        found.flat[cells] += RMS * rng.uniform(*HEIGHT, SPIKES) * rng.choice([-1, 1], SPIKES)
        return found

    return View(places(true, spiked), spiked=True)


def tilt(true: rc.Surface, rng: Random) -> View:
    """Return maps that lie askew."""
    x = np.arange(CELLS) * STEP

    def tilted(heights: Array) -> Array:
        a, b = rng.normal(0, SLOPE, 2)
        return heights + a * x[:, None] + b * x

    return View(places(true, tilted))


INSTRUMENTS = {
    "blur, stated 20 % wrong": blur,
    "noise, two maps a place": noise,
    "tip": tip,
    "spikes, removed": spikes,
    "tilt": tilt,
}


def numbers(surface: rc.Surface) -> Array:
    """Return area, stiffness and gap of a surface."""
    solution = rc.press(surface, MODULUS, pressure=PRESSURE)
    return np.array([getattr(solution, name) for name in NUMBERS])


def specimen(shortest: float, rng: Random) -> Array:
    """Return the numbers of a specimen without an instrument, whose waves end at the shortest of a band [m]."""
    cells = scipy.fft.next_fast_len(math.ceil(6 * SIZE / shortest * (1 - 1e-9)), real=True)
    grid = rc.Grid((cells, cells), SIZE / cells, periodic=True)

    def density(q: Array) -> Array:
        return np.where(q < 2 * math.pi / shortest * (1 + 1e-9), LAW(q), 0.0)

    return numbers(rc.synthesise(grid, density, rng, amplitudes="gaussian"))


def held(spectrum: rc.CombinedSpectrum, of: str, truth: Array, seed: Sequence[int]) -> tuple[Array, Array]:
    """Return whether the extremes of 39 draws hold each truth (NaN if refused), and the mean of the first draws.

    Draws of the next specimen are independent: they are made three at a time until the answer cannot change.
    """
    low, high = np.full(len(truth), math.inf), np.full(len(truth), -math.inf)
    count = DRAWS if of == "mean" else AT_ONCE
    for k in range(DRAWS // count):
        found = rc.press_draws(
            spectrum, MODULUS, PRESSURE, SIZE, of=of, draws=count, rng=np.random.default_rng([*seed, k])
        )
        values = np.array([found.values.get(name, np.full(count, math.nan)) for name in NUMBERS])
        low, high = np.minimum(low, values.min(axis=1)), np.maximum(high, values.max(axis=1))
        if k == 0:
            first = values.mean(axis=1)
        inside = (low < truth) & (truth < high)
        if (inside | np.isnan(values[:, 0])).all():
            break
    return np.where(np.isnan(low), math.nan, inside), first


@dataclass(frozen=True)
class Row:
    """One instrument in one repetition: shortest wave [m], hits and values of each number."""

    shortest: float
    mean: Array
    following: Array
    value: Array
    raw: Array


def run(repetitions: int, chosen: Sequence[str]) -> tuple[dict[str, list[Row]], Mapping[float, Array], Array]:
    """Return the rows of each instrument, true numbers by shortest wave, and those of maps without instrument."""
    truths: dict[float, Array] = {}
    rows: dict[str, list[Row]] = {name: [] for name in chosen}
    clean = []
    for seed in range(repetitions):
        grid = rc.Grid((2 * CELLS, 2 * CELLS), STEP, periodic=True)
        true = rc.synthesise(grid, LAW, np.random.default_rng([seed, 0]), amplitudes="gaussian")
        clean.append([numbers(each) for each in places(true).values()])
        for name in chosen:
            index = list(INSTRUMENTS).index(name)
            view = INSTRUMENTS[name](true, np.random.default_rng([seed, 1, index]))
            raw = np.array([numbers(each) for each in view.maps.values()])
            spectrum = view.spectrum()
            shortest = round(2 * math.pi / spectrum.q_max, 9)
            if shortest not in truths:
                random = np.random.default_rng([len(truths), 2])
                truths[shortest] = np.array([specimen(shortest, random) for _ in range(TRUE)])
            mean, value = held(spectrum, "mean", truths[shortest].mean(axis=0), [seed, 3, index])
            other = specimen(shortest, np.random.default_rng([seed, 4, index]))
            following, _ = held(spectrum, "specimen", other, [seed, 5, index])
            rows[name].append(Row(shortest, mean, following, value, raw))
    return rows, truths, np.array(clean)


def raw_hits(raw: Array, truth: Array) -> Array:
    """Return whether the interval of 95 % of the mean of maps holds the truth, shape (repetitions, numbers)."""
    count = raw.shape[1]
    half = t.ppf(0.975, count - 1) * raw.std(axis=1, ddof=1) / math.sqrt(count)
    return np.asarray(np.abs(raw.mean(axis=1) - truth) < half)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repetitions", type=int, default=100)
    parser.add_argument("--only", nargs="*", default=list(INSTRUMENTS), choices=list(INSTRUMENTS))
    given = parser.parse_args()
    rows, truths, clean = run(given.repetitions, given.only)
    for shortest, values in sorted(truths.items()):
        error = values.std(axis=0, ddof=1) / math.sqrt(len(values)) / values.mean(axis=0)
        texts = [
            f"{name} {mean:.4g} +- {part:.1%}"
            for name, mean, part in zip(NUMBERS.values(), values.mean(axis=0), error, strict=True)
        ]
        print(f"truth down to {shortest * 1e6:.2f} um: {', '.join(texts)}")
    print(
        "| instrument | number | mean | next specimen | bias [%] | as they are | bias [%] | l_c [um] | refused |"
    )
    print("|---|---|---|---|---|---|---|---|---|")
    whole = clean.mean(axis=(0, 1))
    for name, each in rows.items():
        raw = np.array([row.raw for row in each])
        inside, raw_bias = raw_hits(raw, whole).mean(axis=0), raw.mean(axis=(0, 1)) / whole - 1
        waves = sorted({row.shortest for row in each})
        for k, label in enumerate(NUMBERS.values()):
            good = [row for row in each if not math.isnan(row.mean[k])]
            texts = [name, label, "-", "-", "-"]
            if good:
                off = [row.value[k] / truths[row.shortest].mean(axis=0)[k] - 1 for row in good]
                hits = [100 * np.mean([getattr(row, of)[k] for row in good]) for of in ("mean", "following")]
                texts[2:] = [*(f"{hit:.0f}" for hit in hits), f"{100 * np.mean(off):+.1f}"]
            texts += [f"{100 * inside[k]:.0f}", f"{100 * raw_bias[k]:+.0f}"]
            texts += [", ".join(f"{wave * 1e6:.1f}" for wave in waves), str(len(each) - len(good))]
            print(f"| {' | '.join(texts)} |")


if __name__ == "__main__":
    main()
