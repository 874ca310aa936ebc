"""z = Q r^n against its table, Sneddon's integrals and Hertz."""

import itertools

import numpy as np
import pytest
from scipy.integrate import quad

from roughcontact.theory.spheres_and_punches import hertz, power_law_indenter as indenter

KAPPA = {
    0: 1.0,
    0.3: 1.194235876,
    0.5: 1.311028777146,
    0.7: 1.419818333,
    1: np.pi / 2,
    1.5: 1.797210352103,
    2: 2.0,
    3: 3 * np.pi / 4,
    4: 8 / 3,
}
# Force at d = 1 of z = r^n.
FORCE = {
    0.5: 0.387868304545,
    1: 0.636619772368,
    1.5: 0.811799236222,
    2: 0.942809041582,
    3: 1.127251651787,
    4: 1.252067664059,
    6: 1.412184833522,
}


@pytest.mark.parametrize("n", KAPPA)
def test_kappa(n):
    assert indenter.kappa(n) == pytest.approx(KAPPA[n], rel=1e-9)
    # int_0^(pi/2) n sin(t)^(n-1) dt: the transform x int f'(x sin t) dt of the profile x^n.
    if n > 0:
        # With v = sin t and its end-point powers as weights.
        transform = n * quad(lambda v: 1 / np.sqrt(1 + v), 0, 1, weight="alg", wvar=(n - 1, -0.5))[0]
        assert indenter.kappa(n) == pytest.approx(transform, rel=1e-8)


@pytest.mark.parametrize("n", FORCE)
def test_force_at_unit_depth(n):
    c = indenter.contact(1.0, exponent=n, coefficient=1.0, depth=1.0)
    assert c.force == pytest.approx(FORCE[n], rel=1e-12)
    # Thesis, eq. 5.3.
    law = 2 * ((n + 1) * c.force / (2 * n * indenter.kappa(n))) ** (1 / (n + 1))
    assert c.stiffness == pytest.approx(law, rel=1e-14)


def test_cone():
    # d = (pi/2) a tan, F = (2/pi) d^2/tan, p = tan/2 arccosh(a/r).
    c = indenter.contact(1.0, exponent=1, coefficient=0.1, contact_radius=2.0)
    assert c.depth == pytest.approx(np.pi / 2 * 0.2, rel=1e-14)
    assert c.force == pytest.approx(2 / np.pi * c.depth**2 / 0.1, rel=1e-14)
    r = np.array([0.01, 0.5, 1.9])
    np.testing.assert_allclose(c.pressure(r), 0.05 * np.arccosh(2 / r), rtol=1e-12)
    assert c.pressure(0.0) == np.inf


def test_fourth_power():
    c = indenter.contact(1.0, exponent=4, coefficient=1.0, contact_radius=1.0)
    assert c.force == pytest.approx(64 / 15, rel=1e-14)
    r = np.array([0.0, 0.3, 0.9, 1.0, 1.1])
    exact = 64 / (9 * np.pi) * np.sqrt(np.maximum(1 - r**2, 0)) * (r**2 + 0.5)
    np.testing.assert_allclose(c.pressure(r), exact, rtol=1e-13)


def test_square_is_hertz():
    c = indenter.contact(3.0, exponent=2, coefficient=1 / (2 * 5.0), force=0.7)
    point = hertz.point(3.0, radius=5.0, force=0.7)
    for name in ("contact_radius", "depth", "stiffness", "contact_area", "elastic_energy"):
        assert getattr(c, name) == pytest.approx(getattr(point, name), rel=1e-13)
    r = np.array([0.0, 0.3, 1.0, 20.0])
    np.testing.assert_allclose(c.pressure(r), point.pressure(r), rtol=1e-13)
    np.testing.assert_allclose(c.displacement(r), point.displacement(r), rtol=1e-12)


@pytest.mark.parametrize("n", [0.3, 0.7, 1.0, 2.5])
def test_pressure_and_displacement(n):
    c = indenter.contact(2.0, exponent=n, coefficient=0.3, contact_radius=1.5)
    total = quad(lambda r: 2 * np.pi * r * c.pressure(r), 0, 1.5, limit=200)[0]
    assert total == pytest.approx(c.force, rel=1e-6)
    # Outside: (2/pi) int_0^a (d - g(x))/sqrt(r^2 - x^2) dx, g = kappa Q x^n.
    for r in (1.6, 4.0, 500.0):
        springs = quad(
            lambda x, r=r: (1 - (x / 1.5) ** n) / np.sqrt(r**2 - x**2), 0, 1.5, epsabs=0, epsrel=1e-11
        )
        u = 2 / np.pi * c.depth * springs[0]
        assert c.displacement(r) == pytest.approx(u, rel=1e-9)
    assert c.displacement(1.5) == pytest.approx(c.displacement(1.5 * (1 + 1e-12)), rel=1e-5)
    energy = quad(lambda d: indenter.contact(2.0, exponent=n, coefficient=0.3, depth=d).force, 0, c.depth)[0]
    assert c.elastic_energy == pytest.approx(energy, rel=1e-9)


def test_any_three_independent_quantities():
    c = indenter.contact(110e9, exponent=0.7, coefficient=0.02, contact_radius=3e-4)
    names = ("modulus", "coefficient", "contact_radius", "depth", "force", "stiffness")
    values = {name: getattr(c, name) for name in names}
    dependent = [
        {"modulus", "contact_radius", "stiffness"},
        {"coefficient", "contact_radius", "depth"},
        {"depth", "force", "stiffness"},
    ]
    for known in itertools.combinations(names, 3):
        given = {name: values[name] for name in known}
        if set(known) in dependent:
            with pytest.raises(ValueError, match="depend on each other"):
                indenter.contact(exponent=0.7, **given)
        else:
            again = indenter.contact(exponent=0.7, **given)
            # A power of 1/0.7 of numbers near 1e11 and 1e-6.
            assert {name: getattr(again, name) for name in names} == pytest.approx(values, rel=1e-12)


def test_nothing_at_zero_force():
    c = indenter.contact(1.0, exponent=0.5, coefficient=1.0, force=np.array([0.0, 1.0]))
    assert (c.depth[0], c.stiffness[0], c.pressure(0.0)[0], c.displacement(1.0)[0]) == (0, 0, 0, 0)


def test_law():
    law = indenter.law(0.7, 0.02, 110e9)
    c = indenter.contact(110e9, exponent=0.7, coefficient=0.02, force=np.array([1.0, 5.0]))
    for name in ("stiffness", "depth", "contact_area", "elastic_energy"):
        np.testing.assert_array_equal(law.predict(name, np.array([1.0, 5.0])), getattr(c, name))
    with pytest.raises(ValueError, match="coefficient"):
        indenter.law(0.7, 0.0, 1.0)


def test_refusals():
    with pytest.raises(ValueError, match=r"exponent must be positive and finite, not 0\.0"):
        indenter.contact(1.0, exponent=0, coefficient=1.0, force=1.0)
    with pytest.raises(ValueError, match="coefficient"):
        indenter.contact(1.0, exponent=1, coefficient=-1.0, force=1.0)
    with pytest.raises(ValueError, match="exponent must be finite and not negative"):
        indenter.kappa(-0.1)
