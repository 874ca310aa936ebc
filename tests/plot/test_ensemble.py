"""Means with their bands and fits with their intervals: drawn where the numbers are."""

import numpy as np
import pytest
import xarray
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from roughcontact.plot.ensemble import fitted_values, mean_curves

FORCE = xarray.DataArray(np.geomspace(1e-4, 0.07, 6), dims="load", name="dimensionless_force")
HURST = [0.2, 0.8]


def stiffness(hurst=HURST):
    x = xarray.DataArray(hurst, dims="hurst", coords={"hurst": hurst})
    return (FORCE ** (1 / (1 + x))).rename("dimensionless_stiffness").transpose("hurst", "load")


@pytest.fixture
def axes() -> Axes:
    return Figure().subplots()


def bands(axes):
    return [each for each in axes.collections if isinstance(each, PolyCollection)]


class TestMeanCurves:
    def test_each_group_has_its_line_and_its_band(self, axes):
        mean = stiffness()
        mean_curves(FORCE, mean, axes, error=0.1 * mean)
        assert [line.get_label() for line in axes.lines] == ["0.2", "0.8"]
        for i, (line, band) in enumerate(zip(axes.lines, bands(axes), strict=True)):
            np.testing.assert_array_equal(line.get_xdata(), FORCE)
            np.testing.assert_array_equal(line.get_ydata(), mean[i])
            corners = band.get_paths()[0].vertices
            for force, value in zip(FORCE.to_numpy(), mean[i].to_numpy(), strict=True):
                found = corners[corners[:, 0] == force, 1]
                assert found.min() == pytest.approx(0.9 * value, rel=1e-12)
                assert found.max() == pytest.approx(1.1 * value, rel=1e-12)
        assert (axes.get_xscale(), axes.get_yscale()) == ("log", "log")
        assert axes.get_xlabel() == "force / (E* L h)"
        assert axes.get_ylabel() == "stiffness / (E* L)"
        assert axes.get_legend().get_title().get_text() == "hurst"

    def test_the_order_of_dimensions_does_not_matter(self, axes):
        mean_curves(FORCE, stiffness().transpose("load", "hurst"), axes)
        np.testing.assert_array_equal(axes.lines[1].get_ydata(), stiffness()[1])
        assert bands(axes) == []

    def test_one_curve_needs_no_legend(self, axes):
        mean_curves(FORCE, stiffness()[0], axes)
        assert len(axes.lines) == 1
        assert axes.get_legend() is None

    def test_what_is_not_resolved_is_dotted(self, axes):
        mean = stiffness()
        mean_curves(FORCE, mean, axes, resolved=FORCE > 1e-3)
        dotted = [line for line in axes.lines if line.get_linestyle() == ":"]
        whole = [line for line in axes.lines if line.get_linestyle() == "-"]
        assert (len(dotted), len(whole)) == (2, 2)
        np.testing.assert_array_equal(dotted[0].get_xydata(), np.stack([FORCE, mean[0]], 1))
        np.testing.assert_array_equal(whole[0].get_xdata(), FORCE[FORCE > 1e-3])

    def test_zeros_and_what_is_missing_have_no_place(self, axes):
        mean = stiffness()
        mean[0, 1], mean[0, 3] = 0, np.nan
        mean_curves(FORCE, mean, axes, error=mean * 2)  # a band that would reach below zero
        np.testing.assert_array_equal(axes.lines[0].get_xdata(), FORCE[[0, 2, 4, 5]])
        axes.figure.canvas.draw()

    def test_forces_may_differ_from_group_to_group(self, axes):
        factors = xarray.DataArray([1.0, 2.0], dims="hurst", coords={"hurst": HURST})
        mean_curves((factors * FORCE).rename("force"), stiffness(), axes)
        np.testing.assert_array_equal(axes.lines[1].get_xdata(), 2 * FORCE)

    def test_each_axis_names_its_unit(self, axes):
        force = FORCE.rename("force").assign_attrs(units="N")
        mean_curves(force, stiffness().rename("stiffness").assign_attrs(units="N m-1"), axes)
        assert (axes.get_xlabel(), axes.get_ylabel()) == ("force [N]", "stiffness [N/m]")

    def test_many_groups_take_shades(self, axes):
        mean_curves(FORCE, stiffness(np.linspace(0, 2, 24)), axes)
        assert len({tuple(line.get_color()) for line in axes.lines}) == 24
        assert axes.get_legend() is None

    def test_more_dimensions_are_refused(self, axes):
        with pytest.raises(ValueError, match="one dimension of groups, not along points, hurst, load"):
            mean_curves(FORCE, stiffness().expand_dims(points=2), axes)
        with pytest.raises(ValueError, match="curves lie along 'load'"):
            mean_curves(FORCE, stiffness().rename(load="step")[0], axes)


class TestFittedValues:
    FITS = xarray.Dataset(
        {
            "exponent": ("hurst", [0.7, np.nan, 0.5], {"units": "1"}),
            "exponent_low": ("hurst", [0.6, np.nan, np.nan]),
            "exponent_high": ("hurst", [0.9, np.nan, np.nan]),
        },
        {"hurst": [0.2, 0.5, 0.8]},
    )

    def test_stand_with_their_intervals_where_there_are_any(self, axes):
        fitted_values(self.FITS, ax=axes, along="hurst", label="513 x 513", shift=0.01)
        (drawn,) = axes.containers
        points, _, (arms,) = drawn.lines
        np.testing.assert_allclose(points.get_xdata(), [0.21, 0.81], rtol=1e-14)
        np.testing.assert_array_equal(points.get_ydata(), [0.7, 0.5])
        np.testing.assert_allclose(arms.get_segments()[0][:, 1], [0.6, 0.9], rtol=1e-14)
        np.testing.assert_array_equal(arms.get_segments()[1][:, 1], [0.5, 0.5])
        assert drawn.get_label() == "513 x 513"
        assert (axes.get_xlabel(), axes.get_ylabel()) == ("hurst", "exponent")

    def test_each_axis_names_its_unit(self, axes):
        fits = self.FITS.rename(hurst="long_cutoff")
        fits["long_cutoff"].attrs["units"] = "µm"
        fits["exponent"].attrs["units"] = "N m-1"
        fitted_values(fits, ax=axes, along="long_cutoff")
        assert (axes.get_xlabel(), axes.get_ylabel()) == ("long cutoff [µm]", "exponent [N/m]")

    def test_more_dimensions_are_refused(self, axes):
        with pytest.raises(ValueError, match="not only along 'hurst': select first"):
            fitted_values(self.FITS.expand_dims(points=2), ax=axes, along="hurst")
