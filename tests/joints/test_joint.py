"""A whole joint against closed forms: integrals over its face, slip, loss, and the scatter of patches."""

import math

import mpmath
import numpy as np
import pytest

import roughcontact as rc
from made_laws import PER_DECADE, exponential_law, power_law, under_shear

A = 0.9
# A cubic through logarithms: by Taylor series, the slope of exp(b x) at steps of h is off by b^2 h^2/12 or less.
INTERPOLATION = ((1 - A) * math.log(10) / PER_DECADE) ** 2 / 12


def rising(n, law=None):
    """Return the joint whose pressure rises along x from 0 to 2 on a face of 1 x 1."""
    p = np.broadcast_to(2 * (np.arange(n) + 0.5) / n, (3, n))
    return rc.joint(law or power_law(), rc.PressureField(p, (1 / 3, 1 / n)))


def moment(power, n):
    """Return the midpoint sum of x^power over n cells from 0 to 1, by its expansion in h."""
    h = 1 / n
    return (
        1 / (power + 1)
        + float(mpmath.zeta(-power, 0.5)) * h ** (power + 1)
        - power * h**2 / 24
        + 7 * power * (power - 1) * (power - 2) * h**4 / 5760
    )


@pytest.mark.parametrize("n", [16, 64, 256])
def test_sums_over_the_face_are_midpoint_sums(n):
    """The next term of the expansion has h^6 and a factor below 1e-3."""
    joint = rising(n)
    weight, first, second = (2**A * moment(A + k, n) for k in range(3))
    near = {"rel": 3 * INTERPOLATION + n**-6}
    assert joint.normal_stiffness == pytest.approx(weight, **near)
    assert joint.centre[0] == pytest.approx(first / weight, **near)
    # It is a difference of two moments, seven times smaller than either.
    assert joint.tilting[0, 0] == pytest.approx(second - first**2 / weight, rel=30 * INTERPOLATION + n**-6)


def test_a_linear_pressure_has_the_stiffness_of_the_closed_form():
    """With 2048 cells, the midpoint sums are off by 1e-7."""
    joint = rising(2048)
    assert joint.normal_stiffness == pytest.approx(0.9821399911, abs=1e-6)
    assert joint.centre == pytest.approx((0.6551724138, 0.5), abs=1e-6)
    assert joint.tilting[0, 0] == pytest.approx(0.0568939902, abs=1e-6)
    # Along y, K is constant: 1/12 less a ninth of it for three cells.
    assert joint.tilting[1, 1] == pytest.approx(0.9821399911 / 12 * (1 - 1 / 9), abs=1e-6)
    assert joint.tilting[0, 1] == joint.tilting[1, 0] == pytest.approx(0, abs=1e-12)


def test_even_pressure():
    """The midpoint sum of x^2 is 1/12 (1 - h^2)."""
    joint = rc.joint(power_law(), rc.PressureField(np.ones((10, 20)), (0.1, 0.05)))
    assert joint.normal_stiffness == pytest.approx(1, rel=2 * INTERPOLATION)
    assert joint.centre == pytest.approx((0.5, 0.5))
    expected = np.diag([1 - 0.05**2, 1 - 0.1**2]) / 12
    np.testing.assert_allclose(joint.tilting, expected, atol=2 * INTERPOLATION)


def test_tilting_is_that_of_a_slope():
    """The moments of K times a slope of the closing about the centre, summed by hand on a skew field."""
    p = np.outer([1.0, 3.0, 2.0], [0.5, 1.0, 0.25, 0.0]) / 3
    p[0, 0] = np.nan
    joint = rc.joint(power_law(), rc.PressureField(p, (0.1, 0.2)))
    y, x = np.meshgrid([0.05, 0.15, 0.25], [0.1, 0.3, 0.5, 0.7], indexing="ij")
    k = np.nan_to_num(p) ** A * 0.02
    along = np.stack([x - (k * x).sum() / k.sum(), y - (k * y).sum() / k.sum()])
    slopes = np.array([1e-3, -2e-3])
    moments = (along * k * np.tensordot(slopes, along, 1)).sum(axis=(1, 2))
    np.testing.assert_allclose(joint.tilting @ slopes, moments, rtol=1e-5)
    assert abs(joint.tilting[0, 1]) > 1e-6


def test_torsion_of_an_even_ring():
    """K/C pi/2 (r2^4 - r1^4); cells along the rims are whole or left out, at most half a cell in the mean."""
    n, inner, outer = 200, 0.2, 0.45
    grid = rc.Grid((n, n), 1 / n)
    radius = np.hypot(*np.meshgrid(*(each - 0.5 for each in grid.coordinates)))
    p = np.where((radius > inner) & (radius < outer), 2.0, 0.0)
    joint = rc.joint(under_shear(power_law()), rc.PressureField(p, grid))
    sum_ = (p**A * radius**2).sum() / n**2
    assert joint.torsional_stiffness == pytest.approx(sum_, rel=2 * INTERPOLATION)
    ring = 2**A * math.pi / 2 * (outer**4 - inner**4)
    rims = 2**A * 2 * math.pi * (outer**3 + inner**3) / (2 * n)
    assert joint.torsional_stiffness == pytest.approx(ring, abs=rims)
    assert joint.torsional_stiffness == pytest.approx(ring, rel=1e-2)


def test_conductance_adds_up_and_is_that_of_the_stiffness():
    whole = np.outer([1.0, 2.0], [1.0, 0.5, 2.0])
    halves = whole.copy(), whole.copy()
    halves[0][:, :1] = halves[1][:, 1:] = np.nan
    found = [
        rc.joint(power_law(), rc.PressureField(p, 0.1)).conductance(
            conductivities=(50.0, 100.0), resistivities=(1e-8, 3e-8)
        )
        for p in (whole, *halves)
    ]
    for name in ("thermal_conductance", "electrical_conductance"):
        assert found[0][name] == pytest.approx(found[1][name] + found[2][name], rel=1e-12)
    # K/E* times the harmonic mean of the conductivities
    stiffness = (whole**A).sum() * 0.01
    assert found[0]["thermal_conductance"] == pytest.approx(stiffness / 1e9 * 200 / 3, rel=1e-6)


def test_an_exponential_law_slips_alike_under_any_field():
    """Q = mu P (1 - exp(-s/(mu C l))); its gap is linear in ln p, where the cubic is exact."""
    joint = rising(64, under_shear(exponential_law()))
    s = np.array([1e-4, 1e-2, 5e-2])
    expected = 0.3 * -np.expm1(-s / (0.3 * 0.1))
    # Where a cell holds less than the lowest load of the law, it slides: mu times this load and the area.
    np.testing.assert_allclose(joint.shear_force(s), expected, rtol=1e-6, atol=0.3e-6)
    assert joint.shear_force(0.0) == pytest.approx(0, abs=1e-12)
    assert joint.shear_force(10.0) == pytest.approx(joint.gross_slip_force) == pytest.approx(0.3)


@pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
def test_the_loss_of_an_exponential_law(share):
    """W = 4 mu^2 C l P (-(2 - f) ln(1 - f) - 2 f) with f = 1 - exp(-s/(mu C l)), and zeta = W/(2 pi Q s)."""
    joint = rising(64, under_shear(exponential_law()))
    s = -0.03 * math.log1p(-share)
    loss = 4 * 0.09 * 0.1 * (-(2 - share) * math.log1p(-share) - 2 * share)
    # Cells that hold less than the lowest load of 1e-6: the same part of the loss.
    assert joint.loss(s) == pytest.approx(loss, rel=1e-5)
    expected = {0.1: 0.0111770302, 0.5: 0.0729629400, 0.9: 0.2251299245}
    assert joint.damping(s) == pytest.approx(expected[share], rel=1e-5)


@pytest.mark.parametrize("part", [0.05, 0.3, 0.95, 1.5])
def test_even_pressure_slips_as_the_law_and_loses_as_much(part):
    """By quadrature: the backbone has a kink at gross slip, 1e-3 with 64 nodes."""
    law = under_shear(power_law(0.5))
    joint = rc.joint(law, rc.PressureField(np.full((2, 3), 2.0), 0.1))
    s = part * float(law.gross_slip(2.0))
    assert joint.shear_force(s) == pytest.approx(0.06 * law.traction(s, 2.0), rel=1e-12)
    assert joint.loss(s) == pytest.approx(0.06 * law.loss(2.0, displacement=s), rel=1e-3)
    assert joint.shear_stiffness == pytest.approx(0.06 * law.stiffness(2.0), rel=1e-12)


def test_without_friction_there_is_no_shear():
    joint = rising(8)
    assert all(map(math.isnan, (joint.shear_stiffness, joint.torsional_stiffness, joint.gross_slip_force)))
    with pytest.raises(rc.InputError, match="this joint has no friction"):
        joint.shear_force(1e-3)
    assert repr(joint) == "Joint(1 N, normal 983 mN/m)"
    sheared = rising(8, under_shear(power_law()))
    assert repr(sheared) == "Joint(1 N, normal 983 mN/m, shear 983 mN/m)"


def test_a_small_amplitude_moves_only_single_cells():
    coarse = under_shear(power_law(cells=100.0))
    joint = rising(16, coarse)
    with pytest.raises(rc.InputError, match=r"below 0\.1 of that of gross slip, only single cells"):
        joint.loss(1e-3)
    assert rising(16, coarse.fitted).loss(1e-3) > 0


def test_cells_without_pressure_and_below_the_law_are_left_out():
    p = np.array([[0.0, np.nan, 1e-7, 2.0], [1.0, 1.0, 1e-5, 0.0]])
    joint = rc.joint(exponential_law(), rc.PressureField(p, 0.1))
    assert joint.field.face_area == pytest.approx(0.07)
    assert joint.loaded_area == pytest.approx(0.04)
    assert joint.left_out_area == pytest.approx(0.03)
    assert joint.left_out_force == pytest.approx(1e-9)
    np.testing.assert_array_equal(joint.loaded, [[0, 0, 0, 1], [1, 1, 1, 0]])
    np.testing.assert_allclose(
        joint.stiffness_per_area, [[0, np.nan, 0, 20], [10, 10, 1e-4, 0]], rtol=1e-7, atol=0
    )
    assert any(
        "lowest load of the law, are left out. They carry 2.5e-06 % of the force" in each
        for each in joint.notes
    )
    whole = rc.joint(power_law(), rc.PressureField(p, 0.1))  # first touch is known: the law begins at 0
    assert whole.loaded_area == pytest.approx(0.05)
    assert whole.left_out_force == 0
    assert not any("are left out" in each for each in whole.notes)


def test_pressure_that_changes_over_a_few_waves_is_noted():
    """p/|grad p| = x: it is less than three waves on x < 3 w, to half a cell of 1/600."""
    n, wave = 600, 0.03
    p = np.broadcast_to((np.arange(n) + 0.5) / n, (2, n))
    field = rc.PressureField(p, (0.5, 1 / n))
    joint = rc.joint(power_law(), field, longest_wave=wave)
    assert joint.steep_share == pytest.approx(3 * wave, abs=1 / n)
    assert any("% of the loaded area, the pressure changes by its own value" in each for each in joint.notes)
    even = rc.joint(power_law(), rc.PressureField(np.ones((2, n)), (0.5, 1 / n)), longest_wave=wave)
    assert even.steep_share == 0
    assert even.notes == ()
    unknown = rc.joint(power_law(), field)
    assert math.isnan(unknown.steep_share)
    assert unknown.notes == ("The longest wave of the roughness is not given: it is not known whether the law holds on "
                             "the face.",)  # fmt: skip


def test_the_rim_of_an_open_face_is_steep_and_that_of_a_hole_is_not():
    p = np.ones((40, 60))
    p[:, :20] = np.nan
    hole = rc.joint(power_law(), rc.PressureField(p, 0.1), longest_wave=0.1)
    assert hole.steep_share == 0
    open_ = rc.joint(power_law(), rc.PressureField(np.nan_to_num(p), 0.1), longest_wave=0.1)
    # A square of three cells: one column of forty.
    assert open_.steep_share == pytest.approx(1 / 40)


def test_a_joint_that_has_flowed_says_so():
    grid = rc.Grid((32, 32), 1e-6, periodic=True)
    surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, rolloff=1.6e-5, short_cutoff=4e-6)
    field = rc.PressureField(np.full((2, 2), 5e6), 1e-3)
    loop = rc.loading_loop(surface, 1e9, hardness=3e7, pressures=field.loads)
    joint = rc.joint(rc.normal_law(loop), field)
    assert any("counts as pressed before by the largest load" in each for each in joint.notes)
    elastic = rc.joint(rc.normal_law(rc.loading_curve(surface, 1e9, pressures=field.loads)), field)
    assert not any("counts as pressed" in each for each in elastic.notes)
    assert joint.normal_stiffness > elastic.normal_stiffness


def test_notes_of_the_law_under_shear_are_passed_on():
    steel = rc.Solid(2e11, 0.3)
    law = rc.ShearLaw(power_law(), 0.3, 1.2, (steel, steel))
    assert law.notes
    assert set(law.notes) < set(rising(8, law).notes)


def test_the_standard_error_of_several_patches():
    scales = np.array([1.0, 1.2, 0.9])
    laws = [under_shear(power_law(scale=each, map_area=0.02)) for each in scales]
    p = np.array([[1.0, 1.0, 0.0], [1.0, 1.0, np.nan]])
    joint = rc.joint(laws, rc.PressureField(p, 0.5))
    assert joint.normal_stiffness == pytest.approx(scales.mean(), rel=1e-6)
    # A loaded area of 1 has 50 patches of 0.02.
    error = scales.std(ddof=1) * math.sqrt(1 / 50 + 1 / 3)
    for name in ("normal_stiffness", "shear_stiffness"):
        assert joint.standard_error(name) == pytest.approx(error, rel=1e-6)
    np.testing.assert_allclose(
        joint.standard_error("tilting"), joint.tilting * error / scales.mean(), atol=1e-9
    )
    one = rc.joint(laws[0], rc.PressureField(p, 0.5))
    assert math.isnan(one.standard_error("normal_stiffness"))
    assert np.isnan(one.standard_error("tilting")).all()


def test_the_scatter_of_patches_falls_as_the_root_of_their_area_at_high_load_only():
    """Maps of A and 4 A, 60 of each: the ratio of their scatters has a standard error of 1/sqrt(59) = 13 %.

    In the mean of all 60, the lowest load is carried by less than 1 in 1000 cells, where the highest summit decides.
    """
    loads, scatter = [1e4, 5e6], []
    for n in (32, 64):
        found = []
        for k in range(60):
            grid = rc.Grid((n, n), 1e-6, periodic=True)
            surface = rc.self_affine(
                grid,
                hurst=0.8,
                rms=1e-7,
                rng=(7, n, k),
                rolloff=8e-6,
                short_cutoff=4e-6,
                amplitudes="gaussian",
            )
            found.append(rc.loading_curve(surface, 1e9, pressures=loads).interfacial_stiffness_per_area)
        scatter.append(np.std(found, axis=0, ddof=1) / np.mean(found, axis=0))
    low, high = scatter[0] / scatter[1]
    error = 1 / math.sqrt(59)
    assert abs(math.log(high / 2)) < 2 * error
    assert math.log(low / 2) < -2 * error
