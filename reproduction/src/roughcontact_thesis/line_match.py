"""How much higher a line must be to be as stiff as a surface, from ensembles of both in one window."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import xarray

from roughcontact.statistics.bootstrap import counts_of
from roughcontact.statistics.ensemble_mean import mean_over_samples
from roughcontact.statistics.fit_window import CELLS
from roughcontact.validation import Array
from roughcontact_thesis.averaging import converged
from roughcontact_thesis.calibration import force_ratio

__all__ = ["Ensemble", "Match", "match", "pairs"]

_REPLICATES = 200


@dataclass(frozen=True, slots=True, eq=False)
class Ensemble:
    """Curves of one Hurst exponent.

    Parameters
    ----------
    force : array, shape (loads,)
        F/(E* h L).
    stiffness : array, shape (samples, loads)
        k/(E* L).
    cell : float
        That of one cell or spring.
    """

    force: Array
    stiffness: Array
    cell: float

    @classmethod
    def of(cls, curves: xarray.Dataset, cell: float) -> Ensemble:
        """Return those of a dataset of one Hurst exponent, without what is missing in all samples or at all loads."""
        stiffness = curves["dimensionless_stiffness"].transpose("sample", "load").to_numpy()
        there = ~np.isnan(stiffness)
        loads = there.any(axis=0)
        samples = there.any(axis=1)
        return cls(curves["dimensionless_force"].to_numpy()[loads], stiffness[np.ix_(samples, loads)], cell)

    def mean(self) -> Array:
        """Return the mean curve."""
        return mean_over_samples(self.stiffness)

    def resampled(self, rng: np.random.Generator) -> Array:
        """Return mean curves of samples drawn again, shape (replicates, loads)."""
        every = np.ones(len(self.stiffness), bool)
        drawn = rng.random((_REPLICATES, every.size))
        return mean_over_samples(self.stiffness, counts=counts_of(drawn, every))


def pairs(lines: xarray.Dataset, surfaces: xarray.Dataset) -> Iterator[tuple[float, Ensemble, Ensemble]]:
    """Yield each Hurst exponent of the surfaces with the lines and the surfaces that have it.

    Parameters
    ----------
    lines : Dataset
        Every line a sample, see `each_line`, of one number of points.
    surfaces : Dataset
        What a study of the case ``curve`` exports. Loads that missed their tolerance have no part.
    """
    curves = converged(surfaces)[["dimensionless_force", "dimensionless_stiffness"]]
    cell = float((surfaces["cell_stiffness"] / (surfaces["modulus"] * surfaces["size"])).mean())
    for hurst in surfaces["hurst"].to_numpy():
        line = lines.sel(hurst=hurst, method="nearest", tolerance=1e-9)
        both = Ensemble.of(line, 1 / int(lines["points"])), Ensemble.of(curves.sel(hurst=hurst), cell)
        yield float(hurst), *both


@dataclass(frozen=True, slots=True)
class Match:
    """What matches lines to surfaces.

    Parameters
    ----------
    ratio : float
        What force the surfaces take over that of the lines at one stiffness, see `force_ratio`.
    error : float
        Standard error of its logarithm, from samples of both drawn again.
    window : tuple of float
        Stiffnesses k/(E* L) between which they were matched.
    mismatch : float
        Largest difference of ln k of the two means in the window, after the match.
    """

    ratio: float
    error: float
    window: tuple[float, float]
    mismatch: float


def match(lines: Ensemble, surfaces: Ensemble, highest: float, *, seed: int = 0) -> Match:
    """Match two ensembles where the means of both are above 20 cells, up to what is softer at the `highest` force.

    Where the first force of one is stiffer than 20 cells, the window begins there.
    """
    cell = max(lines.cell, surfaces.cell)

    def matched(line: Array, surface: Array) -> tuple[float, tuple[float, float]]:
        curves = (lines.force, line), (surfaces.force, surface)
        window = max(CELLS * cell, line[0], surface[0]), min(_at(highest, *each) for each in curves)
        return force_ratio(*curves, window), window

    found, window = matched(lines.mean(), surfaces.mean())
    rng = np.random.default_rng(seed)
    drawn = (each.resampled(rng) for each in (lines, surfaces))
    # With the whole rule: of other samples the window is another.
    again = [matched(line, surface)[0] for line, surface in zip(*drawn, strict=True)]
    error = float(np.std(np.log(again), ddof=1))
    return Match(found, error, window, _mismatch(lines, surfaces, found, window))


def _at(force: float, forces: Array, stiffness: Array) -> float:
    return float(np.exp(np.interp(np.log(force), np.log(forces), np.log(stiffness))))


def _mismatch(lines: Ensemble, surfaces: Ensemble, ratio: float, window: tuple[float, float]) -> float:
    mean = surfaces.mean()
    inside = (mean >= window[0]) & (mean <= window[1])
    moved = np.interp(np.log(surfaces.force[inside] / ratio), np.log(lines.force), np.log(lines.mean()))
    return float(np.abs(moved - np.log(mean[inside])).max())
