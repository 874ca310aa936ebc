"""The loads that a curve takes by default: they suit the surface, and say why."""

import dataclasses
import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.contact.loads import load_search
from roughcontact.contact.loads.load_ends import NEAR
from roughcontact.contact.loads.load_range import FORCES_BELOW, _even
from roughcontact.contact.loads.load_search import LoadSearch, SearchedLoad, SurfaceKind
from roughcontact.contact.stiffness import cell_stiffness, full_contact_stiffness
from roughcontact.kernels import loader

BEYOND = 1 + 1.001 * NEAR


def rough(n=128, *, periodic=False, seed=1, rms=1e-7, **named):
    grid = rc.Grid((n, n), 1e-6, periodic=periodic)
    return rc.self_affine(grid, hurst=0.8, rms=rms, rng=np.random.default_rng(seed), **named)


def bent(surface, times):
    """Return a surface on a ball whose form is so many times its rms height."""
    x, y = (c - c.mean() for c in surface.grid.coordinates)
    form = -(x[:, None] ** 2 + y**2)
    heights = surface.heights + times * surface.rms * form / form.std()
    return rc.Surface(heights, surface.grid)


def mean_spot(solution):
    """Return the cells of the mean spot, weighted by force."""
    return solution.spots.loads @ solution.spots.areas / solution.force / solution.problem.grid.cell_area


def test_kinds():
    flat = rough(64, rolloff=16e-6)  # without long waves, which may look like a form
    tilted = rc.Surface(flat.heights + 1e-6 * np.arange(64), flat.grid)
    ridges = rc.Surface(flat.heights[:1].copy(), rc.Grid((1, 64), 1e-6))
    kinds = {
        "periodic": rough(64, periodic=True),
        "nominally flat": flat,
        "with form": bent(flat, 3.0),
        "profile": rc.Surface(flat.heights[0], rc.Grid(64, 1e-6)),
    }
    for name, surface in kinds.items():
        assert SurfaceKind.of(surface).value == name
    assert SurfaceKind.of(bent(flat, 0.3)) is SurfaceKind.FLAT
    assert SurfaceKind.of(tilted) is SurfaceKind.FLAT  # a plane is no form
    assert SurfaceKind.of(ridges) is SurfaceKind.FLAT
    rings = rc.RadialGrid.uniform(9, 1.0)
    assert SurfaceKind.of(rc.RadialProfile(-(rings.radii**2), rings)) is SurfaceKind.FORM


MAPS = {
    "fractal": lambda: (rough(), None, "20 cells", "full-contact"),
    "fractal, periodic": lambda: (rough(periodic=True), None, "20 cells", "half of the area"),
    "flat, periodic": lambda: (
        rough(periodic=True, rolloff=16e-6),
        None,
        "spots of 16 cells",
        "half of the area",
    ),
    "flat, free": lambda: (rough(rolloff=16e-6), None, "20 cells", "full-contact"),
    "smooth, periodic": lambda: (
        rough(periodic=True, rolloff=32e-6, short_cutoff=16e-6),
        None,
        "20 cells",
        "half of the area",
    ),
    "form": lambda: (bent(rough(), 10.0), None, "20 cells", "border"),
    "steep": lambda: (rough(rms=2e-5), None, "which no load reaches", "reduced modulus"),
    "steep, rolled off": lambda: (rough(64, rms=4e-6, periodic=True), None, "20 cells", "reduced modulus"),
    "larger than the pilot": lambda: (
        rough(200, periodic=True, rolloff=64e-6),
        None,
        "20 cells",
        "half of the area",
    ),
    "hardness": lambda: (rough(64, rms=2e-6), 1e8, "20 cells", "full-contact"),
    "hardness, periodic": lambda: (
        rough(periodic=True, rms=2e-6, rolloff=16e-6),
        1e8,
        "spots of 16 cells",
        "half of the area",
    ),
    "soft": lambda: (rough(64, rms=2e-6, seed=2), 1e6, "20 cells", "half of the"),
    "hardness by spots": lambda: (rough(64, rms=2e-6), rc.NixGao(1e8, 4e-6), "20 cells", "full-contact"),
}


@pytest.mark.parametrize("name", MAPS)
def test_each_end_is_where_it_is_said_to_be(name):
    surface, hardness, start, end = MAPS[name]()
    found = rc.load_range(surface, 1e9, hardness=hardness)
    assert start in found.reasons[0]
    assert end in found.reasons[1]
    first, before, last, beyond = (
        rc.press(surface, 1e9, force=force, hardness=hardness)
        for force in (found.lowest, found.lowest / BEYOND, found.highest, found.highest * BEYOND)
    )

    # Under a decade of large spots the range begins without them, and says so.
    large = not any("Spots have fewer than 16 cells" in note for note in found.notes)

    def begun(solution):
        """How far above its limit the lower of the two is."""
        stiff = solution.flattened.stiffness / (20 * cell_stiffness(solution.problem.operator))
        return min(stiff, mean_spot(solution) / 16) if large else stiff

    def ended(solution):
        share = solution.flattened.stiffness / full_contact_stiffness(solution.problem)
        return {
            "full-contact": share / 0.9,
            "half of the area": solution.contact_fraction / 0.5,
            "half of the": solution.contact_fraction / 0.5,
            "border": float(solution.touches_edge),
            "reduced modulus": solution.force / solution.contact_area / 0.5e9,
        }[end]

    # A level is a hundredth from its limit, or passes it within a hundredth of the force.
    if found.lowest < found.highest:
        assert begun(first) >= 1
        assert begun(first) <= 1 + NEAR or begun(before) < 1
    assert ended(last) < 1
    assert ended(last) >= 1 - NEAR or ended(beyond) >= 1


def test_a_contact_that_begins_with_many_cells_has_no_lower_end():
    """The crest of a wave is a row of cells: twenty of them touch at once."""
    grid = rc.Grid((64, 64), 1e-6, periodic=True)
    found = rc.load_range(rc.shapes.wave(grid, amplitude=1e-6, wavelength=64e-6), 1e9)
    assert found.reasons[0] == "the smallest force of the search"
    assert found.below


def test_loads_are_even_in_stiffness_and_area_and_not_in_close_pairs():
    surface = rough()
    found = rc.load_range(surface, 1e9)
    assert len(found.forces) == 24
    assert found.below == FORCES_BELOW <= 6
    assert (np.diff(found.forces) > 0).all()
    assert found.forces[found.below] == pytest.approx(found.lowest, rel=5e-3)  # three digits
    assert found.forces[-1] == pytest.approx(found.highest, rel=5e-3)
    curve = rc.loading_curve(surface, 1e9)
    np.testing.assert_allclose(curve.force, found.forces, rtol=1e-12)  # sums over some thousand cells
    inside = curve.force >= found.lowest * (1 - 5e-3)
    assert curve.resolved[inside].sum() >= 10
    assert curve.force[inside].max() > 10 * curve.force[inside].min()
    # Of twenty loads nineteen steps are even in the sum of both ways. Each way is within a factor of two of the mean,
    # as exponents of k and A are, and another two where the curve of the search, known at four loads a decade, is bent.
    for quantity in (curve.force, curve.stiffness, curve.contact_area):
        steps = np.diff(np.log(quantity[inside]))
        assert steps.max() < 4 * steps.mean()
    steps = np.diff(np.log(curve.force[inside]))
    assert steps.min() > steps.mean() / 4
    assert curve.fit().count >= 3


@pytest.mark.parametrize(
    ("stiffness", "area", "force"),
    [
        # In x = log F of 0 to 4, k rises over its range at x < 2 only: both are 3x/4 there, and x/4 + 1 above.
        (
            lambda f: np.minimum(f, 100) ** 0.5,
            lambda f: f ** (2 / 3),
            lambda w: np.where(w < 1.5, 4 * w / 3, 4 * w - 4),
        ),
        (lambda f: f**0.5, lambda f: 0 * f + 1, lambda w: 2 * w),
        (lambda f: 0 * f + 1, lambda f: f, lambda w: 2 * w),
        (
            lambda f: 0 * f + 1,
            lambda f: 1 + 1e-8 * np.sin(f),
            lambda w: 2 * w,
        ),  # within the tolerance of a load
    ],
)
def test_forces_are_even_in_what_changes(stiffness, area, force):
    loads = 10.0 ** np.arange(-1, 5.1, 0.25)
    columns = zip(loads, stiffness(loads), area(loads), strict=True)
    search = LoadSearch(
        None, SurfaceKind.FLAT, tuple(SearchedLoad(*each, *[0.0] * 4, "") for each in columns)
    )
    found = np.log10(_even(search, 1.0, 1e4, 13))
    np.testing.assert_allclose(found, force(np.linspace(0, 2, 13)), atol=1e-12)


@pytest.mark.parametrize(("count", "enough"), [(300, True), (1000, False)])
def test_more_forces_than_steps_of_the_search_have_three_digits(count, enough):
    """The widest steps are halved; once a hundredth is left between any two, three digits hold no more."""
    found = rc.load_range(rough(32), 1e9, count=count)
    steps = np.diff(np.log(found.forces))
    assert steps.min() > 0
    assert (len(found.forces) == count) == enough
    assert [float(f"{force:.2e}") for force in found.forces] == found.forces.tolist()
    assert enough or steps.max() < math.log(1.02)  # of two digits apart, the one between is taken


def test_loads_of_punches_are_even_in_force():
    """Three pillars that keep area and stiffness until their mean pressure is half of the modulus."""
    heights = np.zeros((64, 48))
    heights[5:15, 5:15] = heights[40:50, 4:14] = heights[30:40, 30:42] = 1e-4
    found = rc.load_range(rc.Surface(heights, rc.Grid((64, 48), 1e-6)), 1e9)
    assert found.highest == pytest.approx(0.5e9 * 320e-12, rel=NEAR)
    # Steps of forces that are rounded to three digits, each by half of its last one.
    steps = np.diff(np.log(found.forces[found.below :]))
    np.testing.assert_allclose(steps, math.log(found.highest / found.lowest) / 19, atol=0.011)
    assert found.forces[-1] == pytest.approx(found.highest, rel=5e-3)


def test_loads_follow_the_scales():
    surface = rough(64)
    found = rc.load_range(surface, 1e9)
    higher = rc.load_range(rc.Surface(10 * surface.heights, surface.grid), 1e11)
    assert higher.lowest / found.lowest == pytest.approx(1000, rel=1e-6)
    assert higher.highest / found.highest == pytest.approx(1000, rel=1e-6)
    np.testing.assert_allclose(higher.forces / found.forces, 1000, rtol=1.1e-2)  # both to three digits


def test_machine_code_changes_no_load(monkeypatch):
    surface = rough(96)
    found = rc.load_range(surface, 1e9)
    monkeypatch.setattr(loader, "is_available", lambda: False)
    np.testing.assert_array_equal(rc.load_range(surface, 1e9).forces, found.forces)


@pytest.mark.slow
@pytest.mark.parametrize("hardness", [1e8, 1e6, rc.NixGao(1e7, 4e-6)])
def test_what_flows_goes_on_until_half_of_the_map_bears(hardness):
    """Elasticity ends nothing there: what flows is kept, and its contact is as large as another."""
    surface = rough(32, rms=2e-6)
    found = rc.load_range(surface, 1e9, hardness=hardness)
    ends = (
        "0.9 of the full-contact stiffness",
        "half of the area in contact",
        "0.5 of the force that the hardness can carry",
    )
    assert found.reasons[1] in ends
    heavy = rc.press(surface, 1e9, force=found.highest, hardness=hardness)
    assert 0.2 < heavy.contact_fraction < 0.6
    assert found.highest < rc.load_range(surface, 1e9).highest
    curve = rc.loading_curve(surface, 1e9, forces=found.forces, hardness=hardness)
    assert curve.resolved.sum() >= 15


def test_a_map_on_one_feature_goes_on_until_others_carry():
    surface = rough(128, rms=1e-8, rolloff=32e-6)
    x, y = surface.grid.coordinates
    particle = 3e-7 * np.exp(-(((x[:, None] - 40e-6) ** 2 + (y - 70e-6) ** 2) / (2 * 6e-6**2)))
    dirty = rc.Surface(surface.heights + particle, surface.grid)
    found, clean = rc.load_range(dirty, 1e9), rc.load_range(surface, 1e9)
    assert found.single_feature
    assert any("one feature" in note and "up to" in note for note in found.notes)
    assert not clean.single_feature
    assert not clean.notes
    light, heavy = (rc.press(dirty, 1e9, force=f) for f in (found.lowest, found.highest))
    assert light.spots.loads.max() > 0.5 * light.force
    assert heavy.spots.loads.max() < 0.5 * heavy.force


@pytest.mark.parametrize(
    ("surface", "word"),
    [
        (rough(4), "too few cells"),
        (rough(64, rms=2e-4), "so steep that elasticity ends at first touch"),
        (rough(32), "only"),
    ],
)
def test_what_is_not_resolved_is_said_with_a_remedy(surface, word):
    found = rc.load_range(surface, 1e9)
    (note,) = (note for note in found.notes if "one feature" not in note)
    assert word in note
    assert "take a finer" in note or "give a hardness" in note


def test_lines_and_springs():
    line = rc.Surface(rough(64).heights[0], rc.Grid(64, 1e-6))
    found = rc.load_range(line, 1e9, operator=rc.line(line.grid, 1e9))
    np.testing.assert_allclose(found.forces[[0, -1]] / (1e9 * line.rms), [0.03, 3.0])
    springs = rc.foundation(line.grid, 1e9)
    curve = rc.loading_curve(line, 1e9, operator=springs)
    assert curve.resolved.any()


@pytest.mark.parametrize("count", [1, 2, 7, 40])
def test_as_many_loads_as_are_wanted(count):
    forces = rc.load_range(rough(64), 1e9, count=count).forces
    assert len(forces) == count
    assert (np.diff(forces) > 0).all()


@pytest.mark.parametrize(("cells", "count"), [(64, 7), (64, 12), (128, 7)])
def test_few_loads_over_a_wide_range_are_no_narrow_range(cells, count):
    grid = rc.Grid((cells, cells), 1e-6)
    surface = rc.self_affine(grid, 0.8, 1e-7, np.random.default_rng(0), short_cutoff=8e-6)
    found = rc.load_range(surface, 1e9, count=count)
    assert found.highest > 10 * found.lowest
    assert not any("less than a power law takes" in note for note in found.notes)


def test_refusals():
    surface = rough(16)
    with pytest.raises(ValueError, match="flat surface"):
        rc.load_range(rc.Surface(np.zeros((8, 8)), rc.Grid((8, 8), 1.0)), 1e9)
    with pytest.raises(ValueError, match="count"):
        rc.load_range(surface, 1e9, count=0)
    assert math.isfinite(rc.load_range(surface, 1e9).lowest)


@pytest.mark.parametrize("modulus", [1e9, 1e-3])
def test_a_pilot_that_begins_too_late_is_gone_behind(monkeypatch, modulus):
    """One that is a hundred times as rough begins at ten times the load of twenty cells, in any unit."""
    surface = rough(48, rms=1e-9)
    found = rc.load_range(surface, modulus)

    def rougher(problem):
        return dataclasses.replace(problem, separation=100 * problem.separation)

    monkeypatch.setattr(load_search, "pilot_of", rougher)
    late = rc.load_range(surface, modulus)
    assert late.lowest == pytest.approx(found.lowest, rel=0.02)
    assert late.reasons[0] == found.reasons[0]
