"""Strategies of Hypothesis for tests of programs that use roughcontact: grids, surfaces and loads.

They need the extra ``testing``: ``pip install "roughcontact[testing]"``. Operators that you write are tested by
`roughcontact.check_operator`.
"""

from __future__ import annotations

from roughcontact.testing.strategies import grids, loads, surfaces

__all__ = ["grids", "loads", "surfaces"]
