"""Whether the open part of a periodic map percolates: components that meet themselves across the border.

The shift by whole periods of a path of open cells from a cell to itself is a winding vector. A component conducts along
its winding vectors only: along none, one direction, or all.
"""

from __future__ import annotations

from collections import defaultdict
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

__all__ = ["windings"]

Indices: TypeAlias = npt.NDArray[np.integer[Any]]


def windings(
    labels: Indices,
    first: Indices,
    second: Indices,
    axis: Indices,
) -> tuple[Indices, dict[int, Indices]]:
    """Return the component of each label, and the winding vectors of each component that has some.

    Parameters
    ----------
    labels : int array, shape (n,)
        Of each node, from 0: its component without the faces across the border.
    first, second : int array, shape (f,)
        Nodes of each face across the border, which leads from the last cell of an axis to its first.
    axis : int array, shape (f,)
        The axis whose border it crosses.

    Returns
    -------
    component : int array, shape (number of labels,)
        One of its labels names a component.
    vectors : dict of int to int array, shape (rank, 2)
        Independent winding vectors [periods].
    """
    count = int(labels.max(initial=-1)) + 1
    edges = np.unique(np.stack([labels[first], labels[second], axis], axis=1), axis=0)
    beside: dict[int, list[tuple[int, int, int]]] = defaultdict(list)
    for a, b, along in edges.tolist():
        beside[a].append((b, along, 1))
        beside[b].append((a, along, -1))
    component = np.arange(count)
    offset: dict[int, tuple[int, int]] = {}
    vectors: dict[int, Indices] = {}
    for root in list(beside):
        if root in offset:
            continue
        offset[root], waiting, found = (0, 0), [root], []
        while waiting:
            here = waiting.pop()
            component[here] = root
            for there, along, sign in beside[here]:
                to = (offset[here][0] + sign * (along == 0), offset[here][1] + sign * (along == 1))
                if there not in offset:
                    offset[there] = to
                    waiting.append(there)
                elif to != offset[there]:
                    found.append((to[0] - offset[there][0], to[1] - offset[there][1]))
        if found:
            vectors[root] = _independent(found)
    return component, vectors


def _independent(found: list[tuple[int, int]]) -> Indices:
    """Return the first vector, and the first that is not parallel to it, each divided by its content."""
    first = found[0]
    other = next((each for each in found if first[0] * each[1] != first[1] * each[0]), None)
    chosen = np.array([first] if other is None else [first, other])
    return chosen // np.gcd.reduce(chosen, axis=1, keepdims=True)
