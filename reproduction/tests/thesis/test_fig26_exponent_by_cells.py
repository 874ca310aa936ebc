"""Figure 26: exponents at low H on several grids."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from roughcontact_thesis import fig26_exponent_by_cells as fig26
from roughcontact_thesis.figures import drawn, verdicts
from thesis.synthetic import curves

HURST = np.array([-1.0, -0.5, 0.0, 0.2])
FORCE = np.geomspace(1e-3, 0.07, 40)


def data(exponents=(0.8, 0.8, 0.8)):
    sizes = zip((257, 513, 1025), exponents, strict=True)
    return fig26.averages(
        *(curves(alpha, 1.7, HURST, points=points, force=FORCE, scatter=0.02) for points, alpha in sizes)
    )


def test_one_power_law_has_one_exponent_in_all_windows():
    found = data()
    np.testing.assert_allclose(found["exponent"], 0.8, rtol=1e-10)
    np.testing.assert_allclose(found["common_exponent"], 0.8, rtol=1e-10)
    np.testing.assert_allclose(found["stiffness"], 1.7 * 0.07**0.8, rtol=1e-10)
    # The window of each grid begins where 20 cells carry, the common one where it is told to.
    limits = (20 * 0.8911 / np.array([257, 513, 1025]) / 1.7) ** (1 / 0.8)
    step = FORCE[1] / FORCE[0]
    low = found["window_low"].to_numpy()[:, 0]
    assert ((low >= limits) & (low < limits * step) | (low == 1e-3)).all()
    assert ((found["common_window_low"] >= 0.025) & (found["common_window_low"] < 0.025 * step)).all()
    depends, modes, constant = verdicts(fig26, found)
    assert (depends.word, modes.word, constant.word) == ("does not hold", "does not hold", "holds")


def test_exponents_that_differ_are_told():
    depends, modes, _ = verdicts(fig26, data((0.75, 0.8, 0.85)))
    assert depends.word == "holds"
    assert modes.word == "holds"
    assert "10 of 257²" in depends.found


def test_windows_that_grow_on_a_bent_curve_are_no_dependence_on_the_grid():
    # One curve for all grids, steeper at lower forces: 0.9 below 0.02, 0.75 above.
    def bent(points):
        one = curves(0.75, 1.7, HURST, points=points, force=FORCE, scatter=0.02)
        steeper = np.minimum(FORCE / 0.02, 1) ** 0.15
        return one.assign({name: one[name] * steeper for name in ("stiffness", "dimensionless_stiffness")})

    depends, modes, _ = verdicts(fig26, fig26.averages(*map(bent, (257, 1025))))
    assert depends.word == "holds"
    assert modes.word == "does not hold"


def test_it_is_drawn():
    FigureCanvasAgg(drawn(fig26, data())).draw()


@pytest.mark.parametrize("scale", ["small", "thesis"])
def test_all_hurst_exponents_are_low(scale):
    for study in fig26.studies(scale):
        assert max(each.hurst for each in study.combinations()) <= 0.2
