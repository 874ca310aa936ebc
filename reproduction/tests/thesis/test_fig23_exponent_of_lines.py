"""Figure 23: exponents of rough lines."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from roughcontact.study.study import Study
from roughcontact_thesis import fig23_exponent_of_lines as fig23
from roughcontact_thesis.figures import drawn, verdicts
from roughcontact_thesis.line_ensembles import HURST
from thesis.computed import exported


@pytest.fixture(scope="module")
def data():
    table = {"points": fig23.POINTS, "hurst": HURST}
    study = Study(name="few", case="lines", samples=2, parameters={"lines": 240}, table=table)
    return fig23.averages(exported(study))


def test_exponents_are_those_of_the_reference_runs(data):
    # Of 2^13 points, by another program; of 2^11 the window is another where the law is no power law: H >= 0.6 only.
    reference = {0.55: 0.62, 0.7: 0.575, 1.0: 0.493, 1.45: 0.414, 1.9: 0.366, 2.5: 0.338, 2.95: 0.335}
    for hurst, alpha in reference.items():
        one = data.sel(points=2048, hurst=hurst, method="nearest")
        assert float(one["exponent"]) == pytest.approx(alpha, abs=0.015 + 3 * float(one["exponent_error"]))
    # H = -1 and -1/2 at these numbers of points.
    for points, alpha in ((512, 0.828), (2048, 0.860)):
        low = data.sel(points=points, hurst=slice(None, -0.3))["exponent"].mean()
        assert float(low) == pytest.approx(alpha, abs=0.015)


def test_verdicts_say_what_grows_with_the_number_of_points(data):
    constant, modes, law, ends, hertz = verdicts(fig23, data)
    assert [each.word for each in (law, ends, hertz)] == ["holds"] * 3
    assert constant.word != "does not hold"
    # Fits grow with the number of points, the stiffness at given forces does not.
    assert modes.ruling.word != "holds"


def test_the_picture_has_both_resolutions(data):
    picture = drawn(fig23, data)
    FigureCanvasAgg(picture).draw()
    curves = [line for line in picture.axes[0].lines if len(line.get_xdata()) == data.sizes["hurst"]]
    np.testing.assert_array_equal([line.get_ydata() for line in curves], data["exponent"])
