"""Laws by name: each is the theory's own, and says what it misses."""

import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.theory import laws
from roughcontact.theory.asperity_models import bush_gibson_thomas, greenwood_williamson, interaction
from roughcontact.theory.joints import joint
from roughcontact.theory.persson_theory import persson, persson_plastic
from roughcontact.theory.plastic_asperities import chang_etsion_bogy, kogut_etsion, pullen_williamson
from roughcontact.theory.spheres_and_punches import hertz, rough_sphere
from roughcontact.theory.stiffness_laws import finite_size, pohrt_popov, rough_square

MODULUS, AREA, LENGTH = 1e11, 4e-6, 2e-3
SPECTRUM = rc.SelfAffineSpectrum(0.8, long_cutoff=LENGTH, rolloff=5e-4, short_cutoff=1e-5).scaled(1e-6)
MOMENTS = SPECTRUM.moments()
FACTS = {
    "modulus": MODULUS,
    "area": AREA,
    "spectrum": SPECTRUM,
    "moments": MOMENTS,
    "hurst": 0.8,
    "rolloff": 5e-4,
    "radius": 0.5,
    "hardness": 2e9,
}
DIRECT = {
    "persson": persson.law(SPECTRUM, MODULUS, AREA),
    "finite-size": finite_size.law(finite_size.Cell(0.8, 1e-6, 5e-4), SPECTRUM, MODULUS, AREA),
    "gw": greenwood_williamson.law(MOMENTS, MODULUS, AREA),
    "gw-exponential": greenwood_williamson.law(MOMENTS, MODULUS, AREA, distribution="exponential"),
    "bgt": bush_gibson_thomas.law(MOMENTS, MODULUS, AREA),
    "cgp": interaction.law(MOMENTS, MODULUS, AREA),
    "mikic": joint.mikic(MOMENTS, MODULUS, AREA),
    "cmy": joint.cooper_mikic_yovanovich(MOMENTS, 2e9, MODULUS, AREA),
    "ceb": chang_etsion_bogy.law(MOMENTS, 2e9, MODULUS, AREA),
    "kogut-etsion": kogut_etsion.law(MOMENTS, 2e9, MODULUS, AREA),
    "persson-plastic": persson_plastic.law(SPECTRUM, 2e9, MODULUS, AREA),
    "pullen-williamson": pullen_williamson.law(2e9, AREA),
    "power-law": pohrt_popov.law(0.8, 1e-6, LENGTH, MODULUS),
    **{
        f"rough-square-{cut}": rough_square.law(0.8, 1e-6, LENGTH, MODULUS, cut=cut)
        for cut in ("interior", "period", "patch")
    },
    "hertz": hertz.law(0.5, MODULUS),
    "rough-sphere": rough_sphere.law(0.5, 0.8, 1e-6, LENGTH, MODULUS),
}


def test_every_law_is_here():
    assert set(DIRECT) == set(laws.LAWS)


@pytest.mark.parametrize("name", list(laws.LAWS))
def test_is_the_law_of_the_theory(name):
    law, direct = laws.named(name, **FACTS), DIRECT[name]
    assert law.name == direct.name
    assert set(law.quantities) == set(direct.quantities)
    forces = max(law.domain[0], 0.01) * np.array([1.0, 10.0])
    for quantity in law.quantities:
        values = law.predict(quantity, forces)
        assert np.isfinite(values).all()
        assert values == pytest.approx(direct.predict(quantity, forces), rel=1e-9)


# What follows from the other inputs that the law needs.
IMPLIED = {("finite-size", "rms"), ("finite-size", "rolloff")}
MISSING = [
    (name, need) for name, law in laws.LAWS.items() for need in law.needs if (name, need) not in IMPLIED
]


@pytest.mark.parametrize(("name", "need"), MISSING)
def test_what_is_missing_is_named(name, need):
    everything = FACTS | {"rms": 1e-6, "length": LENGTH}
    given = {key: everything[key] for key in laws.LAWS[name].needs if key != need}
    with pytest.raises(ValueError, match=rf"'{name}' needs .*: {need} missing"):
        laws.named(name, **given)


def test_defaults_follow_from_other_facts():
    inputs = laws.LawInputs(modulus=MODULUS, length=LENGTH, spectrum=SPECTRUM).completed()
    assert inputs.area == pytest.approx(AREA, rel=1e-15)
    assert inputs.rolloff == LENGTH
    assert inputs.rms == pytest.approx(1e-6, rel=1e-12)
    assert inputs.moments.m2 == pytest.approx(MOMENTS.m2, rel=1e-12)
    assert laws.LawInputs(area=AREA).completed().length == pytest.approx(math.sqrt(AREA), rel=1e-15)


def test_unknown_names_are_refused():
    with pytest.raises(ValueError, match="there are persson"):
        laws.named("greenwood")
    with pytest.raises(ValueError, match="no law has the input colour"):
        laws.named("persson", colour="red")
