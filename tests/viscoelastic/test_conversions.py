"""Materials from creep, from two bodies, from other moduli, and fitted ones."""

import dataclasses

import numpy as np
import pint
import pytest

import roughcontact as rc
from roughcontact import Viscoelastic, viscoelastic
from roughcontact.viscoelastic.time_history import checked_history

MATERIALS = {
    "viscous": viscoelastic.viscous(2.0),
    "Kelvin-Voigt": viscoelastic.kelvin_voigt(3.0, 0.5),
    "Maxwell": viscoelastic.maxwell(2.0, 0.7),
    "solid": Viscoelastic(0.5, [1, 2, 3], [5.0, 0.1, 1.0]),
    "wide": Viscoelastic(1.0, np.geomspace(0.1, 100, 8), np.geomspace(1, 1e-6, 8)),
    "solid with dashpot": rc.Viscoelastic(0.3, (1.0, 2.0), (0.5, 2.0), 0.7),
    "Jeffreys": rc.Viscoelastic(0, (1.0,), (0.5,), 0.7),
    "elastic": rc.Viscoelastic(2.0),
}
W = np.geomspace(1e-3, 1e3, 25)


def transform(creep, s):
    """Return s times the Laplace transform of J at s."""
    terms = (J / (1 + s * theta) for J, theta in zip(creep.compliances, creep.times, strict=True))
    return creep.instantaneous + creep.fluidity / s + sum(terms)


@pytest.mark.parametrize("material", MATERIALS.values(), ids=MATERIALS.keys())
class TestExact:
    """A few roundings in sums of positive terms: 1e-14."""

    def test_modulus_and_creep_are_inverse(self, material):
        product = material.complex_modulus(W) * transform(material.creep(), 1j * W)
        np.testing.assert_allclose(product, 1, rtol=1e-14)

    def test_there_and_back(self, material):
        creep = material.creep()
        back = viscoelastic.from_creep(
            creep.instantaneous, creep.compliances, creep.times, fluidity=creep.fluidity
        )
        assert len(back.times) == len(material.times)
        np.testing.assert_allclose(back.complex_modulus(W), material.complex_modulus(W), rtol=1e-14)
        assert sorted(back.times) == pytest.approx(sorted(material.times), rel=1e-13)

    def test_two_bodies(self, material):
        other = Viscoelastic(0.5, [1.0, 2.0], [1.0, 7.0])
        pair = viscoelastic.in_series(material, other)
        wanted = 1 / (1 / material.complex_modulus(W) + 1 / other.complex_modulus(W))
        np.testing.assert_allclose(pair.complex_modulus(W), wanted, rtol=1e-14)

    @pytest.mark.parametrize("K", [3.0, 1e3, 1e12])
    def test_bulk_modulus(self, material, K):
        G = material.complex_modulus(W)
        body = viscoelastic.reduced(material, "shear", bulk=K)
        np.testing.assert_allclose(body.complex_modulus(W), 4 * G * (3 * K + G) / (3 * K + 4 * G), rtol=1e-14)

    @pytest.mark.parametrize("K", [300.0, 1e6])
    def test_young_and_bulk_modulus(self, material, K):
        """E* = E/(1 - nu^2), nu = (3K - E)/(6K)."""
        if material.dashpot:
            with pytest.raises(ValueError, match=r"dashpot exceeds 9 K.*poisson"):
                viscoelastic.reduced(material, "young", bulk=K)
            return
        E = material.complex_modulus(W)
        body = viscoelastic.reduced(material, "young", bulk=K)
        np.testing.assert_allclose(
            body.complex_modulus(W), E / (1 - ((3 * K - E) / (6 * K)) ** 2), rtol=1e-13
        )


def test_digits_of_one_conversion():
    """E_inf = 1, E_k = (2, 3), tau_k = (.5, 4): roots of a quadratic, to the digits of a second program."""
    creep = rc.Viscoelastic(1.0, (2.0, 3.0), (0.5, 4.0)).creep()
    assert creep.instantaneous == pytest.approx(1 / 6, rel=1e-15)
    assert creep.times == pytest.approx((0.71492066000586, 16.78507933999), rel=1e-12)
    assert creep.compliances == pytest.approx((0.0614534141403, 0.7718799191930), rel=1e-12)


def test_a_term_of_zero_weight_changes_nothing():
    plain, more = Viscoelastic(1.0, [2.0], [0.5]), Viscoelastic(1.0, [2.0, 0.0], [0.5, 3.0])
    assert more.creep() == plain.creep()
    assert (more.complex_modulus(W) == plain.complex_modulus(W)).all()


def test_an_elastic_second_body():
    pair = viscoelastic.in_series(viscoelastic.maxwell(2e6, 1.0), rc.Solid(3e6, 0.5))
    assert pair.instantaneous == pytest.approx(1 / (1 / 2e6 + 1 / 4e6), rel=1e-14)
    assert pair.equilibrium == 0


def test_poisson():
    shear = Viscoelastic(1.0, [2.0], [1.0])
    assert viscoelastic.reduced(shear, "shear", poisson=0.25).equilibrium == pytest.approx(2 / 0.75)
    assert viscoelastic.reduced(shear, "young", poisson=0.25).moduli[0] == pytest.approx(2 / (1 - 1 / 16))
    assert viscoelastic.reduced(shear, "reduced") is shear


class TestFitted:
    rubber = Viscoelastic(1e6, [2e6, 3e6, 1e6], [0.01, 0.5, 8.0])
    omega = np.geomspace(0.05, 2e2, 30)
    storage, loss = (lambda measured: (measured.real, measured.imag))(rubber.complex_modulus(omega))

    def test_a_dma_table(self):
        """The fit meets the table to its misfit, and the relaxation in the band nearly as well."""
        found = viscoelastic.from_dma(self.storage, self.loss, angular_frequencies=self.omega, kind="reduced")
        fitted = found.complex_modulus(self.omega)
        off = max(np.abs(fitted.real / self.storage - 1).max(), np.abs(fitted.imag / self.loss - 1).max())
        assert off == pytest.approx(found.misfit, rel=1e-9)
        assert found.misfit < 0.03
        t = np.geomspace(*found.band, 20)
        np.testing.assert_allclose(found.relaxation(t), self.rubber.relaxation(t), rtol=0.03)
        assert min(found.moduli) > 0

    def test_frequencies_in_hertz(self):
        one = viscoelastic.from_dma(self.storage, self.loss, angular_frequencies=self.omega, poisson=0.5)
        two = viscoelastic.from_dma(
            self.storage, self.loss, frequencies=self.omega / (2 * np.pi), poisson=0.5
        )
        assert two.relaxation(1.0) == pytest.approx(one.relaxation(1.0), rel=1e-9)
        assert two.band == pytest.approx(one.band)

    def test_units_of_frequencies_are_not_confused(self):
        U = pint.get_application_registry()
        for name, values in (
            ("frequencies", self.omega * U("rad/s")),
            ("angular_frequencies", self.omega * U.kHz),
        ):
            with pytest.raises(ValueError, match="1 Hz is 2 pi rad/s"):
                viscoelastic.from_dma(self.storage, self.loss, **{name: values}, poisson=0.5)
        viscoelastic.from_dma(self.storage, self.loss, angular_frequencies=self.omega * U("1/s"), poisson=0.5)

    def test_noise_is_stated(self):
        noisy = self.loss * (1 + 0.1 * (-1.0) ** np.arange(30))
        found = viscoelastic.from_dma(self.storage, noisy, angular_frequencies=self.omega, poisson=0.5)
        assert 0.05 < found.misfit < 0.2

    @pytest.mark.parametrize("exponent", [0.05, 0.3, 0.9])
    def test_power_laws(self, exponent):
        """The stated error is the largest one, and small."""
        soft = viscoelastic.power_law(2e5, 0.1, exponent, band=(1e-3, 1e2), equilibrium=1e4)
        t = np.geomspace(1e-3, 1e2, 777)
        off = np.abs(soft.relaxation(t) / (1e4 + 2e5 * (t / 0.1) ** -exponent) - 1).max()
        assert off <= 1.05 * soft.misfit < 3e-3

    def test_other_times_than_those_of_the_data_are_refused(self):
        found = viscoelastic.from_dma(
            self.storage, self.loss, angular_frequencies=self.omega, poisson=0.5, temperature=296.0
        )
        for call in (found.relaxation, found.creep(), lambda t: found.complex_modulus(1 / t)):
            call(20.0), call(0.005)
            for outside in (21.0, 0.0049):
                with pytest.raises(ValueError, match=r"band of the data, 0.005 to 20 s.*band=None"):
                    call(outside)
        assert found.temperature == 296
        cold = found.shifted(100.0, temperature=260.0)
        assert cold.relaxation(2000.0) == pytest.approx(found.relaxation(20.0), rel=1e-14)
        assert cold.band == pytest.approx((0.5, 2000))
        assert cold.temperature == 260
        dataclasses.replace(found, band=None).relaxation(1e9)

    def test_histories_that_leave_the_band_are_refused(self):
        gel = viscoelastic.power_law(1e5, 1.0, 0.3, band=(1e-2, 1e3))
        for times, loads, message in (
            ([0.0, 0.005], [1.0, 1.0], "0.005 s follows 0.005 s after"),
            ([0.0, 1.0, 1.0, 1.005], [0.0, 1.0, 0.5, 0.5], "1.005 s follows 0.005 s after"),
            ([0.0, 1.0, 1001.0], [0.0, 1.0, 1.0], "lasts 1001 s"),
            ([0.0, 1.0, 1.005], [0.0, 1.0, 1.0], "1.005 s follows 0.005 s after"),
        ):
            with pytest.raises(ValueError, match=message):
                checked_history(gel, times, loads)
        t = np.linspace(0, 10, 1001)  # closely spaced times of one ramp are allowed
        checked_history(gel, t, t)
        checked_history(gel, [0.0, 0.0, 0.01, 1.0, 1.0], [0.0, 1.0, 1.0, 1.0, 0.0])  # jumps


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: viscoelastic.from_creep(1.0, [-1.0], [1.0]), "compliances must not be negative"),
        (lambda: viscoelastic.from_creep(1.0, [1.0], [0.0]), "retardation times must be positive"),
        (lambda: viscoelastic.from_creep(1.0, [1.0, 1.0], [1.0, 1.0]), "retardation times must differ"),
        (lambda: viscoelastic.from_creep(1.0, [1.0, 1.0], [1.0]), "lists of one length"),
        (lambda: viscoelastic.from_creep(0.0, [], []), "needs a compliance"),
        (
            lambda: viscoelastic.reduced(MATERIALS["Maxwell"], "bulk", bulk=1.0),
            "'young', 'shear' or 'reduced'",
        ),
        (lambda: viscoelastic.reduced(MATERIALS["Maxwell"], "shear"), "exactly one of poisson and bulk"),
        (
            lambda: viscoelastic.reduced(MATERIALS["Maxwell"], "young", bulk=0.1),
            "bulk must be finite and above 0.2222",
        ),
        (lambda: viscoelastic.reduced(MATERIALS["Maxwell"], "shear", poisson=0.6), "at most 0.5"),
        (lambda: viscoelastic.reduced(MATERIALS["Maxwell"], "reduced", poisson=0.5), "needs no ratio"),
        (lambda: viscoelastic.power_law(1.0, 1.0, 1.2, band=(1.0, 2.0)), "exponent must be between 0 and 1"),
        (lambda: viscoelastic.power_law(1.0, 1.0, 0.2, band=(2.0, 1.0)), "two positive times that rise"),
        (
            lambda: viscoelastic.from_dma([1.0] * 3, [0.1, 0.0, 0.1], frequencies=[1, 2, 3], poisson=0.5),
            "loss must be",
        ),
        (
            lambda: viscoelastic.from_dma([1.0] * 2, [0.1] * 2, frequencies=[1, 2], poisson=0.5),
            "three or more",
        ),
        (
            lambda: viscoelastic.in_series(
                viscoelastic.power_law(1.0, 1.0, 0.2, band=(1.0, 2.0)),
                viscoelastic.power_law(1.0, 1.0, 0.2, band=(3.0, 4.0)),
            ),
            "do not overlap",
        ),
    ],
)
def test_nonsense_is_refused(call, message):
    with pytest.raises(ValueError, match=message):
        call()
