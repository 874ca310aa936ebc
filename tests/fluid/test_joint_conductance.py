"""Spots, films, gas and radiation of a joint: closed forms, a dense solution, bounds, and where the parts add."""

import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.fluid.joint_conductance import stiffness_on_springs

SIDE, CELLS = 192e-6, 48
BOTH = {"conductivities": (50.0, 160.0)}
AIR = rc.Gas("air", pressure=101325, accommodation=(1, 1))


def joint(pressure, n=CELLS, periodic=True, **given):
    grid = rc.Grid((n, n), SIDE / n, periodic=True)
    heights = rc.self_affine(
        grid, hurst=0.8, rms=1e-6, rng=1, rolloff=SIDE / 4, short_cutoff=SIDE * 3 / 48
    ).heights
    surface = rc.Surface(heights, rc.Grid((n, n), SIDE / n, periodic=periodic))
    return rc.press(surface, 58.6e9, pressure=pressure, **given)


def test_the_gas_over_a_wave():
    """The mean of 1/(g + M) over a wave has a closed form; the mean over cells converges to it exponentially."""
    gap = 1e-6 * (1 + 0.5 * np.cos(2 * math.pi * np.arange(64) / 64))
    exact = AIR.conductivity / math.sqrt((1e-6 + AIR.jump_distance) ** 2 - 0.25e-12)
    assert AIR.conductance(gap).mean() == pytest.approx(exact, rel=1e-12)
    # The same with a specific heat of 1006 J/kg/K, where the gas has 1004.5.
    assert exact == pytest.approx(23530.15, rel=1e-3)


def test_free_molecules_carry_the_heat_at_low_pressure():
    """At accommodation 1 in a gap far below the mean free path: (gamma+1)/(gamma-1) p sqrt(R/(8 pi T))."""
    for name, ratio in (("air", 1.4), ("helium", 5 / 3)):
        gas = rc.Gas(name, pressure=100, accommodation=(1, 1))
        free = (ratio + 1) / (ratio - 1) * 100 * math.sqrt(gas.gas_constant / (8 * math.pi * 300))
        assert gas.conductance(0.0) == pytest.approx(free, rel=1e-12)


@pytest.mark.parametrize(
    ("pressure", "spots", "air", "helium", "over", "bounds"),
    [
        (1e6, 7542, 6678, 34660, (1.0024, 1.0024), (1.0001, 1.0006)),
        (1e7, 26830, 8000, 40210, (1.0042, 1.0047), (1.0001, 1.0004)),
        (1e8, 232600, 14770, 63350, (1.0027, 1.0003), (1.00005, 1.0003)),
    ],
)
def test_the_sum_of_the_parts_against_the_solution(pressure, spots, air, helium, over, bounds):
    """The numbers of an independent code, to the digits that it printed; the bound is that of Dirichlet."""
    solution = joint(pressure)
    displaced = solution.problem.operator.apply(solution.frozen.tangent)
    for gas, part, ratio, bound in zip(("air", "helium"), (air, helium), over, bounds, strict=True):
        found = rc.joint_conductance(solution, gas=rc.Gas(gas, pressure=101325, accommodation=(1, 1)), **BOTH)
        assert found.spots == pytest.approx(spots, rel=3e-4)
        assert found.gas == pytest.approx(part, rel=2e-3)  # properties of the gases to three digits
        assert found.additive
        assert found.total == found.parts_sum
        assert found.residual < 1e-7
        assert found.parts_sum / found.solved == pytest.approx(ratio, abs=1.2e-4)
        limit = found.spots + np.mean(found.gas_cells * (1 - displaced) ** 2)
        assert limit / found.solved == pytest.approx(bound, abs=6e-5)
        assert limit > found.solved


def test_a_film_on_a_disc_is_not_added_to_its_constriction():
    """Holm's sum is below the resistance, an even flux above; numbers of an independent code, to its digits."""
    grid = rc.Grid((48, 48), 1.0)
    disc = ~np.isnan(rc.shapes.flat_disc(grid, radius=24.0).heights)
    operator = rc.half_space(grid, 1.0)
    area = float(disc.sum())
    radius = math.sqrt(area / math.pi)
    bare = 1 / (2 * rc.contact_stiffness(disc, grid, 1.0))
    even = np.mean(operator.apply(np.where(disc, 1 / area, 0.0))[disc]) / 2
    table = (
        (0.01, 1.0242, 0.9935, 1.068),
        (0.1, 1.1649, 0.9720, 1.037),
        (1, 2.3437, 0.9720, 1.0044),
        (10, 13.8119, 0.9946, 1.0001),
    )
    for film, resistance, holm, uniform in table:
        own = film * radius  # for resistivities that add to 1, where C is half of the operator
        stiffness, _, error = stiffness_on_springs(operator, np.where(disc, 2 * own, np.inf))
        found = 1 / (2 * stiffness)
        assert error < 1e-7
        assert 4 * radius * found == pytest.approx(resistance, rel=3e-4)
        assert (bare + own / area) / found == pytest.approx(holm, abs=1.2e-4)
        assert (even + own / area) / found == pytest.approx(uniform, abs=6e-4)


@pytest.mark.parametrize("periodic", [True, False])
@pytest.mark.parametrize("film", [0.0, 1e-6])
def test_the_solution_is_that_of_the_dense_matrix(periodic, film):
    solution = joint(3e7, n=12, periodic=periodic)
    found = rc.joint_conductance(solution, gas=AIR, emissivities=(1, 0.5), film=film, **BOTH)
    cells = np.arange(144)
    beside = (found.gas_cells + found.radiation_coefficient * ~solution.contact).ravel()
    contact = solution.contact.ravel()
    scale = found.conductivity / 58.6e9
    matrix = solution.problem.operator.as_matrix(cells)
    resistance = np.where(contact, film, 1 / np.where(contact, 1, beside))
    flux = np.linalg.solve(matrix / scale + np.diag(resistance), np.ones(144))
    drop = 1 - np.mean(matrix / scale @ flux)  # of a free map, without the bodies
    assert found.solved == pytest.approx(flux.mean() / drop, rel=1e-9)
    assert periodic == (drop == pytest.approx(1, abs=1e-9))
    only = np.flatnonzero(contact)
    flux = np.linalg.solve(matrix[np.ix_(only, only)] / scale + film * np.eye(only.size), np.ones(only.size))
    drop = 1 - np.mean(matrix[:, only] / scale @ flux)
    assert found.spots == pytest.approx(flux.sum() / 144 / drop, rel=1e-9)


def test_poor_conductors_have_no_sum():
    found = rc.joint_conductance(joint(1e7), gas=AIR, conductivities=(0.3, 0.3))
    assert not found.additive
    assert found.interaction == pytest.approx(found.gas * SIDE / 0.3)
    assert found.total == found.solved < 0.96 * found.parts_sum
    assert "do not add" in found.notes[0]
    assert found.solved > found.spots


def test_in_vacuum_the_conductance_is_that_of_the_stiffness():
    for given in ({}, {"hardness": 2e9}):
        solution = joint(1e7, **given)
        bare = float(rc.conductance(solution, **BOTH)["thermal_conductance_per_area"])
        found = rc.joint_conductance(solution, **BOTH)
        assert found.spots == found.total == pytest.approx(bare, rel=1e-12)
        assert found.solved == pytest.approx(bare, rel=1e-9)
        assert found.notes == ()
        assert rc.joint_conductance(solution, film=1e-15, **BOTH).spots == pytest.approx(bare, rel=1e-3)


def test_films_of_current_and_of_heat_are_one_problem():
    solution = joint(1e7)
    heat = rc.joint_conductance(solution, conductivities=(50.0, 160.0), film=1e-7)
    current = rc.joint_conductance(solution, resistivities=(1 / 50, 1 / 160), film=1e-7)
    assert current.total == pytest.approx(heat.total, rel=1e-9)
    bare, share = rc.joint_conductance(solution, **BOTH).total, solution.contact_fraction
    assert heat.total < 1 / (1 / bare + 1e-7 / share)  # Holm's sum


def test_full_contact_has_the_resistance_of_its_film():
    full = joint(1e11)
    assert full.contact.all()
    assert rc.joint_conductance(full, gas=AIR, **BOTH).total == math.inf
    assert rc.joint_conductance(full, film=1e-6, **BOTH).total == pytest.approx(1e6, rel=1e-9)


def test_radiation_and_missing_cells():
    heights = joint(1e7).problem.surface.heights.copy()
    heights[np.unravel_index(heights.argmin(), heights.shape)] = np.nan
    surface = rc.Surface(heights, rc.Grid((CELLS, CELLS), SIDE / CELLS, periodic=True))
    solution = rc.press(surface, 58.6e9, pressure=1e6)
    for emissivities, expected in (((1, 1), 6.12), ((0.1, 0.1), 0.32)):
        found = rc.joint_conductance(solution, emissivities=emissivities, temperature=300, **BOTH)
        assert found.radiation_coefficient == pytest.approx(expected, abs=0.005)
        open_cells = CELLS**2 - solution.contact.sum() - 1
        assert found.radiation == pytest.approx(found.radiation_coefficient * open_cells / CELLS**2)
    assert "1 cells hold no height" in found.notes[0]
    loose = rc.joint_conductance(solution, emissivities=(1, 1), temperature=3000, **BOTH)
    assert "Radiation counts" in loose.notes[0]
    assert repr(loose).startswith("JointConductance(spots 7")


def test_messages_name_what_is_missing():
    solution = joint(1e7)
    with pytest.raises(rc.InputError, match="accommodation") as caught:
        rc.joint_conductance(solution, gas=rc.Gas("air"), **BOTH)
    followed = eval(caught.value.remedy.removeprefix("give them: "), {"rc": rc})
    assert rc.joint_conductance(solution, gas=followed, **BOTH).gas > 0
    for given, message in (
        (BOTH | {"emissivities": (1, 1)}, "temperature=300"),
        (BOTH | {"emissivities": (1, 1.1), "temperature": 300}, "at most 1"),
        (BOTH | {"film": -1.0}, "0 or more"),
        (BOTH | {"resistivities": (1e-8, 1e-8)}, "exactly one"),
        ({"resistivities": (1e-8, 1e-8), "gas": AIR}, "give conductivities"),
        ({"conductivities": (0.0, 1.0)}, "insulator"),
    ):
        with pytest.raises(rc.InputError, match=message):
            rc.joint_conductance(solution, **given)
    ring = rc.RadialGrid(np.linspace(0, 5e-5, 51))
    ball = rc.press(rc.RadialProfile(-(ring.radii**2) / 2e-3, ring), 1e9, force=1e-4)
    with pytest.raises(rc.InputError, match="press a Surface"):
        rc.joint_conductance(ball, **BOTH)
