"""Interaction by a mean deflection: the deflection itself, the fixed point, its derivative, its limits."""

import math

import numpy as np
import pytest
from scipy.integrate import dblquad

import roughcontact as rc
from roughcontact.theory.asperity_models import (
    bush_gibson_thomas as bgt,
    greenwood_williamson as gw,
    interaction,
)

MODULUS, AREA = 2e11, 1e-6
MOMENTS = rc.Moments(1e-12, 0.01, 1e9)
INTERFACES = {
    "gaussian": gw.population(MOMENTS, MODULUS),
    "exponential": gw.population(MOMENTS, MODULUS, distribution="exponential"),
    "summits": bgt.Summits(MOMENTS, MODULUS),
}


def test_mean_deflection_of_a_uniformly_loaded_square():
    # <1/r> over two points of the unit square, by the density (1 - x)(1 - y) of their distances; in polar
    # coordinates, over one of eight wedges.
    mean, _ = dblquad(
        lambda r, a: 8 * (1 - r * math.cos(a)) * (1 - r * math.sin(a)),
        0,
        math.pi / 4,
        0,
        lambda a: 1 / math.cos(a),
    )
    assert pytest.approx(mean / math.pi, rel=1e-10) == interaction.SQUARE
    assert pytest.approx(0.946402, abs=5e-7) == interaction.SQUARE


@pytest.mark.parametrize("name", INTERFACES)
class TestMeanGap:
    def test_solves_its_equation(self, name):
        interface = INTERFACES[name]
        lowest = max(interface.lowest, 0.0)
        sunk = interaction.SQUARE * math.sqrt(AREA) / MODULUS * float(interface.pressure(lowest))
        plane = np.linspace(lowest - 0.999 * sunk, lowest + 6e-6, 40)
        gap = interaction.mean_gap(plane, interface, MODULUS, AREA)
        deflection = interaction.SQUARE * math.sqrt(AREA) / MODULUS * interface.pressure(gap)
        assert gap - deflection == pytest.approx(plane, abs=1e-12 * sunk)
        assert (np.diff(gap) > 0).all()

    def test_without_deflection_the_mean_plane_stays(self, name):
        plane = np.array([3e-6, 4e-6])
        assert (interaction.mean_gap(plane, INTERFACES[name], MODULUS, AREA, deflection=0) == plane).all()


class TestLaw:
    @pytest.mark.parametrize("distribution", ["gaussian", "exponential"])
    @pytest.mark.parametrize("deflection", [0.0, 0.7, interaction.SQUARE])
    def test_stiffness_is_the_slope_of_force_over_the_approach(self, distribution, deflection):
        population = gw.population(MOMENTS, MODULUS, distribution=distribution)
        given = {"distribution": distribution, "deflection": deflection}
        law = interaction.law(MOMENTS, MODULUS, AREA, **given)
        plane, step = np.array([2.5e-6, 3.5e-6]), 1e-10  # a ten-thousandth of the rms height
        gap = interaction.mean_gap(
            np.stack([plane - step, plane, plane + step]), population, MODULUS, AREA, deflection=deflection
        )
        force = AREA * population.pressure(gap)
        # A central difference errs by step^2 F'''/6 F', with t/s of order 4/rms at most: 3e-8.
        assert law.predict("stiffness", force[1]) == pytest.approx(
            (force[0] - force[2]) / (2 * step), rel=5e-8
        )

    def test_compliances_add(self):
        law = interaction.law(MOMENTS, MODULUS, AREA)
        force = np.geomspace(1e-6, law.domain[1], 30)
        k, interface = law.predict("stiffness", force), law.predict("interfacial_stiffness", force)
        assert 1 / k - 1 / interface == pytest.approx(
            np.full(30, interaction.SQUARE / (MODULUS * math.sqrt(AREA))), rel=1e-9
        )

    def test_the_energy_is_the_work_of_the_approach(self):
        law = interaction.law(MOMENTS, MODULUS, AREA)
        force, step = np.geomspace(1e-3, 0.9 * law.domain[1], 5), 1e-5
        work = np.diff(law.predict("elastic_energy", force[:, None] * (1 + step * np.array([-1, 1]))))[:, 0]
        # dU = F dd = F dF/k; a central difference of a smooth function of ln F.
        assert work == pytest.approx(2 * step * force**2 / law.predict("stiffness", force), rel=1e-8)

    def test_area_over_load_is_that_without_interaction(self):
        law, plain = interaction.law(MOMENTS, MODULUS, AREA), gw.law(MOMENTS, MODULUS, AREA)
        force = np.geomspace(1e-3, 10, 5)
        for name in plain.quantities.keys() - {"elastic_energy"}:
            assert (law.predict(name, force) == plain.predict(name, force)).all()

    def test_goes_with_any_theory_of_the_interface(self):
        law = interaction.finite_body(bgt.law(MOMENTS, MODULUS, AREA), MODULUS, AREA)
        assert law.name == "Bush-Gibson-Thomas on a finite body"
        assert law.predict("stiffness", 1.0) < law.predict("interfacial_stiffness", 1.0)


class TestAgainstTheSolver:
    def test_the_compliance_of_rough_squares(self):
        # 1/k - 1/K of computed contacts.
        found = np.empty(4)
        for seed in range(4):
            surface = rc.self_affine(
                rc.Grid((48, 48), 1 / 48, periodic=False),
                hurst=0.8,
                rms=0.003,
                rng=np.random.default_rng(seed),
                short_cutoff=1 / 24,
                rolloff=1 / 8,
            )
            solution = rc.press(surface, 1.0, force=3e-4)
            found[seed] = 1 / solution.stiffness - 1 / solution.interfacial_stiffness
        # Deflections at the corner and at the centre of a uniformly loaded square.
        corner = 2 * math.log(1 + math.sqrt(2)) / math.pi
        assert ((found > corner) & (found < 2 * corner)).all()
        # Contacts spread over the square see its mean, with a scatter of 3 % between surfaces.
        assert found.mean() == pytest.approx(interaction.SQUARE, rel=0.03)


class TestRefusals:
    @pytest.mark.parametrize("name", ["exponential", "summits"])
    def test_a_flat_pushed_too_far(self, name):
        with pytest.raises(ValueError, match="does not hold"):
            interaction.mean_gap(-1.0, INTERFACES[name], MODULUS, AREA)

    def test_deflections(self):
        with pytest.raises(ValueError, match="mean deflection"):
            interaction.law(MOMENTS, MODULUS, AREA, deflection=-0.1)

    def test_laws_of_something_else(self):
        with pytest.raises(ValueError, match="no interfacial stiffness"):
            interaction.finite_body(interaction.LoadingLaw("x", "y", {}), MODULUS, AREA)
