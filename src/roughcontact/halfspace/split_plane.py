"""The free half-space on a whole plane, about, at half the cost: only what is smooth is padded to twice the plane.

The influence is split in two (`roughcontact.halfspace.near_far`). A rim as wide as its near part reaches keeps that
from coming round. Its far part has no short waves: a coarse grid of nodes carries it, which is padded to twice its size
as a plane is in an exact product (thesis, eq. A.59 as corrected). Gaussians bring the pressure to the nodes and the
displacement back, so that no wave that ends at the nodes' shortest leaves a tail that would come round either.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import (
    Placed,
    convolve,
    even_multiplier,
    fast_even_length,
    irfft2,
    multiply_even,
    namespace,
    rfft2,
)
from roughcontact.halfspace.influence import Love, wavenumbers
from roughcontact.halfspace.near_far import DECAY, FreeSplit

__all__ = ["LEAST", "SplitPlane"]

Array = npt.NDArray[np.float64]
Pair = tuple[int, int]

LEAST = 60_000  # cells from which on it costs less than an exact product (benchmarks/patches.py)
STEPS = (2, 4, 8)  # cells from node to node, of which the cheapest is taken
WAVES = 8.0  # q s at the shortest wave of the nodes: erfc(4), 2e-8, of the far part is beyond
SHARE = 0.6  # of s^2 that the Gaussians before and after the nodes have


@dataclass(frozen=True, slots=True, eq=False)
class SplitPlane:
    """A product that errs by some 1e-5 of the answer: it drives solves.

    Attributes
    ----------
    nodes, step : tuple of int
        Nodes along each axis, and cells from node to node.
    rim : tuple of int
        Nodes before the first cell.
    padded : tuple of int
        Lengths of the transforms of the nodes.
    near : Placed
        Transform of the near part [m/Pa] over the plane and its rim.
    before, after : Placed
        Gaussians on the waves of the nodes, on the way there and on the way back.
    far : Placed
        Transform of the far part [m/Pa] on the padded nodes, without these Gaussians.
    """

    nodes: Pair
    step: Pair
    rim: Pair
    padded: Pair
    near: Placed
    before: Placed
    after: Placed
    far: Placed

    @classmethod
    def of(cls, kernel: Love, shape: Pair) -> SplitPlane:
        """Return what does the products of a free plane of cells."""
        layouts = [_Layout.of(shape, (kernel.spacing[0], kernel.spacing[1]), step) for step in STEPS]
        layout = min(layouts, key=lambda one: one.cost)
        nodes, step, padded = layout.nodes, layout.step, layout.padded
        split = FreeSplit(kernel, layout.reach)
        distances = tuple(k * d for k, d in zip(step, kernel.spacing, strict=True))
        a2 = SHARE / 2 * (layout.reach / DECAY) ** 2
        blur = np.exp(-(wavenumbers(nodes, distances) ** 2) * a2 / 4)
        blur[-1], blur[:, -1] = 0.0, 0.0  # the nodes' shortest wave does not know its sign
        far = split.far(step, padded) / np.exp(-(wavenumbers(padded, distances) ** 2) * a2 / 2)
        near = even_multiplier(split.near(layout.near), layout.box)
        return cls(
            nodes,
            step,
            layout.rim,
            padded,
            Placed(near),
            Placed(blur),
            Placed(blur * math.prod(step)),
            Placed(far),
        )

    def apply(self, pressure: Array) -> Array:
        """Return the displacement [m] under `pressure` [Pa], in its precision."""
        xp, (ny, nx) = namespace(pressure), pressure.shape
        rows, columns = self.nodes[0], self.nodes[1] // 2 + 1
        box = self.nodes[0] * self.step[0], self.nodes[1] * self.step[1]
        upper, lower = slice(0, rows // 2), slice(box[0] - rows + rows // 2, box[0])
        waves = rfft2(pressure, box)
        long = xp.concat([waves[upper, :columns], waves[lower, :columns]], axis=0)
        multiply_even(long, self.before)
        there, back = self.rim, (-self.rim[0], -self.rim[1])
        on_nodes = xp.roll(irfft2(long, self.nodes), there, axis=(0, 1))
        on_nodes = xp.roll(convolve(on_nodes, self.far, self.padded), back, axis=(0, 1))
        long = rfft2(on_nodes, self.nodes)
        multiply_even(long, self.after)
        multiply_even(waves, self.near)
        waves[upper, :columns] += long[: rows // 2, :]
        waves[lower, :columns] += long[rows // 2 :, :]
        return irfft2(waves, box)[:ny, :nx]


@dataclass(frozen=True, slots=True)
class _Layout:
    """How a plane is covered with nodes; lengths are numbers of cells, but for `reach` [m]."""

    reach: float
    near: Pair
    step: Pair
    nodes: Pair
    padded: Pair
    box: Pair
    rim: Pair

    @classmethod
    def of(cls, shape: Pair, spacing: tuple[float, float], most: int) -> _Layout:
        """Return the layout with `most` cells from node to node along the axis of the longer cells."""
        distance = most * max(spacing)
        reach = DECAY * WAVES / math.pi * distance
        near, step, nodes, padded, box, rim = [], [], [], [], [], []
        for n, d in zip(shape, spacing, strict=True):
            step.append(2 ** int(math.log2(distance / d) + 1e-9))
            cells = int(reach / d) + 1
            nodes.append(fast_even_length(-(-(n + cells) // step[-1])))
            padded.append(fast_even_length(2 * nodes[-1] + 8))
            box.append(nodes[-1] * step[-1])
            near.append(min(cells, box[-1] // 2))  # of a slender plane, all offsets and no more
            rim.append((box[-1] - n) // 2 // step[-1])
        pairs = ((values[0], values[1]) for values in (near, step, nodes, padded, box, rim))
        return cls(reach, *pairs)

    @property
    def cost(self) -> int:
        """Numbers that are transformed there and back."""
        return math.prod(self.box) + math.prod(self.nodes) + math.prod(self.padded) // 2
