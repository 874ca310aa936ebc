import numpy as np
import pytest

import roughcontact as rc
from roughcontact.surface.analysis.histogram import height_histogram


def test_heights_are_counted_once_and_above_their_mean():
    heights = np.array([1.0, 2.0, 2.0, 5.0, np.nan])
    found = height_histogram(rc.Surface(heights, rc.Grid(5, 1.0)), bins=4)
    np.testing.assert_allclose(found.edges, [-1.5, -0.5, 0.5, 1.5, 2.5])
    assert found.count.tolist() == [1, 2, 0, 1]
    assert (found.density * np.diff(found.edges)).sum() == pytest.approx(1)
    np.testing.assert_allclose(found.centres, [-1, 0, 1, 2])


def test_normal_heights_follow_the_normal_density():
    """Each count is binomial."""
    z = np.random.default_rng(0).standard_normal((300, 300)) * 3.0
    found = height_histogram(rc.Surface(z, rc.Grid(z.shape, 1.0)), bins=60)
    expected = found.gaussian(found.centres) * np.diff(found.edges) * z.size
    often = expected > 50
    assert (np.abs(found.count - expected)[often] < 4.5 * np.sqrt(expected[often])).all()


def test_nonsense_is_refused():
    flat = rc.Surface(np.zeros((3, 3)), rc.Grid((3, 3), 1.0))
    with pytest.raises(ValueError, match="bins must be"):
        height_histogram(flat, bins=0)
    with pytest.raises(ValueError, match="all heights are equal"):
        height_histogram(flat).gaussian(0.0)
