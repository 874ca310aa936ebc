"""Pressure and displacement of the half-space: closed forms, resultants, and the sum over the surface."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from roughcontact.mdr.bodies import indenter
from roughcontact.mdr.bodies.indentation import indent
from roughcontact.theory.spheres_and_punches.power_law_indenter import kappa

R = np.array([0.0, 1e-6, 1e-3, 0.1, 0.5, 0.9, 0.999])


def test_hertz():
    contact = indent(indenter.paraboloid(1.0), 1.0, contact_radius=1.0)
    np.testing.assert_allclose(contact.pressure(R), 2 / np.pi * np.sqrt(1 - R**2), rtol=1e-13)
    outside = np.array([1 + 1e-9, 1.01, 2.0, 1e3])
    inverse = np.arcsin(1 / outside)
    truth = ((2 - outside**2) * inverse + np.sqrt(outside**2 - 1)) / np.pi
    # At 1e3 radii the closed form is a difference of equals: 1e6 times the rounding.
    np.testing.assert_allclose(contact.displacement(outside), truth, rtol=1e-9)
    np.testing.assert_allclose(contact.displacement(R), 1 - R**2 / 2)


def test_the_maximum_of_the_reference():
    assert indent(indenter.paraboloid(1.0), 1.0, force=1.0).pressure(0.0) == pytest.approx(
        0.578407449087, abs=6e-13
    )


def test_the_cone_has_an_infinite_tip():
    contact = indent(indenter.cone(0.7), 2.0, contact_radius=1.0)
    np.testing.assert_allclose(contact.pressure(R[1:]), 2.0 * 0.35 * np.arccosh(1 / R[1:]), rtol=1e-12)
    assert contact.pressure(0.0) == np.inf
    assert indent(indenter.power_law(0.5, 1.0), 1.0, depth=1.0).pressure(0.0) == np.inf


def test_the_fourth_power():
    contact = indent(indenter.power_law(4, 1.0), 1.0, contact_radius=1.0)
    truth = 64 / (9 * np.pi) * np.sqrt(1 - R**2) * (R**2 + 0.5)
    np.testing.assert_allclose(contact.pressure(R), truth, rtol=1e-12)


@pytest.mark.parametrize("n", [1.05, 1.2, 1.5, 3.0])
def test_on_the_axis_of_power_laws(n):
    contact = indent(indenter.power_law(n, 1.0), 1.0, contact_radius=1.0)
    assert contact.pressure(0.0) == pytest.approx(kappa(n) * n / (n - 1) / np.pi, rel=1e-12)


def test_the_punch():
    contact = indent(indenter.flat_punch(1.0), 1.0, depth=0.3)
    np.testing.assert_allclose(contact.pressure(R), 0.3 / (np.pi * np.sqrt(1 - R**2)), rtol=1e-14)
    assert contact.pressure(1.0) == np.inf
    assert contact.displacement(1.0) == 0.3
    outside = np.array([1.001, 3.0])
    np.testing.assert_allclose(
        contact.displacement(outside), 0.6 / np.pi * np.arcsin(1 / outside), rtol=1e-13
    )


BODIES = {
    "flat-ended cone": indenter.cone(0.7, flat=0.4),
    "flat-ended paraboloid": indenter.paraboloid(1.0, flat=0.4),
    "rounded cone": indenter.rounded_cone(1.0, 0.3),
    "sphere": indenter.sphere(2.0),
    "rough sphere": indenter.sphere(2.0) + indenter.equivalent_roughness(0.5, rms=0.01, length=1.0),
    "two faces": indenter.cone(0.7, flat=0.4) + indenter.paraboloid(1.0, flat=0.6),
    "cut": indenter.paraboloid(1.0).cut(0.8),
    "ripples": indenter.paraboloid(1.0) + indenter.ripples(1e-3, 0.5, 2.0),
    "function": indenter.of(lambda r: np.maximum(r - 0.4, 0) * 0.7, 2.0),
    "samples": indenter.sampled(np.linspace(0, 2, 201), np.linspace(0, 2, 201) ** 2 / 2),
}


@pytest.mark.parametrize("body", BODIES.values(), ids=BODIES.keys())
class TestResultants:
    @staticmethod
    def contact(body):
        return indent(body, 2.0, depth=1.0)

    @staticmethod
    def integral(contact, weight):
        """Integrate over the disc; r = l + (u - l) sin^2 takes roots and logarithms off the ends of the pieces."""
        ends = [
            0.0,
            *(b for b in contact.profile.breaks if b < contact.contact_radius),
            contact.contact_radius,
        ]
        nodes, weights = np.polynomial.legendre.leggauss(48)
        angle = np.pi / 4 * (nodes + 1)
        total = 0.0
        for low, high in pairwise(ends):
            r = low + (high - low) * np.sin(angle) ** 2
            step = np.pi / 4 * weights * (high - low) * np.sin(2 * angle)
            total += float((step * contact.pressure(r) * weight(r)).sum())
        return total

    def test_the_pressure_carries_the_force(self, body):
        contact = self.contact(body)
        force = self.integral(contact, lambda r: 2 * np.pi * r)
        # What is left is this test's own quadrature beside the logarithm at the rim of a flat face.
        assert force == pytest.approx(contact.force, rel=1e-6)

    def test_the_pressure_makes_the_depth_on_the_axis(self, body):
        """Boussinesq: u(0) = (2/E*) times the integral of p over r."""
        contact = self.contact(body)
        # Tips are of a logarithm or a root: the test's own quadrature again.
        assert self.integral(contact, lambda r: np.ones_like(r)) == pytest.approx(contact.depth, rel=1e-4)

    def test_from_afar_it_is_a_point_force(self, body):
        contact = self.contact(body)
        far = 1e5
        # Next term (a/r)^2/6 and smaller.
        assert contact.displacement(far) * math.pi * 2.0 * far == pytest.approx(contact.force, rel=1e-9)

    def test_the_surface_goes_on_from_the_contact(self, body):
        contact, a = self.contact(body), self.contact(body).contact_radius
        step = 1e-8 * a
        jump = float(contact.displacement(a + step) - contact.displacement(a))
        # A smooth rim: slope times step. An edge: the square root of twice the step.
        assert abs(jump) < (1e-3 if body.edge else 1e-7)

    def test_pressure_and_gap_exclude_each_other(self, body):
        contact = self.contact(body)
        r = np.linspace(1e-3, 2 * contact.contact_radius, 41)
        assert (contact.pressure(r) >= 0).all()
        gap = contact.gap(np.minimum(r, body.radius if not body.edge else np.inf))
        assert (gap >= 0).all()
        assert (gap[r > 1.01 * contact.contact_radius] > 0).all()
        assert (contact.pressure(r)[r > contact.contact_radius] == 0).all()


def test_the_pressure_of_a_flat_ended_cone():
    """Direct quadrature of p(r) = (E*/pi) integral of g'(x)/sqrt(x^2 - r^2), g' from the closed form by hand."""
    b, slope = 0.4, 0.7
    contact = indent(indenter.cone(slope, flat=b), 1.0, contact_radius=1.0)

    def density(x):
        return slope * (math.acos(b / x) + b / math.sqrt(x**2 - b**2))

    for r in (0.0, 0.2, 0.399, 0.401, 0.7):
        low = max(r, b)
        # y^2 = x - low for the root at the lower end.
        truth = quad(
            lambda y, low=low, r=r: 2 * y * density(low + y**2) / math.sqrt((low + y**2) ** 2 - r**2),
            0,
            math.sqrt(1 - low),
            points=[1e-3, 1e-2, 0.1],
            epsrel=1e-11,
            limit=300,
        )[0]
        assert contact.pressure(r) == pytest.approx(truth / np.pi, rel=1e-8)


def test_negative_radii_are_refused():
    contact = indent(indenter.paraboloid(1.0), 1.0, depth=0.1)
    for field in (contact.pressure, contact.displacement, contact.gap):
        with pytest.raises(ValueError, match="not be negative"):
            field(-0.1)


def test_without_contact_nothing_moves():
    contact = indent(indenter.paraboloid(1.0), 1.0, depth=0.0)
    assert contact.pressure(np.array([0.0, 0.1])).tolist() == [0, 0]
    assert contact.displacement(np.array([0.0, 0.1])).tolist() == [0, 0]
