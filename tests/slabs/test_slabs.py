"""One surface in slabs: the same answers as in one process, on any number of them."""

import math
import threading

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.contact.memory_needed import require_memory_for
from roughcontact.contact.spots import find_spots
from roughcontact.kernels import buffers
from roughcontact.slabs import exchange, levels_of_slabs
from roughcontact.slabs.rows import IMBALANCE, edges_of
from roughcontact.slabs.slab_array import SlabArray
from roughcontact.solver import complementarity
from roughcontact.solver.complementarity import added_stiffness
from roughcontact.solver.inner_product import Measure
from roughcontact.surface.generation import random_heights
from slabs.together import together

SIZES = [1, 2, 3, 4]


def rough(shape, seed=1):
    grid = rc.Grid(shape, 1e-6, periodic=True)
    long = max(grid.lengths) / 4
    return rc.self_affine(grid, hurst=0.8, rms=1e-7, rolloff=long, rng=np.random.default_rng(seed))


def in_slabs(surface, communicator):
    slabs = rc.Slabs(communicator)
    return rc.Surface(slabs.array(surface.heights[slabs.rows(surface.grid.shape[0])]), surface.grid)


@pytest.mark.parametrize("processes", [*SIZES, 7, 64])
@pytest.mark.parametrize("count", [1, 5, 64, 250, 2048, 3000])
def test_rows_are_dealt_out_evenly(count, processes):
    edges = np.array(edges_of(count, processes))
    assert (edges[0], edges[-1], len(edges)) == (0, count, processes + 1)
    held = np.diff(edges)
    # A block more than the others, of one row at least.
    assert held.min() >= 0
    assert held.max() <= max(IMBALANCE * count / processes, -(-count // processes))


@pytest.mark.parametrize("processes", SIZES)
def test_coarse_levels_keep_the_dealing(processes):
    edges, half = np.array(edges_of(2048, processes)), np.array(edges_of(1024, processes))
    np.testing.assert_array_equal(edges, 2 * half)


REDUCTIONS = ("sum", "mean", "max", "min", "any", "all", "count_nonzero", "argmin")
CELL_BY_CELL = ("abs", "isfinite", "isinf", "isnan", "sqrt", "zeros_like")


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("shape", [(8, 6), (3, 5), (2, 3)], ids=str)
def test_functions_are_those_of_numpy(size, shape):
    """Of 3 or 2 rows on 4 processes some have none. Whole numbers, so that sums are exact in any order."""
    x = np.random.default_rng(2).integers(-9, 9, shape).astype(float)
    y = x[::-1].copy()

    def work(communicator):
        slabs = rc.Slabs(communicator)
        a, b = (slabs.array(values[slabs.rows(shape[0])]) for values in (x, y))
        xp = a.__array_namespace__()
        for name in REDUCTIONS:
            assert getattr(xp, name)(a) == getattr(np, name)(x), name
        for name in CELL_BY_CELL:
            np.testing.assert_array_equal(getattr(xp, name)(b * b).gathered(), getattr(np, name)(y * y))
        pairs = {
            "where": (xp.where(a > b, a, 0.0), np.where(x > y, x, 0.0)),
            "clip": (xp.clip(a, -1.0, 2.0), np.clip(x, -1.0, 2.0)),
            "minimum": (xp.minimum(a, b), np.minimum(x, y)),
            "maximum": (xp.maximum(a, 1.0), np.maximum(x, 1.0)),
            "reflected": (1.0 - a, 1.0 - x),
            "scalar of NumPy": (np.float64(2.0) * a, 2.0 * x),
            "inverted": (~(a > b), ~(x > y)),
            "mask": (a[a > b], x[x > y]),
            "rows": (a[1 : shape[0] : 2, :2], x[1 : shape[0] : 2, :2]),
            "repeated": (xp.repeat(a, 2, axis=0), np.repeat(x, 2, axis=0)),
            "beside": (xp.concat([a, b], axis=1), np.concatenate([x, y], axis=1)),
            "down": (xp.roll(a, 1, axis=0), np.roll(x, 1, axis=0)),
            "up": (xp.roll(a, -1, axis=0), np.roll(x, -1, axis=0)),
            "across": (xp.roll(a, 1, axis=1), np.roll(x, 1, axis=1)),
            "flat": (xp.reshape(xp.arange(a.size), a.shape), np.arange(x.size).reshape(shape)),
            "full": (xp.full(shape, 3.0), np.full(shape, 3.0)),
        }
        for name, (found, wanted) in pairs.items():
            assert found.shape == wanted.shape, name
            np.testing.assert_array_equal(found.gathered(), wanted, err_msg=name)
        a -= b
        a[...] = a / 2
        np.testing.assert_array_equal(a.gathered(), (x - y) / 2)

    together(size, work)


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("shape", [(12, 20), (15, 9), (3, 8)], ids=str)
@pytest.mark.parametrize(("dtype", "digits"), [("float64", 1e-14), ("float32", 1e-5)])
@pytest.mark.parametrize("at_once", [2**18, 1])
def test_product(size, shape, dtype, digits, at_once, monkeypatch):
    """Precision: that of the type, times what a transform of some hundred values adds up.

    In one exchange, and in several where the slabs differ.
    """
    monkeypatch.setattr(exchange, "FEWEST", at_once)
    monkeypatch.setattr(exchange, "PARTS", 1)
    body = rc.half_space(rc.Grid(shape, (0.3, 0.5), True), 2.0)
    p = np.random.default_rng(0).standard_normal(shape).astype(dtype)
    exact = body.apply(p.astype(float))

    def work(communicator):
        slabs = rc.Slabs(communicator)
        found = rc.half_space(body.grid, 2.0).apply(slabs.array(p[slabs.rows(shape[0])]))
        assert found.dtype == dtype
        return found.gathered()

    for found in together(size, work):
        np.testing.assert_allclose(found, exact, rtol=0, atol=digits * np.abs(exact).max())


@pytest.mark.parametrize(
    ("size", "shape", "small", "load"),
    [
        (1, (128, 128), 2**16, {"pressure": 1e6}),
        (2, (128, 128), 2**16, {"depth": 2.5e-7}),
        (3, (128, 128), 2**10, {"pressure": 1e6}),
        (4, (256, 128), 2**10, {"depth": 2.5e-7}),
        (2, (75, 90), 2**16, {"pressure": 1e6}),
    ],
    ids=str,
)
def test_press(size, shape, small, load, monkeypatch):
    """Coarse levels gathered, dealt out, or none, since rows do not go in pairs.

    A residual of 1e-12 of the largest displacement is one of the pressure that the largest wavenumber magnifies, some
    ten times as much.
    """
    monkeypatch.setattr(levels_of_slabs, "SMALL", small)
    surface = rough(shape)
    here = rc.press(surface, 1e9, **load, tolerance=1e-12)
    names = ("force", "depth", "contact_fraction", "mean_gap", "elastic_energy", "stiffness", "spot_count")

    def work(communicator):
        there = rc.press(in_slabs(surface, communicator), 1e9, **load, tolerance=1e-12)
        numbers = [getattr(there, name) for name in names]
        return there.pressure.gathered(), numbers, there.residual

    answers = together(size, work)
    pressure, numbers, residual = answers[0]
    np.testing.assert_allclose(pressure, here.pressure, rtol=0, atol=1e-10 * here.pressure.max())
    assert residual <= 1e-12
    # The stiffness is as good as the square of its tolerance, 1e-7; the gap is a difference of depths.
    for name, found in zip(names, numbers, strict=True):
        assert found == pytest.approx(getattr(here, name), rel=1e-9), name
    for other, same, _ in answers[1:]:  # all processes have the same
        np.testing.assert_array_equal(other, pressure)
        assert same == numbers


def test_whole_levels_leave_no_memory_to_those_in_slabs(monkeypatch):
    """Planes of 128 x 128 numbers are among those that are kept for the next."""
    monkeypatch.setattr(levels_of_slabs, "SMALL", 2**14)
    rc.press(rough((128, 128)), 1e9, pressure=1e6)
    assert buffers._total[0] > 0
    together(1, lambda one: rc.press(in_slabs(rough((256, 256)), one), 1e9, pressure=1e6))
    assert (128, 128) not in {shape for shape, _ in buffers._kept}


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("shape", [(12, 9), (3, 8), (40, 40)], ids=str)
@pytest.mark.parametrize("filled", [0.0, 0.3, 0.55, 1.0])
def test_spots_are_those_of_one_process(size, shape, filled):
    """Near 0.59, where contact percolates, spots go through all processes and round the edges."""
    rng = np.random.default_rng(7)
    pressure = np.where(rng.random(shape) < filled, rng.random(shape), 0.0)
    grid = rc.Grid(shape, 1e-6, periodic=True)
    cell = rc.half_space(grid, 1.0).weights
    whole = find_spots(pressure > 0, pressure, grid, Measure(cell))

    def work(communicator):
        slabs = rc.Slabs(communicator)
        there = slabs.array(pressure[slabs.rows(shape[0])])
        spots = find_spots(there > 0, there, grid, Measure(cell))
        return spots.count, spots.labels.gathered(), spots.areas, spots.loads

    for count, labels, areas, loads in together(size, work):
        assert count == whole.count
        np.testing.assert_array_equal(labels, whole.labels)
        # Sums of at most 1600 numbers of one sign: each addition rounds once.
        np.testing.assert_allclose(areas, whole.areas, rtol=1600 * 2.3e-16)
        np.testing.assert_allclose(loads, whole.loads, rtol=1600 * 2.3e-16)


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("shape", [(12, 9), (3, 8), (40, 40)], ids=str)
@pytest.mark.parametrize("many", [10**6, 3])
def test_what_cells_would_add_is_that_of_one_process(size, shape, many, monkeypatch):
    """Cells near them lie on several processes; none has all."""
    monkeypatch.setattr(complementarity, "MANY", many)
    rng = np.random.default_rng(8)
    pressed, weak = rng.random(shape) < 0.3, rng.random(shape) < 0.2
    weak &= ~pressed
    body = rc.half_space(rc.Grid(shape, 1e-6, periodic=True), 1.0)
    whole = added_stiffness(body, pressed, weak)
    assert math.isinf(whole) == (many == 3)

    def work(communicator):
        slabs = rc.Slabs(communicator)
        rows = slabs.rows(shape[0])
        return added_stiffness(body, slabs.array(pressed[rows]), slabs.array(weak[rows]))

    monkeypatch.setattr(SlabArray, "gathered", lambda _: pytest.fail("no process has room for all"))
    # A sum of positive numbers in another order.
    assert together(size, work) == [pytest.approx(whole, rel=weak.sum() * 2.3e-16)] * size


@pytest.mark.parametrize("hardness", [None, 3e7])
def test_curve(hardness):
    """With missing points under a hardness."""
    surface = rough((64, 48))
    if hardness is not None:
        heights = surface.heights.copy()
        heights[30:34, 4:9] = np.nan  # on two processes
        surface = rc.Surface(heights, surface.grid)
    asked = {"pressures": [2e5, 5e5, 1e6], "tolerance": 1e-10, "hardness": hardness}
    here = rc.loading_curve(surface, 1e9, **asked)

    def work(communicator):
        return rc.loading_curve(in_slabs(surface, communicator), 1e9, **asked)

    for there in together(2, work):
        np.testing.assert_allclose(there.depth, here.depth, rtol=1e-8)
        np.testing.assert_allclose(there.stiffness, here.stiffness, rtol=1e-6)
        np.testing.assert_array_equal(there.spots, here.spots)


@pytest.mark.parametrize("size", [*SIZES, 7])
@pytest.mark.parametrize("kind", ["mean", "plane", "quadratic"])
def test_levelling(size, kind):
    """Heights to what sums over 30 numbers round; of 5 rows two of seven processes have none."""
    heights = np.random.default_rng(3).standard_normal((5, 6)) + 3 * np.arange(6)
    heights[2, 3] = np.nan
    surface = rc.Surface(heights, rc.Grid((5, 6), 1.0))
    here = surface.levelled(kind)

    def work(communicator):
        there = in_slabs(surface, communicator).levelled(kind)
        return there.heights.gathered(), there.provenance

    for found, provenance in together(size, work):
        np.testing.assert_allclose(found, here.heights, rtol=0, atol=30 * 2.3e-16 * 18)
        assert provenance == here.provenance


def test_back_on_the_host_it_is_a_solution_like_any():
    surface = rough((64, 64))

    def work(communicator):
        there = rc.press(in_slabs(surface, communicator), 1e9, pressure=1e6)
        back = there.on_host()
        assert isinstance(back.pressure, np.ndarray)
        np.testing.assert_array_equal(back.problem.surface.heights, surface.heights)
        return back.spots.count == there.spot_count

    assert all(together(2, work))


def test_what_is_refused():
    surface = rough((64, 64))
    with pytest.raises(ValueError, match=r"mpi4py.MPI.COMM_WORLD, not 4, which lacks rank"):
        rc.Slabs(4)

    def too_few(communicator):
        rc.Slabs(communicator).array(surface.heights[: 10 - communicator.rank])

    def of_two_types(communicator):
        rc.Slabs(communicator).array(np.zeros((2, 2), [np.float32, np.float64][communicator.rank]))

    def not_periodic(communicator):
        free = rc.Surface(surface.heights, rc.Grid((64, 64), 1e-6))
        rc.press(in_slabs(free, communicator), 1e9, force=1e-3)

    for work, message in [
        (too_few, r"gave \[10, 9\] rows.*Slabs.rows"),
        (of_two_types, "differ in length or type"),
        (not_periodic, "must be periodic along both axes"),
    ]:
        with pytest.raises(ValueError, match=message):
            together(2, work)


def test_an_array_in_slabs_does_not_become_a_whole_one_by_itself():
    rows = rc.Slabs().array(np.ones((4, 3)))
    with pytest.raises(TypeError, match=r"\.gathered\(\)"):
        np.asarray(rows)
    with pytest.raises(ValueError, match=r"Slabs\.array"):
        rows + np.ones((4, 3))
    with pytest.raises(TypeError, match="slices"):
        rows[0]
    assert repr(rows) == "SlabArray(4 x 3 float64, rows 0 to 4 here)"


WAYS = {
    "plain": {},
    "limited": {"rolloff": 1.2e-5, "short_cutoff": 3e-6, "support": "disc"},
    "of a band": {"rms_band": (2e-5, 3.2e-6), "amplitudes": "gaussian"},
    "along a direction": {"anisotropy": (3.0, 0.4)},
}


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("shape", [(24, 20), (15, 9), (3, 40)], ids=str)
@pytest.mark.parametrize("way", WAYS)
def test_surfaces_are_made_in_place(size, shape, way, monkeypatch):
    """Waves to the last bit on any number of processes, heights to what transforms of a thousand waves round.

    Those of one process without slabs have another common factor: its sum rounds otherwise.
    """
    monkeypatch.setattr(exchange, "FEWEST", 2 * shape[0])  # two columns at once
    monkeypatch.setattr(random_heights, "POWERS", 30)
    grid = rc.Grid(shape, (1e-6, 1.2e-6), periodic=True)
    if way == "of a band" and shape == (3, 40):
        return  # no such grid has this band
    given = {"hurst": 0.8, "rms": 1e-7, **WAYS[way]}
    here = rc.self_affine(grid, **given, rng=np.random.default_rng(3))
    made = {}
    real = exchange.plane_of_waves

    def watched(waves, shape, functions):
        def kept(columns):
            part = waves(columns)
            made.update({columns.start + k: part[:, k].copy() for k in range(part.shape[1])})
            return part

        return real(kept, shape, functions)

    monkeypatch.setattr(random_heights, "plane_of_waves", watched)

    def work(communicator):
        slabs = rc.Slabs(communicator)
        there = rc.self_affine(grid, **given, rng=np.random.default_rng(3), slabs=slabs)
        return there.heights.gathered(), there.provenance

    for heights, provenance in together(size, work):
        np.testing.assert_allclose(heights, here.heights, rtol=0, atol=1e-14 * here.rms)
        assert provenance == here.provenance
    waves = np.stack([made[k] for k in range(shape[1] // 2 + 1)], axis=1)
    made.clear()
    together(1, work)
    np.testing.assert_array_equal(np.stack([made[k] for k in range(shape[1] // 2 + 1)], axis=1), waves)


def test_a_spectrum_that_sets_the_height():
    grid = rc.Grid((16, 16), 1e-6, periodic=True)
    spectrum = rc.SelfAffineSpectrum(0.8, rolloff=8e-6).scaled(1e-7, grid)
    here = rc.synthesise(grid, spectrum, np.random.default_rng(3))

    def work(communicator):
        slabs = rc.Slabs(communicator)
        return rc.synthesise(grid, spectrum, np.random.default_rng(3), slabs=slabs).heights.gathered()

    for heights in together(3, work):
        np.testing.assert_allclose(heights, here.heights, rtol=0, atol=1e-14 * here.rms)


def test_processes_agree_on_what_they_draw():
    """The same seed on all; without any, the first process draws for all."""
    grid = rc.Grid((16, 16), 1e-6, periodic=True)

    def work(communicator, rng):
        return rc.self_affine(grid, 0.8, 1e-7, rng, slabs=rc.Slabs(communicator)).heights.gathered()

    for heights in together(3, lambda one: work(one, 5)):
        np.testing.assert_array_equal(
            heights, together(1, lambda one: work(one, np.random.default_rng(5)))[0]
        )
    unseeded = together(3, lambda one: work(one, None))
    for heights in unseeded:
        np.testing.assert_array_equal(heights, unseeded[0])
    assert not np.array_equal(unseeded[0], together(3, lambda one: work(one, None))[0])
    with pytest.raises(ValueError, match="as rng=1"):
        together(2, lambda one: work(one, None if one.rank else 5))


def test_surfaces_that_are_not_made_in_place():
    grid = rc.Grid((16, 16), 1e-6, periodic=True)

    def make(communicator, seed=0, given=None, **keywords):
        rng = np.random.default_rng(seed)
        rc.self_affine(given or grid, 0.8, 1e-7, rng, **keywords, slabs=rc.Slabs(communicator))

    for work, message in [
        (lambda one: make(one, one.rank), "the processes drew different phases"),
        (lambda one: make(one, given=rc.Grid((16, 16), 1e-6)), "must be periodic along both axes"),
        (lambda one: make(one, long_cutoff=1e-6), "no wave of this grid lies inside"),
        (lambda one: make(one, short_cutoff=8e-6, rms_band=(4e-6, 3e-6)), "lies in rms_band"),
    ]:
        with pytest.raises(ValueError, match=message):
            together(2, work)


@pytest.mark.parametrize("processes", [1, 3])
def test_what_does_not_fit_is_refused_on_all_processes(processes, monkeypatch):
    surface, told = rough((1032, 1032)), []

    def refused(communicator):
        with pytest.raises(ValueError, match="memory") as error:
            rc.press(in_slabs(surface, communicator), 1e9, pressure=1e6)
        told.append(str(error.value))
        assert (
            sum(communicator.allgather(rc.memory_needed(in_slabs(surface, communicator))[0])) == 40 * 1032**2
        )

    monkeypatch.setattr("roughcontact.memory.most_memory", lambda: 40 * 1032**2 - 1)
    together(processes, refused)
    assert len(told) == processes
    assert f"a load on 1032 x 1032 cells, held by {processes} processes of which {processes} share" in told[0]


@pytest.mark.parametrize("machines", ["abc", "aba"])
def test_memory_is_that_of_the_processes_that_share_a_machine(machines, monkeypatch):
    """Each process takes two thirds of a machine: one fits, two do not, and then none begins."""
    surface, names, told = rough((516, 516)), {}, []
    share = 40 * 516**2 / 3
    monkeypatch.setattr("roughcontact.memory.most_memory", lambda: 1.5 * share)
    monkeypatch.setattr("platform.node", lambda: names[threading.get_ident()])

    def work(communicator):
        names[threading.get_ident()] = machines[communicator.rank]
        try:
            require_memory_for(in_slabs(surface, communicator))
        except ValueError as error:
            told.append(str(error))

    together(3, work)
    assert len(told) == (3 if machines == "aba" else 0)
    assert all("held by 3 processes of which 2 share this machine" in words for words in told)
