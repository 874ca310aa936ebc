"""Arrays of other libraries: what goes in comes out, and nothing but coarse levels goes through NumPy on the way."""

from unittest.mock import Mock

import matplotlib.pyplot as plt
import numpy as np
import pytest

import roughcontact as rc
from libraries import LIBRARIES, without_torch
from roughcontact.files import provenance
from roughcontact.slabs import levels_of_slabs


@pytest.fixture(params=LIBRARIES, ids=lambda kind: kind.__name__)
def library(request):
    return request.param


@pytest.fixture(params=[False, True], ids=["free", "periodic"])
def rough(request):
    grid = rc.Grid((40, 30), (0.02, 0.03), request.param)
    return rc.self_affine(grid, hurst=0.8, rms=0.01, rng=np.random.default_rng(3))


def elsewhere(surface, library):
    return rc.Surface(library.put(surface.heights.copy()), surface.grid)


OPERATORS = {
    "free": lambda: rc.half_space(rc.Grid((13, 20), (0.3, 0.5)), 2.0),
    "periodic": lambda: rc.half_space(rc.Grid((12, 21), (0.3, 0.5), True), 2.0),
    "dense": lambda: rc.half_space(rc.Grid((6, 7), (0.3, 0.5)), 2.0, method="dense"),
    "ring": lambda: rc.ring(rc.RadialGrid.uniform(20, 1.0), 2.0),
    "line": lambda: rc.line(rc.Grid(50, 0.5), 2.0),
    "periodic line": lambda: rc.line(rc.Grid(50, 0.5, True), 2.0),
    "foundation": lambda: rc.foundation(rc.Grid(50, 0.5), 2.0),
}


@pytest.mark.parametrize("name", OPERATORS)
@pytest.mark.parametrize(("dtype", "digits"), [("float64", 1e-14), ("float32", 1e-5)])
def test_operators(library, name, dtype, digits):
    """Single precision: 6e-8, times what a transform of some hundred values adds up."""
    operator = OPERATORS[name]()
    p = np.random.default_rng(0).standard_normal(operator.grid.shape)
    exact = operator.apply(p)
    found = operator.apply(library.put(p, dtype))
    assert library.is_there(found)
    assert str(found.dtype).endswith(dtype)
    np.testing.assert_allclose(library.get(found), exact, rtol=0, atol=digits * np.abs(exact).max())


def test_single_precision_in_numpy_too():
    operator = OPERATORS["free"]()
    assert operator.apply(np.ones(operator.grid.shape, np.float32)).dtype == np.float32


@pytest.mark.parametrize("name", OPERATORS)
def test_whole_numbers_lose_nothing(name):
    operator = OPERATORS[name]()
    p = np.arange(operator.grid.size).reshape(operator.grid.shape) % 3
    np.testing.assert_array_equal(operator.apply(p), operator.apply(p.astype(float)))
    np.testing.assert_array_equal(operator.apply(p > 1), operator.apply((p > 1).astype(float)))


@pytest.mark.parametrize("name", [name for name in OPERATORS if name != "foundation"])
def test_whole_numbers_of_other_libraries_are_refused(library, name):
    operator = OPERATORS[name]()
    with pytest.raises(ValueError, match=r"floating numbers, not .*int64: convert"):
        operator.apply(library.put(np.ones(operator.grid.shape), "int64"))


def test_large_planes_are_pressed_where_they_are(library):
    grid = rc.Grid((250, 260), 1 / 250)
    rough = rc.self_affine(grid, hurst=0.8, rms=0.01, rng=np.random.default_rng(3))
    here, there = (rc.press(s, 1.0, force=3e-3, tolerance=1e-10) for s in (rough, elsewhere(rough, library)))
    assert library.is_there(there.pressure)
    largest = here.pressure.max()
    np.testing.assert_allclose(library.get(there.pressure), here.pressure, rtol=0, atol=1e-7 * largest)


def test_heights_in_single_precision_are_pressed_in_double(library, rough):
    single = rc.Surface(library.put(rough.heights.copy(), "float32"), rough.grid)
    same = rc.Surface(rough.heights.astype(np.float32), rough.grid)
    here, there = (rc.press(s, 1.0, force=2e-3, tolerance=1e-10) for s in (same, single))
    assert str(there.pressure.dtype).endswith("float64")
    largest = here.pressure.max()
    np.testing.assert_allclose(library.get(there.pressure), here.pressure, rtol=0, atol=1e-7 * largest)
    assert single.rms == pytest.approx(same.rms, rel=1e-12)


@pytest.mark.parametrize("load", [{"force": 2e-3}, {"depth": 0.008}], ids=str)
@pytest.mark.parametrize("solver", [rc.ActiveSet(), rc.PolonskyKeer()], ids=repr)
def test_press(library, rough, load, solver):
    """The same answer as on the host, within the tolerances of both; the arrays where they were."""
    here = rc.press(rough, 1.0, **load, tolerance=1e-10)
    there = rc.press(elsewhere(rough, library), 1.0, **load, solver=solver, tolerance=1e-10)
    assert there.status.converged
    for name in ("pressure", "displacement", "gap", "contact"):
        assert library.is_there(getattr(there, name)), name
    largest = here.pressure.max()
    np.testing.assert_allclose(library.get(there.pressure), here.pressure, rtol=0, atol=1e-7 * largest)
    for name in ("force", "depth", "contact_area", "contact_fraction", "mean_gap", "elastic_energy"):
        assert getattr(there, name) == pytest.approx(getattr(here, name), rel=1e-7), name
    for name in ("stiffness", "interfacial_stiffness"):  # as good as the square of their tolerance, 1e-7
        assert getattr(there, name) == pytest.approx(getattr(here, name), rel=1e-7), name
    for name in ("spot_count", "touches_edge", "resolved", "missing", "notes"):
        assert getattr(there, name) == getattr(here, name), name


def test_the_certificate_is_one_of_double_precision(library, rough):
    """Single precision inside: the residual is recomputed on the host in NumPy."""
    there = rc.press(elsewhere(rough, library), 1.0, force=2e-3, solver=rc.ActiveSet(dense_limit=0))
    back = there.on_host()
    gap = rc.half_space(rough.grid, 1.0).apply(back.pressure) + back.problem.separation - back.depth
    u = gap - back.problem.separation + back.depth
    wrong = np.where(back.pressure > 0, np.abs(gap), -gap).max() / np.abs(u).max()
    assert wrong <= 1.1e-8


def test_curves_hardness_and_missing_points(library, rough):
    heights = rough.heights.copy()
    heights[3:6, 4:9] = np.nan
    here = rc.Surface(heights, rough.grid)
    there = elsewhere(here, library)
    forces = [5e-4, 1e-3, 2e-3]
    a, b = (rc.loading_curve(s, 1.0, forces=forces, tolerance=1e-10, hardness=0.2) for s in (here, there))
    np.testing.assert_allclose(b.depth, a.depth, rtol=1e-7)
    np.testing.assert_allclose(b.stiffness, a.stiffness, rtol=1e-5)
    np.testing.assert_array_equal(b.spots, a.spots)
    assert b.rms == pytest.approx(a.rms, rel=1e-12)


def test_back_on_the_host_it_is_a_solution_like_any(library, rough):
    there = rc.press(elsewhere(rough, library), 1.0, force=2e-3)
    with pytest.raises(ValueError, match="on_host"):
        _ = there.spots
    back = there.on_host()
    assert back.spots.count == there.spot_count
    assert there.to_record() == back.to_record()
    assert isinstance(there.to_dataset()["pressure"].to_numpy(), np.ndarray)
    assert back.on_host() is back


@pytest.mark.parametrize(
    ("heights", "message"),
    [
        (np.zeros((3, 3)), "do not fit"),
        (np.full((2, 2), np.inf), "finite"),
        (np.full((2, 2), np.nan), "all heights are NaN"),
    ],
)
def test_bad_heights_are_refused_there_too(library, heights, message):
    with pytest.raises(ValueError, match=message):
        rc.Surface(library.put(heights), rc.Grid((2, 2), 1.0))


@without_torch
def test_what_is_to_be_differentiated_is_refused(rough):
    import torch

    heights = torch.tensor(rough.heights, requires_grad=True)
    message = (
        r"detach them, heights.detach\(\), or .*: rc.differentiable_curve\(grid, modulus, forces=\[...\]\)\("
    )
    with pytest.raises(ValueError, match=message):
        rc.Surface(heights, rough.grid)
    assert rc.Surface(heights.detach(), rough.grid).rms > 0
    assert rc.differentiable_curve(rough.grid, 1.0, forces=[1e-4])(heights).depth.requires_grad


def test_two_libraries_are_not_mixed(library, rough):
    there = elsewhere(rough, library)
    for first, second in ((there, rough), (rough, there)):
        with pytest.raises(ValueError, match="in one array library"):
            _ = first + second
    region = library.put(np.eye(*rough.grid.shape), "bool")
    operator = rc.half_space(rough.grid, 1.0)
    with pytest.raises(ValueError, match="of the same library as the region"):
        rc.prescribed_displacement(region, np.ones(rough.grid.shape), operator=operator)


def test_a_mask_is_pressed_where_it_lives(library, rough):
    mask = np.eye(*rough.grid.shape, dtype=bool)
    there = rc.contact_stiffness(library.put(mask, "bool"), rough.grid, 1.0)
    assert there == pytest.approx(rc.contact_stiffness(mask, rough.grid, 1.0), rel=1e-7)


def test_pictures_and_theories_fetch_what_they_need(library, rough):
    from roughcontact.evaluation.theories import persson_pressures
    from roughcontact.plot.canvas import pressure_distribution_figure, solution_figure

    there = rc.press(elsewhere(rough, library), 1.0, force=2e-3)
    density = persson_pressures(there)
    stress = np.array([0.1, 0.2])
    # The force is a sum of 1200 cells, in another order.
    np.testing.assert_allclose(density(stress), persson_pressures(there.on_host())(stress), rtol=1e-12)
    assert len(solution_figure(there).axes) >= 2
    assert len(pressure_distribution_figure(there, {"Persson": density}).axes) == 1
    (here,), (law,) = (rc.loading_laws(each, 1.0, "gw") for each in (rough, there.problem.surface))
    assert law.predict("stiffness", 2e-3) == here.predict("stiffness", 2e-3)


def test_a_surface_is_prepared_on_the_host(library, rough):
    there = elsewhere(rough, library)
    for prepare in (
        lambda s: s.levelled("plane"),
        lambda s: s.filtered(short_cutoff=0.1),
        lambda s: s.flipped("x"),
    ):
        with pytest.raises(ValueError, match="prepare the surface first"):
            prepare(there)


def test_files_are_those_of_the_host(library, rough, tmp_path, monkeypatch):
    monkeypatch.setattr(provenance, "datetime", Mock())  # a file says when it was written
    provenance.datetime.now().isoformat.return_value = "2026-01-01T00:00:00+00:00"
    bodies = rc.Solid(1.0, 0.3), rc.Solid(1.0, 0.3)
    there = rc.press(elsewhere(rough, library), bodies, force=1e-3)
    slid = rc.slide(there, bodies, friction=0.3, force=1e-4)
    surfaces, back = (each.problem.surface for each in (there, there.on_host())), there.on_host()
    for one, other, kinds in (
        (*surfaces, ("npz", "nc", "x3p", "txt", "npy", "vti")),
        (there, back, ("nc", "vti")),
        (slid, slid.on_host(), ("nc", "vti")),
    ):
        for kind in kinds:
            files = [tmp_path / f"{name}.{kind}" for name in ("there", "here")]
            for each, file in zip((one, other), files, strict=True):
                rc.write(each, file)
            assert files[0].read_bytes() == files[1].read_bytes(), kind


def test_fields_below_are_those_of_the_host(library, rough):
    there = rc.press(elsewhere(rough, library), 1.0, force=2e-3)
    back, body = there.on_host(), rc.Solid(1.0, 0.3)
    stress, expected = (rc.below(each, 0.01, body) for each in (there, back))
    np.testing.assert_array_equal(stress.von_mises, expected.von_mises)
    moved, expected = (rc.displacement_below(each, 0.01, body) for each in (there, back))
    np.testing.assert_array_equal(moved.z, expected.z)
    assert rc.largest_von_mises(there, body) == rc.largest_von_mises(back, body)
    axes = rc.plot.von_mises_section(there, body)
    assert axes.get_xlabel()
    plt.close(axes.figure)


@pytest.mark.parametrize(("cells", "there"), [(2**12, False), (2**11, True)])
def test_coarse_levels_are_solved_on_the_host_where_they_are_small(library, monkeypatch, cells, there):
    monkeypatch.setattr(levels_of_slabs, "SMALL", cells)
    solved = []
    run = rc.ActiveSet.run

    def noted(self, operator, separation, spec, initial):
        solved.append((separation.shape[0], library.is_there(separation)))
        return run(self, operator, separation, spec, initial)

    monkeypatch.setattr(rc.ActiveSet, "run", noted)
    rough = rc.self_affine(rc.Grid((256, 256), 1 / 256), 0.8, 0.01, rng=np.random.default_rng(3))
    solution = rc.press(elsewhere(rough, library), 1.0, force=3e-3)
    assert library.is_there(solution.pressure)
    assert solved[-1] == (256, True)
    assert {place for side, place in solved if side <= 64} == {there}
