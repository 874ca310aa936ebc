"""The example maps: the same on every call, as described, and read back from every file without a warning."""

import warnings

import numpy as np
import pytest

import roughcontact as rc

# Shape, spacing [m], rms height [m] that the description states for the map without its tilt, missing cells.
STATED = {
    "ground": ((192, 256), 1e-6, 0.4e-6, 0),
    "blasted": ((256, 256), 2e-6, 2e-6, 0),
    "turned": ((160, 320), 2e-6, None, 512),
}
MAPS = pytest.mark.parametrize("name", STATED)


@MAPS
def test_a_map_is_as_described(name):
    shape, step, rms, missing = STATED[name]
    surface = rc.examples.surface(name)
    assert surface.grid == rc.Grid(shape, step)
    assert surface.missing == missing
    assert "CC0 1.0" in surface.provenance[0]
    if rms is not None:  # stated with one digit
        np.testing.assert_allclose(surface.levelled("plane").rms, rms, rtol=0.05)
    # 3 um over the width, and what a random surface of this size has of a slope along x
    across = np.polynomial.Polynomial.fit(*_along_x(surface), 1).convert().coef[1]
    np.testing.assert_allclose(across * surface.grid.lengths[1], 3e-6, rtol=0.5)


def _along_x(surface):
    measured = ~np.isnan(surface.heights)
    return np.broadcast_to(surface.grid.coordinates[1], surface.grid.shape)[measured], surface.heights[
        measured
    ]


@MAPS
def test_a_map_is_the_same_on_every_call(name):
    first, second = rc.examples.surface(name), rc.examples.surface(name)
    assert np.array_equal(first.heights, second.heights, equal_nan=True)
    assert first.provenance == second.provenance


def test_the_lay_is_as_described():
    def slopes(name):
        return [np.nanstd(np.diff(rc.examples.surface(name).heights, axis=axis)) for axis in (0, 1)]

    along_y, along_x = slopes("ground")
    assert along_y > 4 * along_x
    along_y, along_x = slopes("turned")
    assert along_x > 2 * along_y
    along_y, along_x = slopes("blasted")
    np.testing.assert_allclose(along_y, along_x, rtol=0.1)


def test_grooves_of_the_tool_repeat_with_the_feed():
    heights = rc.examples.surface("turned").filled().levelled("plane").heights
    spectrum = np.abs(np.fft.rfft(heights.mean(axis=0)))
    assert np.argmax(spectrum) == 8  # of 80 um in 640 um


@MAPS
@pytest.mark.parametrize("kind", [".x3p", ".npz", ".nc"])
def test_a_written_map_is_read_without_a_warning(name, kind, tmp_path):
    surface = rc.examples.surface(name)
    rc.write(surface, tmp_path / f"map{kind}")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        again = rc.read(tmp_path / f"map{kind}")
    assert np.array_equal(again.heights, surface.heights, equal_nan=True)


@MAPS
def test_a_map_is_pressed_where_its_contact_is_resolved(name):
    surface = rc.examples.surface(name).levelled("plane")
    curve = rc.loading_curve(surface, 100e9, pressures=[10e6, 30e6])
    assert curve.resolved.all()
    assert (curve.residual < 1e-8).all()


@pytest.mark.parametrize("wrong", ["Ground", "", 3, None, ["ground"]])
def test_a_wrong_name_lists_the_names(wrong):
    with pytest.raises(ValueError, match=r"there is no example map .*; there are ground, blasted, turned"):
        rc.examples.surface(wrong)
