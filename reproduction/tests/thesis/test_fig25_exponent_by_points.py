"""Figure 25: exponents at a low Hurst exponent."""

import numpy as np
import pytest
import xarray
from matplotlib.backends.backend_agg import FigureCanvasAgg

from roughcontact_thesis import fig25_exponent_by_points as fig25
from roughcontact_thesis.figures import drawn, verdicts
from thesis.computed import exported

POINTS = [2**8, 2**10, 2**12]


def surfaces(points, exponent, rng):
    """Return what a study of surfaces exports, of a law that is known."""
    force = np.geomspace(1e-3, 0.07, 40)
    scatter = 1 + 0.1 * rng.standard_normal((20, 1))
    curves = 1.5 * force**exponent * scatter / scatter.mean()
    return xarray.Dataset(
        {
            "dimensionless_force": ("load", force),
            "dimensionless_stiffness": (("hurst", "sample", "load"), [curves] * 2),
            "stiffness": (("hurst", "sample", "load"), [3e5 * curves] * 2),
            "cell_stiffness": 3e5 * 0.0007,
            "full_contact_stiffness": 3e5 * 1.15,
        },
        {"hurst": [-0.5, 0.2], "points": points},
    )


@pytest.fixture(scope="module")
def data():
    lines, *_ = fig25.studies("small")
    few = lines.model_copy(update={"table": {"points": tuple(POINTS)}})
    rng = np.random.default_rng(0)
    return fig25.averages(exported(few), surfaces(257, 0.7, rng), surfaces(513, 0.75, rng))


def test_the_study_of_lines_is_that_of_the_thesis():
    lines, *others = fig25.studies("thesis")
    assert lines.samples * lines.parameters["lines"] == 1000
    assert others  # of surfaces


def test_exponents_of_surfaces_are_fitted_as_they_are(data):
    np.testing.assert_array_equal(data["cells"], [257, 513])
    np.testing.assert_allclose(data["surface_exponent"], [0.7, 0.75], rtol=1e-9)


def test_exponents_of_lines_grow_as_the_windows_do(data):
    assert (np.diff(data["exponent"]) > 0).all()
    assert (np.diff(data["window_low"]) < 0).all()
    # The same of independent heights; lines lie below by what twenty springs are off their mean.
    away = (data["white"] - data["exponent"]).to_numpy()
    assert (np.abs(away) < 0.03 + 3 * data["exponent_error"]).all()
    law, surface = verdicts(fig25, data)
    assert law.word != "does not hold"
    assert surface.word == "does not hold"
    FigureCanvasAgg(drawn(fig25, data)).draw()
