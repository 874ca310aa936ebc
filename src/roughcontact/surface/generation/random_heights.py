"""Heights of random waves, in one process or in slabs, where each process generates some columns of the waves."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.errors import InputError, about
from roughcontact.grid import Grid
from roughcontact.progress.events import task, tracked
from roughcontact.slabs.exchange import plane_of_waves
from roughcontact.slabs.slab_array import SlabArray
from roughcontact.slabs.slabs import Slabs
from roughcontact.surface.generation.random_phases import (
    Amplitudes,
    Keys,
    draw_keys,
    require_amplitudes,
    unit_waves,
)
from roughcontact.surface.generation.wave_grid import (
    ALL,
    Spectrum,
    Support,
    cell_centres,
    counted_powers,
    no_wave,
    require_no_band,
    scale_of,
    wave_amplitudes,
    wave_integers,
    wave_powers,
)
from roughcontact.validation import Array, RngLike

__all__ = ["SizedSpectrum", "random_heights"]

BLOCK = 2**15  # waves generated at once: a megabyte or two of words and angles
POWERS = 2**18  # waves whose powers are added at once: some megabytes


@dataclass(frozen=True, slots=True)
class SizedSpectrum:
    """A spectrum and the scale of the heights, see ``wave_grid.wave_amplitudes``."""

    spectrum: Spectrum
    support: Support
    rms: float | None
    rms_band: tuple[float, float] | None


def random_heights(
    grid: Grid, sized: SizedSpectrum, rng: RngLike, amplitudes: Amplitudes, nodal: bool, slabs: Slabs | None
) -> Array:
    """Return the heights [m] of random waves (eqs 2.12 and 2.15).

    Parameters
    ----------
    grid : Grid
    sized : SizedSpectrum
    rng : int, numpy.random.Generator, SeedSequence, BitGenerator or None
        In slabs the same seed or state on all processes; with None the first process draws for all.
    amplitudes : {"exact", "gaussian"}
    nodal : bool
        Whether the last row and column repeat the first.
    slabs : Slabs, optional
        Processes that generate the heights together.

    Raises
    ------
    ValueError
        If a nodal grid is periodic or too small, or no wave is left; in slabs, if the grid is not periodic or the
        processes draw different phases.
    """
    require_amplitudes(amplitudes)
    if nodal and any(grid.periodic):
        raise about("nodal", "repeats the first row at the end: a periodic grid would hold it twice")
    if nodal and min(grid.shape) < 3:
        raise InputError(f"a nodal grid needs at least 3 nodes an axis, not {grid.shape}", place="nodal")
    with task("Adding up the waves of", shape=grid.shape):
        if slabs is not None:
            return _heights_in_slabs(grid, sized, rng, amplitudes, slabs)  # type: ignore[return-value]
        return _heights(grid, sized, rng, amplitudes, nodal)


def _heights(grid: Grid, sized: SizedSpectrum, rng: RngLike, amplitudes: Amplitudes, nodal: bool) -> Array:
    import scipy.fft  # not needed to press measured surfaces

    shape = tuple(n - 1 for n in grid.shape) if nodal else grid.shape
    amplitude = wave_amplitudes(
        sized.spectrum, shape, grid.spacing, sized.support, rms=sized.rms, rms_band=sized.rms_band
    )
    amplitude *= math.prod(shape)  # of the transform
    waves = _waves(draw_keys(rng), amplitude, shape, amplitudes, nodal)
    heights = np.asarray(scipy.fft.irfftn(waves, s=shape, overwrite_x=True))
    return np.pad(heights, [(0, 1)] * grid.ndim, mode="wrap") if nodal else heights


def _waves(
    keys: Keys, amplitude: Array, shape: tuple[int, ...], amplitudes: Amplitudes, nodal: bool
) -> npt.NDArray[np.complex128]:
    """Return the waves about the first point, row by row; it lies at the origin (nodal) or half a cell from it."""
    *rows, columns = wave_integers(shape)
    ky = rows[0] if rows else np.zeros(1, dtype=np.int64)
    along, *across = reversed(cell_centres(shape))
    waves = np.empty((len(ky), len(columns)), np.complex128)
    powers = amplitude.reshape(waves.shape)
    step = max(1, BLOCK // len(columns))
    for start in tracked(range(0, len(ky), step), "Drawing phases", "blocks"):
        part = slice(start, start + step)
        waves[part] = unit_waves(keys, ky[part], (0, len(columns)), amplitudes)
        waves[part] *= powers[part]
        if not nodal:
            waves[part] *= along
            for turn in across:
                waves[part] *= turn[part]
    return waves.reshape(amplitude.shape)


def _heights_in_slabs(
    grid: Grid, sized: SizedSpectrum, rng: RngLike, amplitudes: Amplitudes, slabs: Slabs
) -> SlabArray:
    if grid.ndim != 2 or not all(grid.periodic):
        raise InputError(
            "a surface in slabs must be periodic along both axes",
            "make the grid with periodic=True, or generate the surface in one process",
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
        raise InputError(
            "the processes drew different phases",
            "give each the same seed, such as rng=1, or a generator in the same state",
        )
    first: Keys = drawn[0][0]
    return first


def _scale(grid: Grid, sized: SizedSpectrum, slabs: Slabs) -> float:
    """Return the factor that gives the waves their rms height; the same on any number of processes."""
    shape = grid.shape
    mine, step = slabs.rows(shape[0]), max(1, POWERS // (shape[1] // 2 + 1))
    sums: list[tuple[float, float]] = []
    for start in range(mine.start, mine.stop, step):
        part = (slice(start, min(start + step, mine.stop)), ALL[1])
        powers = wave_powers(sized.spectrum, shape, grid.spacing, sized.support, part)
        counted = counted_powers(powers, shape, grid.spacing, sized.rms_band, part)
        # Row by row, and rounded only once: the distribution of the rows over the processes makes no difference.
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
