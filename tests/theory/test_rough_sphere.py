"""The rough sphere: figure 37, Sneddon's integrals of the combined profile, and both asymptotes."""

import numpy as np
import pytest
from scipy.integrate import quad

from roughcontact.theory.spheres_and_punches import hertz, power_law_indenter as indenter, rough_sphere
from roughcontact.theory.stiffness_laws import pohrt_popov

FIGURE_37 = {"radius": 0.5, "hurst": 0.7, "rms": 9e-3, "length": 1.0, "modulus": 1.0}


def test_figure_37():
    assert rough_sphere.coefficient(0.7, 9e-3, 1.0) == pytest.approx(0.0250082, abs=5e-8)
    cross = rough_sphere.crossover_force(**FIGURE_37)
    assert cross == pytest.approx(7.997403e-5, rel=1e-6)
    assert hertz.point(1.0, radius=0.5, force=cross).stiffness == pytest.approx(0.0621379, abs=5e-8)
    assert rough_sphere.stiffness(cross, **FIGURE_37) == pytest.approx(0.0458874, abs=5e-8)


def test_values_beside_which_computed_curves_were_put():
    f = 10.0 ** np.arange(-6, -1.9, 0.5)
    k = [0.0046, 0.0089, 0.0166, 0.0297, 0.0507, 0.0825, 0.1294, 0.198, 0.2983]
    np.testing.assert_allclose(rough_sphere.stiffness(f, **FIGURE_37), k, atol=5.1e-5)


@pytest.mark.parametrize("hurst", [0.3, 0.7, 1.0, 1.9])
def test_profile_gives_force_depth_and_stiffness(hurst):
    """Eqs 5.7 to 5.9 from f = r^2/(2R) + Q r^H: g(x) = int_0^(pi/2) x f'(x sin t) dt, F = 2 E* int (d - g)."""
    body = {"radius": 0.5, "hurst": hurst, "rms": 9e-3, "length": 1.0, "modulus": 3.0}
    law = rough_sphere.law(**body)
    q, a = rough_sphere.coefficient(hurst, 9e-3, 1.0), 0.05

    def springs(x):
        # x f'(x sin t) = x^2 sin(t)/R + H Q x^H sin(t)^(H-1), with v = sin t.
        power = quad(lambda v: 1 / np.sqrt(1 + v), 0, 1, weight="alg", wvar=(hurst - 1, -0.5))[0]
        return x**2 / 0.5 + hurst * q * x**hurst * power

    d = springs(a)
    force = 2 * 3 * quad(lambda x: d - springs(x), 0, a, epsrel=1e-10)[0]
    assert rough_sphere.stiffness(force, **body) == pytest.approx(2 * 3 * a, rel=1e-7)
    assert law.predict("depth", force) == pytest.approx(d, rel=1e-7)


def test_inverse_is_exact():
    k = np.geomspace(1e-9, 1.0, 40)
    for hurst in (0.05, 0.7, 2.0):
        body = FIGURE_37 | {"hurst": hurst}
        np.testing.assert_allclose(
            rough_sphere.stiffness(rough_sphere.force(k, **body), **body), k, rtol=1e-13
        )
    assert rough_sphere.stiffness(0.0, **FIGURE_37) == 0


def test_below_both_asymptotes_and_near_the_lower_one():
    f = np.geomspace(1e-12, 0.3, 60)
    k = rough_sphere.stiffness(f, **FIGURE_37)
    smooth = hertz.point(1.0, radius=0.5, force=f).stiffness
    rough = (f / 9e-3) ** (1 / 1.7)
    assert (k < np.minimum(smooth, rough)).all()
    assert k[0] == pytest.approx(rough[0], rel=1e-3)
    # Far above the crossover force the ratio tends to 1 as (F_c/F)^((2-H)/3), times a third.
    assert 1 - 0.4 * (8e-5 / 0.3) ** 0.43 < k[-1] / smooth[-1] < 1


def test_roughness_alone():
    """A very large sphere: eq. 5.3 with the Q of eq. 5.6 is the power law 5.5."""
    q = rough_sphere.coefficient(0.7, 9e-3, 2.0)
    k = indenter.contact(5.0, exponent=0.7, coefficient=q, force=1e-4).stiffness
    assert k == pytest.approx(pohrt_popov.stiffness(1e-4, 0.7, 9e-3, 2.0, 5.0), rel=1e-13)
    body = {"radius": 1e12, "hurst": 0.7, "rms": 9e-3, "length": 2.0, "modulus": 5.0}
    assert rough_sphere.stiffness(1e-4, **body) == pytest.approx(k, rel=1e-9)


@pytest.mark.parametrize("prefactor", [None, 0.8])
def test_crossover_is_where_the_asymptotes_meet(prefactor):
    body = {"radius": 0.02, "hurst": 1.2, "rms": 1e-6, "length": 1e-3, "modulus": 110e9}
    cross = rough_sphere.crossover_force(*body.values(), prefactor=prefactor)
    k = hertz.point(110e9, radius=0.02, force=cross).stiffness
    # Either term of eq. 5.9 alone takes half of the force at that stiffness.
    assert rough_sphere.force(k, **body, prefactor=prefactor) == pytest.approx(2 * cross, rel=1e-12)


def test_law():
    law = rough_sphere.law(*FIGURE_37.values())
    f = np.array([0.0, 1e-5, 1e-2])
    np.testing.assert_array_equal(law.predict("stiffness", f), rough_sphere.stiffness(f, **FIGURE_37))
    # dF/dd and U = int F dd by differences: the third derivatives are of order 1/f^2.
    step = 1e-5 * f[1:]
    d = [law.predict("depth", f[1:] + sign * step) for sign in (-1, 1)]
    np.testing.assert_allclose(2 * step / (d[1] - d[0]), law.predict("stiffness", f[1:]), rtol=1e-8)
    u = [law.predict("elastic_energy", f[1:] + sign * step) for sign in (-1, 1)]
    np.testing.assert_allclose((u[1] - u[0]) / (d[1] - d[0]), f[1:], rtol=1e-8)
    # The disc of contact is as wide as the square.
    assert rough_sphere.stiffness(law.domain[1], **FIGURE_37) == pytest.approx(1.0, rel=1e-13)


def test_refusals():
    with pytest.raises(ValueError, match="follow the same power law and never cross"):
        rough_sphere.crossover_force(0.5, 2.0, 9e-3, 1.0, 1.0)
    with pytest.raises(ValueError, match="hurst must not exceed 2"):
        rough_sphere.stiffness(1e-3, **FIGURE_37 | {"hurst": 2.5})
    with pytest.raises(ValueError, match="hurst must exceed 0"):
        rough_sphere.coefficient(0.0, 1.0, 1.0)
    with pytest.raises(ValueError, match="radius"):
        rough_sphere.law(0.0, 0.7, 1.0, 1.0, 1.0)
    with pytest.raises(ValueError, match="radius"):
        rough_sphere.force(1.0, **FIGURE_37 | {"radius": -1.0})
