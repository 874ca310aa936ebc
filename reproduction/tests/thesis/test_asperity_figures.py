"""Figures 31 to 33: asperities with and without interaction."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

import roughcontact as rc
from roughcontact.study.study import Study
from roughcontact.theory.asperity_models import greenwood_williamson
from roughcontact_thesis import (
    fig31_asperities_smooth as fig31,
    fig32_asperities_rough as fig32,
    fig33_asperity_exponents as fig33,
)
from roughcontact_thesis.asperity_ensembles import (
    HURST,
    asperity_averages,
    greenwood_williamson_stiffness,
    law_exponent,
    studies,
)
from roughcontact_thesis.figures import drawn, verdicts
from thesis.computed import exported


@pytest.fixture(scope="module")
def asperities():
    [study] = studies("small")
    parameters = study.parameters | {"loads": 13}
    return exported(Study(**(dict(study) | {"samples": 3, "parameters": parameters})))


def test_the_study_is_that_of_the_thesis():
    [study] = studies("thesis")
    assert study.samples == 25
    assert {fig31.HURST, fig32.HURST, *fig33.HURST} == set(HURST)
    assert law_exponent(fig31.HURST) == pytest.approx(0.5128, abs=5e-5)
    assert law_exponent(fig32.HURST) == pytest.approx(0.9524, abs=5e-5)


def test_the_classical_curve_is_that_of_the_moments_of_a_surface():
    # Exact amplitudes: every surface has the same moments.
    surface = rc.self_affine(rc.Grid((128, 128), 1 / 128, periodic=True), 0.5, 1.0, np.random.default_rng(0))
    force = np.array([1e-3, 1e-2, 1e-1])
    law = greenwood_williamson.law(rc.surface_moments(surface, derivative="spectral"), 1.0, 1.0)
    expected = law.quantities["interfacial_stiffness"](force)
    np.testing.assert_allclose(greenwood_williamson_stiffness(force, 0.5, 128), expected, rtol=1e-9)


def test_averages_hold_every_realisation_and_fit_in_their_window(asperities):
    found = asperity_averages(asperities)
    one = found.sel(hurst=0.5)
    np.testing.assert_array_equal(one["stiffness"], asperities["dimensionless_stiffness"].sel(hurst=0.5))
    force, spots = found["force"].to_numpy(), one["spots"].to_numpy()
    low = force[spots >= 10][0]
    assert float(one["window_low"]) == low
    inside = (force >= low) & (force <= 0.07)
    for name, exponent in (("stiffness", "exponent"), ("independent", "independent_exponent")):
        means = np.log(one[name].mean("sample")[inside])
        assert float(one[exponent]) == pytest.approx(np.polyfit(np.log(force[inside]), means, 1)[0], rel=1e-9)
    # Interaction makes the law less steep, and the more so the larger H is.
    assert (found["exponent"] < found["independent_exponent"]).all()
    assert float(found["exponent"][0]) > float(found["exponent"][-1]) + 0.1
    assert (found["classical_exponent"] > 0.9).all()


@pytest.mark.parametrize("module", [fig31, fig32])
def test_figures_31_and_32_show_all_realisations(module, asperities):
    data = module.averages(asperities)
    assert data["stiffness"].sizes == {"sample": 3, "load": 13}
    assert float(data["hurst"]) == module.HURST
    slope, *others = verdicts(module, data)
    (linear,) = (each for each in others if "original model" in each.claim)
    assert f"the law {law_exponent(module.HURST):.3f}" in slope.found
    assert linear.word == "holds"
    picture = drawn(module, data)
    FigureCanvasAgg(picture).draw()
    spots = [line for line in picture.axes[0].lines if line.get_marker() == "." and len(line.get_xdata())]
    np.testing.assert_array_equal([line.get_ydata() for line in spots], data["stiffness"])


def test_figure_33_compares_five_dimensions(asperities):
    data = fig33.averages(asperities)
    assert "sample" not in data.dims
    interacting, less_linear, alone = verdicts(fig33, data)
    assert "D_f = 2.9, 2.7, 2.5, 2.3, 2.1" in interacting.found
    assert less_linear.word != "does not hold"
    assert alone.kind == "theory"
    FigureCanvasAgg(drawn(fig33, data)).draw()
