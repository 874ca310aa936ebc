import numpy as np
import pytest

import roughcontact as rc
from roughcontact.surface.fractal import box_counting_dimension, fractal_dimension, magnify
from roughcontact.surface.generation.fourier import synthesise
from roughcontact.surface.generation.spectrum import SelfAffineSpectrum


@pytest.mark.parametrize("factor", [0.3, 2.0])
def test_a_magnified_surface_has_the_same_spectrum(factor):
    """Eqs 2.1 to 2.8: magnified by b, it is what the same C2D [m^4] gives on a length that is b times as large."""
    law = SelfAffineSpectrum(0.7, scale=1e-6)
    one = synthesise(rc.Grid((32, 48), (0.1, 0.2), True), law, np.random.default_rng(0))
    larger = magnify(one, factor, 0.7)
    grid = rc.Grid((32, 48), (0.1 * factor, 0.2 * factor), True)
    expected = synthesise(grid, law, np.random.default_rng(0))
    assert larger.grid == grid
    np.testing.assert_allclose(larger.heights, expected.heights, rtol=0, atol=1e-13 * expected.rms)
    assert larger.provenance == (*one.provenance, f"magnified by {factor:g} with H = 0.7")


def test_fractal_dimension():
    """Eq. 2.2; the thesis' D = 2.05 and 2.95."""
    assert fractal_dimension(0.95) == pytest.approx(2.05)
    assert fractal_dimension(0.05) == pytest.approx(2.95)
    assert fractal_dimension(0.3, dimension=1) == pytest.approx(1.7)


@pytest.mark.parametrize(("hurst", "error"), [(0.1, 0.3), (0.3, 0.2), (0.5, 0.13), (0.7, 0.13), (0.9, 0.13)])
def test_box_counting_is_rough_as_stated(hurst, error):
    for seed in range(3):
        surface = rc.self_affine(rc.Grid((512, 512), 1.0), hurst, 1.0, np.random.default_rng(seed))
        assert box_counting_dimension(surface) == pytest.approx(3 - hurst, abs=error)


def test_box_counting_knows_no_unit_of_height():
    line = rc.self_affine(rc.Grid(1024, 1e-6), 0.5, 1e-9, np.random.default_rng(1))
    dimension = box_counting_dimension(line)
    assert 1.3 < dimension < 1.6
    assert box_counting_dimension(1e6 * line) == pytest.approx(dimension, rel=1e-12)


def test_a_smooth_surface_has_the_dimension_two():
    """Tiles of a plane need boxes in proportion to their width, exactly."""
    y, x = np.mgrid[:129, :129]
    assert box_counting_dimension(rc.Surface(0.3 * x + 0.1 * y, rc.Grid((129, 129), 1.0))) == pytest.approx(
        2, abs=1e-12
    )
    assert box_counting_dimension(rc.Surface(np.arange(65.0), rc.Grid(65, 1.0))) == pytest.approx(
        1, abs=1e-12
    )


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: magnify(rc.Surface(np.ones(3), rc.Grid(3, 1.0)), 0.0, 0.5), "magnification must be"),
        (lambda: magnify(rc.Surface(np.ones(3), rc.Grid(3, 1.0)), 2.0, np.nan), "hurst must be"),
        (lambda: fractal_dimension(1.1), "from 0 to 1"),
        (lambda: fractal_dimension(0.5, 3), "dimension must be"),
        (lambda: box_counting_dimension(rc.Surface(np.ones(64), rc.Grid(64, 1.0))), "at least 65"),
        (lambda: box_counting_dimension(rc.Surface(np.ones(65), rc.Grid(65, 1.0))), "flat"),
        (lambda: box_counting_dimension(rc.Surface([1.0, np.nan], rc.Grid(2, 1.0))), "1 points are missing"),
    ],
)
def test_nonsense_is_refused(make, message):
    with pytest.raises(ValueError, match=message):
        make()
