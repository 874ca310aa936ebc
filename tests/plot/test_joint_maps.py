"""The picture of a joint: pressure and stiffness per area where they are, in their units."""

import numpy as np
import pytest

import roughcontact as rc
from made_laws import power_law


@pytest.mark.parametrize(
    ("size", "scales", "units"),
    [(1e-3, (1e-6, 1e-12), ("MPa", "N/µm/mm²", "mm")), (1.0, (1e-3, 1e-12), ("kPa", "N/µm/mm²", "m"))],
)
def test_both_maps_are_those_of_the_joint(size, scales, units):
    p = np.outer([1.0, 2.0, 3.0], [1.0, 0.0, 2.0, 4.0, 1.0]) * (1e6 if size < 1 else 1e3)
    p[0, 0] = np.nan
    law = power_law(0.9, scale=1e6, low=1e2, high=1e8)
    joint = rc.joint(law, rc.PressureField(p, (2 * size, size)))
    figure = rc.plot.joint_figure(joint)
    assert len(figure.axes) == 2
    for axes, values, scale, unit in zip(
        figure.axes, (p, joint.stiffness_per_area), scales, units[:2], strict=True
    ):
        [image] = axes.images
        shown = np.ma.filled(image.get_array().astype(float), np.nan)
        np.testing.assert_allclose(shown, values * scale, rtol=1e-12)
        assert image.get_extent() == [0.0, 5.0, 6.0, 0.0]
        assert image.get_clim() == pytest.approx((0.0, np.nanmax(values) * scale))
        assert f"[{unit}]" in image.colorbar.ax.get_ylabel()
        assert axes.get_xlabel() == f"x [{units[2]}]"
        [mark] = axes.lines
        assert mark.get_xydata()[0] == pytest.approx(np.array(joint.centre) / size)


def test_wide_faces_are_drawn_one_above_the_other():
    law = power_law(0.9, low=1e-2, high=1e2)
    wide = rc.plot.joint_figure(rc.joint(law, rc.PressureField(np.ones((2, 8)), 1.0)))
    first, second = (axes.get_position() for axes in wide.axes)
    assert first.x0 == pytest.approx(second.x0)
    square = rc.plot.joint_figure(rc.joint(law, rc.PressureField(np.ones((4, 4)), 1.0)))
    first, second = (axes.get_position() for axes in square.axes)
    assert first.y0 == pytest.approx(second.y0)
