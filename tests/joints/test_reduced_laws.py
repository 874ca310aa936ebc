"""Reduced models at one pressure: Jenkins elements on the backbone, Iwan's distribution, and their misfit."""

import math

import numpy as np
import pint
import pytest

import roughcontact as rc
from made_laws import exponential, hertz, power
from roughcontact.errors import InputError

MU = 0.3
# Of a sphere with 64 elements from a hundredth of the gross slip on: amplitude over gross slip, error of the loss in %.
SPHERE = [(0.01, -100.0), (0.03, -3.8), (0.05, -0.9), (0.3, 0.25), (0.8, -0.1)]


def test_a_sphere():
    """A span h of nearly even distribution takes h^3/s^3 off the loss at its end: -3.8 % at the third row."""
    law = hertz()
    top = float(law.gross_slip(1.0))
    elements = law.elements(1.0, count=64)
    for part, error in SPHERE:
        relative = elements.loss(part * top) / law.loss(1.0, displacement=part * top) - 1
        assert 100 * relative == pytest.approx(error, abs=0.05)
    coarse = law.elements(1.0, count=16)
    assert 100 * (coarse.loss(0.8 * top) / law.loss(1.0, displacement=0.8 * top) - 1) == pytest.approx(
        8.7, abs=0.05
    )


@pytest.mark.parametrize("law", [hertz(), power(0.9), exponential()])
@pytest.mark.parametrize("pressure", [1.0, 0.4])
def test_elements_meet_the_backbone_at_their_slips(law, pressure):
    """Up to gross slip, or to the lowest load of the law, where the elements stay."""
    elements = law.elements(pressure, count=12, first=0.02)
    s = elements.slip
    assert s[0] / s[-1] == pytest.approx(0.02, rel=1e-12)
    np.testing.assert_allclose(np.diff(np.log(s)), math.log(50) / 11, rtol=1e-9)
    np.testing.assert_allclose(elements.traction(s), law.traction(s, pressure), rtol=1e-12)
    assert (elements.stiffness > 0).all()
    most = MU * (pressure - law.normal.lowest)
    assert elements.traction(10 * s[-1]) == pytest.approx(most, rel=1e-12)
    assert elements.traction(-0.3 * s[-1]) == -elements.traction(0.3 * s[-1])
    # The chord lies under the backbone.
    between = np.sqrt(s[1:] * s[:-1])
    assert (elements.traction(between) < law.traction(between, pressure)).all()


def test_the_last_slip_may_lie_beyond_the_law_by_rounding():
    """At a pressure of 0.25, rounding puts the gap of the last slip beyond the gap of the lowest load."""
    elements = exponential().elements(0.25, count=8, first=0.5)
    assert max(elements.misfit.values()) < 0.3


def test_the_loss_of_elements_is_the_area_of_their_loop():
    """Each is an elastic and ideally plastic spring: a parallelogram. At the slips, the corners are all met."""
    elements = hertz().elements(1.0, count=8)
    amplitude = float(elements.slip[5])
    half = np.concatenate([[0.0], 2 * elements.slip[:6]])  # displacement since the reversal
    s, q = amplitude - half, elements.traction(amplitude) - 2 * elements.traction(half / 2)
    area = 2 * ((q[1:] + q[:-1]) / 2 @ np.diff(s))
    assert elements.loss(amplitude) == pytest.approx(abs(area), rel=1e-12)
    assert elements.loss([0.0, elements.slip[0]]).tolist() == [0, 0]


def test_the_misfit_is_the_largest_difference_between_the_slips_too():
    law = power(0.9)
    for count in (8, 32):
        elements, top = law.elements(0.5, count=count), float(law.gross_slip(0.5))
        s = np.geomspace(0.05 * top, top, 103)  # five to an element at least
        traction = abs(elements.traction(s) / law.traction(s, 0.5) - 1).max()
        loss = abs(elements.loss(s) / [law.loss(0.5, displacement=each) for each in s] - 1).max()
        assert 0.7 * elements.misfit["traction"] < traction < 1.1 * elements.misfit["traction"]
        assert 0.7 * elements.misfit["loss"] < loss < 1.1 * elements.misfit["loss"]
    # At another pressure they are wrong by more than their misfit.
    wrong = elements.traction(0.1 * top) / law.traction(0.1 * top, 1.0) - 1
    assert abs(wrong) > 10 * elements.misfit["traction"]


def test_elements_of_a_computed_surface():
    """The stiffness of a computed law rises with the pressure, so that no element is negative; the loss of small
    amplitudes is compared, too, which the law itself does not give for single cells."""
    grid = rc.Grid((32, 32), 1e-6, periodic=True)
    surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=4, rolloff=2e-5, short_cutoff=5e-6)
    bodies = (rc.Solid(2e9, 0.0), rc.Solid(2e9, 0.0))
    curve = rc.loading_curve(surface, bodies, pressures=np.geomspace(1e4, 5e6, 14))
    law = rc.shear_law(curve, bodies, friction=MU)
    elements = law.elements(3e6, count=32)
    assert (elements.stiffness >= 0).all()
    assert elements.stiffness @ elements.slip == pytest.approx(MU * 3e6, rel=1e-12)
    assert elements.misfit["traction"] < 0.01
    assert repr(elements).startswith("JenkinsElements(32, only at 3e+06 Pa, slips ")
    assert any("belong to the nominal pressure 3e+06 Pa only" in note for note in elements.notes)
    assert any(f"{elements.slip[0]:.3g} m nothing is dissipated" in note for note in elements.notes)


@pytest.mark.parametrize("law", [power(0.6), power(0.9)])
def test_iwans_distribution_of_a_power_law(law):
    """Its integral is the stiffness, its first moment mu p: quadrature by midpoints after y = s_max (1 - (1 - x)^2)."""
    p, top = 0.7, float(law.gross_slip(0.7))
    x = (np.arange(20000) + 0.5) / 20000
    y, weight = top * (1 - (1 - x) ** 2), 2 * top * (1 - x) / 20000
    phi = law.iwan(p, y)
    assert phi @ weight == pytest.approx(float(law.stiffness(p)), rel=1e-5)
    assert (phi * y) @ weight == pytest.approx(MU * p, rel=1e-5)
    s = 0.4 * top
    assert (phi * np.minimum(y, s)) @ weight == pytest.approx(float(law.traction(s, p)), rel=1e-5)
    assert law.iwan(p, [1.1 * top, 5 * top]).tolist() == [0, 0]


def test_iwans_distribution_of_an_exponential_law():
    """``phi = p/(mu C^2) exp(-y/(mu C))`` for g0 = 1; the stiffness is good to 1e-9, its exponent over 4 % to 1e-7."""
    bodies = (rc.Solid(2 * (1 - 0.09), 0.3),) * 2
    law, y = exponential(bodies=bodies), np.array([0.0, 0.1, 0.5])
    expected = 0.5 / (MU * law.ratio**2) * np.exp(-y / (MU * law.ratio))
    np.testing.assert_allclose(law.iwan(0.5, y), expected, rtol=1e-6)
    with pytest.raises(InputError, match="lies below the lowest load"):
        law.iwan(0.5, 5.0)


def test_numbers_with_units():
    U = pint.get_application_registry()
    law = power(0.9)
    elements = law.elements(500 * U.mPa, count=4)
    assert elements.pressure == pytest.approx(0.5)
    assert elements.traction(100 * U.mm) == elements.traction(0.1)
    assert elements.loss(100 * U.mm) == elements.loss(0.1)
    assert law.iwan(0.5 * U.Pa, 10 * U.cm) == law.iwan(0.5, 0.1)
    assert elements.traction(np.ones((2, 3))).shape == (2, 3) == elements.loss(np.ones((2, 3))).shape
    with pytest.raises(InputError, match="m"):
        elements.traction(1 * U.Pa)


def test_what_is_refused():
    law = power(0.9)
    p = np.array([1.0, 2.0])
    stepped = rc.ShearLaw(rc.NormalLaw(p, -p, p, math.nan, p, 1.0, 1.0, math.inf, {}), MU, 1.0, law.bodies)
    for wrong, message in (
        (lambda: law.elements(0.5, count=1), "at least two elements"),
        (lambda: law.elements(0.5, count=0), "count"),
        (lambda: law.elements(0.5, first=0.0), "`first` is a fraction of the last slip .*0.01"),
        (lambda: law.elements(0.5, first=1.0), "`first` is a fraction of the last slip"),
        (lambda: law.elements(2.0), "the law holds from 0 to 1 Pa"),
        (lambda: law.elements(0.0), "pressure must be positive and finite"),
        (lambda: exponential().elements(1e-3), r"above 0\.001 Pa .* give a larger pressure"),
        (lambda: law.iwan(0.5, -1.0), "not negative"),
        (lambda: law.iwan(2.0, 0.1), "the law holds from 0 to 1 Pa"),
        (lambda: stepped.iwan(1.5, 0.1), "needs a smooth stiffness: use the law `fitted`"),
        (lambda: law.elements(0.5).loss(-0.1), "not negative"),
    ):
        with pytest.raises(InputError, match=message):
            wrong()
