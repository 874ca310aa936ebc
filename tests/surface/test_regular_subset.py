"""The part of many numbers from which quantiles are computed."""

import numpy as np
import pytest

from roughcontact.surface.preparation.regular_subset import regular_subset


@pytest.mark.parametrize("shape", [(0,), (7,), (3, 5), (300, 400), (199_999,)])
def test_few_numbers_are_all_taken(shape):
    values = np.arange(np.prod(shape)).reshape(shape)
    np.testing.assert_array_equal(regular_subset(values), values.ravel())


@pytest.mark.parametrize("shape", [(500, 500), (640, 480), (1000, 1000), (1024, 1536), (3, 700_000)])
def test_of_many_numbers_even_and_odd_columns_are_taken_alike(shape):
    """The stride is odd, from 200 000 numbers on 3: two thirds of 100 000 at least, and fewer than twice as many."""
    columns = regular_subset(np.broadcast_to(np.arange(shape[1]), shape))
    assert 66_666 <= columns.size < 200_000
    assert abs(np.count_nonzero(columns % 2) - columns.size / 2) <= 0.5
