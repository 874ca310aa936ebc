"""The finite-size crossover: a heuristic, so its limits and its trend, and computed contacts within a factor."""

import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.theory.persson_theory import persson, persson_separation
from roughcontact.theory.random_surfaces.waves import Waves
from roughcontact.theory.stiffness_laws import finite_size
from roughcontact.theory.stiffness_laws.finite_size import Cell

MODULUS = 1e11
SPECTRUM = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-3, rolloff=1e-4, short_cutoff=1e-6).scaled(1e-6)
CELL = Cell(0.8, 1e-6, 1e-4)


def test_cell_is_the_power_law_of_the_thesis():
    scale = MODULUS * 1e-6 * 1e-4
    assert CELL.stiffness(0.01 * scale, MODULUS) / (MODULUS * 1e-4) == pytest.approx(
        1.7 / 1.8 * 0.01 ** (1 / 1.8), rel=1e-14
    )
    assert Cell(0.8, 1e-6, 1e-4, 2.0).stiffness(scale, MODULUS) == pytest.approx(
        2 * MODULUS * 1e-4, rel=1e-14
    )


def test_both_laws_meet_at_the_crossover():
    u0 = persson_separation.decay_length(SPECTRUM)
    force = CELL.crossover_force(MODULUS, u0)
    assert CELL.stiffness(force, MODULUS) == pytest.approx(force / u0, rel=1e-12)


def test_crossover_of_an_unrestricted_surface_lies_next_to_full_contact():
    # Section 8.4: about 0.17 of E* h L at H = 0.7, with u0 = 0.45 * 1.11 h.
    cell = Cell(0.7, 1.0, 1.0)
    assert cell.crossover_force(1.0, 0.45 * 1.11) == pytest.approx(0.185, abs=0.02)


def test_law_is_the_stiffer_of_both():
    area = 1e-6
    law = finite_size.law(CELL, SPECTRUM, MODULUS, area)
    linear = persson.law(SPECTRUM, MODULUS, area)
    meeting = CELL.crossover_force(MODULUS, persson_separation.decay_length(SPECTRUM))
    low, high = meeting * np.geomspace(1e-6, 0.5, 5), meeting * np.geomspace(2, 1e3, 5)
    assert law.predict("interfacial_stiffness", low) == pytest.approx(CELL.stiffness(low, MODULUS), rel=1e-14)
    assert law.predict("interfacial_stiffness", high) == pytest.approx(
        linear.predict("interfacial_stiffness", high), rel=1e-14
    )


def test_crossover_pressure_falls_with_the_nominal_area():
    # The force of a cell stays as it is.
    u0 = persson_separation.decay_length(SPECTRUM)
    force = CELL.crossover_force(MODULUS, u0)
    for area in (1e-8, 1e-4):
        law = finite_size.law(CELL, SPECTRUM, MODULUS, area)
        below, above = law.predict("interfacial_stiffness", force * np.array([0.5, 4.0]))
        assert below == pytest.approx(float(CELL.stiffness(0.5 * force, MODULUS)), rel=1e-14)
        assert above > 1.5 * CELL.stiffness(4 * force, MODULUS)


def test_computed_contacts_cross_over():
    # Four cells a side of 24 grid cells each, three samples: a trend, no measurement.
    grid, area, rms = rc.Grid((96, 96), 1 / 96, periodic=True), 1.0, 0.01
    cell = Cell(0.8, rms, 0.25)
    forces = np.geomspace(3e-3, 1.0, 4) * rms
    curves = []
    for seed in range(3):
        surface = rc.self_affine(
            grid,
            hurst=0.8,
            rms=rms,
            rng=np.random.default_rng(seed),
            rolloff=0.25,
            short_cutoff=1 / 24,
        )
        curves.append(rc.loading_curve(surface, 1.0, forces=forces).interfacial_stiffness)
    waves = Waves.of_heights(surface.heights, grid.spacing)
    computed = np.mean(curves, axis=0)
    predicted = finite_size.law(cell, waves, 1.0, area).predict("interfacial_stiffness", forces)
    linear = persson.law(waves, 1.0, area).predict("interfacial_stiffness", forces)
    # A factor of two each way: the prefactors are not claimed, and three samples scatter by a fifth.
    assert (np.abs(np.log(computed / predicted)) < math.log(2)).all()
    assert computed[0] > 2 * linear[0]
    assert computed[-1] == pytest.approx(linear[-1], rel=0.3)


def test_bad_input_is_refused():
    with pytest.raises(ValueError, match="Hurst exponents above 0"):
        Cell(2.5, 1.0, 1.0)
    with pytest.raises(ValueError, match="rms height"):
        Cell(0.8, 0.0, 1.0)
    with pytest.raises(ValueError, match="prefactor"):
        Cell(0.8, 1.0, 1.0, -1.0)
    with pytest.raises(ValueError, match="larger than the nominal area"):
        finite_size.law(CELL, SPECTRUM, MODULUS, 1e-9)
    with pytest.raises(ValueError, match="decay length"):
        CELL.crossover_force(MODULUS, 0.0)
