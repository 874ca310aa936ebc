"""The case of nominally flat surfaces and the tops of their cells."""

from itertools import pairwise

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.study.cases import find_case
from roughcontact.study.cases.cells_case import CASE, CellsParameters
from roughcontact.study.cases.curve_case import CASE as CURVE, CurveParameters

GIVEN = {"points": 32, "size": 2e-3, "modulus": 1e11, "hurst": 0.8, "rms": 1e-6, "loads": 3}


def run(seed=0, **given):
    return CASE.run(CellsParameters(**(GIVEN | given)), np.random.default_rng(seed))


def test_it_comes_with_the_package():
    assert find_case("cells") is CASE


@pytest.mark.parametrize(
    ("limit", "edges"),
    [
        ({"long_cutoff": 0.25}, [0, 8, 16, 24, 32]),
        ({"rolloff": 0.25}, [0, 8, 16, 24, 32]),
        ({"long_cutoff": 0.3}, [0, 11, 21, 32]),
        ({"long_cutoff": 2.0}, [0, 32]),
        ({}, [0, 32]),
    ],
)
def test_the_curve_is_that_of_the_surface_and_tops_are_those_of_its_cells(limit, edges):
    record = run(seed=5, **limit)
    plain = CURVE.run(CurveParameters(**(GIVEN | limit)), np.random.default_rng(5))
    assert record.drop_vars(["below", "peak"]).identical(plain)
    lengths = {name: part * 2e-3 for name, part in limit.items()}
    grid = rc.Grid((32, 32), 2e-3 / 32)
    heights = rc.self_affine(grid, 0.8, 1e-6, np.random.default_rng(5), **lengths).heights
    sides = list(pairwise(edges))
    tops = np.array([heights[slice(*rows), slice(*columns)].max() for rows in sides for columns in sides])
    np.testing.assert_array_equal(record["below"], np.sort(heights.max() - tops))
    assert float(record["below"][0]) == 0
    assert float(record["peak"]) == heights.max() - heights.mean()
