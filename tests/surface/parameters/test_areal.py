import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.surface.parameters.areal import areal_parameters, gradient_and_area


def wave(n=64, amplitude=2.0, length=10.0, periods=4, periodic=True):
    x = np.arange(n) * length / n
    heights = amplitude * np.sin(2 * np.pi * periods * x / length) * np.ones((n // 2, 1))
    return rc.Surface(heights, rc.Grid(heights.shape, length / n, periodic))


def rough(shape=(20, 24), periodic=False, holes=0, seed=0):
    rng = np.random.default_rng(seed)
    heights = rng.standard_normal(shape) ** 3
    heights.flat[rng.choice(heights.size, holes, replace=False)] = np.nan
    return rc.Surface(heights, rc.Grid(shape, (0.5, 0.25), periodic))


def test_heights_of_a_sine():
    """Sq = A/sqrt2, Ssk = 0, Sku = 3/2, Sp = Sv = A, exact for sums over whole waves; Sa is their sum of |sin|."""
    found = areal_parameters(wave())
    assert found.Sq == pytest.approx(math.sqrt(2), rel=1e-12)
    assert found.Ssk == pytest.approx(0, abs=1e-12)
    assert found.Sku == pytest.approx(1.5, rel=1e-12)
    assert (found.Sp, found.Sv, found.Sz) == pytest.approx((2, 2, 4), rel=1e-12)
    # 16 points a wave: the mean of |sin| is 2/pi times (pi/16) cot(pi/16).
    assert found.Sa == pytest.approx(2 * 2 / math.pi * (math.pi / 16) / math.tan(math.pi / 16), rel=1e-12)


def test_sa_of_a_fine_sine_is_the_mean_of_the_continuous_one():
    """2A/pi; n points a wave miss (pi/n)^2/3 of it."""
    assert areal_parameters(wave(512, periods=1)).Sa == pytest.approx(
        2 * 2 / math.pi, rel=1.01 * (math.pi / 512) ** 2 / 3
    )


def test_gradient_of_a_sine():
    """Sdq = A q/sqrt2 times sinc(q D/2), exactly; Sdr is its half square where slopes are small."""
    surface = wave(amplitude=1e-4)
    q, spacing = 2 * math.pi * 4 / 10, 10 / 64
    gradient = 1e-4 * q / math.sqrt(2) * np.sinc(q * spacing / 2 / math.pi)
    found = areal_parameters(surface)
    assert found.Sdq == pytest.approx(gradient, rel=1e-12)
    # sqrt(1 + s) - 1 = s/2 - s^2/8 + ..., s up to 1e-7.
    assert found.Sdr == pytest.approx(gradient**2 / 2, rel=1e-7)


def test_a_tilted_plane_has_its_gradient_and_area():
    y, x = np.mgrid[:7, :9]
    surface = rc.Surface(3.0 * 0.25 * x - 4.0 * 0.5 * y, rc.Grid((7, 9), (0.5, 0.25)))
    assert gradient_and_area(surface) == pytest.approx((5.0, math.sqrt(26) - 1), rel=1e-12)


@pytest.mark.parametrize("periodic", [False, True, (True, False)])
@pytest.mark.parametrize("holes", [0, 30])
def test_gradient_and_area_are_those_of_the_triangles(periodic, holes):
    """Each triangle by the cross product of its edges."""
    surface = rough(periodic=periodic, holes=holes)
    z, (ny, nx), (dy, dx) = surface.heights, surface.grid.shape, surface.grid.spacing
    normals = []
    for i in range(ny if surface.grid.periodic[0] else ny - 1):
        for j in range(nx if surface.grid.periodic[1] else nx - 1):
            corner = {
                (a, b): np.array([b * dx, a * dy, z[(i + a) % ny, (j + b) % nx]])
                for a in (0, 1)
                for b in (0, 1)
            }
            for apex in corner:
                one, other = corner[1 - apex[0], apex[1]], corner[apex[0], 1 - apex[1]]
                normals.append(np.cross(one - corner[apex], other - corner[apex]))
    normals = np.array([n for n in normals if not np.isnan(n).any()])
    gradient, area = gradient_and_area(surface)
    slopes = normals[:, :2] / normals[:, 2:]
    assert gradient == pytest.approx(math.sqrt((slopes**2).sum(axis=1).mean()), rel=1e-12)
    assert area == pytest.approx(np.linalg.norm(normals, axis=1).mean() / (dx * dy) - 1, rel=1e-12)


def test_heights_of_any_surface_against_sums():
    surface = rough(holes=17)
    z = [float(h) for h in surface.heights.ravel() if not math.isnan(h)]
    mean = math.fsum(z) / len(z)
    z = [h - mean for h in z]
    sq = math.sqrt(math.fsum(h * h for h in z) / len(z))
    found = areal_parameters(surface)
    assert found.Sq == pytest.approx(sq, rel=1e-12)
    assert found.Sa == pytest.approx(math.fsum(abs(h) for h in z) / len(z), rel=1e-12)
    assert found.Ssk == pytest.approx(math.fsum(h**3 for h in z) / len(z) / sq**3, rel=1e-11)
    assert found.Sku == pytest.approx(math.fsum(h**4 for h in z) / len(z) / sq**4, rel=1e-12)
    assert (found.Sp, found.Sv) == pytest.approx((max(z), -min(z)), rel=1e-12)


def test_decay_of_a_wave():
    """acf = cos(qx): it meets 0.2 at acos(0.2)/q across, and never along."""
    found = areal_parameters(wave(256))
    q, spacing = 2 * math.pi * 4 / 10, 10 / 256
    # A cubic spline errs by (q D)^4/384 of the cosine at most, over its slope, which is that of acos(0.2).
    assert found.Sal == pytest.approx(math.acos(0.2) / q, abs=(q * spacing) ** 4 / 384 / math.sqrt(0.96) / q)
    assert math.isnan(found.Str)


def test_aspect_of_an_oblong_texture():
    """acf = exp(-(x/a)^2 - (y/b)^2) meets 0.2 at sqrt(ln 5) a and b.

    The spectrum is given exactly, so that the sample has this autocorrelation but for its mean, which is
    taken out: -pi a b/L^2 at every lag.
    """
    n, a, b = 256, 6.0, 15.0
    x = np.minimum(np.arange(n), n - np.arange(n)).astype(float)
    acf = np.exp(-((x[:, None] / b) ** 2) - (x / a) ** 2)
    amplitude = np.sqrt(np.maximum(np.fft.rfft2(acf).real, 0))
    phases = np.fft.rfft2(np.random.default_rng(0).standard_normal((n, n)))
    heights = np.fft.irfft2(amplitude * phases / np.abs(phases), s=(n, n))
    found = areal_parameters(rc.Surface(heights, rc.Grid((n, n), 1.0, True)))
    lift = math.pi * a * b / n**2  # of the acf; moves the lag by lift/(slope of the acf)
    tolerance = 2 * lift / (0.2 * 2 * math.sqrt(math.log(5))) + 0.01
    assert found.Sal == pytest.approx(a * math.sqrt(math.log(5)), rel=tolerance)
    assert found.Str == pytest.approx(a / b, rel=tolerance)


def test_what_is_no_texture_is_refused():
    with pytest.raises(ValueError, match="2 x 2"):
        areal_parameters(rc.Surface(np.zeros(5), rc.Grid(5, 1.0)))
    with pytest.raises(ValueError, match="all heights are equal"):
        areal_parameters(rc.Surface(np.zeros((5, 5)), rc.Grid((5, 5), 1.0)))
    with pytest.raises(ValueError, match="decay"):
        areal_parameters(rough(), decay=1.0)
    lonely = np.full((4, 4), np.nan)
    lonely[::2, ::2] = [[1.0, 2.0], [3.0, 4.0]]
    with pytest.raises(ValueError, match="no three neighbouring"):
        gradient_and_area(rc.Surface(lonely, rc.Grid((4, 4), 1.0)))
