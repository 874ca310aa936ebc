"""Curves: identities between their columns, which hold whatever the surface."""

import math
from dataclasses import replace

import numpy as np
import oracles
import pytest

import roughcontact as rc


def rough(n=96, hurst=0.8, seed=0, periodic=False):
    return rc.self_affine(rc.Grid((n, n), 1 / n, periodic), hurst, 0.01, np.random.default_rng(seed))


CASES = [
    {"hurst": 0.8},
    {"hurst": 0.2, "seed": 1},
    {"hurst": 1.6, "seed": 2},
    {"hurst": 0.8, "seed": 3, "periodic": True},
]


@pytest.fixture(params=CASES, ids=str, scope="module")
def curve(request):
    return rc.loading_curve(rough(**request.param), 1.0, forces=np.geomspace(1e-6, 2e-2, 60), tolerance=1e-10)


def test_every_point_is_certified(curve):
    assert (curve.residual <= 1e-10).all()
    assert (curve.stiffness_residual <= 1e-7).all()
    assert set(curve.status) == {rc.Status.CONVERGED}
    np.testing.assert_allclose(curve.force, np.geomspace(1e-6, 2e-2, 60), rtol=1e-10)


def test_tangents_bound_the_secants(curve):
    """F is convex in d: k1 <= dF/dd <= k2 between neighbours (1e-6: the depths' own certificates)."""
    k, secant = curve.stiffness, curve.secant_stiffness
    assert (k[:-1] <= secant * (1 + 1e-6)).all()
    assert (secant <= k[1:] * (1 + 1e-6)).all()
    assert (np.diff(k) >= -1e-7 * k[1:]).all()


def test_work_becomes_energy(curve):
    """dU = F dd exactly (thesis, eq. 3.17): between the rectangles below and above F(d)."""
    work = np.diff(curve.elastic_energy)
    step = np.diff(curve.depth)
    slack = 1e-8 * curve.elastic_energy[1:]
    assert (curve.force[:-1] * step <= work + slack).all()
    assert (work <= curve.force[1:] * step + slack).all()


def test_work_becomes_energy_in_the_limit():
    """The trapezoid of F over d between two loads 1e-3 apart, to the square of that."""
    near = rc.loading_curve(rough(), 1.0, forces=[1e-3, 1.001e-3], tolerance=1e-12)
    work = 0.5 * near.force.sum() * np.diff(near.depth)[0]
    assert np.diff(near.elastic_energy)[0] == pytest.approx(work, rel=1e-6)


def test_bounds_between_the_two_stiffnesses(curve):
    """E* L (1/k - 1/K) lies between 0.56110 and 1.12220 on a free square; on a periodic one k = K."""
    if all(curve.periodic):
        np.testing.assert_allclose(curve.interfacial_stiffness, curve.stiffness, rtol=1e-12)
        return
    difference = 1 / curve.stiffness - 1 / curve.interfacial_stiffness
    low, high = 2 * math.log(1 + math.sqrt(2)) / math.pi, 4 * math.log(1 + math.sqrt(2)) / math.pi
    assert (difference > low).all()
    assert (difference < high).all()


def test_the_interfacial_stiffness_is_the_slope_of_the_gap(curve):
    """-dF/d(mean gap) between neighbours lies between the two values (1e-6: the certificates of the gaps)."""
    K = curve.interfacial_stiffness
    slope = -np.diff(curve.force) / np.diff(curve.mean_gap)
    assert (slope < K[1:] * (1 + 1e-6)).all()
    assert (slope > K[:-1] * (1 - 1e-6)).all()


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("solver", [rc.ActiveSet(), rc.ActiveSet(dense_limit=0), rc.PolonskyKeer()], ids=repr)
def test_stiffness_is_the_derivative(periodic, solver):
    """Central difference over a step in which the contact set does not change: 1e-5."""
    surface = rough(64, periodic=periodic)
    here = rc.press(surface, 1.0, force=2e-3, tolerance=1e-12, solver=solver)
    step = 1e-6 * here.depth
    low, high = (
        rc.press(surface, 1.0, depth=here.depth + s, tolerance=1e-12, solver=solver) for s in (-step, step)
    )
    np.testing.assert_array_equal(low.contact, high.contact)
    assert (high.force - low.force) / (2 * step) == pytest.approx(here.stiffness, rel=1e-5)
    gap = (high.mean_gap - low.mean_gap) / (2 * step)
    assert -(high.force - low.force) / (2 * step) / gap == pytest.approx(here.interfacial_stiffness, rel=1e-5)


def test_force_is_the_integral_of_stiffness():
    """Thesis, eq. 4.9, for Hertz: k = 2 E* a at each depth."""
    n = 97
    surface = rc.Surface(oracles.paraboloid(n, 1.0), rc.Grid((n, n), 1 / n))
    depths = np.linspace(0.002, 0.16, 40)
    curve = rc.loading_curve(surface, 1.0, depths=depths)
    np.testing.assert_array_equal(curve.depth, depths)
    a = np.sqrt(depths)
    large = a * n > 15  # the staircase of the rim: some dx/a
    np.testing.assert_allclose(curve.stiffness[large], 2 * a[large], rtol=0.01)
    np.testing.assert_allclose(curve.force[large], 4 / 3 * a[large] ** 3, rtol=2e-3)


def test_a_path_is_the_curve_point_by_point():
    surface = rough(48)
    forces = [1e-5, 1e-4, 1e-3]
    curve = rc.loading_curve(surface, 1.0, forces=forces)
    for i, solution in enumerate(rc.loading_path(surface, 1.0, forces=forces)):
        alone = rc.press(surface, 1.0, force=forces[i])
        assert solution.force == curve.force[i]
        assert solution.stiffness == curve.stiffness[i] == pytest.approx(alone.stiffness, rel=1e-6)
        assert solution.depth == pytest.approx(alone.depth, rel=1e-7)
        assert curve.mean_gap[i] == pytest.approx(np.mean(solution.gap), rel=1e-9)
        assert curve.spots[i] == alone.spots.count
        u = oracles.displacement(surface.grid, 1.0, solution.pressure)
        energy = 0.5 * (u * solution.pressure).sum() * surface.grid.cell_area
        assert curve.elastic_energy[i] == pytest.approx(energy, rel=1e-7)


def test_curve_through_full_contact_of_a_periodic_surface():
    curve = rc.loading_curve(rough(32, hurst=1.5, periodic=True), 1.0, forces=[1e-4, 1e-2, 1.0, 2.0, 100.0])
    assert np.isinf(curve.stiffness[-2:]).all()
    assert curve.depth[-1] == pytest.approx(curve.depth[-2], rel=1e-7)
    assert curve.full_contact_stiffness == np.inf
    assert not curve.resolved[-2:].any()


def test_resolution_limits():
    surface = rough(64)
    curve = rc.loading_curve(surface, 1.0, forces=np.geomspace(1e-7, 10, 50))
    single = rc.contact_stiffness(np.eye(1, 64 * 64, 99, dtype=bool).reshape(64, 64), surface.grid, 1.0)
    full = rc.contact_stiffness(np.ones((64, 64), bool), surface.grid, 1.0)
    assert curve.cell_stiffness == pytest.approx(single, rel=1e-12)
    assert curve.full_contact_stiffness == pytest.approx(full, rel=1e-3)
    k = curve.stiffness
    np.testing.assert_array_equal(
        curve.resolved, (k >= 20 * single) & (k < 0.9 * curve.full_contact_stiffness)
    )
    assert 0 < curve.resolved.sum() < len(curve)


def test_fit_of_hertz():
    """Paraboloid: k ~ F^(1/3), k = (6 R E*^2 F)^(1/3)."""
    n = 129
    surface = rc.Surface(oracles.paraboloid(n, 1.0), rc.Grid((n, n), 1 / n))
    a = np.linspace(0.15, 0.45, 25)
    curve = rc.loading_curve(surface, 1.0, forces=4 / 3 * a**3)
    law = curve.fit(window=(0.0, 1.0))
    assert law.count == 25
    assert law.exponent == pytest.approx(1 / 3, abs=0.005)
    assert law.scatter < 0.005
    np.testing.assert_allclose(law.stiffness(curve.force), 2 * a, rtol=0.01)
    expected = (6 * surface.rms / 1.0) ** (1 / 3)  # k/(E* L) over (F/(E* h L))^(1/3) with R = L = 1
    assert law.prefactor == pytest.approx(expected, rel=0.02)


def test_a_load_on_the_limit_belongs_to_the_window():
    curve = rc.loading_curve(rough(64), 1.0, forces=np.geomspace(1e-4, 1e-3, 7))
    assert curve.fit(window=(1e-4, 1e-3)).count == 7
    assert curve.fit(window=(1.01e-4, 0.99e-3)).count == 5


def test_a_law_says_through_which_loads_it_goes():
    """Up to F/(E* h L) = 0.07 where that leaves a decade, h being 0.01 here, and E* and L one; else all resolved."""
    curve = rc.loading_curve(rough(64), 1.0, forces=np.geomspace(1e-5, 1e-2, 13))
    fine = replace(curve, cell_stiffness=1e-9)  # of which all loads are resolved
    law = fine.fit()
    assert law.count == (curve.force <= 7e-4).sum() == 8
    assert law.rule == (
        "8 of 13 resolved loads, those up to 0.0007 N, where F/(E* L h) is 0.07 and the power law ends"
    )
    assert fine.fit((1e-4, 1e-3)).rule == "5 loads from 0.0001 to 0.001 N"
    short = replace(curve, cell_stiffness=curve.stiffness[6] / 20)
    assert short.fit().rule == "all 7 resolved loads"  # of which two are lighter


def test_depths_may_begin_at_first_touch():
    curve = rc.loading_curve(rough(32), 1.0, depths=np.linspace(0, 0.01, 5))
    assert curve.force[0] == curve.stiffness[0] == 0
    assert curve.status[0] is rc.Status.NO_CONTACT
    assert (np.diff(curve.force) > 0).all()


def test_dimensionless_numbers_do_not_depend_on_scale():
    one = rc.loading_curve(rough(64), 1.0, forces=np.geomspace(1e-5, 1e-3, 9))
    made = rough(64)
    scaled = rc.Surface(made.heights * 3e-6, rc.Grid((64, 64), 1e-6 / 64))
    two = rc.loading_curve(scaled, 110e9, forces=np.geomspace(1e-5, 1e-3, 9) * 110e9 * 3e-12)
    np.testing.assert_allclose(two.dimensionless_force, one.dimensionless_force, rtol=1e-9)
    np.testing.assert_allclose(two.dimensionless_stiffness, one.dimensionless_stiffness, rtol=1e-6)


@pytest.mark.parametrize(
    ("more", "message"),
    [
        ({"forces": []}, "at least one"),
        ({"forces": [1.0, 1.0]}, "increase strictly"),
        ({"forces": [1.0, 0.5]}, "0.5 follows 1"),
        ({"forces": [1.0, np.nan]}, "must be finite"),
        ({"forces": [-1.0, 1.0]}, "force must be positive"),
        ({"forces": [[1.0, 2.0]]}, "one row"),
        ({"depths": [-1.0]}, "first touch"),
        ({"forces": [1.0], "depths": [1.0]}, "forces and depths"),
    ],
)
def test_nonsense_is_refused_before_the_first_load(more, message):
    with pytest.raises(ValueError, match=message):
        rc.loading_path(rough(16), 1.0, **more)  # not even a next() is needed


def test_too_deep_for_a_periodic_surface_is_refused_at_once():
    with pytest.raises(ValueError, match="mean separation"):
        rc.loading_path(rough(16, periodic=True), 1.0, depths=[0.001, 1.0])


def test_too_few_points_for_a_law():
    """The message names what would serve."""
    curve = rc.loading_curve(rough(16), 3.0, forces=[1e-5, 1e-4])
    with pytest.raises(ValueError, match=r"not 0: leave the loads out"):
        curve.fit()


def test_no_law_is_fitted_to_less_than_a_decade_unless_asked():
    curve = rc.loading_curve(rough(128), 1.0, forces=np.geomspace(2e-4, 1.9e-3, 6))
    with pytest.raises(ValueError, match="a decade of force, and the resolved points span a factor of"):
        curve.fit()
    assert curve.fit((2e-4, 1.9e-3)).count == 6


def test_loads_nobody_named():
    surface = rough(128)
    curve = rc.loading_curve(surface, 2.0)
    assert len(curve) == 24
    np.testing.assert_allclose(curve.force, rc.load_range(surface, 2.0).forces, rtol=1e-10)
    flat = rc.Surface(np.zeros((8, 8)), rc.Grid((8, 8), 1.0))
    with pytest.raises(ValueError, match="flat surface"):
        rc.loading_curve(flat, 1.0)


def test_a_curve_says_what_it_spans():
    curve = rc.loading_curve(rough(128), 1.0, forces=[1e-6, 7e-4])
    assert repr(curve) == "Curve(1 of 2 points resolved, force 1e-06 to 0.0007 N)"


def test_nominal_area_leaves_out_the_hole_in_rings():
    """Of every geometry it is the area of the grid's cells, as their weights add up."""
    for edges in (np.linspace(0.0, 1.0, 17), np.linspace(0.5, 1.0, 17), [0.9, 0.95, 1.0]):
        rings = rc.RadialGrid(edges)
        curve = rc.loading_curve(rc.RadialProfile(-(rings.radii**2), rings), 1.0, depths=[1e-2])
        inner, outer = edges[0], edges[-1]
        assert curve.nominal_area == rings.cell_area.sum()
        assert curve.nominal_area == pytest.approx(np.pi * (outer**2 - inner**2), rel=1e-14)
        assert curve.length == pytest.approx(np.sqrt(np.pi) * outer, rel=1e-15)
    plane, line = rc.Grid((8, 6), (2.0, 1.0)), rc.Grid(8, 2.0)
    heights = np.random.default_rng(0).standard_normal((8, 6))
    assert rc.loading_curve(rc.Surface(heights, plane), 1.0, depths=[0.1]).nominal_area == 96.0
    profile = rc.Surface(heights[:, 0], line)
    for body in (rc.foundation, rc.line):
        curve = rc.loading_curve(profile, 1.0, forces=[0.1], operator=body(line, 1.0))
        assert curve.nominal_area == 16.0


@pytest.mark.parametrize("periodic", [False, True])
def test_per_area(periodic):
    grid = rc.Grid((16, 32), (2e-6, 1e-6), periodic)
    rough = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(0))
    pressures = np.array([1e6, 1e7])
    curve = rc.loading_curve(rough, 1e11, pressures=pressures)
    area = 32e-6 * 32e-6
    np.testing.assert_allclose(curve.nominal_pressure, pressures, rtol=1e-9)
    np.testing.assert_allclose(
        curve.interfacial_stiffness_per_area, curve.interfacial_stiffness / area, rtol=1e-15
    )
    np.testing.assert_allclose(curve.contact_fraction, curve.contact_area / area, rtol=1e-15)
    names = {"nominal_pressure": "Pa", "contact_fraction": "1", "interfacial_stiffness_per_area": "Pa m-1"}
    dataset, record = curve.to_dataset(), curve.to_record()
    for name, unit in names.items():
        assert dataset[name].units == record["units"][name] == unit
        assert dataset[name].to_numpy().tolist() == record[name] == getattr(curve, name).tolist()


def test_per_area_is_per_length_on_a_line_and_per_springs():
    grid = rc.Grid(16, 1e-6)
    line = rc.Surface(np.arange(16) * 1e-9, grid)
    units = {}
    for name, operator in (("line", rc.line(grid, 1e11)), ("springs", rc.foundation(grid, 1e11))):
        curve = rc.loading_curve(line, 1e11, forces=[1.0, 2.0], operator=operator)
        np.testing.assert_allclose(curve.nominal_pressure, np.array([1.0, 2.0]) / 16e-6, rtol=1e-9)
        dataset = curve.to_dataset()
        units[name] = [dataset[each].units for each in ("nominal_pressure", "interfacial_stiffness_per_area")]
    assert units == {"line": ["Pa", "Pa m-1"], "springs": ["N m-1", "N m-2"]}
