"""Figure 22: rough lines from the first spring to the last."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from roughcontact_thesis import fig22_stiffness_of_lines as fig22
from roughcontact_thesis.figures import drawn, verdicts
from thesis.computed import exported


@pytest.fixture(scope="module")
def data():
    [study] = fig22.studies("small")
    return fig22.averages(exported(study.with_samples(2), seconds=True))


def test_the_study_is_that_of_the_thesis():
    [study] = fig22.studies("thesis")
    assert study.samples * study.parameters["lines"] == 1500
    assert (study.parameters["points"], study.parameters["loads"]) == (500, 400)
    assert study.table["hurst"].values(float) == tuple(np.arange(11) / 5)


def test_stiffness_rises_with_the_force_and_the_hurst_exponent(data):
    k = data["stiffness"].to_numpy()
    assert k.shape == (11, 400)
    assert (np.diff(k, axis=1) >= 0).all()
    # At a force below the crossing of all curves.
    low = int(np.searchsorted(data["force"], 1e-3))
    assert (np.diff(k[:, low]) > 0).all()


def test_verdicts_and_picture(data):
    plateaus, law = verdicts(fig22, data)
    # A hundred lines say no more of the law.
    assert [each.word for each in (plateaus, law)] == ["holds", "not decided"]
    sure = data.assign(stiffness_error=0.01 * data["stiffness_error"])
    assert [each.word for each in verdicts(fig22, sure)] == ["holds"] * 2
    bent = sure.assign(misfit=sure["misfit"] + 0.05)
    assert [each.word for each in verdicts(fig22, bent)] == ["holds", "does not hold"]
    FigureCanvasAgg(drawn(fig22, data)).draw()
