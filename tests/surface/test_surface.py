import numpy as np
import pytest

import roughcontact as rc

GRID = rc.Grid((6, 9), (0.5, 0.25))


def heights(rng=0):
    return np.random.default_rng(rng).standard_normal(GRID.shape)


def test_a_surface_keeps_its_own_copy():
    given = heights()
    surface = rc.Surface(given, GRID)
    given[0, 0] = 99.0
    assert surface.heights[0, 0] != 99.0
    with pytest.raises(ValueError, match="read-only"):
        surface.heights[0, 0] = 1.0


def test_rms_is_about_the_mean():
    """Thesis, eq. 4.12, which forgets to say so."""
    assert rc.Surface(heights() + 5, GRID).rms == pytest.approx(np.std(heights()), rel=1e-14)


@pytest.mark.parametrize("offset", [0.0, 1e6])
def test_a_plane_is_taken_out_exactly_and_missing_points_are_ignored(offset):
    y, x = np.mgrid[:6, :9]
    rough = heights()
    rough[2, 3] = rough[5, 8] = np.nan
    tilted = rc.Surface(rough + offset + 3.0 * x - 2.0 * y, GRID).levelled("plane")
    flat = rc.Surface(rough, GRID).levelled("plane")
    # The offset leaves eps * offset of the heights behind.
    np.testing.assert_allclose(tilted.heights, flat.heights, rtol=0, atol=1e-13 + 4e-16 * offset)
    assert np.isnan(tilted.heights).sum() == tilted.missing == 2
    measured = tilted.heights[tilted.measured]
    assert abs(measured.sum()) < 1e-12 + 1e-14 * offset
    assert tilted.provenance[-1] == "tilt removed by a least-squares plane"


def test_levelling_by_the_mean():
    surface = rc.Surface(heights() + 7, GRID).levelled("mean")
    assert abs(surface.heights.mean()) < 1e-14
    with pytest.raises(ValueError, match="levelling must be"):
        surface.levelled("bowl")


@pytest.mark.parametrize(
    ("bad", "message"),
    [
        (np.zeros((9, 6)), "do not fit"),
        (np.full(GRID.shape, np.nan), "all heights are NaN"),
        (np.full(GRID.shape, np.inf), "infinite"),
        (np.full(GRID.shape, 1j), "real numbers"),
        (np.full(GRID.shape, "x"), "real numbers"),
    ],
)
def test_nonsense_is_refused(bad, message):
    with pytest.raises(ValueError, match=message):
        rc.Surface(bad, GRID)


def test_other_heights_keep_the_history_and_take_another_grid():
    surface = rc.Surface(heights(), GRID, ("as measured",))
    changed = surface.with_heights(2 * surface.heights, "doubled")
    np.testing.assert_array_equal(changed.heights, 2 * surface.heights)
    assert changed.grid == GRID
    assert changed.provenance == ("as measured", "doubled")
    small = rc.Grid((2, 3), (1.5, 0.75))
    assert surface.with_heights(surface.heights[::3, ::3], "thinned", small).grid == small
    with pytest.raises(ValueError, match="do not fit"):
        surface.with_heights(surface.heights[::3, ::3], "thinned")


def test_a_surface_shows_where_it_lies_and_what_was_done_not_its_heights():
    profile = rc.Surface(np.arange(900.0), rc.Grid(900, 1e-6))
    assert repr(profile) == f"Surface({profile.grid}, heights as given)"
    done = profile.levelled("mean").with_heights(np.ones(900), "made even")
    assert repr(done) == f"Surface({profile.grid}, mean height removed; made even)"
