"""Flow through the gap of rough contacts."""

from dataclasses import replace

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.fluid import fluids
from roughcontact.fluid.constriction import Constriction, cells_near
from roughcontact.fluid.leak import Leak
from roughcontact.recipe.leak_job import GASES

GRID = 64


def rough(n=GRID, periodic=True, seed=3):
    grid = rc.Grid((n, n), 1 / n, periodic=True)
    rng = np.random.default_rng(seed)
    surface = rc.self_affine(grid, hurst=0.8, rms=0.01, rng=rng, rolloff=0.25, short_cutoff=1 / 8)
    return surface if periodic else rc.Surface(surface.heights, rc.Grid((n, n), 1 / n))


def pressed(pressure, **given):
    return rc.press(rough(**given), 1.0, pressure=pressure)


@pytest.mark.parametrize(
    ("n", "pressure", "volumes", "fluxes", "bilinear"),
    [
        (64, 0.005, 2.1637e-6, None, None),
        (64, 0.02, 2.4332e-7, None, None),
        (64, 0.035, 3.4283e-8, None, None),
        (64, 0.045, 5.680e-9, None, None),
        (96, 0.005, 2.1825e-6, 2.1922e-6, 2.2021e-6),
        (96, 0.035, 3.4764e-8, 3.5207e-8, 3.5784e-8),
        (96, 0.045, 5.982e-9, 6.081e-9, 6.179e-9),
    ],
)
def test_reference_numbers(n, pressure, volumes, fluxes, bilinear):
    """Of an independent code, to four digits; half the trace of the tensor."""
    flow = rc.gap_flow(pressed(pressure, n=n))
    assert np.trace(flow.transmissivity) / 2 == pytest.approx(volumes, rel=2e-4)
    if fluxes:
        low, high = (np.trace(each) / 2 for each in flow.interval)
        assert (low, high) == pytest.approx((fluxes, bilinear), rel=2e-4)


def test_fields_carry_the_flow():
    """The mean flux of a unit drop is the row of the tensor; a pressure falls from 1 to 0 from side to side."""
    flow = rc.gap_flow(pressed(0.02))
    for direction in (0, 1):
        mean = [each.mean() for each in flow.flux(direction)]
        np.testing.assert_allclose(mean, flow.transmissivity[direction], rtol=1e-9)
    across = rc.gap_flow(pressed(0.005, periodic=False), axis=1)
    drop, (_, along) = across.pressure(), across.flux()
    assert np.nanmin(drop) >= 0
    assert np.nanmax(drop) <= 1 + 1e-12
    assert np.nanmean(drop[:, 0]) > 0.9
    assert np.nanmean(drop[:, -1]) < 0.1
    np.testing.assert_allclose(along.mean(axis=0), across.transmissivity[0, 0], rtol=1e-9)


def test_near_the_threshold_a_constriction_decides():
    """In place, width and share; far from it no constriction takes half of the drop."""
    wide, narrow = rc.gap_flow(pressed(0.01)), rc.gap_flow(pressed(0.07))
    assert wide.constriction.resolved
    assert wide.constriction.share < 0.3
    assert wide.notes == ()
    assert not narrow.constriction.resolved
    assert narrow.constriction.cells < 4
    assert any("The critical constriction is 3 cells wide and takes" in note for note in narrow.notes)
    i, j = (round(x * GRID - 0.5) for x in narrow.constriction.place)
    assert 0 < narrow.gap[i, j] <= narrow.constriction.gap < 1e-3


def test_full_contact_and_none():
    full = rc.press(rough(n=16), 1.0, force=10.0)
    assert full.contact_fraction == 1
    assert not rc.gap_flow(full).percolates
    hardly = rc.gap_flow(rc.press(rough(n=16), 1.0, force=1e-12))
    assert hardly.percolates
    assert len(hardly.windings) == 2


def test_missing_cells_are_closed_or_open():
    surface = rough(periodic=False)
    heights = surface.heights.copy()
    heights[30:34] = np.nan  # a ditch across
    solution = rc.press(rc.Surface(heights, surface.grid), 1.0, force=0.005)
    closed, opened = (rc.gap_flow(solution, axis=0, missing=each) for each in ("closed", "open"))
    assert not closed.percolates
    assert opened.percolates
    assert any("cells hold no height" in note for note in opened.notes)
    along = [rc.gap_flow(solution, axis=1, missing=each).transmissivity[0, 0] for each in ("closed", "open")]
    assert along[1] > 100 * along[0]


def test_plastic_contacts_and_slip():
    solution = rc.press(rough(), 1.0, pressure=0.02, hardness=0.1)
    assert solution.plastic.any()
    assert rc.gap_flow(solution).percolates
    without, with_slip = (rc.gap_flow(solution, slip_length=b).transmissivity for b in (0.0, 1e-3))
    assert np.linalg.eigvalsh(with_slip - without)[0] > 0


def test_the_transmissivity_is_continuous_in_load():
    """As cells close one by one, the logarithm bends by far less than its step."""
    path = rc.loading_path(rough(n=48), 1.0, pressures=np.linspace(0.0295, 0.0305, 13))
    logs = np.log([np.trace(rc.gap_flow(solution).transmissivity) for solution in path])
    assert np.abs(np.diff(logs, 2)).max() < 0.05 * np.abs(np.diff(logs)).max()


WATER = rc.Liquid(viscosity=1e-3, density=1000.0)


def steel(pressure=50e6, n=32):
    grid = rc.Grid((n, n), 4e-6)
    surface = rc.self_affine(
        rc.Grid((n, n), 4e-6, periodic=True),
        0.8,
        1e-6,
        np.random.default_rng(1),
        rolloff=64e-6,
        short_cutoff=32e-6,
    )
    return rc.press(rc.Surface(surface.heights, grid), 115e9, pressure=pressure)


def test_a_leak_is_the_transmissivity_times_drop_over_viscosity():
    solution = steel()
    found = rc.leak(solution, WATER, drop=1e5, axis=1)
    kappa = rc.gap_flow(solution, axis=1).transmissivity[0, 0]
    assert found.volume == pytest.approx(kappa * 1e5 / 12e-3, rel=1e-12)
    assert found.mass == pytest.approx(found.volume * 1000, rel=1e-12)
    seal = rc.leak(solution, WATER, drop=1e5, axis=1, seal_width=1e-3, circumference=0.1)
    assert seal.volume == pytest.approx(100 * found.volume, rel=1e-12)
    assert np.isnan(rc.leak(solution, rc.Liquid(1e-3), drop=1e5, axis=1).mass)
    assert np.isnan(found.throughput)


def test_a_gas_flows_by_the_squares_of_its_pressures():
    """Without slip G (p1^2 - p2^2)/(2 R T 12 eta); slip adds to it."""
    solution, air = steel(2e6), rc.Gas("air")
    found = rc.leak(solution, air, upstream=2e5, downstream=1e5, axis=0)
    kappa = rc.gap_flow(solution, axis=0).transmissivity[0, 0]
    no_slip = kappa * (4e10 - 1e10) / (2 * air.gas_constant * 300 * 12 * air.viscosity)
    assert 1 < found.mass / no_slip < 1.5
    assert found.throughput == pytest.approx(found.mass * air.gas_constant * 300, rel=1e-12)
    assert found.rarefaction > 5


@pytest.mark.parametrize(
    ("name", "path", "jump"),
    [("air", 67.5, 3.267), ("nitrogen", 66.1, 3.256), ("helium", 195.3, 3.772), ("argon", 70.8, 3.747)],
)
def test_gases_at_300_kelvin(name, path, jump):
    """Mean free path and jump distance as in the table that the constants come from."""
    gas = rc.Gas(name, pressure=101325, accommodation=(1.0, 1.0))
    assert gas.mean_free_path(101325) * 1e9 == pytest.approx(path, abs=0.15)
    assert gas.jump_distance / gas.mean_free_path(101325) == pytest.approx(
        jump, rel=3e-3
    )  # the table is rounded


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"fluid": rc.Gas("air"), "drop": 1e5}, "give upstream= and downstream=, absolute"),
        ({"fluid": WATER}, "or only drop="),
        ({"fluid": WATER, "drop": -1.0}, "exceed the downstream pressure"),
        ({"fluid": WATER, "drop": 1e9}, "exceeds the nominal pressure"),
        ({"fluid": WATER, "drop": 1e5, "seal_width": 1e-3}, "give both"),
        ({"fluid": "water", "drop": 1e5}, "must be an rc.Liquid or an rc.Gas"),
        ({"fluid": rc.Gas("air"), "upstream": 2e3, "downstream": 1.0}, "too rarefied"),
    ],
)
def test_leaks_that_make_no_sense(given, words):
    with pytest.raises(ValueError, match=words):
        rc.leak(steel(), **{"axis": 0} | given)


def test_warnings_of_a_leak():
    solution = steel()
    assert not any("nominal pressure" in note for note in rc.leak(solution, WATER, drop=4.9e6, axis=0).notes)
    assert any("10% of the nominal" in note for note in rc.leak(solution, WATER, drop=5.1e6, axis=0).notes)
    boiling = rc.Liquid(1e-3, 1000.0, vapour_pressure=3e3)
    high, low = (rc.leak(solution, boiling, upstream=2e5, downstream=p, axis=0).notes for p in (1e5, 1e3))
    assert any("boils" in note for note in low)
    assert not any("boils" in note for note in high)
    thin = rc.Liquid(1e-6, 1000.0)
    assert any("inertia" in note for note in rc.leak(steel(1e6), thin, drop=1e5, axis=0).notes)


@pytest.mark.parametrize(
    ("solution", "given", "words"),
    [
        (lambda: steel(), {}, "exactly one of axis and between"),
        (lambda: steel(), {"axis": 2}, "along an axis that is not periodic"),
        (lambda: pressed(0.01), {"axis": 0}, "along an axis that is not periodic"),
        (lambda: steel(), {"axis": 0, "missing": "shut"}, "must be 'closed' or 'open'"),
        (lambda: steel(), {"axis": 0, "slip_length": -1.0}, "must be 0 or more"),
        (lambda: steel(), {"between": (np.ones((2, 2), bool),) * 2}, "two regions of shape"),
        (
            lambda: rc.loading_curve(rough(n=16), 1.0, pressures=[0.01]),
            {},
            "must be a Solution, as rc.press returns it",
        ),
    ],
)
def test_flows_that_make_no_sense(solution, given, words):
    with pytest.raises(ValueError, match=words):
        rc.gap_flow(solution(), **given)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: rc.Liquid(0.0), "the viscosity must be positive"),
        (lambda: rc.Liquid(1e-3, -1.0), "the density must be positive"),
        (lambda: rc.Gas("xenon"), "must be one of air, nitrogen"),
        (lambda: rc.Gas("air", temperature=20), "between 200 and 600 K"),
        (lambda: rc.Gas("air", pressure=0.0), "must be positive and finite"),
        (lambda: rc.Gas("air", accommodation=(0.9, 1.1)), "two coefficients above 0"),
        (lambda: rc.Gas("air", momentum_accommodation=0.0), "above 0 and up to 1"),
        (lambda: rc.Gas("air").jump_distance, "accommodation at both walls"),
    ],
)
def test_fluids_that_make_no_sense(make, words):
    with pytest.raises(ValueError, match=words):
        make()


def test_adhesive_states_carry_a_flow_above_a_closing_gap():
    """Cells at the wall and below the gap are closed; wider ones keep the gap of the state."""
    surface = rc.Surface(rough(n=32, periodic=False).heights * 1e-6, rc.Grid((32, 32), 1e-6))
    state = rc.adhesive_state(surface, 1e9, rc.Adhesion(1e-3, 2e-8), depth=1e-8)
    assert state.contact.any()
    narrow, wide = (rc.gap_flow(state, axis=0, closing_gap=each) for each in (1e-9, 8e-9))
    is_open = ~state.contact & (state.gap >= 8e-9)
    np.testing.assert_array_equal(wide.gap, np.where(is_open, state.gap, 0))
    assert 0 < wide.transmissivity[0, 0] < narrow.transmissivity[0, 0]
    assert narrow.to_record()["contact_fraction"] == state.contact_fraction
    assert wide.notes == ()
    heights = surface.heights.copy()
    heights[10:12, 5:9] = np.nan
    torn = rc.adhesive_state(rc.Surface(heights, surface.grid), 1e9, rc.Adhesion(1e-3, 2e-8), depth=1e-8)
    closed, opened = (rc.gap_flow(torn, axis=0, closing_gap=1e-9, missing=m) for m in ("closed", "open"))
    assert (closed.gap[10:12, 5:9] == 0).all()
    assert opened.transmissivity[0, 0] > closed.transmissivity[0, 0]
    assert any("8 cells hold no height" in note for note in closed.notes)


def test_pressed_rings_are_closed_by_one_ring_in_contact():
    """An axisymmetric contact always seals; at first touch the whole gap is open."""
    rings = rc.RadialGrid(np.linspace(1e-3, 2e-3, 65))
    profile = rc.RadialProfile(-1e-6 * (rings.radii / 1e-3 - 1.5) ** 2, rings)
    pressed = rc.press(profile, 1e9, force=1e-3)
    assert 0 < pressed.contact.sum() < 64
    assert not rc.gap_flow(pressed).percolates
    assert rc.leak(pressed, WATER, drop=10.0).volume == 0
    stuck = rc.adhesive_state(profile, 1e9, rc.Adhesion(1e-3, 1e-7), depth=-1e-7)
    assert not stuck.contact.any()
    assert rc.gap_flow(stuck, closing_gap=1e-9).percolates


def test_commands_offer_every_gas():
    assert tuple(fluids._GASES) == GASES


def test_a_film_has_the_unit_of_its_kind():
    pytest.importorskip("pint")
    import pint

    unit, solution = pint.get_application_registry(), steel()
    found = rc.joint_conductance(solution, resistivities=(1e-8, 1e-8), film=1e-3 * unit.ohm * unit.mm**2)
    assert found.film == pytest.approx(1e-9)
    with pytest.raises(ValueError, match="film must be in"):
        rc.joint_conductance(solution, conductivities=(50.0, 50.0), film=1e-3 * unit.ohm * unit.mm**2)


def test_the_reynolds_number_is_that_of_the_constriction_and_of_the_drop_over_the_map():
    """In a uniform gap h of length L, it is density times flux over viscosity, times h over the width of the map."""
    grid = rc.Grid((16, 32), 1e-6)
    flat = rc.Surface(np.zeros(grid.shape), grid)
    flow = replace(rc.gap_flow(rc.press(flat, 1e9, depth=0.0), axis=0), gap=np.full(grid.shape, 2e-7))
    found = [
        Leak(flow, WATER, 1e5, 0.0, 0.0, seal_width=width, circumference=1e-3)
        for width in (None, grid.lengths[0], 10 * grid.lengths[0])
    ]
    flux = 2e-7**3 / (12 * WATER.viscosity) * 1e5 / grid.lengths[0]
    exact = WATER.density * flux / WATER.viscosity * 2e-7 / grid.lengths[1]
    np.testing.assert_allclose([each.reynolds for each in found], [exact, exact, exact / 10], rtol=1e-9)


@pytest.mark.parametrize("periodic", [False, True])
def test_cells_near_a_constriction_lie_across_the_border_of_a_period_only(periodic):
    grid = rc.Grid((8, 8), 1.0, periodic=periodic)
    place = Constriction(place=(0.5, 4.5), cells=4, width=5.0, gap=1.0, share=0.5)
    rows, columns = np.nonzero(cells_near(place, grid))
    assert set(rows) == ({0, 1, 2, 6, 7} if periodic else {0, 1, 2})
    assert set(columns) == {2, 3, 4, 5, 6}
