"""The numbers of another program, surfalize 0.19.2, for one surface written down in closed form."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.surface.parameters.areal import areal_parameters
from roughcontact.surface.parameters.material_ratio import stratified_parameters
from roughcontact.surface.parameters.profile import profile_parameters


@pytest.fixture(scope="module")
def heights():
    y, x = np.mgrid[:120, :150].astype(float)
    waves = np.sin(0.31 * x + 0.11 * y) + 0.7 * np.cos(0.17 * x - 0.43 * y + 1.0)
    return waves + 0.4 * np.exp(np.sin(0.73 * x + 0.59 * y)) + 0.3 * np.sin(0.037 * x * y / 9)


@pytest.fixture(scope="module")
def surface(heights):
    return rc.Surface(heights, rc.Grid((120, 150), (0.8, 1.0)))


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("Sa", 0.7740094460305065),
        ("Sq", 0.9425950133753032),
        ("Ssk", 0.04334105761071722),
        ("Sku", 2.4200507767491506),
        ("Sp", 2.5384668508002006),
        ("Sv", 2.33339137130925),
        ("Sz", 4.87185822210945),
        ("Sdr", 0.12423407335745495),
    ],
)
def test_what_has_one_definition_is_the_same(surface, name, value):
    # Sums in another order.
    assert getattr(areal_parameters(surface), name) == pytest.approx(value, rel=1e-11)


def test_the_gradient_differs_by_its_edges(surface):
    """That program gives the steps along the border the weight of the others; triangles give them half of it."""
    z = surface.heights
    along_x, along_y = np.diff(z, axis=1) / 1.0, np.diff(z, axis=0) / 0.8
    theirs = np.sqrt((along_x**2).mean() + (along_y**2).mean())
    assert theirs == pytest.approx(0.5237398703790075, rel=1e-12)
    half_x, half_y = np.ones((120, 1)), np.ones((1, 150))
    half_x[[0, -1]] = half_y[:, [0, -1]] = 0.5
    square = np.average(along_x**2, weights=half_x * np.ones_like(along_x))
    square += np.average(along_y**2, weights=half_y * np.ones_like(along_y))
    assert areal_parameters(surface).Sdq == pytest.approx(np.sqrt(square), rel=1e-12)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("Sk", 2.6350276031024173),
        ("Spk", 0.7167334265700323),
        ("Svk", 0.6407193468418171),
        ("Smr1", 0.09046568608913848),
        ("Smr2", 0.9148004607724399),
        ("Vmp", 0.03705462578435968),
        ("Vmc", 0.9018569370660915),
        ("Vvc", 1.198324632839166),
        ("Vvv", 0.0948878001844658),
    ],
)
def test_the_material_ratio_curve_differs_by_a_point_at_its_ends(surface, name, value):
    """That program, told to look at 400 000 ratios, lays the curve from 0 to 1 and leaves out its last stretches.

    The triangles at the ends have some 2 000 of the 18 000 points: one or two of them is a thousandth.
    """
    assert getattr(stratified_parameters(surface), name) == pytest.approx(value, rel=1e-3)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("Ra", 0.8103121537305509),
        ("Rq", 0.9761465876387632),
        ("Rsk", -0.07468977252558874),
        ("Rku", 2.424683851204899),
        ("Rt", 4.302582778343211),
        ("Rp", 1.6668314915171512),
        ("Rv", 1.5062840275372977),
        ("Rz", 3.1731155190544493),
    ],
)
def test_a_profile_of_five_whole_sections_is_the_same(heights, name, value):
    profile = rc.Surface(heights[60], rc.Grid(150, 1.0))
    assert getattr(profile_parameters(profile), name) == pytest.approx(value, rel=1e-11)
