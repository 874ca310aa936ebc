"""Thesis, section 3.2: the sign of the interfacial stiffness, and when the energy against the mean gap is right."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.theory.persson_theory import persson_separation


def printed_stiffness(pressure, gap, area):
    """K = A0 dp/du, below eq. 3.16, by differences."""
    return area * np.diff(pressure) / np.diff(gap)


def rough(periodic):
    grid = rc.Grid((32, 32), 1 / 32, periodic=periodic)
    return rc.self_affine(grid, hurst=0.8, rms=0.01, rng=np.random.default_rng(4), short_cutoff=1 / 8)


def near(force, step=1e-4):
    return force * np.array([1 - step, 1, 1 + step])


class TestStiffness:
    def test_3_16_stiffness_against_the_mean_gap_is_positive(self):
        curve = rc.loading_curve(rough(True), 1.0, forces=near(3e-3, 1e-2))
        printed = printed_stiffness(curve.force, curve.mean_gap, 1.0)
        assert (printed < 0).all()
        # The force is convex in the gap: a secant lies between the tangents at its ends, here to the solver's 1e-8
        # over the step of 1e-2.
        tangents = curve.interfacial_stiffness
        assert (tangents[:-1] <= -printed * (1 + 1e-6)).all()
        assert (-printed <= tangents[1:] * (1 + 1e-6)).all()

    def test_3_16_in_persson_s_theory(self):
        spectrum = rc.SelfAffineSpectrum(0.8, long_cutoff=1.0, short_cutoff=1e-2).scaled(0.01)
        p = near(1e-3)
        gap = persson_separation.mean_gap(p, 1.0, spectrum)
        printed = printed_stiffness(p[::2], gap[::2], 1.0)[0]
        # A central difference of step 1e-4.
        assert persson_separation.stiffness(p[1], 1.0, spectrum) == pytest.approx(-printed, rel=1e-6)


class TestEnergy:
    """The remark below eq. 3.16, that 3.12 and 3.13 are not correct, holds for finite bodies only."""

    @pytest.mark.parametrize("force", [1e-4, 1e-2])
    def test_3_13_is_exact_for_a_periodic_body(self, force):
        curve = rc.loading_curve(rough(True), 1.0, forces=near(force), tolerance=1e-11)
        energy, gap = curve.elastic_energy, curve.mean_gap
        # Central difference of step 1e-4, of pressures solved to 1e-11.
        assert -(energy[2] - energy[0]) / (gap[2] - gap[0]) == pytest.approx(force, rel=1e-5)

    @pytest.mark.parametrize("force", [1e-3, 1e-2])
    def test_3_17_is_exact_for_a_finite_body_and_3_13_is_not(self, force):
        curve = rc.loading_curve(rough(False), 1.0, forces=near(force), tolerance=1e-11)
        energy = curve.elastic_energy
        assert (energy[2] - energy[0]) / (curve.depth[2] - curve.depth[0]) == pytest.approx(force, rel=1e-5)
        assert -(energy[2] - energy[0]) / (curve.mean_gap[2] - curve.mean_gap[0]) > 1.1 * force
