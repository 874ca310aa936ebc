"""Theories of a joint without heights: by hand, and by the laws that they are."""

import math

import numpy as np
import pytest
from scipy.special import erf

import roughcontact as rc
from roughcontact.evaluation.theory_table import WITHOUT_SIZE
from roughcontact.recipe.theory_job import JOINT_THEORIES

ONE, OTHER = rc.handbook("aluminium"), rc.handbook("stainless-steel")
MODULUS = rc.reduced_modulus(ONE.solid, OTHER.solid)
CONDUCTIVITIES = (ONE.conductivity, OTHER.conductivity)
PRESSURES = np.array([1e6, 5e6, 1e7])
TWO = rc.specified(sigma=(1.2e-6, 1.2e-6), slope=(0.12, 0.12))
SETTLED = rc.specified(sigma=1.2e-6, slope=0.12, hurst=0.8, rolloff=64e-6)


def table(joint, names, pressures=PRESSURES, **more):
    given = {"hardness": ONE.hardness, "conductivities": CONDUCTIVITIES}
    return rc.theory_table(joint, MODULUS, names, pressures, **(given | more))


def test_two_blasted_faces_have_the_conductance_that_is_reckoned_by_hand():
    found = table(TWO, ["cmy", "mikic"])["thermal_conductance_per_area"]
    k = 2 / (1 / 167.0 + 1 / 16.2)
    sigma, m = 1.2e-6 * math.sqrt(2), 0.12 * math.sqrt(2)
    by_hand = 1.25 * k * m / sigma * (PRESSURES / ONE.hardness) ** 0.95
    np.testing.assert_allclose(found.sel(theory="cmy"), by_hand, rtol=1e-12)
    elastic = 1.55 * k * m / sigma * (math.sqrt(2) * PRESSURES / (MODULUS * m)) ** 0.94
    np.testing.assert_allclose(found.sel(theory="mikic"), elastic, rtol=1e-12)


def test_persson_knows_the_slope_only_for_the_area():
    found = table(SETTLED, "persson")["contact_fraction"].sel(theory="persson")
    slope = math.sqrt(2 * math.pi / 2) * 0.12  # rms of the gradient
    # The spectrum is cut a thousand roll-offs away, whose waves have 1e-12 of the mean square slope.
    np.testing.assert_allclose(found, erf(math.sqrt(2) * PRESSURES / (MODULUS * slope)), rtol=1e-9)


def test_asperities_take_the_bandwidth_from_nayak_or_from_the_spectrum():
    alpha = SETTLED.spectrum.moments().nayak
    by_nayak = rc.specified(sigma=1.2e-6, slope=0.12, nayak=alpha)
    for name in ("gw", "bgt", "kogut-etsion"):
        np.testing.assert_allclose(
            table(by_nayak, name)["mean_gap"], table(SETTLED, name)["mean_gap"], rtol=1e-9
        )


@pytest.mark.parametrize("name", WITHOUT_SIZE)
def test_each_theory_is_the_law_of_its_name(name):
    """On any area, with moments and spectrum of the joint."""
    area, moments = 3e-4, SETTLED.spectrum.moments()
    spectrum = rc.theory.waves.Waves.of_spectrum(SETTLED.spectrum, q_min=SETTLED.spectrum.q_rolloff / 1e3)
    law = rc.theory.laws.named(
        name, modulus=MODULUS, area=area, moments=moments, spectrum=spectrum, hardness=ONE.hardness
    )
    found = table(SETTLED, name).sel(theory=name)
    names = {
        "contact_area": ("contact_fraction", area),
        "interfacial_stiffness": ("interfacial_stiffness_per_area", area),
        "mean_gap": ("mean_gap", 1),
    }
    for quantity in law.quantities.keys() & names:
        column, over = names[quantity]
        np.testing.assert_allclose(found[column], law.predict(quantity, PRESSURES * area) / over, rtol=1e-9)
    assert name in JOINT_THEORIES
    assert len(JOINT_THEORIES) == len(WITHOUT_SIZE)


def test_what_a_theory_does_not_say_is_nan():
    found = table(SETTLED, ["cmy", "kogut-etsion", "pullen-williamson"], [1e6, 1e8])
    assert np.isnan(found["mean_gap"].sel(theory="cmy")).all()
    # The fit ends at 5 % of the hardness, 52 MPa.
    assert np.isnan(found["contact_fraction"].sel(theory="cmy")).values.tolist() == [False, True]
    # Spots conduct as they unload: the stiffness of first loading is another one.
    assert np.isfinite(found["interfacial_stiffness_per_area"].sel(theory="kogut-etsion")).all()
    assert np.isnan(found["thermal_conductance_per_area"].sel(theory="kogut-etsion")).all()


def test_a_table_says_what_it_holds():
    found = table(TWO, "cmy", resistivities=(ONE.resistivity, OTHER.resistivity))
    assert found["thermal_conductance_per_area"].attrs["units"] == "W m-2 K-1"
    assert float(found["hardness"]) == ONE.hardness
    resistance = found["electrical_resistance_per_area"] * found["electrical_conductance_per_area"]
    np.testing.assert_allclose(resistance, 1, rtol=1e-14)
    assert "thermal_conductance_per_area" not in table(TWO, "cmy", conductivities=None)


@pytest.mark.parametrize(
    ("joint", "names", "more", "words"),
    [
        (TWO, "gw", {}, "give `nayak`, or `hurst`"),
        (TWO, "persson", {}, "give `hurst` and one of"),
        (TWO, "power-law", {}, "needs the size of the joint: choose from persson, gw"),
        (TWO, "cgp", {}, "needs the size of the joint"),
        (TWO, "hurtz", {}, "is not known: choose from"),
        (TWO, "cmy", {"hardness": None}, "give the `hardness` of the softer body"),
        (1.2e-6, "cmy", {}, "give rc.specified"),
        (TWO, "cmy", {"conductivities": (0.0, math.inf, 1.0)}, "are not two numbers"),
    ],
)
def test_what_cannot_be_told_is_refused(joint, names, more, words):
    with pytest.raises(rc.InputError, match=words):
        table(joint, names, **more)
