"""Figure 21: from the power law to saturation."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from roughcontact.study.study import Study
from roughcontact_thesis import fig21_stiffness_of_surfaces as fig21
from roughcontact_thesis.ensembles import full_contact_study
from roughcontact_thesis.figures import drawn, verdicts
from thesis.computed import exported
from thesis.synthetic import curves

HURST = np.array([0.0, 0.5, 1.0])


@pytest.fixture(scope="module")
def data():
    force = np.geomspace(1e-4, 300, 60)
    return fig21.averages(curves(1 / (HURST + 1), 1.0, HURST, points=1025, force=force, scatter=0.0))


def test_the_plateau_and_the_power_law_are_read(data):
    plateau, law, shape = verdicts(fig21, data)
    assert plateau.found.startswith("1.1500")
    assert plateau.word == "holds"
    assert law.word == "holds"
    assert shape.word == "not decided"
    assert "1.00 (H = 0)" in law.found
    # A curve that bends by a tenth is no power law.
    bent = data.assign(stiffness=data["stiffness"] * (1 + 0.1 * np.sin(np.log(data["force"]))))
    assert verdicts(fig21, bent)[1].word == "does not hold"


def test_it_is_drawn(data):
    FigureCanvasAgg(drawn(fig21, data)).draw()


def test_full_contact_is_reached_on_few_cells():
    study = full_contact_study("small")
    parameters = study.parameters | {"points": 17, "loads": 4}
    few = Study(name="few", case="curve", samples=2, parameters=parameters, table={"hurst": (0.0, 1.0)})
    found = fig21.averages(exported(few))
    # Of 16 cells a side 1.128631, of 32 1.140213: in full contact all surfaces are one square.
    last = found["stiffness"].isel(load=-1)
    assert ((last > 1.1286) & (last < 1.1402)).all()
    assert np.isnan(found["exponent"]).all()  # too few cells for a power law
    assert verdicts(fig21, found)[1].word == "not decided"
