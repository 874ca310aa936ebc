"""ASPHER with its hierarchical matrices at their default order, which err by more than a certificate allows."""

from __future__ import annotations

from typing import Any

from suite import peer_aspher

PACKAGE = "aspher"
SETTINGS = "solve_nested, H2 matrices of order 6, active set"
START = peer_aspher.START
ONCE = True  # no tolerance brings its answers to a certificate: none is searched


def normal(problem: Any, tolerance: float) -> dict[str, Any]:
    if problem.periodic or len(problem.heights) <= 64:
        raise NotImplementedError(
            "its hierarchical matrices are of free surfaces, its active set of nested grids"
        )
    return peer_aspher.normal(problem, tolerance, active_set=True)
