"""The current or heat of each cell and of each spot."""

import numpy as np
import pytest
import scipy.special

import roughcontact as rc

MODULUS = 3e10
COPPER = {"resistivities": (1.7e-8, 5e-8)}
STEEL = {"conductivities": (50.0, 16.0)}


def flat(mask, grid):
    """Return the solution for a flat punch of the shape of a mask; nothing is measured beside it."""
    return rc.press(rc.Surface(np.where(mask, 0.0, np.nan), grid), MODULUS, force=1.0)


def places(grid):
    y, x = ((np.arange(n) + 0.5) * step for n, step in zip(grid.shape, grid.spacing, strict=True))
    return y[:, None], x


@pytest.fixture(scope="module")
def rough():
    """A map that is not square, of cells that are not square, with several spots."""
    heights = rc.self_affine(
        rc.Grid((24, 40), 1e-6), hurst=0.8, rms=2e-7, rng=np.random.default_rng(3)
    ).heights
    return rc.press(rc.Surface(heights, rc.Grid((24, 40), (1e-6, 1.5e-6))), MODULUS, force=2e-2)


def test_a_round_spot_has_the_resistance_and_the_density_of_holm():
    """R = (rho1 + rho2)/(4a), j = I/(2 pi a sqrt(a^2 - r^2)); the rings' edge costs a part of 1/n."""
    radius, n = 1e-5, 200
    grid = rc.RadialGrid.uniform(n, radius)
    disc = rc.press(rc.RadialProfile(np.zeros(n), grid), MODULUS, force=1.0)
    flux = rc.contact_flux(disc, **COPPER, drop=1e-3)
    holm = 6.7e-8 / (4 * radius)
    assert flux.spots.count == 1
    for resistance in (flux.resistance, *flux.resistances, *flux.resistances_alone):
        assert resistance == pytest.approx(holm, rel=1 / n)
    assert flux.resistances_holm[0] == pytest.approx(holm, rel=1e-12)
    inner = grid.radii < 0.9 * radius
    expected = flux.total / (2 * np.pi * radius * np.sqrt(radius**2 - grid.radii**2))
    np.testing.assert_allclose(flux.density[inner], expected[inner], rtol=2 / n)


@pytest.mark.parametrize("cells", [12, 24])
def test_a_ball_conducts_through_hertz_circle(cells):
    """The rim of a spot of cells is known to half a cell."""
    grid, radius = rc.Grid((64, 64), 1e-6), 1e-4
    a = cells * 1e-6
    ball = rc.shapes.paraboloid(grid, radius=radius)
    flux = rc.contact_flux(rc.press(ball, MODULUS, force=4 * MODULUS * a**3 / (3 * radius)), **STEEL)
    assert flux.resistance == pytest.approx((1 / 50 + 1 / 16) / (4 * a), rel=0.5 / cells)
    assert flux.resistances_alone[0] == pytest.approx(flux.resistance, rel=1e-9)


def test_an_elliptical_spot():
    """R = (rho1 + rho2) K(e)/(2 pi a): below Holm's round spot of the same area, the worst conductor of all shapes."""
    grid, a, b = rc.Grid((40, 72), 1e-6), 32e-6, 16e-6
    y, x = places(grid)
    ellipse = ((x - 36e-6) / a) ** 2 + ((y - 20e-6) / b) ** 2 < 1
    flux = rc.contact_flux(flat(ellipse, grid), **COPPER)
    exact = 6.7e-8 * scipy.special.ellipk(1 - (b / a) ** 2) / (2 * np.pi * a)
    assert flux.resistance == pytest.approx(exact, rel=0.5 / 16)
    assert exact < 6.7e-8 / (4 * np.sqrt(a * b))
    assert flux.resistances_holm[0] == pytest.approx(6.7e-8 / (4 * np.sqrt(a * b)), rel=0.5 / 16)


def test_two_spots_hinder_each_other_as_their_influence_requires():
    """Of two cells alike, t = 1/(A11 + A12), against 1/A11 alone."""
    grid = rc.Grid((3, 40), 1e-6)
    mask = np.zeros(grid.shape, bool)
    mask[1, [2, 30]] = True
    flux = rc.contact_flux(flat(mask, grid), **COPPER)
    near, far = rc.half_space(grid, MODULUS).as_matrix(np.flatnonzero(mask))[0]
    assert flux.shares.tolist() == pytest.approx([0.5, 0.5], rel=1e-12)
    np.testing.assert_allclose(flux.resistances / flux.resistances_alone, 1 + far / near, rtol=1e-12)
    # Far apart, the other spot is a point: 1/(pi E* s), to the square of cell over distance.
    assert far == pytest.approx(1e-12 / (np.pi * MODULUS * 28e-6), rel=1 / 28**2)


@pytest.mark.parametrize("given", [COPPER, STEEL])
def test_against_a_dense_solve(rough, given):
    """The matrix of all cells in contact, solved at once; the tangent is solved to 1e-7 of the unit displacement."""
    cells = np.flatnonzero(rough.contact)
    matrix = rough.problem.operator.as_matrix(cells)
    tangent = np.linalg.solve(matrix, np.ones(cells.size))
    if given is COPPER:
        factor = 2 / (MODULUS * sum(given["resistivities"]))
    else:
        factor = 2 / (MODULUS * sum(1 / each for each in given["conductivities"]))
    flux = rc.contact_flux(rough, **given, drop=3.0)
    np.testing.assert_allclose(flux.density.ravel()[cells], 3 * factor * tangent, rtol=1e-5)
    assert np.count_nonzero(flux.density) == cells.size
    labels, area = rough.spots.labels.ravel()[cells], rough.problem.grid.cell_area
    assert rough.spots.count > 3
    for spot in range(1, rough.spots.count + 1):
        mine = labels == spot
        assert flux.fluxes[spot - 1] == pytest.approx(3 * factor * area * tangent[mine].sum(), rel=1e-6)
        alone = area * np.linalg.solve(matrix[np.ix_(mine, mine)], np.ones(mine.sum())).sum()
        assert flux.resistances_alone[spot - 1] == pytest.approx(1 / (factor * alone), rel=1e-9)


@pytest.mark.parametrize("of", ["interface", "total"])
def test_the_parts_sum_to_the_conductance(rough, of):
    """Each sum is one of fewer than a thousand numbers: to rounding."""
    flux = rc.contact_flux(rough, **COPPER, drop=0.25, of=of)
    known = rc.conductance(rough, **COPPER, of=of)
    assert flux.total == pytest.approx(0.25 * known["electrical_conductance"], rel=1e-12)
    assert flux.fluxes.sum() == pytest.approx(flux.total, rel=1e-12)
    assert flux.density.sum() * rough.problem.grid.cell_area == pytest.approx(flux.total, rel=1e-12)
    assert (1 / flux.resistances).sum() == pytest.approx(1 / known["electrical_resistance"], rel=1e-12)
    assert flux.shares.sum() == pytest.approx(1, rel=1e-12)
    assert flux.largest == pytest.approx(flux.fluxes.max(), rel=1e-12)
    assert flux.largest_share == flux.shares.max()


def test_only_the_drop_depends_on_the_part(rough):
    interface, total = (rc.contact_flux(rough, **COPPER, of=of) for of in ("interface", "total"))
    assert interface.total > total.total
    np.testing.assert_array_equal(interface.shares, total.shares)
    np.testing.assert_array_equal(interface.resistances_alone, total.resistances_alone)


def test_heat_and_current_are_alike(rough):
    """rho = 1/lambda; the flux is in proportion to the drop."""
    current = rc.contact_flux(rough, resistivities=(0.02, 0.0625), drop=2.0)
    heat = rc.contact_flux(rough, **STEEL)
    assert (current.kind, heat.kind) == ("electrical", "thermal")
    np.testing.assert_allclose(current.density, 2 * heat.density, rtol=1e-12)
    np.testing.assert_allclose(current.resistances_alone, heat.resistances_alone, rtol=1e-12)
    np.testing.assert_allclose(current.resistances_holm, heat.resistances_holm, rtol=1e-12)


def test_a_mirrored_surface_conducts_alike(rough):
    mirrored = rc.press(rough.problem.surface.flipped("x"), MODULUS, force=rough.force)
    flux, other = (rc.contact_flux(each, **COPPER) for each in (rough, mirrored))
    # The tangents are solved to 1e-7 of the unit displacement.
    np.testing.assert_allclose(other.density[:, ::-1], flux.density, rtol=1e-5)
    np.testing.assert_allclose(np.sort(other.fluxes), np.sort(flux.fluxes), rtol=1e-6)


def test_other_spots_hinder_a_spot_on_a_free_map():
    """Twenty-two spots at A/A0 = .117: together they conduct half of what they would alone.

    On a free map the influence is positive everywhere, so that no spot conducts more than alone.
    """
    grid = rc.Grid((64, 64), 1 / 64)
    surface = rc.self_affine(grid, hurst=0.8, rms=0.01, rng=np.random.default_rng(4))
    solution = rc.press(surface, 1.0, force=0.00883)
    flux = rc.contact_flux(solution, **COPPER)
    ratio = flux.resistances_alone / flux.resistances
    assert flux.spots.count == 22
    assert solution.contact_fraction == pytest.approx(0.117, abs=5e-4)
    assert ratio.min() == pytest.approx(0.095, abs=1e-3)
    assert ratio.max() == pytest.approx(0.729, abs=1e-3)
    assert 1 / (flux.resistance * (1 / flux.resistances_alone).sum()) == pytest.approx(0.530, abs=1e-3)


def test_on_a_period_the_spreading_resistance_is_left_out():
    """A square lattice of round spots: 1/k = 1/k_alone - 3.90026/(pi E* L), with the constant of point charges.

    The other spots are points to (a/L)^3. The sum over waves and Love's influence differ between neighbouring cells: by
    a fiftieth of a cell in the radius, at most.
    """
    n, a = 64, 5.0
    grid = rc.Grid((n, n), 1.0, periodic=True)
    y, x = places(grid)
    heights = np.where(np.hypot(y - n / 2, x - n / 2) < a, 0.0, -1e9)
    flux = rc.contact_flux(rc.press(rc.Surface(heights, grid), MODULUS, force=1.0), **COPPER)
    k_alone = 6.7e-8 / flux.resistances_alone[0] / 2  # k/E*, a length
    expected = 1 - k_alone * 3.9002649200019558 / (np.pi * n)
    assert flux.resistance / flux.resistances_alone[0] == pytest.approx(expected, abs=(a / n) ** 3 + 0.02 / a)
    assert flux.resistances[0] < flux.resistances_alone[0]


def test_spots_of_a_periodic_map_can_conduct_more_than_alone():
    """The drop of an interface leaves out the spreading resistance, which each spot alone has in full."""
    grid = rc.Grid((64, 64), 1 / 64, periodic=True)
    rng = np.random.default_rng(4)
    surface = rc.self_affine(grid, hurst=0.8, rms=0.01, rng=rng, rolloff=0.25, short_cutoff=1 / 8)
    solution = rc.press(surface, 1.0, force=0.013)
    flux = rc.contact_flux(solution, **COPPER)
    assert solution.contact_fraction == pytest.approx(0.119, abs=5e-4)
    assert (flux.resistances_alone / flux.resistances).max() == pytest.approx(2.35, abs=0.01)
    other = rc.contact_flux(solution, **COPPER, of="interface")
    assert other.total == pytest.approx(flux.total, rel=1e-12)


def test_a_spot_of_one_cell_is_not_resolved():
    """A cell has the stiffness pi E* h/(4 ln(1 + sqrt 2)), Holm's round spot 2 E* h/sqrt(pi)."""
    grid = rc.Grid((3, 3), 1e-6)
    flux = rc.contact_flux(flat(np.eye(9)[4].reshape(3, 3) > 0, grid), **COPPER)
    ratio = 8 * np.log(1 + np.sqrt(2)) / np.pi**1.5
    assert flux.resistances_alone[0] / flux.resistances_holm[0] == pytest.approx(ratio, rel=1e-12)
    assert f"{ratio:.2f}" == "1.27"


def test_a_spot_across_the_edge_of_a_period_is_one_spot():
    n = 24
    grid = rc.Grid((n, n + 6), 1.0, periodic=True)
    y, x = places(grid)
    ellipse = ((y - 12) / 4) ** 2 + ((x - 15) / 7) ** 2 < 1
    rolled = np.roll(ellipse, (11, 14), axis=(0, 1))
    found = [
        rc.contact_flux(rc.press(rc.Surface(np.where(mask, 0.0, -1e9), grid), MODULUS, force=1.0), **COPPER)
        for mask in (ellipse, rolled)
    ]
    assert [each.spots.count for each in found] == [1, 1]
    np.testing.assert_allclose(*(each.resistances_alone for each in found), rtol=1e-9)
    np.testing.assert_allclose(*(each.resistances for each in found), rtol=1e-9)
    punch = rc.contact_stiffness(ellipse, rc.Grid(grid.shape, 1.0), MODULUS)
    assert found[1].resistances_alone[0] == pytest.approx(MODULUS * 6.7e-8 / (2 * punch), rel=1e-9)


def test_a_ridge_over_a_whole_period_is_never_alone():
    grid = rc.Grid((8, 12), 1.0, periodic=True)
    ridge = np.where((np.arange(12) < 3) & np.ones((8, 1), bool), 0.0, -1e9)
    ridge[4, 8] = 0.0
    flux = rc.contact_flux(rc.press(rc.Surface(ridge, grid), MODULUS, force=1.0), **COPPER)
    assert np.isnan(flux.resistances_alone).tolist() == [True, False]
    assert np.isfinite(flux.resistances).all()


def test_plastic_cells_conduct():
    """Like the flat punch of their shape, whatever the hardness."""
    grid = rc.Grid((32, 32), 1e-6)
    surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(0))
    hard = rc.press(surface, MODULUS, force=1e-1, hardness=5e8)
    assert hard.plastic.any()
    flux = rc.contact_flux(hard, **COPPER)
    punch = rc.contact_stiffness(hard.contact, grid, MODULUS)
    assert flux.total == pytest.approx(2 * punch / (MODULUS * 6.7e-8), rel=1e-12)
    assert (flux.density[hard.plastic] > 0).all()


def test_an_insulator_and_no_contact():
    ball = rc.shapes.paraboloid(rc.Grid((16, 16), 1e-6), radius=1e-4)
    flux = rc.contact_flux(rc.press(ball, MODULUS, force=1e-2), conductivities=(400.0, 0.0))
    assert (flux.total, flux.fluxes.tolist(), flux.shares.tolist()) == (0.0, [0.0], [1.0])
    assert flux.resistance == np.inf
    assert (flux.resistances.tolist(), flux.resistances_alone.tolist()) == ([np.inf], [np.inf])
    apart = rc.contact_flux(rc.press(ball, MODULUS, depth=0.0), **COPPER)
    assert (apart.total, apart.largest, apart.shares.size, apart.resistances_alone.size) == (0.0, 0.0, 0, 0)
    assert not apart.density.any()


def test_units_of_the_drop(rough):
    import pint

    units = pint.get_application_registry()
    assert rc.contact_flux(rough, **COPPER, drop=20 * units.mV).drop == pytest.approx(0.02)
    assert rc.contact_flux(rough, **STEEL, drop=2 * units.kelvin).drop == 2
    with pytest.raises(ValueError, match="drop must be in K"):
        rc.contact_flux(rough, **STEEL, drop=1 * units.V)
    with pytest.raises(ValueError, match="drop must be in V"):
        rc.contact_flux(rough, **COPPER, drop=1 * units.K)


def test_one_periodic_axis_has_only_an_interface():
    grid = rc.Grid((16, 16), 1e-6, periodic=(True, False))
    solution = rc.press(rc.shapes.paraboloid(grid, radius=1e-4), MODULUS, force=1e-2)
    with pytest.raises(ValueError, match="use of='interface'"):
        rc.contact_flux(solution, **COPPER)
    found = rc.contact_flux(solution, **COPPER, of="interface")
    # The reference length of the operator moves depths, not currents of the interface.
    body = rc.singly_periodic(grid, MODULUS, reference_length=1e-3)
    other = rc.press(rc.shapes.paraboloid(grid, radius=1e-4), MODULUS, force=1e-2, operator=body)
    assert rc.contact_flux(other, **COPPER, of="interface").total == pytest.approx(found.total, rel=1e-6)


def test_only_half_spaces_conduct_by_the_analogy():
    grid = rc.Grid((16, 16), 1e-6)
    ball = rc.shapes.paraboloid(grid, radius=1e-4)
    mat = rc.layer(grid, MODULUS, 2e-6, base="rigid-frictionless")
    with pytest.raises(ValueError, match="proportional only for half-spaces"):
        rc.contact_flux(rc.press(ball, MODULUS, force=1e-2, operator=mat), **COPPER)
    with pytest.raises(ValueError, match="proportional only for half-spaces"):
        rc.conductance(rc.press(ball, MODULUS, force=1e-2, operator=mat), **COPPER)
    body = rc.half_space(grid, MODULUS, method="dense")
    assert rc.contact_flux(rc.press(ball, MODULUS, force=1e-2, operator=body), **COPPER).total > 0


def test_as_data(rough, tmp_path):
    import xarray

    flux = rc.contact_flux(rough, **COPPER, drop=0.5)
    data = flux.to_dataset()
    assert data["current_density"].dims == ("y", "x")
    assert data["spot_share"].dims == ("spot",)
    units = {name: data[name].attrs["units"] for name in data if "units" in data[name].attrs}
    assert units["spot_current"] == units["current"] == "A"
    assert units["current_density"] == "A m-2"
    assert {units[name] for name in units if "resistance" in name} == {"ohm"}
    assert float(data["spot_current"].sum()) == pytest.approx(float(data["current"]), rel=1e-12)
    np.testing.assert_allclose(data["spot_resistance_alone"], flux.resistances_alone, rtol=1e-15)
    rc.write(flux, tmp_path / "flux.nc")
    with xarray.open_dataset(tmp_path / "flux.nc") as read:
        np.testing.assert_array_equal(read["current_density"], flux.density)
        assert float(read["voltage"]) == 0.5
    rc.write(flux, tmp_path / "spots.csv")
    lines = (tmp_path / "spots.csv").read_text().splitlines()
    assert len(lines) == 1 + flux.spots.count
    assert "spot_current [A]" in lines[0]
    frame = flux.to_dataframe()
    assert frame["spot_share"].tolist() == flux.shares.tolist()
    heat = rc.contact_flux(rough, **STEEL).to_dataset()
    assert heat["heat_flux"].attrs["units"] == "W m-2"
    assert heat["spot_thermal_resistance_holm"].attrs["units"] == "K W-1"
    with pytest.raises(rc.WriteError, match="cannot write"):
        rc.write(flux, tmp_path / "flux.vti")


def test_pictures(rough):
    flux = rc.contact_flux(rough, **COPPER, drop=1e-3)
    for field in ("share", "density"):
        axes = flux.plot(field=field)
        assert axes.get_title().endswith("through one spot")
    axes = rc.plot.spot_resistances(flux)
    assert [len(each.get_offsets()) for each in axes.collections] == [flux.spots.count] * 2
    with pytest.raises(ValueError, match="field must be"):
        flux.plot(field="current")
    n = 20
    rings = rc.press(rc.RadialProfile(np.zeros(n), rc.RadialGrid.uniform(n, 1e-5)), MODULUS, force=1.0)
    assert rc.contact_flux(rings, **STEEL).plot(field="density").get_xlabel() == "r [µm]"


def test_a_largest_density_is_not_offered(rough):
    flux = rc.contact_flux(rough, **COPPER)
    with pytest.raises(AttributeError, match="largest density depends on the grid"):
        flux.largest_density  # noqa: B018


def test_the_largest_density_has_no_limit_and_the_largest_current_has():
    """A round spot of n rings: the density at its edge grows as the root of n, the current converges."""
    densities, currents = [], []
    for n in (20, 80):
        disc = rc.press(rc.RadialProfile(np.zeros(n), rc.RadialGrid.uniform(n, 1e-5)), MODULUS, force=1.0)
        flux = rc.contact_flux(disc, **COPPER)
        densities.append(flux.density.max())
        currents.append(flux.largest)
    assert densities[1] / densities[0] == pytest.approx(2, rel=1 / 20)
    assert currents[1] == pytest.approx(currents[0], rel=1 / 20)
