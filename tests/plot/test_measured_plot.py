"""The picture of a combined spectrum shows its numbers, in two units."""

import dataclasses

import numpy as np
import pytest
from matplotlib.figure import Figure

import roughcontact as rc


@pytest.mark.parametrize(("scale", "unit"), [(1.0, "µm"), (1e-3, "nm")])
def test_the_picture_draws_the_mean_its_interval_and_each_map(scale, unit):
    grid = rc.Grid((48, 64), (2e-6 * scale, 1e-6 * scale))
    maps = {name: rc.self_affine(grid, 0.8, 1e-7 * scale, seed) for seed, name in enumerate("abc")}
    spectrum = dataclasses.replace(rc.Measurements.of(maps).combined_spectrum(), outlying=("b",))
    axes = rc.plot.combined_spectrum(spectrum, Figure().subplots(), level=0.5)
    assert axes.get_xlabel() == f"wavenumber q [rad/{unit}]"
    drawn = {line.get_label(): line for line in axes.lines}
    q, length = drawn["mean"].get_xdata(), 1e6 / scale
    np.testing.assert_allclose(q, spectrum.wavenumber / length)
    factor = drawn["mean"].get_ydata()[0] / spectrum.density[0]
    np.testing.assert_allclose(drawn["mean"].get_ydata(), factor * spectrum.density)
    np.testing.assert_allclose(drawn["b: differs"].get_ydata(), factor * spectrum.map_density[1])
    assert drawn["b: differs"].get_linestyle() == "--"
    np.testing.assert_allclose(drawn["2 measurements"].get_ydata(), factor * spectrum.map_density[0])
    band = axes.collections[0].get_paths()[0].vertices
    low, high = spectrum.interval(0.5)
    assert band[:, 1].min() == pytest.approx(factor * low.min())
    assert band[:, 1].max() == pytest.approx(factor * high.max())
    assert axes.get_legend().get_texts()[0].get_text() == "50 % interval"


def test_without_outliers_no_map_is_dashed():
    maps = {name: rc.self_affine(rc.Grid((48, 64), 1e-6), 0.8, 1e-7, seed) for seed, name in enumerate("ab")}
    axes = rc.plot.combined_spectrum(rc.Measurements.of(maps).combined_spectrum(), Figure().subplots())
    assert all(line.get_linestyle() == "-" for line in axes.lines)
