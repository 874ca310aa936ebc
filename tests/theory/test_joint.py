"""The correlations of thermal joints as laws of area and stiffness."""

import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.theory.joints import conductance, joint, thermal

MOMENTS = rc.Moments(1e-12, 0.005, 1e9)
MODULUS, HARDNESS, AREA, PAIR = 1e11, 1e9, 1e-4, (16.2, 167.0)
FORCE = np.geomspace(1.0, 1e3, 7)  # [N]: 0.01 to 10 MPa


def test_their_stiffness_conducts_as_they_say():
    """Back through the exact analogy, with any conductivities."""
    for mechanical, thermic in (
        (joint.mikic(MOMENTS, MODULUS, AREA), thermal.elastic_law(MOMENTS, MODULUS, PAIR, AREA)),
        (
            joint.cooper_mikic_yovanovich(MOMENTS, HARDNESS, MODULUS, AREA),
            thermal.plastic_law(MOMENTS, HARDNESS, PAIR, AREA),
        ),
    ):
        stiffness = mechanical.predict("interfacial_stiffness", FORCE)
        conducted = conductance.thermal(stiffness, MODULUS, PAIR)
        np.testing.assert_allclose(conducted, thermic.predict("thermal_conductance", FORCE), rtol=1e-13)
        assert mechanical.domain == thermic.domain


def test_elastic_spots_bear_the_pressure_of_asperity_theory():
    """A = sqrt(2 pi) F/(E* g), g^2 = 2 m2: Bush, Gibson and Thomas at light loads."""
    slope = math.sqrt(2 * MOMENTS.m2)
    expected = math.sqrt(2 * math.pi) * FORCE / (MODULUS * slope)
    law = joint.mikic(MOMENTS, MODULUS, AREA)
    np.testing.assert_allclose(law.predict("contact_area", FORCE), expected, rtol=1e-13)


def test_flowing_spots_bear_the_hardness():
    law = joint.cooper_mikic_yovanovich(MOMENTS, HARDNESS, MODULUS, AREA)
    np.testing.assert_allclose(law.predict("contact_area", FORCE), FORCE / HARDNESS, rtol=1e-13)
    assert law.plastic
    assert not joint.mikic(MOMENTS, MODULUS, AREA).plastic


def test_both_end_at_a_twentieth_of_the_area():
    for law in (
        joint.mikic(MOMENTS, MODULUS, AREA),
        joint.cooper_mikic_yovanovich(MOMENTS, HARDNESS, MODULUS, AREA),
    ):
        top = law.domain[1]
        assert law.predict("contact_area", top) == pytest.approx(0.05 * AREA, rel=1e-12)
        assert np.isnan(law.predict("contact_area", 1.01 * top))
