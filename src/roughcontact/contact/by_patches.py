"""Solves on the tiles that a region touches: an inexact operator there drives, products with the exact one certify."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import is_numpy
from roughcontact.contact.conjugate_gradient import Relaxed, relax
from roughcontact.contact.iterative import press_region
from roughcontact.contact.problem import Control
from roughcontact.halfspace.operator import Operator
from roughcontact.halfspace.patches import PatchOperator
from roughcontact.halfspace.tiles import Tiles, count

__all__ = ["GAIN", "factorised", "patch_on", "press_by_patches", "relax_by_patches"]

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]

FACTORISED = 1200  # cells: their third power, against some thirty products on few tiles
GAIN = 1e-3  # what one round on patches can take off an error
LEAST = 12_000  # cells of a plane from which on tiles may cost less (benchmarks/patches.py)


def patch_on(operator: Operator, region: Mask, previous: PatchOperator | None = None) -> PatchOperator | None:
    """Return the operator on the tiles of a region, the previous one if it serves; None where it would not pay."""
    patches = getattr(operator, "patches", None)
    if patches is None or not is_numpy(region) or region.size < LEAST:
        return None
    if previous is not None and previous.tiles.hold(region):
        return previous
    tiles = Tiles.of(region)
    everything = count(region.shape[0]) * count(region.shape[1])
    return patches.on(tiles) if len(tiles) < patches.cover * everything else None


def factorised(operator: Operator, limit: int) -> int:
    """Return up to how many cells a factorisation pays: fewer than `limit` where patches compete with it."""
    return min(limit, FACTORISED) if getattr(operator, "patches", None) is not None else limit


def press_by_patches(
    patch: PatchOperator,
    operator: Operator,
    separation: Array,
    control: Control,
    region: Mask,
    pressure: Array,
    displacement: Array,
    *,
    limit: float,
    max_steps: int,
) -> Relaxed:
    """Do what `press_region` does, and one exact product; tiles hold the region and all cells under pressure.

    The displacement that is given is exact, and the operator on the tiles adds to it what changes of pressure do: of
    that alone it gets some part wrong.
    """
    tiles = patch.tiles
    found = press_region(
        patch,
        tiles.gather(separation),
        control,
        tiles.gather(region),
        tiles.gather(pressure),
        tiles.gather(displacement),
        limit=limit,
        max_steps=max_steps,
    )
    return _certified(found, tiles, operator)


def relax_by_patches(
    patch: PatchOperator,
    operator: Operator,
    region: Mask,
    separation: Array,
    pressure: Array,
    displacement: Array,
    *,
    limit: float,
    max_steps: int,
) -> Relaxed:
    """Do what `relax` does at depth 0, and one exact product."""
    tiles = patch.tiles
    found = relax(
        patch,
        tiles.gather(region),
        tiles.gather(separation),
        tiles.gather(pressure),
        tiles.gather(displacement),
        depth=0.0,
        limit=limit,
        max_steps=max_steps,
    )
    return _certified(found, tiles, operator)


def _certified(found: Relaxed, tiles: Tiles, operator: Operator) -> Relaxed:
    pressure = tiles.scatter(found.pressure)
    return replace(found, pressure=pressure, displacement=operator.apply(pressure), steps=found.steps + 1)
