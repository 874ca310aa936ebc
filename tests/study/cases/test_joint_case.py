"""The case of periodic pieces of joints, in numbers without units."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.study.cases.joint_case import CASE, JointParameters
from roughcontact.study.study_errors import StudyError

GIVEN = {"hurst": 0.8, "side": 2.0, "band": 2.0, "points": 24, "loads": 4, "lowest_pressure": 0.05}


def run(seed=0, **given):
    return CASE.run(JointParameters(**(GIVEN | given)), np.random.default_rng(seed))


def test_numbers_are_those_of_a_joint_in_any_units():
    """Heights, lengths and modulus scale out of an elastic contact."""
    record = run(seed=3, draw=5)
    rolloff, rms, modulus = 40e-6, 2e-7, 70e9
    surface = rc.self_affine(
        rc.Grid((24, 24), 2 * rolloff / 24, periodic=True),
        0.8,
        rms,
        np.random.default_rng(3).spawn(6)[-1],
        rolloff=rolloff,
        short_cutoff=rolloff / 2,
        amplitudes="gaussian",
    )
    pressures = record["pressure"].to_numpy() * modulus * rms / rolloff
    curve = rc.loading_curve(surface, modulus, pressures=pressures)
    stiffness = curve.interfacial_stiffness_per_area * rolloff / modulus
    np.testing.assert_allclose(record["stiffness_per_area"], stiffness, rtol=1e-6)
    np.testing.assert_allclose(record["fraction"], curve.contact_fraction, rtol=1e-14)  # a quotient of areas
    assert bool(record["converged"])


def test_draws_and_samples_are_other_surfaces():
    found = [
        run(**each)["stiffness_per_area"].to_numpy()
        for each in ({"draw": 0}, {"draw": 1}, {"seed": 1}, {"draw": 0})
    ]
    for other in found[1:3]:
        assert (found[0] != other).all()
    np.testing.assert_array_equal(found[0], found[3])


def test_pressures_above_half_of_the_hardness_are_left_out():
    record = run(hardness=1.0)
    applied = record["pressure"] <= 0.5
    assert 0 < int(applied.sum()) < 4
    for name in ("stiffness_per_area", "fraction"):
        np.testing.assert_array_equal(np.isfinite(record[name]), applied)
    softer = record["fraction"].to_numpy() > run()["fraction"].to_numpy()
    assert softer[applied].all()


def test_a_wave_takes_six_cells():
    JointParameters(**GIVEN)
    with pytest.raises(StudyError, match="points must be at least 25"):
        JointParameters(**(GIVEN | {"band": 2.01}))
    with pytest.raises(StudyError, match="lowest_pressure must be below"):
        JointParameters(**(GIVEN | {"highest_pressure": 0.05}))
