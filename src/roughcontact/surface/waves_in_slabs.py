"""Random surfaces made in place: each process makes some columns of the waves, and gets its rows of the heights."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.grid import Grid
from roughcontact.slabs.exchange import plane_of_waves
from roughcontact.slabs.slab_array import SlabArray
from roughcontact.slabs.slabs import Slabs
from roughcontact.surface.random_phases import Amplitudes, Keys, draw_keys, unit_waves
from roughcontact.surface.wave_grid import (
    ALL,
    Spectrum,
    Support,
    cell_centres,
    counted_powers,
    no_wave,
    require_no_band,
    scale_of,
    wave_integers,
    wave_powers,
)
from roughcontact.validation import RngLike

__all__ = ["SizedSpectrum", "heights_in_slabs"]

BLOCK = 2**18  # waves whose powers are added at once: some megabytes


@dataclass(frozen=True, slots=True)
class SizedSpectrum:
    """A spectrum and what sets the height, see ``roughcontact.surface.wave_grid.wave_amplitudes``."""

    spectrum: Spectrum
    support: Support
    rms: float | None
    rms_band: tuple[float, float] | None


def heights_in_slabs(
    grid: Grid, sized: SizedSpectrum, rng: RngLike, amplitudes: Amplitudes, slabs: Slabs
) -> SlabArray:
    """Return the heights [m] of random waves.

    Parameters
    ----------
    grid : Grid
    sized : SizedSpectrum
    rng : int, numpy.random.Generator, SeedSequence, BitGenerator or None
        The same seed or state on all processes; of None the first process draws for all.
    amplitudes : {"exact", "gaussian"}
    slabs : Slabs

    Raises
    ------
    ValueError
        If the grid is not periodic, the processes draw different phases, or no wave is left.
    """
    if grid.ndim != 2 or not all(grid.periodic):
        raise ValueError(
            "a surface in slabs must be periodic along both axes: Grid(..., periodic=True), or make it in one process"
        )
    keys = _keys(rng, slabs)
    shape, factor = grid.shape, _scale(grid, sized, slabs)
    ky, _ = wave_integers(shape)
    down, along = cell_centres(shape)

    def waves(columns: slice) -> npt.NDArray[np.complex128]:
        powers = wave_powers(sized.spectrum, shape, grid.spacing, sized.support, (ALL[0], columns))
        np.sqrt(powers, out=powers)
        powers *= factor
        powers *= math.prod(shape)  # of the transform
        made = unit_waves(keys, ky, (columns.start, columns.stop), amplitudes)
        made *= powers
        made *= along[:, columns]
        made *= down
        return made

    return plane_of_waves(waves, shape, slabs.functions)  # type: ignore[arg-type]


def _keys(rng: RngLike, slabs: Slabs) -> Keys:
    """Return the key that all processes draw, or that the first of them draws if none has a seed."""
    drawn = slabs.communicator.allgather((draw_keys(rng), rng is None))
    if not all(unseeded for _, unseeded in drawn) and len({keys.tobytes() for keys, _ in drawn}) > 1:
        raise ValueError(
            "the processes drew different phases: give each the same seed, as rng=1, or a generator in the same state"
        )
    first: Keys = drawn[0][0]
    return first


def _scale(grid: Grid, sized: SizedSpectrum, slabs: Slabs) -> float:
    """Return the factor that gives the waves their rms height; the same on any number of processes."""
    shape = grid.shape
    mine, step = slabs.rows(shape[0]), max(1, BLOCK // (shape[1] // 2 + 1))
    sums: list[tuple[float, float]] = []
    for start in range(mine.start, mine.stop, step):
        part = (slice(start, min(start + step, mine.stop)), ALL[1])
        powers = wave_powers(sized.spectrum, shape, grid.spacing, sized.support, part)
        counted = counted_powers(powers, shape, grid.spacing, sized.rms_band, part)
        # Row by row, and rounded once in all: whoever holds which rows makes no difference.
        sums += [
            (float(row.sum()), float(all_of_row.sum()))
            for row, all_of_row in zip(counted, powers, strict=True)
        ]
    of_all = [each for part in slabs.communicator.allgather(sums) for each in part]
    if not any(power for _, power in of_all):
        raise no_wave()
    if sized.rms is None:
        require_no_band(sized.rms_band)
        return 1.0
    return scale_of(sized.rms, math.fsum(counted for counted, _ in of_all), sized.rms_band)
