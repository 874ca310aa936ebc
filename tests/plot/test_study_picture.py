"""The picture of a study: lines, bands and marks lie where the numbers are."""

import numpy as np
import pytest
import xarray
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_hex

from roughcontact.plot.study_picture import study_figure
from roughcontact.statistics.averages import averages
from roughcontact.statistics.fit_window import force_window

FORCE = np.geomspace(1e-4, 0.07, 12)
HURST, POINTS = np.array([0.2, 0.8]), np.array([64, 256, 1024])
DIMS = ("hurst", "points", "sample", "load")


@pytest.fixture
def averaged():
    shape = (2, 3, 4, 12)
    draw = np.random.default_rng(3)
    stiffness = FORCE ** (1 / (1 + HURST))[:, None, None, None] * draw.lognormal(0, 0.1, (*shape[:3], 1))
    dataset = xarray.Dataset(
        {
            "dimensionless_force": ("load", FORCE),
            "dimensionless_stiffness": (DIMS, stiffness, {"units": "1"}),
            "resolved": (DIMS, np.broadcast_to(FORCE > 1e-3, shape)),
            "rms": (DIMS[:3], draw.lognormal(0, 0.1, shape[:3]), {"units": "m"}),
            "pulled": ((*DIMS[:3], "pull"), draw.lognormal(0, 0.1, (*shape[:3], 5)), {"units": "m"}),
            "case_status": (DIMS[:3], np.full(shape[:3], "done")),
        },
        {"hurst": HURST, "points": POINTS, "sample": np.arange(4)},
    )
    return averages(dataset, force_window(1e-3, 0.07), rng=np.random.default_rng(1))


def means_drawn(axes):
    """Return the full lines: the means where they are resolved."""
    return [line for line in axes.lines if line.get_linestyle() == "-"]


def marks(axes):
    """Return of each series its colour, its places and its values with their limits."""
    found = []
    for container in axes.containers:
        x, y = container.lines[0].get_data()
        [segments] = [bars.get_segments() for bars in container.lines[2]]
        limits = np.array([[each[0][1], each[1][1]] for each in segments])
        found.append((to_hex(container.lines[0].get_color()), np.asarray(x), np.asarray(y), limits))
    return found


def test_means_laws_and_exponents_are_drawn(averaged):
    left, right = study_figure(averaged, "dimensionless_stiffness").axes
    expected = averaged["dimensionless_stiffness_mean"].to_numpy().reshape(6, 12)
    lines = means_drawn(left)
    assert len(lines) == 6
    for line, values in zip(lines, expected, strict=True):
        np.testing.assert_array_equal(line.get_xdata(), FORCE[FORCE > 1e-3])
        np.testing.assert_array_equal(line.get_ydata(), values[FORCE > 1e-3])
    errors = averaged["dimensionless_stiffness_standard_error"].to_numpy().reshape(6, 12)
    bands = [each for each in left.collections if isinstance(each, PolyCollection)]
    for band, values, error in zip(bands, expected, errors, strict=True):
        corners = band.get_paths()[0].vertices
        ends = [(np.min(y), np.max(y)) for y in (corners[corners[:, 0] == force, 1] for force in FORCE)]
        np.testing.assert_allclose(ends, np.stack([values - error, values + error], 1), rtol=1e-12)
    assert (left.get_xlabel(), left.get_ylabel()) == ("force / (E* L h)", "stiffness / (E* L)")
    assert left.get_legend().get_title().get_text() == "hurst, points"
    assert [text.get_text() for text in left.get_legend().get_texts()][:2] == ["0.2, 64", "0.2, 256"]
    laws = [line for line in left.lines if line.get_linestyle() == "--"]
    names = ("exponent", "prefactor", "window_low", "window_high")
    for law, alpha, zeta, low, high in zip(
        laws, *(averaged[name].values.flat for name in names), strict=True
    ):
        np.testing.assert_array_equal(law.get_xdata(), (low, high))
        np.testing.assert_allclose(law.get_ydata(), zeta * law.get_xdata() ** alpha, rtol=1e-14)

    # There are three numbers of points and two Hurst exponents: the former stand on the axis, by their logarithm.
    assert (right.get_xlabel(), right.get_xscale()) == ("points", "log")
    assert [text.get_text() for text in right.get_legend().get_texts()] == ["0.2", "0.8"]
    assert right.get_legend().get_title().get_text() == "hurst"
    for i, (_, x, y, limits) in enumerate(marks(right)):
        np.testing.assert_array_equal(x, POINTS)
        np.testing.assert_array_equal(y, averaged["exponent"][i])
        ends = np.transpose([averaged["exponent_low"][i], averaged["exponent_high"][i]])
        np.testing.assert_allclose(limits, ends, rtol=1e-14)
    assert right.get_title() == "95 % intervals"


def test_the_parameter_on_the_axis_can_be_chosen(averaged):
    _, right = study_figure(averaged, "dimensionless_stiffness", "hurst").axes
    series = marks(right)
    assert len({colour for colour, *_ in series}) == 3
    for i, (_, x, y, _) in enumerate(series):
        np.testing.assert_array_equal(y, averaged["exponent"][:, i])
        # Marks of the three series stand beside each other: on the value, and as far to its left as to its right.
        np.testing.assert_allclose(x - HURST, 0.006 * (i - 1) * np.ptp(HURST), atol=1e-15)


def test_a_number_without_loads_stands_against_what_varies(averaged):
    [axes] = study_figure(averaged, "rms").axes
    for i, (_, x, y, limits) in enumerate(marks(axes)):
        mean, error = averaged["rms_mean"][i], averaged["rms_standard_error"][i]
        np.testing.assert_array_equal(x, POINTS)
        np.testing.assert_array_equal(y, mean)
        np.testing.assert_allclose(limits, np.transpose([mean - error, mean + error]), rtol=1e-14)
    assert axes.get_ylabel() == "rms height [m]"
    assert axes.get_title() == "means and their standard errors"


@pytest.mark.parametrize("count", [0, 1, 2])
def test_marks_at_a_load_that_is_not_resolved_are_hollow(count):
    """The load is resolved in `count` of three samples at H = 0.2, and in all at 0.8: half of them make a mark full."""
    dims = ("hurst", "sample")
    resolved = np.array([np.arange(3) < count, np.ones(3, dtype=bool)])
    values = np.random.default_rng(2).lognormal(0, 0.1, (2, 3))
    dataset = xarray.Dataset(
        {
            "stiffness": (dims, values),
            "resolved": (dims, resolved),
            "case_status": (dims, np.full((2, 3), "done")),
        },
        {"hurst": HURST},
    )
    found = averages(dataset, rng=1)
    assert found["resolved_samples"].to_numpy().tolist() == [count, 3]
    [axes] = study_figure(found, "stiffness", at="1 MPa").axes
    hollow = [line for line in axes.lines if line.get_markerfacecolor() == "white"]
    if count < 2:
        [line] = hollow
        np.testing.assert_array_equal(line.get_xydata(), [[HURST[0], values[0].mean()]])
        assert [text.get_text() for text in axes.get_legend().get_texts()] == ["not resolved"]
    else:
        assert not hollow
        assert axes.get_legend() is None
    [(_, x, y, _)] = marks(axes)
    np.testing.assert_array_equal(x, HURST)
    np.testing.assert_array_equal(y, values.mean(axis=1))


def test_curves_are_dotted_where_no_sample_is_resolved(averaged):
    """Also where all samples agree, which an export states once."""
    none = averaged.assign(resolved_samples=0 * averaged["resolved_samples"])
    axes = study_figure(none, "dimensionless_stiffness").axes[0]
    assert [line for line in means_drawn(axes) if len(line.get_xdata())] == []
    assert len([line for line in axes.lines if line.get_linestyle() == ":"]) == 6


def test_axes_name_the_units_of_the_study(averaged):
    """Newtons and metres of a study without numbers free of dimension, against lengths in micrometres."""
    renamed = averaged.rename(
        {
            "dimensionless_force": "force",
            "dimensionless_stiffness_mean": "depth_mean",
            "dimensionless_stiffness_standard_error": "depth_standard_error",
            "points": "long_cutoff",
        }
    )
    renamed = renamed.assign_coords(long_cutoff=1e-7 * POINTS)
    for name, unit in (("force", "N"), ("depth_mean", "m"), ("long_cutoff", "m")):
        renamed[name].attrs["units"] = unit
    [axes] = study_figure(renamed, "depth").axes
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("force [mN]", "depth [mm]")
    [line, *_] = means_drawn(axes)
    np.testing.assert_array_equal(line.get_xdata(), 1e3 * FORCE[FORCE > 1e-3])
    np.testing.assert_array_equal(line.get_ydata(), 1e3 * renamed["depth_mean"][0, 0][FORCE > 1e-3])
    [axes] = study_figure(renamed, "rms", "long_cutoff").axes
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("long cutoff [µm]", "rms height [m]")
    np.testing.assert_allclose(marks(axes)[0][1], 0.1 * POINTS, rtol=1e-14)


def test_a_stiffness_per_area_is_drawn_in_the_unit_of_the_table(averaged):
    """1 Pa/m is 1e-12 N/µm/mm²; the title states the load."""
    words = ("mean", "standard_error")
    names = {f"rms_{word}": f"interfacial_stiffness_per_area_{word}" for word in words}
    areal = averaged.drop_vars(list(names.values()), errors="ignore").rename(names)
    for name in names.values():
        areal[name] = (1e13 * areal[name]).assign_attrs(units="Pa m-1")
    [axes] = study_figure(areal, "interfacial_stiffness_per_area", "hurst", at="1 MPa").axes
    assert axes.get_ylabel().endswith("[N/µm/mm²]")
    assert axes.get_title() == "means and their standard errors, at 1 MPa"
    for i, (_, _, y, limits) in enumerate(marks(axes)):
        np.testing.assert_allclose(y, 1e-12 * areal[f"{names['rms_mean']}"][:, i], rtol=1e-14)
        error = areal[names["rms_standard_error"]][:, i]
        np.testing.assert_allclose(np.diff(limits)[:, 0], 2e-12 * error, rtol=1e-12)


@pytest.mark.parametrize(("factor", "axis"), [(1.0, "hurst"), (1.05, "points")])
def test_a_parameter_that_does_not_change_the_curves_is_not_the_default(averaged, factor, axis):
    """Points have more values: they are the default unless all their curves coincide."""
    mean = averaged["dimensionless_stiffness_mean"]
    same = mean.isel(points=0, drop=True) * xarray.DataArray([1.0, factor, 1.0], dims="points")
    scaled = averaged.assign(dimensionless_stiffness_mean=same.transpose(*mean.dims))
    assert study_figure(scaled, "dimensionless_stiffness").axes[-1].get_xlabel().startswith(axis[:4])


def test_a_study_is_drawn_against_force_without_dimension_where_it_has_both(averaged):
    both = averaged.assign(force=("load", 1e3 * FORCE, {"units": "N"}))
    axes = study_figure(both, "dimensionless_stiffness").axes[0]
    assert axes.get_xlabel() == "force / (E* L h)"
    np.testing.assert_array_equal(means_drawn(axes)[0].get_xdata(), FORCE[FORCE > 1e-3])


def test_of_one_combination_there_is_one_curve(averaged):
    one = averaged.isel(hurst=0, points=0, drop=True)
    [axes] = study_figure(one, "dimensionless_stiffness").axes
    assert len(means_drawn(axes)) == 1
    assert axes.get_legend() is None
    with pytest.raises(ValueError, match="'rms' is one number, and nothing varies"):
        study_figure(one, "rms")


def test_more_lines_than_a_legend_holds_stand_in_panels(averaged):
    """Of 9 combinations each panel shows those of one rms height, which its title states in micrometres."""
    more = xarray.concat([averaged, averaged.isel(hurst=0)], "hurst", data_vars="minimal").assign_coords(
        hurst=[0.2, 0.8, 1.2]
    )
    more = more.rename(points="height").assign_coords(height=("height", [1e-6, 2e-6, 5e-7], {"units": "m"}))
    *panels, last = study_figure(more, "dimensionless_stiffness", "hurst").axes
    assert [axes.get_title() for axes in panels] == ["height = 1 µm", "height = 2 µm", "height = 0.5 µm"]
    for j, axes in enumerate(panels):
        for i, line in enumerate(means_drawn(axes)):
            expected = more["dimensionless_stiffness_mean"][i, j].to_numpy()
            np.testing.assert_array_equal(line.get_ydata(), expected[FORCE > 1e-3])
        assert len([line for line in axes.lines if line.get_linestyle() == "--"]) == 3
    assert len({axes.get_ylim() for axes in panels}) == 1
    assert len({axes.get_xlim() for axes in panels}) == 1
    assert not any(text.get_text() for axes in panels for text in axes.get_xticklabels(minor=True))
    assert [axes.get_legend() is None for axes in panels] == [False, True, True]
    assert [text.get_text() for text in panels[0].get_legend().get_texts()] == ["0.2", "0.8", "1.2"]
    assert last.get_legend().get_title().get_text() == "height [µm]"
    assert [text.get_text() for text in last.get_legend().get_texts()] == ["1", "2", "0.5"]


def test_rows_are_groups_with_all_their_parameters(averaged):
    rows = averaged.isel(points=0, drop=True).rename(hurst="row")
    rows = rows.assign_coords(row=[0, 1], hurst=("row", HURST), label=("row", ["a", "b"]))
    left, right = study_figure(rows, "dimensionless_stiffness").axes
    assert [text.get_text() for text in left.get_legend().get_texts()] == ["0.2, a", "0.8, b"]
    np.testing.assert_array_equal(
        [y for _, _, y, _ in marks(right)], rows["exponent"].to_numpy()[:, np.newaxis]
    )


def test_what_cannot_be_drawn_is_refused(averaged):
    with pytest.raises(
        ValueError, match="no 'stifness' differs between samples: choose from dimensionless_stiff"
    ):
        study_figure(averaged, "stifness")
    with pytest.raises(ValueError, match="'sample' is not a number that varies: choose from hurst, points"):
        study_figure(averaged, "rms", "sample")
    with pytest.raises(ValueError, match="'pulled' lies along pull: choose one along the loads, or none"):
        study_figure(averaged, "pulled")
