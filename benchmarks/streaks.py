"""How well streaks are recognised, and where force stands: the numbers of docs/concepts/spikes.md.

python benchmarks/streaks.py            made surfaces, without and with streaks that are added to them
python benchmarks/streaks.py FILE...    measured maps: cells of streaks and of pieces, as `info` finds them
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterator

import numpy as np

import roughcontact as rc
from roughcontact.surface.preparation.streaks import pieces_along_rows, streaks_in, tail_of
from roughcontact.validation import Array, Mask


def made(seeds: int) -> Iterator[Array]:
    """Yield maps of self-affine surfaces, of stretched ones along and across the rows, and of the examples."""
    for hurst in (0.0, 0.25, 0.5, 0.75, 1.0):
        for seed in range(2 * seeds):
            rng, grid = np.random.default_rng(seed), rc.Grid((128, 160), 1.0, periodic=seed % 2 == 0)
            yield rc.self_affine(grid, hurst, 1.0, rng).heights
    for ratio in (2.0, 4.0, 12.0, 30.0):
        for hurst in (0.3, 0.7):
            for seed in range(seeds):
                waves = {
                    "rolloff": 40.0,
                    "short_cutoff": 4.0 if seed % 2 else None,
                    "anisotropy": (ratio, 0.0),
                }
                rng, grid = np.random.default_rng(seed), rc.Grid((192, 192), 1.0)
                heights = rc.self_affine(grid, hurst, 1.0, rng, **waves).heights
                yield from (heights, heights.T)
    for name in ("ground", "blasted", "turned"):
        heights = rc.examples.surface(name).heights
        yield from (heights, heights.T)


def with_streaks(heights: Array, rng: np.random.Generator) -> tuple[Array, Mask]:
    """Return a map with up to 12 streaks and pieces along its rows, 1.2 to 3 times the limit high, and their cells."""
    steps = np.abs(np.diff(heights, axis=0)).ravel()
    limit = tail_of(steps, steps.size)[1]
    truth, added = np.zeros(heights.shape, bool), np.zeros(heights.shape)
    for count in range(12):
        length = (30, 20)[count] if count < 2 else int(rng.integers(3, 16))
        wide = 1 + (count % 3 == 2)
        row, column = int(rng.integers(2, len(heights) - 4)), int(rng.integers(0, heights.shape[1] - length))
        if not truth[row - 2 : row + wide + 2, column : column + length].any():
            truth[row : row + wide, column : column + length] = True
            added[row : row + wide, column : column + length] = rng.uniform(1.2, 3) * limit
    return heights + added, truth


def concentration(seeds: int) -> list[float]:
    """Return for resolved contacts the share of the cells in contact that carry half of the force."""
    found = []
    for hurst in (0.1, 0.5, 1.0):
        for seed in range(seeds):
            grid = rc.Grid((128, 128), 1.0, periodic=seed % 2 == 0)
            surface = rc.self_affine(grid, hurst, 1.0, np.random.default_rng(seed))
            slope = rc.surface_moments(surface).rms_slope
            found += [rc.press(surface, 1.0, pressure=part * slope / 2) for part in (5e-4, 3e-3, 3e-2, 0.1)]
    grid = rc.Grid((128, 128), 1.0)
    radius = np.hypot(*np.meshgrid(*(x - 64 for x in grid.coordinates), indexing="ij"))
    for power in (0.5, 1.0, 1.5, 2.0, 4.0, 20.0):
        body = rc.Surface(-((radius / 64) ** power), grid)
        found += [rc.press(body, 1.0, force=64 * part) for part in (1e-3, 1e-2, 0.1)]
    shares = []
    for solution in found:
        if solution.resolved_from_below:
            loads = np.sort(solution.pressure[solution.contact])[::-1]
            shares.append((1 + np.searchsorted(np.cumsum(loads), loads.sum() / 2)) / len(loads))
    return shares


def main(files: list[str]) -> None:
    """Print the counts."""
    warnings.simplefilter("ignore")  # of files
    for name in files:
        heights = rc.read(name).heights
        pieces = [int(pieces_along_rows(each).sum()) for each in (heights, heights.T)]
        print(
            f"{name}: {int(streaks_in(heights).sum())} cells of streaks, {pieces[0]} and {pieces[1]} of pieces"
        )
    if files:
        return
    maps = list(made(10))
    marked = sum(int(streaks_in(heights).any()) for heights in maps)
    print(f"{len(maps)} made maps: streaks found in {marked}")
    rng, true, found, false = np.random.default_rng(5), 0, 0, 0
    for heights in maps:
        streaked, truth = with_streaks(heights, rng)
        cells = streaks_in(streaked)
        true, found, false = true + truth.sum(), found + (cells & truth).sum(), false + (cells & ~truth).sum()
    print(f"with streaks: {100 * found / true:.2f} % of {true} cells found, {false} other cells marked")
    shares = concentration(6)
    print(
        f"{len(shares)} resolved contacts: half of the force on at least {min(shares):.2f} of the cells in contact"
    )


if __name__ == "__main__":
    main(sys.argv[1:])
