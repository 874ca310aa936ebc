"""Where contacts begin and end: one cell, flat, full, missing, edges."""

from dataclasses import replace

import numpy as np
import oracles
import pytest

import roughcontact as rc


def wave(periodic, n=32):
    x = np.arange(n) / n
    heights = 0.01 * (np.cos(2 * np.pi * x)[:, None] + np.cos(2 * np.pi * x))
    return rc.Surface(heights, rc.Grid((n, n), 1 / n, periodic))


@pytest.mark.parametrize("periodic", [False, True])
def test_one_touching_cell(periodic):
    """A spike: the depth is what one cell makes of the force, and the notes say that the grid speaks."""
    n = 15
    heights = np.zeros((n, n))
    heights[4, 9] = 1.0
    surface = rc.Surface(heights, rc.Grid((n, n), 0.1, periodic))
    solution = rc.press(surface, 2.0, force=1e-4)
    single = rc.contact_stiffness(solution.contact, surface.grid, 2.0)
    assert solution.contact.sum() == 1
    assert solution.stiffness == pytest.approx(single, rel=1e-12)
    assert solution.depth == pytest.approx(1e-4 / single, rel=1e-12)
    assert solution.spots.count == 1
    assert any("single cell" in note for note in solution.notes)


@pytest.mark.parametrize("force", [1e-6, 1.0, 1e6])
def test_a_flat_free_surface_is_a_punch(force):
    surface = rc.Surface(np.zeros((24, 24)), rc.Grid((24, 24), 1 / 24))
    solution = rc.press(surface, 1.0, force=force)
    full = rc.contact_stiffness(np.ones((24, 24), bool), surface.grid, 1.0)
    assert solution.contact.all()
    assert solution.stiffness == pytest.approx(full, rel=1e-7)
    assert solution.depth == pytest.approx(force / full, rel=1e-7)
    assert solution.interfacial_stiffness == np.inf
    assert solution.mean_gap == pytest.approx(0, abs=1e-8 * solution.depth)
    assert solution.touches_edge


@pytest.mark.parametrize("shape", [(16, 20), (1, 1)], ids=str)
@pytest.mark.parametrize("force", [1e-6, 1.0, 1e6])
def test_a_flat_periodic_surface_carries_a_uniform_pressure(force, shape):
    surface = rc.Surface(np.full(shape, 3.0), rc.Grid(shape, 0.1, True))
    solution = rc.press(surface, 1.0, force=force)
    np.testing.assert_allclose(solution.pressure, force / surface.grid.area, rtol=1e-9)
    assert solution.depth == pytest.approx(0, abs=1e-12 * force)
    assert solution.stiffness == solution.interfacial_stiffness == np.inf
    assert not solution.touches_edge
    assert solution.spots.count == 1


def test_full_contact_of_a_periodic_surface():
    """Every wave is flattened: p_q = E* q h_q / 2, the depth is the mean separation, the stiffness infinite."""
    surface = wave(True)
    closing = 2 * np.pi * 0.01  # the sum of both waves' amplitudes E* q h / 2
    solution = rc.press(surface, 1.0, force=2 * closing)
    expected = 2 * closing + surface.heights * np.pi
    np.testing.assert_allclose(solution.pressure, expected, rtol=1e-6)
    assert solution.contact.all()
    assert solution.depth == pytest.approx(0.02, rel=1e-7)
    assert solution.stiffness == np.inf
    assert solution.mean_gap == pytest.approx(0, abs=1e-9)


def test_a_periodic_surface_cannot_sink_below_full_contact():
    surface = wave(True)
    near = rc.press(surface, 1.0, depth=0.02 * (1 - 1e-4))
    assert near.status is rc.Status.CONVERGED
    with pytest.raises(ValueError, match="exceeds the mean separation"):
        rc.press(surface, 1.0, depth=0.02 * (1 + 1e-6))


@pytest.mark.parametrize("periodic", [False, True])
def test_depth_zero_is_first_touch(periodic):
    solution = rc.press(wave(periodic), 1.0, depth=0.0)
    assert solution.status is rc.Status.NO_CONTACT
    assert solution.force == solution.stiffness == solution.contact_area == solution.elastic_energy == 0
    assert solution.interfacial_stiffness == solution.residual == 0
    assert solution.spots.count == 0
    assert solution.mean_gap == pytest.approx(0.02)


def test_a_free_surface_goes_on_beyond_full_contact():
    surface = wave(False)
    full = rc.contact_stiffness(np.ones((32, 32), bool), surface.grid, 1.0)
    one, two = (rc.press(surface, 1.0, force=f, tolerance=1e-10) for f in (1.0, 2.0))
    assert one.contact.all()
    assert two.depth - one.depth == pytest.approx(1 / full, rel=1e-8)


@pytest.mark.parametrize("periodic", [False, True])
def test_an_ellipse_of_one_missing_patch(periodic):
    """Missing cells carry nothing, are counted, and change the answer only by being absent."""
    surface = wave(periodic)
    y, x = np.mgrid[:32, :32]
    patch = ((y - 3) / 3) ** 2 + ((x - 30) / 2) ** 2 <= 1
    heights = surface.heights.copy()
    heights[patch] = np.nan
    holed = rc.Surface(heights, surface.grid)
    lowered = rc.Surface(np.where(patch, -1e3, surface.heights), surface.grid)
    solution = rc.press(holed, 1.0, force=3e-3, tolerance=1e-10)
    assert solution.missing == patch.sum()
    assert not solution.contact[patch].any()
    assert np.isnan(solution.gap[patch]).all()
    assert np.isfinite(solution.mean_gap)
    assert oracles.certificate(holed, 1.0, solution.pressure, solution.depth) <= 1e-10
    assert any(str(patch.sum()) in note for note in solution.notes)
    deep = rc.press(lowered, 1.0, force=3e-3, tolerance=1e-10)
    np.testing.assert_allclose(solution.pressure, deep.pressure, rtol=0, atol=1e-7 * deep.pressure.max())


def test_an_isolated_missing_cell():
    heights = oracles.paraboloid(33, 1.0)
    heights[16, 16] = np.nan  # the apex itself
    solution = rc.press(rc.Surface(heights, rc.Grid((33, 33), 1 / 33)), 1.0, force=1e-2)
    assert solution.missing == 1
    assert solution.pressure[16, 16] == 0
    assert solution.spots.count == 1


def test_contact_at_the_edge_is_said():
    heights = oracles.paraboloid(33, 1.0, apex=(0.5, 0.0))
    solution = rc.press(rc.Surface(heights, rc.Grid((33, 33), 1 / 33)), 1.0, force=1e-3)
    assert solution.touches_edge
    assert any("edge" in note for note in solution.notes)
    inside = rc.press(rc.Surface(oracles.paraboloid(33, 1.0), rc.Grid((33, 33), 1 / 33)), 1.0, force=1e-3)
    assert not inside.touches_edge
    assert not any("edge" in note for note in inside.notes)


def test_spots_go_on_across_a_periodic_edge():
    surface = wave(True)  # the crest sits in the corner
    periodic = rc.press(surface, 1.0, force=1e-4).spots
    free = rc.press(rc.Surface(surface.heights, rc.Grid((32, 32), 1 / 32)), 1.0, force=1e-3).spots
    assert periodic.count == 1
    assert free.count > 1
    for spots, force in ((periodic, 1e-4), (free, 1e-3)):
        assert spots.loads.sum() == pytest.approx(force, rel=1e-10)
        assert len(spots.areas) == len(spots.loads) == spots.labels.max() == spots.count


@pytest.mark.parametrize("shape", [(1, 40), (40, 1), (1, 1), (2, 3)])
def test_slender_grids(shape):
    rng = np.random.default_rng(0)
    surface = rc.Surface(rng.standard_normal(shape) * 0.01, rc.Grid(shape, 0.1))
    solution = rc.press(surface, 1.0, force=1e-3)
    assert oracles.certificate(surface, 1.0, solution.pressure, solution.depth) <= 1e-8


def test_histograms_are_densities():
    solution = rc.press(wave(False), 1.0, force=1e-2)
    for density, edges in (solution.pressure_histogram(20), solution.gap_histogram(30)):
        assert (density * np.diff(edges)).sum() == pytest.approx(1, rel=1e-12)
        assert edges[0] == 0
    with pytest.raises(ValueError, match="at least one bin"):
        solution.gap_histogram(0)


@pytest.mark.parametrize(
    ("more", "message"),
    [
        ({"force": 0.0}, "force must be positive"),
        ({"force": -1.0}, "force must be positive"),
        ({"force": np.nan}, "force must be a number"),
        ({"force": np.inf}, "force must be positive"),
        ({"depth": -1e-9}, "depth counts from first touch"),
        ({"pressure": 0.0}, "pressure must be positive"),
        ({}, "exactly one of force"),
        ({"force": 1.0, "depth": 1.0}, "force and depth"),
        ({"force": 1.0, "modulus": 0.0}, "reduced modulus"),
        ({"force": 1.0, "tolerance": 0.0}, "tolerance must lie"),
        ({"force": [1.0]}, "force must be one number"),
        ({"depth": [1.0]}, "depth must be one number"),
        ({"pressure": [1.0]}, "pressure must be one number"),
        ({"force": 1.0, "tolerance": "1e-8"}, "tolerance must be one number"),
        ({"force": 1.0, "hardness": "1GPa"}, "no material named '1GPa'.*give the numbers of the material"),
        ({"force": 1.0, "operator": "fft"}, "an operator is wanted"),
        ({"force": 1.0, "solver": "active set"}, "a solver is wanted"),
        ({"force": 1.0, "solver": rc.PolonskyKeer}, "a solver is wanted"),
        ({"force": 1.0, "surface": np.zeros((4, 4))}, "surface must be a Surface"),
        ({"force": 1.0, "operator": rc.half_space(rc.Grid((4, 4), 1.0), 1.0)}, "is not the surface's"),
    ],
)
def test_nonsense_is_refused(more, message):
    arguments = {"surface": wave(False), "modulus": 1.0} | more
    with pytest.raises(ValueError, match=message):
        rc.press(arguments.pop("surface"), arguments.pop("modulus"), **arguments)


def test_masks_that_make_no_sense():
    operator = rc.half_space(rc.Grid((4, 4), 1.0, True), 1.0)
    some = np.eye(4, dtype=bool)
    with pytest.raises(ValueError, match="does not fit"):
        rc.contact_stiffness(np.ones((3, 3), bool), operator.grid, 1.0)
    assert rc.contact_stiffness(np.zeros((4, 4), bool), operator.grid, 1.0) == 0
    assert rc.contact_stiffness(np.ones((4, 4), bool), operator.grid, 1.0) == np.inf
    for region, u, message in [
        (np.zeros((4, 4), bool), 1.0, "no cell"),
        (np.ones((4, 4), bool), 1.0, "leave a cell free"),
        (some, 0.0, "not zero"),
        (some, np.nan, "finite"),
        (some, np.inf, "finite"),
        (np.ones((2, 2), bool), 1.0, "does not fit"),
        (some, np.ones(3), "does not fit"),
        (some.tolist(), np.zeros((4, 4)), "not zero"),
    ]:
        with pytest.raises(ValueError, match=message):
            rc.prescribed_displacement(region, u, operator=operator)


def test_missing_cells_leave_a_periodic_surface_a_way_out():
    """They may bulge, so that any depth can be reached."""
    heights = wave(True).heights.copy()
    heights[10:14, 20:30] = np.nan
    holed = rc.Surface(heights, wave(True).grid)
    solution = rc.press(holed, 1.0, depth=0.03)
    assert oracles.certificate(holed, 1.0, solution.pressure, solution.depth) <= 1e-8
    assert np.isfinite(solution.stiffness)


def test_a_resolved_contact_has_nothing_to_say():
    n = 129
    surface = rc.Surface(oracles.paraboloid(n, 100.0), rc.Grid((n, n), 1 / n))
    small, good, full = (rc.press(surface, 1.0, force=f) for f in (1e-8, 1e-4, 1.0))
    assert (small.resolved, good.resolved, full.resolved) == (False, True, False)
    assert any("Not resolved" in note or "single cell" in note for note in small.notes)
    assert good.notes == ()
    assert repr(good).startswith("Solution(converged, force 0.0001 N, depth ")


@pytest.mark.parametrize(
    ("surface", "force", "words"),
    [
        (wave(False), 1.0, "the reduced modulus: real bodies"),
        (wave(False), 10.0, "check the units"),
        (
            rc.Surface(np.eye(1, 1024, 333).reshape(32, 32), rc.Grid((32, 32), 1.0)),
            1e-9,
            "1 point stands more than 8 rms heights above the mean of nearly all, and carries 100% of the force. If "
            "they are faults of the measurement, remove them by masked(above=0.251)",
        ),
    ],
)
def test_what_an_engineer_would_question_is_said(surface, force, words):
    assert any(words in note for note in rc.press(surface, 1.0, force=force).notes)


@pytest.mark.parametrize(("part", "told"), [(0.49, False), (0.51, True)])
def test_a_pressure_beyond_half_the_modulus_is_warned_of(part, told):
    """On a single cell, whose pressure is force over area."""
    surface = rc.Surface(np.eye(1, 64, 27).reshape(8, 8), rc.Grid((8, 8), 0.5))
    solution = rc.press(surface, 4.0, force=part * 4.0 * 0.25)
    assert solution.pressure.max() == pytest.approx(part * 4.0, rel=1e-12)
    words = f"The largest pressure, {part * 4:.3g} Pa, is {part:.3g} times the reduced modulus"
    assert any(note.startswith(words) for note in solution.notes) == told
    assert any("small strains" in note for note in solution.notes) == told


def test_outliers_are_questioned_with_the_force_that_they_carry():
    """Of two high points the force is split by their heights."""
    heights = np.zeros((32, 32))
    heights[4, 4], heights[20, 20] = 1.0, 0.9
    solution = rc.press(rc.Surface(heights, rc.Grid((32, 32), 1.0)), 1.0, depth=1.5)
    share = solution.pressure[[4, 20], [4, 20]].sum() / solution.pressure.sum()
    assert 0.1 < share < 0.9
    assert any(f"and carry {share:.0%} of the force" in note for note in solution.notes)


def joint_of(soft, pressure=3e7, **named):
    """Return a contact of a soft metal of this hardness."""
    grid = rc.Grid((128, 128), 4e-6, periodic=True)
    rough = rc.self_affine(grid, 0.8, 1e-6, np.random.default_rng(1), rolloff=128e-6, short_cutoff=32e-6)
    gold = replace(rc.handbook("gold"), hardness=soft)
    return rc.press(rough, (rc.handbook("steel").solid, gold), pressure=pressure, **named)


@pytest.mark.parametrize(("part", "told"), [(0.18, False), (0.22, True)])
def test_an_elastic_contact_far_above_the_hardness_of_a_named_material_is_wrong(part, told):
    """Where less of the contact is above it, a contact that flows has nearly the same area and stiffness."""
    pressure = joint_of(1e12).pressure
    limit = float(np.quantile(pressure[pressure > 0], 1 - part))
    elastic, flowing = joint_of(limit), joint_of(limit, hardness=limit)
    words = f"of the contact area the pressure exceeds the hardness of gold, {limit / 1e9:.4g} GPa"
    assert any(words in note for note in elastic.notes[:1]) == told
    assert (
        any(f"If this is the first loading, give hardness={limit:.4g}." in note for note in elastic.notes)
        == told
    )
    assert flowing.contact_area == pytest.approx(elastic.contact_area, rel=0.1)
    assert flowing.flattened.stiffness == pytest.approx(elastic.stiffness, rel=0.1)
    for state in (flowing, flowing.flattened):
        assert not any(words in note for note in state.notes)
    assert elastic.problem.modulus == rc.reduced_modulus("steel", "gold")


def test_a_number_is_a_number():
    with pytest.raises(ValueError, match="SI units, not '10N'"):
        rc.press(wave(False), 1.0, force="10N")
    with pytest.raises(ValueError, match=r"a Solid .* is needed"):
        rc.reduced_modulus(210e9)


def test_a_gap_that_is_but_rounding_has_a_histogram():
    """One cell is left open, its gap a rounding error of either sign."""
    from dataclasses import replace

    solution = rc.press(wave(True), 1.0, force=1e-2)
    closed = replace(solution, pressure=solution.pressure + 1.0)
    closed.pressure[0, 0] = 0.0
    closed.__dict__["gap"] = np.full(closed.pressure.shape, -1e-20)
    density, edges = closed.gap_histogram(4)
    assert (density * np.diff(edges)).sum() == pytest.approx(1)


def test_words_on_lines_and_springs():
    """Units per length; a line is judged by its width; the pressure of springs is none to hold against a modulus."""
    grid = rc.Grid(64, 0.1)
    surface = rc.Surface(-((grid.coordinates[0] - 3.2) ** 2), grid)
    line = rc.press(surface, 1.0, force=1e-1, operator=rc.line(grid, 1.0))
    assert "force 0.1 N m-1," in repr(line)
    assert any("narrower than 20 cells" in note for note in line.notes)
    curve = rc.loading_curve(surface, 1.0, forces=[0.1, 0.2], operator=rc.line(grid, 1.0))
    assert repr(curve).endswith("force 0.1 to 0.2 N m-1)")
    with pytest.raises(ValueError, match="a finer grid, or another window of forces"):
        curve.fit()
    springs = rc.press(surface, 1.0, depth=6.0, operator=rc.foundation(grid, 1.0))
    assert springs.pressure.max() > 1.0
    assert not any("modulus:" in note for note in springs.notes)


@pytest.mark.parametrize("window", [(1.0, 1e-8), (-1.0, 1.0), (np.nan, 1.0)])
def test_a_window_that_is_none_is_refused(window):
    curve = rc.loading_curve(wave(False), 1.0, forces=[1e-3, 1e-2])
    with pytest.raises(ValueError, match="to a larger one"):
        curve.fit(window)


@pytest.mark.parametrize(
    "kind", ["plane", "dense", "moving-grid", "multilevel", "periodic", "half", "ring", "line", "foundation"]
)
def test_two_moduli_are_one_too_many(kind):
    """The operator has one, and the call names one: where they differ, numbers would be wrong."""
    grid = rc.Grid((6, 8), 1.0, {"periodic": True, "half": (True, False)}.get(kind, False))
    rows, rings = rc.Grid(8, 1.0), rc.RadialGrid.uniform(8, 1.0)
    operators = {
        "ring": lambda: rc.ring(rings, 2.0),
        "line": lambda: rc.line(rows, 2.0),
        "foundation": lambda: rc.foundation(rows, 2.0),
    }
    method = kind if kind in ("dense", "moving-grid", "multilevel") else "fft"
    operator = operators.get(kind, lambda: rc.half_space(grid, 2.0, method=method))()
    heights = np.random.default_rng(0).random(operator.grid.shape)
    body = rc.RadialProfile(heights, rings) if kind == "ring" else rc.Surface(heights, operator.grid)
    assert rc.press(body, 2.0, force=0.1, operator=operator).status.converged
    with pytest.raises(ValueError, match="modulus of 2 Pa, and 1 Pa is asked for"):
        rc.press(body, 1.0, force=0.1, operator=operator)
