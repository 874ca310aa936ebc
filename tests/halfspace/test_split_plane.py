"""Products on the whole plane in two parts: what they miss, and where they are."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import roughcontact as rc
from roughcontact.halfspace.influence import Love
from roughcontact.halfspace.split_plane import LEAST, SplitPlane

GRIDS = {
    "square": rc.Grid((128, 128), (1e-3, 1e-3)),
    "any shape": rc.Grid((97, 230), (1e-6, 1e-6)),
    "slender cells": rc.Grid((90, 150), (5.0, 1.0)),
    "cells slender the other way": rc.Grid((150, 90), (1.0, 5.0)),
    "slender plane": rc.Grid((6, 700), (1.0, 1.0)),
}


def missed(grid, pressure):
    """Return the largest error, over what pressure of this size but of one sign would do."""
    exact = rc.half_space(grid, 2e9)
    quick = SplitPlane.of(Love(grid.spacing, 2e9), grid.shape)
    scale = np.abs(exact.apply(np.abs(pressure))).max()
    return np.abs(quick.apply(pressure) - exact.apply(pressure)).max() / scale


@pytest.mark.parametrize("name", GRIDS)
@pytest.mark.parametrize("kind", ["both signs", "constant", "spots"])
def test_it_misses_no_more_than_it_says(name, kind):
    grid = GRIDS[name]
    rng = np.random.default_rng(1)
    pressure = {
        "both signs": rng.normal(size=grid.shape),
        "constant": np.ones(grid.shape),
        "spots": (rng.random(grid.shape) < 0.05) * 1.0,
    }[kind]
    assert missed(grid, 1e6 * pressure) < 5e-5


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 96), st.integers(0, 229))
def test_a_cell_anywhere_is_seen_by_all(row, column):
    """At the edges above all: nothing comes round."""
    grid = GRIDS["any shape"]
    pressure = np.zeros(grid.shape)
    pressure[row, column] = 1.0
    exact = rc.half_space(grid, 1.0).apply(pressure)
    quick = SplitPlane.of(Love(grid.spacing, 1.0), grid.shape).apply(pressure)
    assert np.abs(quick - exact).max() < 5e-5 * exact.max()
    far = exact < 0.03 * exact.max()  # where short waves are gone
    assert np.abs(quick / exact - 1)[far].max() < 3e-3


def test_symmetric_and_in_the_precision_of_the_field():
    grid = GRIDS["any shape"]
    quick = SplitPlane.of(Love(grid.spacing, 1.0), grid.shape)
    rng = np.random.default_rng(2)
    a, b = rng.normal(size=(2, *grid.shape))
    rounding = 1e-12 * np.vdot(np.abs(a), quick.apply(np.abs(b)))
    assert np.vdot(a, quick.apply(b)) == pytest.approx(np.vdot(b, quick.apply(a)), abs=rounding)
    single = quick.apply(a.astype(np.float32))
    assert single.dtype == np.float32
    assert np.abs(single - quick.apply(a)).max() < 1e-5 * np.abs(quick.apply(a)).max()


def test_half_spaces_have_it_where_it_pays():
    side = int(LEAST**0.5) + 1
    large = rc.Grid((side, side), 1.0)
    assert rc.half_space(large, 1.0).quick is not None
    assert rc.half_space(rc.Grid((64, 64), 1.0), 1.0).quick is None
    layer = rc.layer(large, rc.Solid(1e9, 0.3), 10.0, base="bonded")
    assert getattr(layer, "quick", None) is None  # another body's influence is not split
