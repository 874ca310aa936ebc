import math

import pytest

import roughcontact as rc
from roughcontact.materials import as_modulus

STEEL, RUBBER = rc.Solid(210e9, 0.3), rc.Solid(1e6, 0.5)


def test_equal_bodies():
    """Thesis, eq. 4.3: nu = 0.3 on both sides gives E / (2 * 0.91)."""
    assert rc.reduced_modulus(STEEL, STEEL) == pytest.approx(210e9 / (2 * 0.91), rel=1e-15)


def test_a_rigid_partner_drops_out():
    rigid = rc.Solid(math.inf, 0.3)
    assert rc.reduced_modulus(RUBBER) == rc.reduced_modulus(RUBBER, rigid) == pytest.approx(1e6 / 0.75)


@pytest.mark.parametrize(("nu", "ratio"), [(0.0, 1.0), (0.5, 1.5), (0.3, 1.7 / 1.4)])
def test_normal_over_shear_is_mindlins_ratio(nu, ratio):
    """Thesis, eq. 4.5: (2 - nu) / (2 (1 - nu)) for equal bodies."""
    body = rc.Solid(3.0, nu)
    assert rc.reduced_modulus(body, body) / rc.reduced_shear_modulus(body, body) == pytest.approx(
        ratio, rel=1e-14
    )


def test_a_modulus_may_be_a_number_a_solid_or_a_pair():
    assert as_modulus(5.0) == 5.0
    assert as_modulus(STEEL) == rc.reduced_modulus(STEEL)
    assert as_modulus((STEEL, RUBBER)) == rc.reduced_modulus(STEEL, RUBBER)
    assert as_modulus(("steel", "Aluminum")) == rc.reduced_modulus("steel", "aluminium")
    assert as_modulus("Gold") == as_modulus(rc.handbook("gold")) == rc.reduced_modulus("gold")


@pytest.mark.parametrize("modulus", [0.0, -1.0, math.nan, math.inf])
def test_a_modulus_of_no_body_is_refused(modulus):
    with pytest.raises(ValueError, match="reduced modulus must be positive"):
        as_modulus(modulus)


@pytest.mark.parametrize(("young", "nu"), [(0.0, 0.3), (-1.0, 0.3), (1.0, 0.6), (1.0, -1.0), (math.nan, 0.3)])
def test_a_solid_of_no_body_is_refused(young, nu):
    with pytest.raises(ValueError, match="must"):
        rc.Solid(young, nu)


@pytest.mark.parametrize("modulus", ["110GPa", None, [1.0], [STEEL, RUBBER], 1j])
def test_what_is_no_number_is_refused(modulus):
    with pytest.raises(ValueError, match="reduced modulus must be one number"):
        as_modulus(modulus)


def test_three_bodies_are_refused():
    with pytest.raises(ValueError, match="two solids"):
        as_modulus((STEEL, RUBBER, STEEL))


def test_two_rigid_bodies_are_refused():
    with pytest.raises(ValueError, match="rigid"):
        rc.reduced_modulus(rc.Solid(math.inf, 0.3))
