"""The law of rough squares as computed: its window, its cuts, its errors, and what it is for shapes of arguments."""

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

import roughcontact as rc
from roughcontact.theory.stiffness_laws import pohrt_popov, rough_square
from roughcontact.theory.stiffness_laws.rough_square_table import COLUMNS, TABLES

STEEL = {"rms": 2e-6, "length": 1e-3, "modulus": 110e9}
HURST = np.array([0.25, 0.7, 1.0, 1.6, 2.95])
CUTS = ("interior", "period", "patch")
every_cut = pytest.mark.parametrize("cut", CUTS)


def rows(cut):
    return [dict(zip(COLUMNS, row, strict=True)) for row in TABLES[cut]]


@every_cut
def test_exponent_prefactor_and_stiffness_are_one_law(cut):
    alpha, zeta = rough_square.exponent(HURST, cut=cut), rough_square.prefactor(HURST, cut=cut)
    for f in (0.015, 0.02):
        k = rough_square.stiffness(f, HURST, 1.0, 1.0, 1.0, cut=cut)
        np.testing.assert_allclose(k, zeta * f**alpha, rtol=1e-14)
    scaled = rough_square.stiffness(0.02 * 220, HURST, **STEEL, cut=cut)
    plain = rough_square.stiffness(0.02, HURST, 1.0, 1.0, 1.0, cut=cut)
    np.testing.assert_allclose(scaled, 110e6 * plain, rtol=1e-14)


@every_cut
def test_errors_follow_from_those_of_exponent_and_level_and_from_the_misfit(cut):
    """Drawn with their errors and correlation, ln k scatters as is said, to four errors of a scatter, 1/sqrt(2 n)."""
    rng = np.random.default_rng(3)
    for row in rows(cut):
        h, of_alpha, of_level = row["hurst"], row["exponent_error"], row["level_error"]
        covariance = row["correlation"] * of_alpha * of_level
        pairs = rng.multivariate_normal(
            (0, 0), [[of_alpha**2, covariance], [covariance, of_level**2]], size=1000
        )
        for force in (row["highest"] / 1.2, row["highest"]):
            scatter = (pairs[:, 0] * np.log(force / 0.02) + pairs[:, 1]).std()
            error = rough_square.relative_error(force, h, 1.0, 1.0, 1.0, cut=cut)
            assert error >= row["misfit"]
            assert np.sqrt(error**2 - row["misfit"] ** 2) == pytest.approx(scatter, rel=4 / 2000**0.5)
        zeta = (pairs[:, 1] - pairs[:, 0] * np.log(0.02)).std()
        error = rough_square.prefactor_error(h, cut=cut) / rough_square.prefactor(h, cut=cut)
        assert error == pytest.approx(zeta, rel=4 / 2000**0.5)
        assert rough_square.exponent_error(h, cut=cut) == of_alpha


@every_cut
def test_between_the_hurst_exponents_of_the_ensembles_it_goes_one_way(cut):
    dense = np.linspace(*rough_square.HURST_LIMITS, 400)
    assert (np.diff(rough_square.exponent(dense, cut=cut)) < 0).all()
    assert (np.diff(rough_square.stiffness(0.015, dense, 1.0, 1.0, 1.0, cut=cut)) > 0).all()


@every_cut
def test_a_hurst_exponent_that_is_left_out_is_interpolated(cut):
    """The page states these bounds: 1.1 % of kappa, 2.5 standard errors of alpha."""
    table = {name: np.array([row[name] for row in rows(cut)]) for name in COLUMNS}
    hurst = table["hurst"]
    for place in range(1, len(hurst) - 1):
        others = np.arange(len(hurst)) != place
        alpha, kappa = (
            PchipInterpolator(hurst[others], table[name][others])(hurst[place])
            for name in ("exponent", "level")
        )
        assert abs(alpha - table["exponent"][place]) < 2.55 * table["exponent_error"][place]
        assert kappa == pytest.approx(table["level"][place], rel=0.0115)


def test_a_random_cut_is_stiffer_and_a_patch_softer_than_the_interior():
    """A smooth crest beside its other part is stiffer than alone in the middle, and softer without it."""
    interior, period, patch = (rough_square.stiffness(0.015, HURST, 1.0, 1.0, 1.0, cut=cut) for cut in CUTS)
    assert (period > interior).all()
    assert (patch < interior).all()
    assert (interior - patch < period - interior).all()


@every_cut
def test_the_range_of_single_surfaces_is_that_of_the_table_at_the_ends_of_the_window(cut):
    for row in rows(cut):
        given = (row["hurst"], 1.0, 1.0, 1.0)
        law = rough_square.law(*given, cut=cut)
        for force, end in zip(law.domain, ("first", "last"), strict=True):
            low, high = rough_square.single_range(force, *given, cut=cut)
            mean = rough_square.stiffness(force, *given, cut=cut)
            assert low / mean == pytest.approx(row[f"low_{end}"], rel=1e-9)
            assert high / mean == pytest.approx(row[f"high_{end}"], rel=1e-9)
            assert low < mean < high


@every_cut
def test_squares_needed_reach_the_wanted_error(cut):
    """Exponents of n squares scatter by sd/sqrt(n), and H by that over dalpha/dH, here by differences."""
    for row in rows(cut)[1:-1]:
        hurst = row["hurst"]
        needed = rough_square.squares_needed(hurst, 0.1, cut=cut)
        slope = np.subtract(*(rough_square.exponent(hurst + step, cut=cut) for step in (1e-5, -1e-5))) / 2e-5
        assert row["scatter"] / np.sqrt(needed) == pytest.approx(0.1 * abs(slope), rel=1e-3)
        assert rough_square.squares_needed(hurst, 0.05, cut=cut) == pytest.approx(4 * needed)


def test_the_range_of_single_surfaces_holds_for_one_that_is_computed():
    """Nine in ten lie inside; of these three, with phases that the ensemble does not hold, all do."""
    grid = rc.Grid((64, 64), 1 / 64)
    for seed in range(3):
        drawn = rc.self_affine(rc.Grid((64, 64), 1 / 64, periodic=True), hurst=1.6, rms=0.01, rng=seed)
        row, column = np.unravel_index(drawn.heights.argmax(), drawn.heights.shape)
        surface = rc.Surface(np.roll(drawn.heights, (32 - row, 32 - column), (0, 1)), grid)
        k = rc.press(surface, 1.0, force=0.02 * 0.01).stiffness
        low, high = rough_square.single_range(0.02 * 0.01, 1.6, 0.01, 1.0, 1.0, cut="interior")
        assert low < k < high


@every_cut
def test_shapes_follow_numpy(cut):
    f = np.array([[0.015], [0.02]])
    for function in (rough_square.stiffness, rough_square.relative_error):
        assert function(f, np.array([0.7, 1.0, 1.3]), 1.0, 1.0, 1.0, cut=cut).shape == (2, 3)
        assert np.ndim(function(0.02, 0.7, 1.0, 1.0, 1.0, cut=cut)) == 0
    assert np.ndim(rough_square.exponent(0.7, cut=cut)) == 0


@every_cut
@pytest.mark.parametrize("hurst", [0.25, 0.7])
def test_it_ends_where_its_ensembles_do(cut, hurst):
    surface = (hurst, *STEEL.values())
    law = rough_square.law(*surface, cut=cut)
    low, high = law.domain
    scale = 110e9 * 1e-3
    assert rough_square.stiffness(low, *surface, cut=cut) == pytest.approx(
        rough_square.LEAST_STIFFNESS * scale, rel=1e-12
    )
    [highest] = [row["highest"] for row in rows(cut) if row["hurst"] == hurst]
    assert high == pytest.approx(highest * scale * 2e-6, rel=1e-12)
    assert (highest == pohrt_popov.FORCE_LIMIT) == (cut != "interior" or hurst > 0.5)
    for outside in (low * (1 - 1e-6), high * (1 + 1e-6)):
        assert np.isnan(law.predict("stiffness", outside))
        with pytest.raises(ValueError, match="compute the surface, or use pohrt_popov"):
            rough_square.stiffness(outside, *surface, cut=cut)
    forces = np.geomspace(low, high, 5)
    np.testing.assert_array_equal(
        law.predict("stiffness", forces), rough_square.stiffness(forces, *surface, cut=cut)
    )


def test_a_hurst_exponent_outside_and_a_cut_that_does_not_exist_are_refused():
    for hurst in (0.05, 3.0):
        with pytest.raises(ValueError, match=r"hurst must lie from 0\.1 to 2\.95"):
            rough_square.exponent(hurst, cut="interior")
    with pytest.raises(ValueError, match="no cut 'middle'; there are interior, period, patch"):
        rough_square.exponent(0.7, cut="middle")
    with pytest.raises(TypeError, match="cut"):
        rough_square.exponent(0.7)


class TestMaps:
    """The laws of a map: only for a free square whose longest waves have its side."""

    def law(self, shape=(64, 64), periodic=False, spacing=1e-6, **more):
        drawn = rc.self_affine(rc.Grid(shape, spacing, periodic=True), hurst=0.8, rms=1e-7, rng=1, **more)
        return rc.Surface(drawn.heights, rc.Grid(shape, spacing, periodic=periodic))

    def test_of_a_square(self):
        surface = self.law()
        [law] = rc.loading_laws(surface, 1e11, "rough-square-period", hurst=0.8)
        direct = rough_square.law(0.8, surface.rms, 64e-6, 1e11, cut="period")
        assert law.domain == pytest.approx(direct.domain, rel=1e-12)

    @pytest.mark.parametrize(
        ("surface", "message"),
        [
            ({"shape": (64, 80)}, "this map is 80 µm by 64 µm: crop it to a square"),
            ({"periodic": True}, "this map is periodic: use persson"),
            ({"shape": (128, 128), "rolloff": 16e-6}, r"has a roll-off at 1\d\.\d µm, with a side of 128 µm"),
        ],
    )
    def test_of_other_maps(self, surface, message):
        with pytest.raises(ValueError, match=message):
            rc.loading_laws(self.law(**surface), 1e11, "rough-square-interior")

    def test_a_given_rolloff(self):
        with pytest.raises(ValueError, match="has a roll-off at 20"):
            rc.loading_laws(self.law(), 1e11, "rough-square-interior", rolloff=20e-6)
        assert rc.loading_laws(self.law(), 1e11, "rough-square-interior", rolloff=64e-6)
