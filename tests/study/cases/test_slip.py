"""The case of contacts that are pulled until they slide."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.study.cases import find_case
from roughcontact.study.cases.slip_case import CASE, SlipParameters
from roughcontact.study.study_errors import StudyError
from study.cases.pure import pure_record

ROUGH = {"points": 32, "size": 2e-3, "modulus": 1e11, "hurst": 0.7, "rms": 1e-6, "loads": 3, "pulls": 4}


def run(seed=0, **given):
    return CASE.run(SlipParameters(**(ROUGH | given)), np.random.default_rng(seed))


def surface(seed=0):
    return rc.self_affine(rc.Grid((32, 32), 2e-3 / 32), 0.7, 1e-6, np.random.default_rng(seed))


def test_it_comes_with_the_package():
    assert find_case("slip") is CASE


def test_the_two_bodies_have_the_modulus_together():
    for nu in (-0.5, 0.0, 0.5):
        bodies = SlipParameters(**ROUGH, poisson_ratio=nu).bodies
        assert rc.reduced_modulus(*bodies) == pytest.approx(1e11, rel=1e-14)
        assert bodies[0] == bodies[1]
        assert bodies[0].poisson_ratio == nu


def test_it_is_pure_and_survives_as_text():
    one = pure_record(run)
    assert (one["status"] == "converged").all()
    assert float(one["residual"].max()) <= 1e-6


@pytest.mark.parametrize("nu", [0.0, 0.3])
def test_a_sphere_slips_as_cattaneo_and_mindlin_say(nu):
    # A paraboloid with next to no roughness on it; d is 1e-2 of the radius of the contact.
    radius, mu, load = 0.5, 0.2, np.geomspace(3e-4, 3e-3, 3)
    record = run(
        points=65,
        size=1.0,
        modulus=1.0,
        rms=1e-9,
        radius=radius,
        poisson_ratio=nu,
        friction=mu,
        lowest_force=load[0] / 1e-9,
        highest_force=load[-1] / 1e-9,
        pulls=5,
    )
    contact_radius = (3 * load * radius / 4) ** (1 / 3)
    depth, ratio = contact_radius**2 / radius, (2 - nu) / (2 * (1 - nu))
    np.testing.assert_allclose(record["force"], load, rtol=1e-9)
    # A disc of 8 to 17 cells across: depth and stiffness to a few per cent, their ratios far better.
    np.testing.assert_allclose(record["depth"], depth, rtol=0.01)
    np.testing.assert_allclose(record["stiffness"], 2 * contact_radius, rtol=0.08)
    np.testing.assert_allclose(record["stiffness"] / record["tangential_stiffness"], ratio, rtol=1e-3)
    pulled = record["pulled"].to_numpy()
    np.testing.assert_allclose(pulled, [0.2, 0.4, 0.6, 0.8, 1.0], rtol=1e-15)
    moved = (record["tangential_displacement"] / (mu * ratio * record["depth"])).to_numpy()
    expected = 1 - (1 - pulled) ** (2 / 3)
    # At Q = mu F the last cell to slip lies at the middle, whose pressure is that of a whole cell.
    np.testing.assert_allclose(moved, np.broadcast_to(expected, moved.shape), atol=0.02)
    stick = (record["stick_area"] / record["contact_area"]).to_numpy()
    # One ring of cells more or less, at a radius of c: 2 pi c of them.
    cells = (np.pi * contact_radius**2 * 65**2)[:, None]
    np.testing.assert_allclose(
        stick, np.broadcast_to((1 - pulled) ** (2 / 3), stick.shape), atol=(2 / np.sqrt(cells / np.pi)).max()
    )
    assert (stick[:, -1] == 0).all()


def test_without_poissons_ratio_the_way_is_that_of_the_normal_curve():
    record = run(poisson_ratio=0.0, friction=0.4, tolerance=1e-8)
    np.testing.assert_allclose(record["tangential_stiffness"], record["stiffness"], rtol=1e-8)
    np.testing.assert_allclose(
        record["principal_stiffness"].isel(principal=0), record["stiffness"], rtol=1e-8
    )
    shape, depth = surface(), record["depth"].to_numpy()
    for load, force in enumerate(record["force"].to_numpy()):
        for pull, part in enumerate(record["pulled"].to_numpy()[:-1]):
            held = rc.press(shape, 1e11, force=force * (1 - part)).depth
            moved = float(record["tangential_displacement"][load, pull])
            # Both certificates are parts of a displacement near the depth itself.
            assert moved == pytest.approx(0.4 * (depth[load] - held), abs=1e-6 * depth[load])
        assert float(record["tangential_displacement"][load, -1]) == pytest.approx(
            0.4 * depth[load], rel=1e-6
        )


@pytest.mark.parametrize("nu", [0.3, 0.5])
def test_stiffnesses_lie_between_those_of_both_directions(nu):
    record = run(poisson_ratio=nu)
    # (kappa X + Y) of Cerruti lies between X + Y and kappa (X + Y), kappa = 1/(1 - nu), and so does the stiffness.
    ratio = record["stiffness"] / record["principal_stiffness"]
    assert (ratio >= 1).all()
    assert (ratio <= 1 / (1 - nu)).all()
    low, high = (record["principal_stiffness"].isel(principal=i) for i in (0, 1))
    assert (low <= high).all()
    np.testing.assert_allclose(record["tangential_stiffness"], (low + high) / 2, rtol=1e-15)
    assert (np.diff(record["tangential_displacement"], axis=1) > 0).all()
    assert (np.diff(record["stick_area"], axis=1) <= 0).all()
    assert (record["stick_area"].isel(pull=-1) == 0).all()


def test_everything_tangential_is_in_proportion_to_friction():
    one, other = run(friction=0.1), run(friction=1.0)
    np.testing.assert_allclose(
        10 * one["tangential_displacement"], other["tangential_displacement"], rtol=2e-5
    )
    np.testing.assert_array_equal(one["tangential_stiffness"], other["tangential_stiffness"])


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ({"poisson_ratio": 0.6}, "less than or equal to 0.5"),
        ({"poisson_ratio": -1.0}, "greater than -1"),
        ({"friction": 0.0}, "greater than 0"),
        ({"pulls": 0}, "greater than or equal to 1"),
        ({"highest_force": 1e-4}, "lowest_force must be below highest_force"),
        ({"hardness": 1.0}, "there is no 'hardness'"),
    ],
)
def test_what_makes_no_sense_is_refused(wrong, says):
    with pytest.raises(StudyError, match=says):
        run(**wrong)
