"""The power law of self-affine surfaces: its parts agree with each other, and it says where it ends."""

import numpy as np
import pytest
from scipy.integrate import quad

from roughcontact.theory.spheres_and_punches import punch
from roughcontact.theory.stiffness_laws import pohrt_popov

STEEL = {"rms": 2e-6, "length": 1e-3, "modulus": 110e9}


def test_exponent_and_prefactor():
    h = np.array([0.3, 0.7, 1.0, 2.0, 2.5, 3.0])
    np.testing.assert_allclose(
        pohrt_popov.exponent(h), [1 / 1.3, 1 / 1.7, 1 / 2, 1 / 3, 1 / 3, 1 / 3], rtol=1e-15
    )
    np.testing.assert_allclose(pohrt_popov.prefactor(h)[:4], 1.7 / (h[:4] + 1), rtol=1e-15)
    assert pohrt_popov.prefactor(0.7) == pytest.approx(1, rel=1e-15)
    # The single crest of two crossed waves: R = L^2/(4 pi^2 h) in eq. 5.4.
    crest = (6 / (4 * np.pi**2)) ** (1 / 3)
    assert crest == pytest.approx(0.53366, abs=5e-6)
    assert pohrt_popov.prefactor(3.0) / crest == pytest.approx(1.06, abs=5e-3)


def test_dimensionless_law():
    """Thesis, eq. 4.74, and the values at F/(E* h L) = 0.07 beside which computed curves were put."""
    known = {0.4: 0.182, 0.7: 0.209, 1.0: 0.225, 1.5: 0.235, 2.0: 0.234}
    for h, k in known.items():
        assert pohrt_popov.stiffness(0.07, h, 1.0, 1.0, 1.0) == pytest.approx(k, abs=5e-4)


def test_scales_of_force_and_stiffness():
    k = pohrt_popov.stiffness(np.array([0.0, 0.01, 0.02]), 0.8, 1.0, 1.0, 1.0)
    scaled = pohrt_popov.stiffness(np.array([0.0, 0.01, 0.02]) * 220, 0.8, **STEEL)
    np.testing.assert_allclose(scaled, k * 110e6, rtol=1e-14)


@pytest.mark.parametrize("hurst", [0.2, 0.8, 2.0, 2.7])
def test_force_depth_and_energy_belong_together(hurst):
    surface = (hurst, *STEEL.values())
    f = 10.0
    k, d = pohrt_popov.stiffness(f, *surface), pohrt_popov.depth(f, *surface)
    assert pohrt_popov.force(k, *surface) == pytest.approx(f, rel=1e-13)
    # Eq. 5.1.
    assert pohrt_popov.force_at_depth(d, *surface) == pytest.approx(f, rel=1e-13)
    step = 1e-5 * d
    slope = np.diff(pohrt_popov.force_at_depth(np.array([d - step, d + step]), *surface))[0] / (2 * step)
    # Third derivatives: 6 for an exponent of 6, times step^2/6.
    assert slope == pytest.approx(k, rel=1e-8)
    law = pohrt_popov.law(*surface)
    energy = quad(lambda x: pohrt_popov.force_at_depth(x, *surface), 0, d)[0]
    assert law.predict("elastic_energy", f) == pytest.approx(energy, rel=1e-9)
    assert law.predict("stiffness", f) == k
    assert law.predict("depth", np.array([0.0, f])).tolist() == [0.0, d]


def test_size_does_not_matter_at_given_theta():
    """Eq. 7.2: L from 1 to 100 at one Theta = h L^-H."""
    length, h = np.array([1.0, 10.0, 100.0]), 0.8
    theta = 0.01
    k = pohrt_popov.stiffness(1e-4, h, theta * length**h, length, 3.0)
    np.testing.assert_allclose(k, pohrt_popov.scale_free_stiffness(1e-4, h, theta, 3.0), rtol=1e-14)
    np.testing.assert_allclose(pohrt_popov.theta(h, theta * length**h, length), theta, rtol=1e-14)


def test_law_ends_where_the_fits_end():
    law = pohrt_popov.law(0.8, *STEEL.values())
    end = 0.07 * 110e9 * 2e-6 * 1e-3
    assert law.domain == pytest.approx((0, end), rel=1e-15)
    assert np.isnan(law.predict("stiffness", 1.01 * end))
    assert np.isfinite(law.predict("stiffness", 0.99 * end))


def test_refusals():
    with pytest.raises(ValueError, match="hurst must exceed 0: at 0 and below the shortest waves dominate"):
        pohrt_popov.exponent(0.0)
    with pytest.raises(ValueError, match="hurst must not exceed 3"):
        pohrt_popov.stiffness(1e-3, 3.1, 1.0, 1.0, 1.0)
    with pytest.raises(ValueError, match="hurst must exceed 0"):
        pohrt_popov.prefactor(np.nan)
    with pytest.raises(ValueError, match=r"hurst must not exceed 2: one smooth crest"):
        pohrt_popov.scale_free_stiffness(1e-3, 2.1, 1.0, 1.0)
    limit = punch.square(1.0, 1.0)
    for wrong in (
        lambda: pohrt_popov.stiffness(1.5, 0.3, 1.0, 1.0, 1.0),
        lambda: pohrt_popov.force(1.0001 * limit, 0.3, 1.0, 1.0, 1.0),
        lambda: pohrt_popov.depth(1.5, 0.3, 1.0, 1.0, 1.0),
        lambda: pohrt_popov.force_at_depth(10.0, 0.3, 1.0, 1.0, 1.0),
    ):
        with pytest.raises(ValueError, match="passes the full-contact stiffness"):
            wrong()
    assert pohrt_popov.force(0.9999 * limit, 0.3, 1.0, 1.0, 1.0) > 0
