"""One surface on several grids: the waves of n cells are those of 2n, 3n and n + 1 cells without the finest."""

import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.mdr.lines.random_lines import line_heights, random_waves, rough_lines
from roughcontact.surface.generation.fourier import synthesise
from roughcontact.surface.generation.wave_grid import multiplicity, wave_amplitudes, wave_powers

SIDES = (2.0, 3.0)  # of cells that are not square
PAIRS = [
    *(((n,), (m,)) for n, m in [(64, 128), (257, 513), (64, 65), (65, 66), (50, 150), (7, 1000)]),
    *(((n, n), (m, m)) for n, m in [(64, 128), (257, 513), (64, 65), (65, 66), (33, 99)]),
    ((48, 81), (96, 100)),
    ((30, 50), (30, 51)),
]


def grid(shape, periodic=True):
    return rc.Grid(shape, tuple(side / n for side, n in zip(SIDES, shape, strict=False)), periodic)


def law(shape, hurst=0.8):
    return rc.SelfAffineSpectrum(hurst, dimension=len(shape), scale=1e-3)


def waves(surface):
    """Return the complex waves about the outer corner of the first cell, by signed wave vector; no Nyquist wave."""
    shape, found = surface.heights.shape, np.fft.fftn(surface.heights) / surface.heights.size
    numbers = [np.fft.fftfreq(n, 1 / n).round().astype(int) for n in shape]
    for axis, (n, k) in enumerate(zip(shape, numbers, strict=True)):
        turn = np.exp(-1j * np.pi * k / n)
        found *= turn.reshape([-1 if other == axis else 1 for other in range(len(shape))])
    return lambda most: found[np.ix_(*[np.arange(-m, m + 1) for m in most])]


@pytest.mark.parametrize(("coarse", "fine"), PAIRS)
@pytest.mark.parametrize("amplitudes", ["exact", "gaussian"])
def test_waves_up_to_the_coarse_nyquist_wavenumber_are_equal(coarse, fine, amplitudes):
    one, two = (
        synthesise(grid(shape), law(shape), np.random.default_rng(7), amplitudes=amplitudes)
        for shape in (coarse, fine)
    )
    most = [(n - 1) // 2 for n in coarse]
    assert np.abs(waves(one)(most) - waves(two)(most)).max() < 1e-12 * one.rms
    assert np.abs(waves(one)(most)).max() > 0.1 * one.rms
    other = synthesise(grid(fine), law(fine), np.random.default_rng(8), amplitudes=amplitudes)
    assert np.abs(waves(one)(most) - waves(other)(most)).max() > 0.1 * one.rms


@pytest.mark.parametrize("shape", [(64,), (65,), (48, 81)])
def test_a_point_keeps_its_height(shape):
    """The middle of three small cells is the centre of the large one; of a surface without finer waves."""
    coarse = grid(shape)
    given = {"rms": 1.0, "short_cutoff": 2.5 * max(coarse.spacing)}
    one, two = (
        rc.self_affine(each, 0.3, rng=np.random.default_rng(2), **given)
        for each in (coarse, grid(tuple(3 * n for n in shape)))
    )
    middle = (slice(1, None, 3),) * len(shape)
    assert np.abs(one.heights - two.heights[middle]).max() < 1e-12


@pytest.mark.parametrize("shape", [(64,), (65,), (48, 81)])
@pytest.mark.parametrize("times", [2, 3])
def test_nodal_grids_share_their_nodes(shape, times):
    nodes = [tuple(factor * n + 1 for n in shape) for factor in (1, times)]
    spacing = [tuple(s / (n - 1) for s, n in zip(SIDES, each, strict=False)) for each in nodes]
    given = {"rms": 1.0, "short_cutoff": 2.5 * max(spacing[0]), "nodal": True}
    one, two = (
        rc.self_affine(rc.Grid(*each), 0.3, rng=np.random.default_rng(2), **given)
        for each in zip(nodes, spacing, strict=True)
    )
    assert np.abs(one.heights - two.heights[(slice(None, None, times),) * len(shape)]).max() < 1e-12


def test_nodes_and_cells_are_of_one_surface():
    """Nodes are the corners of cells: halfway between two centres, where a grid of twice as many nodes has them."""
    n, length = 32, 1.0
    given = {"rms": 1.0, "short_cutoff": length / 12}
    cells = rc.self_affine(rc.Grid((n, n), length / n), 0.3, rng=np.random.default_rng(2), **given)
    nodal = rc.Grid((2 * n + 1,) * 2, length / (2 * n))
    nodes = rc.self_affine(nodal, 0.3, rng=np.random.default_rng(2), nodal=True, **given)
    assert np.abs(cells.heights - nodes.heights[1::2, 1::2]).max() < 1e-12


def test_cells_need_not_be_square_nor_sides_equal():
    """Phases know the integers of a wave alone: stretched sides stretch the surface, if its law is without a length."""
    square, long = (
        rc.self_affine(rc.Grid((40, 60), (dy, 0.1)), -1.0, 1.0, np.random.default_rng(3)) for dy in (0.1, 0.3)
    )
    assert np.abs(square.heights - long.heights).max() < 1e-12


@pytest.mark.parametrize(("hurst", "factor"), [(0.0, 0.11), (0.8, None)])
def test_under_an_rms_height_alone_grids_scale_their_waves(hurst, factor):
    """Each to its own sum: at H = 0 by 11 % between 512 and 2048 cells; what is left is one surface to rounding."""
    scale = [
        math.sqrt(1 / (wave_powers(law((n, n), hurst), (n, n), (1 / n,) * 2) * multiplicity((n, n))).sum())
        for n in (512, 2048)
    ]
    if factor:
        assert scale[0] / scale[1] - 1 == pytest.approx(factor, abs=0.005)
    one, two = (
        rc.self_affine(rc.Grid((n, n), 1 / n), hurst, 1.0, np.random.default_rng(4)) for n in (512, 2048)
    )
    assert one.rms == pytest.approx(1, rel=1e-12) == two.rms
    most = (255, 255)
    assert np.abs(waves(one)(most) - waves(two)(most) * (scale[0] / scale[1])).max() < 1e-12


@pytest.mark.parametrize("hurst", [-1.0, 0.0, 0.8])
@pytest.mark.parametrize("amplitudes", ["exact", "gaussian"])
def test_a_band_scales_all_grids_alike(hurst, amplitudes):
    given = {"rms_band": (1.0, 1 / 25), "amplitudes": amplitudes}
    found = [
        rc.self_affine(rc.Grid((n, n), 1 / n), hurst, 1.0, np.random.default_rng(4), **given)
        for n in (64, 65, 130)
    ]
    small = waves(found[0])((31, 31))
    for other in found[1:]:
        assert np.abs(small - waves(other)((31, 31))).max() < 1e-12 * found[0].rms
    if amplitudes == "exact":
        k = np.hypot(*np.mgrid[-31:32, -31:32])
        assert (np.abs(small[k <= 25]) ** 2).sum() == pytest.approx(1, rel=1e-12)
        assert found[1].rms > found[0].rms > 1


def test_a_band_of_all_waves_is_none():
    """All waves of a grid: up to those in its corners, which a finer grid has, too."""
    spectrum, shape = rc.SelfAffineSpectrum(0.5, short_cutoff=0.1), (65, 65)
    spacing = (1 / 65, 1 / 65)
    plain = wave_amplitudes(spectrum, shape, spacing, rms=2.0)
    np.testing.assert_allclose(
        wave_amplitudes(spectrum, shape, spacing, rms=2.0, rms_band=(1.0, 0.1)), plain, rtol=1e-14
    )
    np.testing.assert_allclose(
        wave_amplitudes(spectrum, shape, spacing, rms=2.0, rms_band=(7.0, 0.05)), plain, rtol=1e-14
    )


@pytest.mark.parametrize("n", [64, 65])
def test_a_band_may_go_to_the_last_wave_of_a_grid_and_no_further(n):
    each, last = rc.Grid((n, n), 1 / n), (n - 1) // 2
    rng = np.random.default_rng(0)
    assert rc.self_affine(each, 0.8, 1.0, rng, rms_band=(1.0, 1 / last)).rms > 1
    assert rc.self_affine(each, 0.8, 1.0, rng, rms_band=(1.0, 1 / (last + 0.9))).rms > 1
    with pytest.raises(ValueError, match=rf"a grid of {n} cells of .* has only waves longer"):
        rc.self_affine(each, 0.8, 1.0, rng, rms_band=(1.0, 1 / (last + 1)))


@pytest.mark.parametrize(
    ("more", "message"),
    [
        ({"rms_band": (0.1, 1.0)}, "begin with the longest"),
        ({"rms_band": 0.1}, "must be two"),
        ({"rms_band": (1.0, 0.0)}, "positive"),
        ({"rms_band": ("1mm", 0.1)}, "number"),
        ({"rms_band": (0.99, 0.8)}, "lies in rms_band"),
        ({"rms_band": (1.0, 0.5), "long_cutoff": 0.3}, "lies in rms_band"),
        ({"rms_band": (1.0, 0.01)}, "only waves longer"),
    ],
)
def test_bands_that_are_refused(more, message):
    with pytest.raises(ValueError, match=message):
        rc.self_affine(rc.Grid((64, 64), 1 / 64), 0.8, 1.0, np.random.default_rng(0), **more)


def test_a_band_without_an_rms_height_is_refused():
    with pytest.raises(ValueError, match="also give rms"):
        synthesise(grid((64,)), law((64,)), np.random.default_rng(0), rms_band=(1.0, 0.5))


@pytest.mark.parametrize(("n", "m"), [(64, 128), (257, 513), (64, 65)])
@pytest.mark.parametrize("amplitudes", ["exact", "gaussian"])
def test_lines_in_batches_nest_too(n, m, amplitudes):
    given = {"rms": 1.0, "rms_band": (2.0, 0.1), "amplitudes": amplitudes}
    one, two = (
        next(iter(rough_lines(grid((k,)), law((k,)), np.random.default_rng(7), 5, **given))) for k in (n, m)
    )
    for first, second in zip(one, two, strict=True):
        most = [(n - 1) // 2]
        first, second = (waves(rc.Surface(heights, grid(heights.shape)))(most) for heights in (first, second))
        assert np.abs(first - second).max() < 1e-12
    few, many = (random_waves(grid((k,)), np.random.default_rng(7), 5, amplitudes=amplitudes) for k in (n, m))
    np.testing.assert_array_equal(few, many[:, : n // 2 + 1])
    given.pop("amplitudes")
    np.testing.assert_allclose(line_heights(grid((n,)), law((n,)), few, **given), one, rtol=0, atol=1e-14)


def test_a_line_is_the_row_of_a_surface_that_knows_no_y():
    ridges = rc.DirectionalSpectrum(lambda qy, qx: np.where(qy == 0, 1 / (1 + qx**2), 0.0))
    surface = synthesise(grid((8, 60)), ridges, np.random.default_rng(1), rms=1.0)
    line = synthesise(rc.Grid(60, 0.05), lambda q: 1 / (1 + q**2), np.random.default_rng(1), rms=1.0)
    np.testing.assert_allclose(surface.heights, np.tile(line.heights, (8, 1)), rtol=0, atol=1e-13)


@pytest.mark.parametrize("amplitudes", ["exact", "gaussian"])
def test_the_generator_moves_on_alike_on_all_grids(amplitudes):
    """So that what is drawn after a surface, the next sample for example, is one on all grids as well."""
    next_numbers = set()
    for shape in [(8,), (64,), (33, 20), (128, 128)]:
        rng = np.random.default_rng(3)
        synthesise(grid(shape), law(shape), rng, amplitudes=amplitudes)
        next_numbers.add(rng.random())
    assert len(next_numbers) == 1
