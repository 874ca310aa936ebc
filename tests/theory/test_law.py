"""Laws, and what they are made of, go from process to process."""

import math
import pickle

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.evaluation.theories import persson_pressures
from roughcontact.theory.asperity_models import (
    asperities,
    bush_gibson_thomas,
    greenwood_williamson,
    interaction,
)
from roughcontact.theory.joints import conductance, mindlin, thermal
from roughcontact.theory.persson_theory import persson
from roughcontact.theory.spheres_and_punches import hertz, power_law_indenter, rough_sphere
from roughcontact.theory.springs import cosine, gaussian_heights, height_distribution
from roughcontact.theory.springs.beat_wave import beat_wave
from roughcontact.theory.stiffness_laws import finite_size, pohrt_popov, rough_square
from roughcontact.theory.tools.computed import as_law

SPECTRUM = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-3, rolloff=5e-4, short_cutoff=1e-5).scaled(1e-6)
MOMENTS = SPECTRUM.moments()
SURFACE = rc.self_affine(rc.Grid((16, 16), 1e-5), 0.8, 1e-6, np.random.default_rng(0))
PEAKS = asperities.Asperities(
    np.array([0.0, 3.0, 7.0]), np.array([0.0, 4.0, 1.0]), np.array([0.0, -0.01, -0.02]), np.full(3, 2.0), 1.0
)
HERTZ = hertz.law(0.5, 1e11)
HEIGHTS = {
    "density": height_distribution.from_density(math.sqrt),  # a function of a module can be sent
    "breaks": height_distribution.from_density(math.exp, breaks=(0.2, 0.6)),
    "samples": height_distribution.from_samples([0.0, 0.1, 1.0], [1.0, 2.0, 0.5]),
    "wave": beat_wave(1, 0.3),
    "waves": beat_wave(3, 0.3),
}
LAWS = {
    "persson": persson.law(SPECTRUM, 1e11, 1e-6),
    "finite-size": finite_size.law(finite_size.Cell(0.8, 1e-6, 5e-4), SPECTRUM, 1e11, 1e-6),
    "gw": greenwood_williamson.law(MOMENTS, 1e11, 1e-6),
    "bgt": bush_gibson_thomas.law(MOMENTS, 1e11, 1e-6),
    "cgp": interaction.law(MOMENTS, 1e11, 1e-6),
    "finite-body": interaction.finite_body(persson.law(SPECTRUM, 1e11, 1e-6), 1e11, 1e-6),
    "power-law": pohrt_popov.law(0.8, 1e-6, 1e-3, 1e11),
    "rough-square": rough_square.law(0.8, 1e-9, 1e-3, 1e8, cut="interior"),
    "hertz": HERTZ,
    "indenter": power_law_indenter.law(1.5, 0.3, 1e11),
    "rough-sphere": rough_sphere.law(0.5, 0.8, 1e-6, 1e-3, 1e11),
    "asperities": asperities.law(PEAKS),
    "alone": asperities.law(PEAKS, interaction=False),
    "cosine": cosine.law(0.1, 1.0, 1.0),
    "white": gaussian_heights.law(0.1, 1.0, 1.0),
    "sideways": mindlin.law(HERTZ, 1.2),
    "plastic": thermal.plastic_law(MOMENTS, 1e9, (10.0, 20.0), 1e-6),
    "elastic": thermal.elastic_law(MOMENTS, 1e11, (10.0, 20.0), 1e-6),
    "conductance": conductance.law(HERTZ, 1e11, resistivities=(1e-8, 2e-8), conductivities=(10.0, 20.0)),
    "computed": as_law(rc.loading_curve(SURFACE, 1e11, forces=[1e-3, 2e-3, 4e-3])),
    **{f"heights of {name}": heights.law(1.0, 1.0) for name, heights in HEIGHTS.items()},
    **{f"{law.name} of a surface": law for law in rc.loading_laws(SURFACE, 1e11, ["persson", "gw", "bgt"])},
}


@pytest.mark.parametrize("name", LAWS)
def test_a_law_can_be_sent(name):
    law = LAWS[name]
    other = pickle.loads(pickle.dumps(law))
    assert (other.name, other.source, other.domain) == (law.name, law.source, law.domain)
    assert list(other.quantities) == list(law.quantities)
    forces = np.array([1e-3, 2e-3])
    for quantity in law.quantities:
        np.testing.assert_array_equal(other.predict(quantity, forces), law.predict(quantity, forces))


@pytest.mark.parametrize("name", HEIGHTS)
def test_a_distribution_of_heights_can_be_sent(name):
    heights = HEIGHTS[name]
    other = pickle.loads(pickle.dumps(heights))
    depths = np.array([0.0, 0.05, 0.4])
    np.testing.assert_array_equal(other.force(depths, 1.0, 1.0), heights.force(depths, 1.0, 1.0))
    np.testing.assert_array_equal(other.stiffness(depths, 1.0, 1.0), heights.stiffness(depths, 1.0, 1.0))


def test_the_pressures_of_persson_can_be_sent():
    density = persson_pressures(rc.press(SURFACE, 1e11, force=2e-3))
    stress = np.array([1e6, 1e8])
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(density))(stress), density(stress))
