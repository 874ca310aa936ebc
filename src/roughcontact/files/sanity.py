"""Sizes and heights that no measured surface of a machine part has: worth a word, no reason to refuse."""

from __future__ import annotations

import numpy as np

from roughcontact.files.heightmap import Array

__all__ = ["IMPOSSIBLE", "doubts_about", "highest"]

_SMALLEST, _LARGEST = 1e-9, 1.0  # side lengths [m]
_STEEPEST = 10.0  # rms height over side length
_HIGHEST = 1.0  # [m]
# Beyond any body to be pressed: random bytes read as numbers, not a wrong unit.
IMPOSSIBLE = 1e9  # [m]


def highest(heights: Array) -> float:
    """Return the largest finite height or depth [m]; 0 if there is none."""
    return float(np.abs(heights[np.isfinite(heights)]).max(initial=0.0))


def doubts_about(heights: Array, lengths: tuple[float, ...]) -> tuple[str, ...]:
    """Return a line for everything absurd about `heights` (ny, nx) [m] on sides of `lengths` (Ly, Lx) [m]."""
    found = []
    if min(lengths) < _SMALLEST or max(lengths) > _LARGEST:
        sides = " m x ".join(f"{length:.3g}" for length in lengths)
        found.append(f"a surface of {sides} m is unusual; check size=")
    if (peak := highest(heights)) > _HIGHEST:
        found.append(f"heights up to {peak:.3g} m are unusual; check unit=")
    rms = float(np.nanstd(heights))
    if rms > _STEEPEST * min(lengths):
        found.append(
            f"an rms height of {rms:.3g} m on {min(lengths):.3g} m is unusual; check unit= and size="
        )
    return tuple(found)
