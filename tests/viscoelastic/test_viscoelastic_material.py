"""Viscoelastic materials: closed forms, and the identity of relaxation and creep."""

import math

import numpy as np
import pytest

from roughcontact.viscoelastic.models import kelvin_voigt, maxwell, standard_solid, viscous
from roughcontact.viscoelastic.prony_series import Viscoelastic

MATERIALS = {
    "viscous": viscous(2.0),
    "Kelvin-Voigt": kelvin_voigt(3.0, 0.5),
    "Maxwell": maxwell(2.0, 0.7),
    "standard solid": standard_solid(1.0, 3.0, 0.4),
    "Prony solid": Viscoelastic(0.5, [1, 2, 3], [5.0, 0.1, 1.0]),
    "Prony fluid": Viscoelastic(0, [1, 2, 3], [0.3, 1.0, 5.0]),
    "wide": Viscoelastic(1.0, np.geomspace(1, 1e3, 8), np.geomspace(1, 1e-6, 8)),
    "solid with dashpot": Viscoelastic(0.3, (1.0, 2.0), (0.5, 2.0), 0.7),
    "Jeffreys": Viscoelastic(0, (1.0,), (0.5,), 0.7),
    "elastic": Viscoelastic(2.0),
}
T = np.array([0.03, 0.4, 2.0])


def convolution(material, t):
    """Integral of E(t - s) dJ(s), with J's slope from its terms and the pulses of both by hand."""
    creep = material.creep()
    # Pieces that shrink towards both ends see times from 1e-6 on.
    half = np.concatenate([[0.0], t / 2 * 2.0 ** np.arange(-24, 1)])
    edges = np.concatenate([half, (t - half[-2::-1])])
    nodes, weights = np.polynomial.legendre.leggauss(24)
    width = np.diff(edges)[:, None] / 2
    s = (edges[:-1, None] + width * (nodes + 1)).ravel()
    rate = creep.fluidity + sum(
        J / theta * np.exp(-s / theta) for J, theta in zip(creep.compliances, creep.times, strict=True)
    )
    rate_now = creep.fluidity + sum(
        J / theta * math.exp(-t / theta) for J, theta in zip(creep.compliances, creep.times, strict=True)
    )
    regular = float(((width * weights).ravel() * material.relaxation(t - s) * rate).sum())
    return creep.instantaneous * float(material.relaxation(t)) + regular + material.dashpot * rate_now


@pytest.mark.parametrize("material", MATERIALS.values(), ids=MATERIALS.keys())
class TestEveryMaterial:
    @pytest.mark.parametrize("t", T)
    def test_relaxation_and_creep_belong_together(self, material, t):
        assert convolution(material, t) == pytest.approx(1, abs=1e-13)

    def test_creep_grows_and_relaxation_falls(self, material):
        t = np.geomspace(1e-4, 1e2, 60)
        assert (np.diff(material.creep()(t)) >= 0).all()
        assert (np.diff(material.relaxation(t)) <= 0).all()

    def test_both_ends(self, material):
        creep = material.creep()
        assert creep(0.0) == (0 if material.dashpot else pytest.approx(1 / material.instantaneous))
        if material.equilibrium:
            assert creep(1e9) == pytest.approx(1 / material.equilibrium, rel=1e-12)


class TestClosedForms:
    """Theory, section 7."""

    def test_viscous(self):
        np.testing.assert_allclose(viscous(2.0).creep()(T), T / 8, rtol=1e-15)
        assert viscous(2.0).dashpot == 8

    def test_kelvin_voigt(self):
        np.testing.assert_allclose(kelvin_voigt(3.0, 0.5).creep()(T), (1 - np.exp(-T / 0.5)) / 3, rtol=1e-13)

    def test_maxwell(self):
        np.testing.assert_allclose(maxwell(2.0, 0.7).creep()(T), (1 + T / 0.7) / 2, rtol=1e-15)
        np.testing.assert_allclose(maxwell(2.0, 0.7).relaxation(T), 2 * np.exp(-T / 0.7), rtol=1e-15)

    def test_standard_solid(self):
        solid = standard_solid(1.0, 3.0, 0.4)
        np.testing.assert_allclose(solid.creep()(T), 1 - (1 - 1 / 3) * np.exp(-T / 1.2), rtol=1e-14)
        np.testing.assert_allclose(solid.relaxation(T), 1 + 2 * np.exp(-T / 0.4), rtol=1e-15)

    def test_special_cases_agree(self):
        assert Viscoelastic(1.0, [2.0], [0.4]) == standard_solid(1.0, 3.0, 0.4)
        assert Viscoelastic(0.0, [2.0], [0.7]) == maxwell(2.0, 0.7)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Viscoelastic(), "needs a modulus or a viscosity"),
        (lambda: Viscoelastic(-1.0), "negative"),
        (lambda: Viscoelastic(1.0, (1.0,), ()), "each modulus"),
        (
            lambda: Viscoelastic(1.0, [1.0, 2.0], [1.0, 1.0]),
            "the relaxation times of the elements must differ",
        ),
        (lambda: Viscoelastic(1.0, [-1.0], [1.0]), "moduli and viscosities must be finite and not negative"),
        (lambda: maxwell(1.0, math.inf), "times of elements must be positive and finite"),
        (lambda: Viscoelastic(1.0, [1.0], [0.0]), "times of elements must be positive and finite"),
        (lambda: viscous(math.nan), "viscosity must be a number, not nan"),
        (lambda: standard_solid(3.0, 1.0, 1.0), "softens"),
        (lambda: Viscoelastic(1e8, 1e8, 1.0), "moduli must be a list, such as .*not 100000000.0"),
        (lambda: Viscoelastic(1e8, ["a"], [1.0]), "moduli must be"),
        (lambda: maxwell("a", 1.0), "modulus"),
        (lambda: kelvin_voigt(1.0, "a"), "retardation_time"),
        (lambda: standard_solid("a", 1.0, 1.0), "equilibrium must be"),
        (lambda: viscous("a"), "viscosity"),
        (lambda: maxwell(1.0, 1.0).relaxation(-1.0), "must not be negative.*not -1"),
        (lambda: maxwell(1.0, 1.0).relaxation([0.0, math.nan]), "not nan"),
        (lambda: maxwell(1.0, 1.0).creep()(-1.0), "there is no response before the load"),
    ],
)
def test_nonsense_is_refused(make, message):
    with pytest.raises(ValueError, match=message):
        make()
