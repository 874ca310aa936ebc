"""Line contact: closed forms of cylinders, strips and waves."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.halfspace.influence.love import strip

MODULUS = 2.0


def cylinder(cells, force=1.0, reference=4.0, offset=0.0):
    grid = rc.Grid(cells, 4.0 / cells)
    x = grid.coordinates[0] - 2 - offset * grid.spacing[0]
    operator = rc.line(grid, MODULUS, reference_length=reference)
    return rc.press(rc.Surface(-(x**2) / 2, grid), MODULUS, force=force, operator=operator)


def test_the_table_of_the_thesis():
    """B_0 = 3; the closed form against itself in 30 digits where the series takes over."""
    import mpmath

    table = strip(np.arange(2000))
    assert table[0] == 3.0
    with mpmath.workdps(40):
        for k in (1, 2, 7, 8, 9, 30, 1999):
            q = mpmath.mpf(k)
            exact = 3 - (q + 1) ** 2 * mpmath.log(q + 1) + 2 * q**2 * mpmath.log(q)
            exact -= (q - 1) ** 2 * mpmath.log(q - 1) if k > 1 else 0
            # The closed form of eight strips and fewer has terms of up to 9^2 ln 9 = 180, rounded.
            assert table[k] == pytest.approx(float(exact), abs=2e-13 if k < 8 else 4e-15 * abs(float(exact)))


def test_a_load_presses_down_and_less_far_away():
    grid = rc.Grid(50, 0.1)
    p = np.zeros(50)
    p[0] = 1.0
    u = rc.line(grid, MODULUS).apply(p)
    assert (np.diff(u) < 0).all()
    assert u[-1] > 0


def test_far_field_is_a_line_load():
    """u = (2 F/pi E*) (ln(L_ref/x) + (dx/x)^2/12): the next term is that of a strip averaged over a strip."""
    grid = rc.Grid(400, 0.1)
    p = np.zeros(400)
    p[0] = 3.0
    x, force = 39.9, 0.3
    exact = 2 * force / (np.pi * MODULUS) * (np.log(100.0 / x) + (0.1 / x) ** 2 / 12)
    assert rc.line(grid, MODULUS, reference_length=100.0).apply(p)[-1] == pytest.approx(exact, abs=1e-12)


def test_hertz_on_cylinders():
    """a^2 = 4 F R/(pi E*), p0 = 2F/(pi a), d = (F/pi E*)(2 ln(2 L_ref/a) + 1); means over offsets within a cell."""
    a = np.sqrt(4 / (np.pi * MODULUS))
    depth, p0 = (2 * np.log(2 * 4.0 / a) + 1) / (np.pi * MODULUS), 2 / (np.pi * a)

    def errors(cells):
        found = []
        for offset in np.arange(8) / 8:
            s = cylinder(cells, offset=offset)
            x = s.problem.grid.coordinates[0] - 2 - offset * s.problem.grid.spacing[0]
            exact = p0 * np.sqrt(np.maximum(1 - (x / a) ** 2, 0))
            found.append((s.depth - depth, np.abs(s.pressure - exact)[np.abs(x) < a / 2].max() / p0))
        return np.sqrt(np.mean(np.square(found), axis=0))

    coarse, fine = errors(100), errors(400)
    assert fine[0] < 3e-5 * depth
    assert fine[1] < 3e-5
    assert (np.log(coarse / fine) / np.log(4) > 1.6).all()  # order two, scattered by where the edge falls


def test_another_reference_length_shifts_the_depth_alone():
    """By 2 F ln(10)/(pi E*) a decade."""
    near, far = cylinder(200, reference=4.0), cylinder(200, reference=40.0)
    np.testing.assert_allclose(far.pressure, near.pressure, atol=1e-9)
    assert far.depth - near.depth == pytest.approx(2 * np.log(10) / (np.pi * MODULUS), rel=1e-12)
    # The tolerance of the certificate is of the largest displacement, which the far body has more of.


def test_a_flat_strip():
    """k = pi E*/(2 ln(2 L_ref/a)), from below and of first order in the cell; twice the cells, half the error."""

    def error(cells):
        grid = rc.Grid(cells, 1.0 / cells)
        operator = rc.line(grid, MODULUS, reference_length=50.0)
        k = rc.contact_stiffness(np.ones(cells, bool), grid, MODULUS, operator=operator)
        return k / (np.pi * MODULUS / (2 * np.log(2 * 50.0 / 0.5))) - 1

    errors = np.array([error(n) for n in (50, 100, 200)])
    assert (errors < 0).all()
    np.testing.assert_allclose(errors[:-1] / errors[1:], 2, rtol=0.02)
    assert abs(2 * errors[-1] - errors[-2]) < 2e-6


def test_westergaard_on_a_periodic_line():
    """f = h (1 - cos 2 pi x/l): p_mean = (pi E* h/l) sin^2(pi a/l), and its pressure."""
    n, length, h, half = 1024, 2.0, 0.01, 0.4
    grid = rc.Grid(n, length / n, True)
    x = grid.coordinates[0] - length / 2
    surface = rc.Surface(-h * (1 - np.cos(2 * np.pi * x / length)), grid)
    mean = np.pi * MODULUS * h / length * np.sin(np.pi * half / length) ** 2
    s = rc.press(surface, MODULUS, pressure=mean, operator=rc.line(grid, MODULUS))
    psi, edge = np.pi * x / length, np.sin(np.pi * half / length)
    root = np.sqrt(np.maximum(edge**2 - np.sin(psi) ** 2, 0))
    exact = 2 * mean * np.cos(psi) / edge**2 * root
    inside = np.abs(x) < half / 2
    np.testing.assert_allclose(s.pressure[inside], exact[inside], rtol=2e-5)
    assert s.contact_area == pytest.approx(2 * half, abs=2 * grid.spacing[0])
    assert s.force == pytest.approx(mean * length, rel=1e-12)


def test_a_periodic_line_is_a_periodic_surface_of_one_row():
    line = rc.Grid(64, 0.1, True)
    plane = rc.Grid((1, 64), (0.7, 0.1), True)
    p = np.random.default_rng(0).random(64)
    np.testing.assert_allclose(
        rc.line(line, MODULUS).apply(p),
        rc.half_space(plane, MODULUS).apply(p[None])[0],
        rtol=1e-13,
        atol=1e-15,
    )


def test_a_free_line_is_the_middle_of_a_long_strip_of_a_surface():
    """Differences of displacement: the constant is the length of the strip, 2 ln(2 L/x) for a strip of length 2 L.

    Point loads along y from -L to L; the remainder is of order (x/L)^2. (The surface
    takes values in the middle of cells, the line means over them: they agree where the pressure is smooth.)
    """
    n, long = 40, 4001
    x = np.arange(n) - (n - 1) / 2
    p = np.exp(-((x / 6) ** 2))
    strip = rc.half_space(rc.Grid((long, n), (5.0, 1.0)), MODULUS).apply(np.tile(p, (long, 1)))[long // 2]
    line = rc.line(rc.Grid(n, 1.0), MODULUS).apply(p)
    np.testing.assert_allclose(strip - strip[0], line - line[0], atol=2e-3 * np.ptp(line))


def test_several_strips_and_a_rough_line():
    grid = rc.Grid(512, 1e-6)
    rough = rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=np.random.default_rng(0))
    curve = rc.loading_curve(rough, 1e9, pressures=np.geomspace(1e5, 1e8, 12), operator=rc.line(grid, 1e9))
    assert (np.diff(curve.depth) > 0).all()
    assert (np.diff(curve.stiffness) >= 0).all()
    assert curve.spots.max() > 1
    assert curve.resolved.any()
    # k = dF/dd at fixed region lies between the secants on either side of it, since F(d) is convex.
    assert (curve.secant_stiffness >= curve.stiffness[:-1] * (1 - 1e-6)).all()
    assert (curve.secant_stiffness <= curve.stiffness[1:] * (1 + 1e-6)).all()


@pytest.mark.parametrize(
    ("grid", "reference", "message"),
    [
        (rc.Grid((4, 4), 1.0), None, "one axis"),
        (rc.Grid(8, 1.0), 7.0, "at least that of the grid, 8 m"),
        (rc.Grid(8, 1.0), np.inf, "finite"),
        (rc.Grid(8, 1.0, True), 10.0, "no reference length"),
    ],
)
def test_nonsense_is_refused(grid, reference, message):
    with pytest.raises(ValueError, match=message):
        rc.line(grid, MODULUS, reference_length=reference)


def test_a_line_must_name_its_operator():
    grid = rc.Grid(8, 1.0)
    with pytest.raises(ValueError, match=r"operator=line\(grid, modulus\)"):
        rc.press(rc.Surface(np.arange(8.0), grid), 1.0, force=1.0)
