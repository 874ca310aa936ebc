"""Any independent set of power products gives the rest."""

import numpy as np
import pytest

from roughcontact.theory.tools.products import Product, solve

BOX = {
    "width": Product((1, 0)),
    "height": Product((0, 1)),
    "area": Product((1, 1)),
    "volume": Product((2, 1), 3.0),
    "aspect": Product((1, -1)),
}


def test_every_pair_gives_the_same_box():
    values = {"width": 2.0, "height": 5.0, "area": 10.0, "volume": 60.0, "aspect": 0.4}
    for first in BOX:
        for second in set(BOX) - {first}:
            found = solve(BOX, {name: np.float64(values[name]) for name in (first, second)})
            assert found == pytest.approx(values, rel=1e-14)


def test_arrays_are_broadcast_and_known_values_kept():
    width, area = np.array([[1.0], [3.0]]), np.array([1.0, 2.0, 6.0])
    found = solve(BOX, {"width": width, "area": area})
    assert found["width"] is width
    np.testing.assert_allclose(found["height"], area / width, rtol=1e-15)


def test_zero_counts_only_where_it_matters():
    plain = {name: BOX[name] for name in ("width", "height", "area", "volume")}
    found = solve(plain, {"width": np.float64(3.0), "area": np.float64(0.0)})
    assert (found["height"], found["volume"], found["width"]) == (0.0, 0.0, 3.0)


def test_too_few_too_many_or_dependent():
    one = np.float64(1.0)
    with pytest.raises(
        ValueError, match="2 of width, height, area, volume, aspect determine the rest, not 1: width"
    ):
        solve(BOX, {"width": one})
    with pytest.raises(ValueError, match="not 0: none"):
        solve(BOX, {})
    with pytest.raises(ValueError, match="not 3"):
        solve(BOX, {"width": one, "height": one, "area": one})
    twice = {**BOX, "double": Product((2, 0))}
    with pytest.raises(ValueError, match="width, double depend on each other"):
        solve(twice, {"width": one, "double": one})
