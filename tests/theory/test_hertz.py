"""Hertz' contacts against reference numbers, each other, and direct integration of the pressure."""

import itertools

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import ellipkm1

import roughcontact as rc
from roughcontact.theory.spheres_and_punches import hertz

POINT = {
    "modulus": 110e9,
    "radius": 0.02,
    "contact_radius": 3e-4,
    "depth": 4.5e-6,
    "force": 4 / 3 * 110e9 * 2.7e-11 / 0.02,
    "max_pressure": 2 * 110e9 * 3e-4 / (np.pi * 0.02),
    "stiffness": 2 * 110e9 * 3e-4,
}
# R with a and d, E* with a and k, F = (2/3) k d, F = (2/3) pi a^2 p0, p0 = k/(pi R).
DEPENDENT = [
    {"radius", "contact_radius", "depth"},
    {"modulus", "contact_radius", "stiffness"},
    {"depth", "force", "stiffness"},
    {"contact_radius", "force", "max_pressure"},
    {"radius", "max_pressure", "stiffness"},
]
LINE = {"modulus": 110e9, "radius": 0.02, "half_width": 3e-4}
LINE["force"] = np.pi * LINE["modulus"] * LINE["half_width"] ** 2 / (4 * LINE["radius"])
LINE["max_pressure"] = LINE["modulus"] * LINE["half_width"] / (2 * LINE["radius"])
LENGTH = 0.1
LINE["depth"] = LINE["force"] / (np.pi * LINE["modulus"]) * (2 * np.log(2 * LENGTH / LINE["half_width"]) + 1)


def fields(contact):
    return {name: getattr(contact, name) for name in POINT}


class TestPoint:
    def test_reference(self):
        c = hertz.point(1.0, radius=1.0, force=1.0)
        assert c.contact_radius == pytest.approx(0.908560296416, rel=1e-12)
        assert c.depth == pytest.approx(0.825481812224, rel=1e-12)
        assert c.max_pressure == pytest.approx(0.578407449087, rel=1e-12)
        assert c.stiffness == pytest.approx(1.817120592832, rel=1e-12)
        # Thesis, eq. 5.4.
        assert c.stiffness == pytest.approx(6 ** (1 / 3), rel=1e-14)

    @pytest.mark.parametrize("known", [*itertools.combinations(POINT, 3)], ids="-".join)
    def test_any_three_independent_quantities(self, known):
        given = {name: POINT[name] for name in known}
        if set(known) in DEPENDENT:
            with pytest.raises(ValueError, match="depend on each other"):
                hertz.point(**given)
        else:
            # Powers of up to 3 of numbers near 1e11 and 1e-6, each rounded.
            assert fields(hertz.point(**given)) == pytest.approx(POINT, rel=1e-13)

    def test_stiffness_and_energy_belong_to_force_and_depth(self):
        d, h = 1e-6, 1e-9
        c, below, above = (hertz.point(1e9, radius=0.01, depth=x) for x in (d, d - h, d + h))
        # The third derivative of d^(3/2) leaves h^2/(24 d^2) of it.
        assert (above.force - below.force) / (2 * h) == pytest.approx(c.stiffness, rel=1e-6)
        energy = quad(lambda x: hertz.point(1e9, radius=0.01, depth=x).force, 0, d)[0]
        assert c.elastic_energy == pytest.approx(energy, rel=1e-10)

    def test_pressure_carries_the_force(self):
        c = hertz.point(**{name: POINT[name] for name in ("modulus", "radius", "depth")})
        a = c.contact_radius
        total = quad(lambda r: 2 * np.pi * r * c.pressure(r), 0, a)[0]
        assert total == pytest.approx(c.force, rel=1e-10)
        assert c.pressure(0.0) == pytest.approx(c.max_pressure, rel=1e-15)
        assert c.pressure(1.001 * a) == 0

    @pytest.mark.parametrize("ratio", [0.3, 1.5, 20.0])
    def test_displacement_follows_from_the_pressure(self, ratio):
        """Rings of pressure: u = (1/pi E*) int p(s) s 4/(r + s) K(k) ds."""
        c = hertz.point(1.0, radius=1.0, contact_radius=0.2)
        r = 0.2 * ratio
        u = quad(
            lambda s: c.pressure(s) * s * 4 / (r + s) * ellipkm1(((r - s) / (r + s)) ** 2) / np.pi,
            *(0, 0.2),
            points=[r] if r < 0.2 else None,
            limit=200,
        )[0]
        assert c.displacement(r) == pytest.approx(u, rel=1e-8)

    def test_displacement_far_away_is_that_of_a_point_load(self):
        c = hertz.point(1.0, radius=1.0, contact_radius=0.2)
        r = 0.2 * 10.0 ** np.arange(4, 12)
        # The next term is a^2/(10 r^2) of it: 1e-9 for the nearest.
        np.testing.assert_allclose(c.displacement(r), c.force / (np.pi * r), rtol=1.1e-9)
        np.testing.assert_allclose(c.displacement(r[2:]), c.force / (np.pi * r[2:]), rtol=1e-12)

    def test_displacement_is_continuous_and_smooth_at_the_edge(self):
        c, h = hertz.point(1.0, radius=1.0, contact_radius=0.2), 1e-6
        u = c.displacement(np.array([0.2 - h, 0.2, 0.2 + h]))
        assert u[1] == pytest.approx(c.depth / 2, rel=1e-14)
        # The curvature jumps by an inverse root outside: a difference of slopes of order sqrt(h).
        assert (u[2] - u[1]) / (u[1] - u[0]) == pytest.approx(1, abs=1e-2)

    def test_arrays(self):
        c = hertz.point(1.0, radius=np.array([[1.0], [8.0]]), force=np.array([0.0, 1.0, 2.0]))
        assert c.depth.shape == (2, 3)
        assert (c.depth[:, 0] == 0).all()
        assert (c.stiffness[:, 0] == 0).all()
        np.testing.assert_allclose(c.stiffness[1], 2 * c.stiffness[0], rtol=1e-14)
        np.testing.assert_array_equal(c.displacement(1.0)[:, 0], 0)
        assert isinstance(hertz.point(1.0, radius=1.0, force=1.0).depth, float)

    def test_refusals(self):
        with pytest.raises(ValueError, match=r"force \[N\] must be finite and not negative, not -1.0"):
            hertz.point(1.0, radius=1.0, force=-1.0)
        with pytest.raises(ValueError, match=r"force \[N\] must be positive and finite, not 0.0"):
            hertz.point(radius=1.0, depth=1.0, force=0.0)
        with pytest.raises(ValueError, match=r"radius \[m\] must be positive and finite, not inf"):
            hertz.point(1.0, radius=np.inf, force=1.0)
        with pytest.raises(ValueError, match=r"3 of modulus, radius, .* determine the rest, not 2"):
            hertz.point(1.0, radius=1.0)
        with pytest.raises(ValueError, match="not 4"):
            hertz.point(1.0, radius=1.0, force=1.0, depth=1.0)

    def test_law(self):
        law = hertz.law(0.02, 110e9)
        forces = np.array([0.0, 1.0, 10.0])
        c = hertz.point(110e9, radius=0.02, force=forces)
        for name in ("stiffness", "depth", "contact_area", "elastic_energy"):
            np.testing.assert_array_equal(law.predict(name, forces), getattr(c, name))
        with pytest.raises(ValueError, match="radius"):
            hertz.law(-1.0, 1.0)


class TestLine:
    def test_reference(self):
        c = hertz.line(1.0, radius=1.0, force=1.0, reference_length=5.0)
        assert c.half_width == pytest.approx(1.128379167096, rel=1e-12)
        assert c.max_pressure == pytest.approx(0.564189583548, rel=1e-12)
        assert c.depth == pytest.approx((2 * np.log(10 / c.half_width) + 1) / np.pi, rel=1e-14)

    @pytest.mark.parametrize("known", [*itertools.combinations(LINE, 3)], ids="-".join)
    def test_any_three_independent_quantities(self, known):
        given = {name: LINE[name] for name in known}
        dependent = [{"half_width", "force", "max_pressure"}, {"radius", "half_width", "depth"}]
        if set(known) in dependent:
            with pytest.raises(ValueError, match="depend on each other"):
                hertz.line(**given, reference_length=LENGTH)
        else:
            c = hertz.line(**given, reference_length=LENGTH)
            assert {name: getattr(c, name) for name in LINE} == pytest.approx(LINE, rel=1e-12)

    def test_arrays_of_depths(self):
        depth = LINE["depth"] * np.array([0.1, 1.0, 2.0])
        c = hertz.line(110e9, radius=0.02, depth=depth, reference_length=LENGTH)
        np.testing.assert_allclose(c.depth, depth, rtol=1e-13)

    def test_stiffness_is_the_slope_of_the_force(self):
        d, h = LINE["depth"], 1e-5 * LINE["depth"]
        f = [hertz.line(110e9, radius=0.02, depth=x, reference_length=LENGTH).force for x in (d - h, d + h)]
        c = hertz.line(110e9, radius=0.02, depth=d, reference_length=LENGTH)
        assert (f[1] - f[0]) / (2 * h) == pytest.approx(c.stiffness, rel=1e-8)

    @pytest.mark.parametrize("ratio", [0.0, 0.6, 1.4, 9.0])
    def test_displacement_follows_from_the_pressure(self, ratio):
        """u = -(2/pi E*) int p ln(|x - s|/L) ds (thesis, eq. A.40)."""
        c = hertz.line(1.0, radius=1.0, half_width=0.1, reference_length=3.0)
        x = 0.1 * ratio
        u = quad(
            lambda s: -2 / np.pi * c.pressure(s) * np.log(abs(x - s) / 3.0),
            *(-0.1, 0.1),
            points=[x] if x < 0.1 else None,
            limit=200,
        )[0]
        assert c.displacement(x) == pytest.approx(u, rel=1e-8)

    def test_pressure_carries_the_force(self):
        c = hertz.line(1.0, radius=1.0, half_width=0.1)
        assert 2 * quad(c.pressure, 0, 0.1)[0] == pytest.approx(c.force, rel=1e-10)

    def test_another_reference_shifts_the_depth(self):
        one, other = (hertz.line(1.0, radius=1.0, force=1e-3, reference_length=x) for x in (1.0, 10.0))
        assert other.depth - one.depth == pytest.approx(2e-3 * np.log(10) / np.pi, rel=1e-12)

    def test_refusals(self):
        c = hertz.line(1.0, radius=1.0, force=1.0)
        with pytest.raises(ValueError, match="give a reference_length"):
            _ = c.depth
        with pytest.raises(ValueError, match="is undefined without a reference_length"):
            hertz.line(1.0, radius=1.0, depth=1.0)
        with pytest.raises(ValueError, match="a larger force would give a smaller depth"):
            hertz.line(1.0, radius=1.0, force=1.0, reference_length=0.5)
        with pytest.raises(ValueError, match="no contact has this depth"):
            hertz.line(1.0, radius=1.0, depth=1.01, reference_length=1.0)
        with pytest.raises(ValueError, match="3 of modulus"):
            hertz.line(1.0, radius=1.0)


def potential(c, x, y):
    """Return the displacement at an inner point by the chords through it: int p dl of each is closed."""
    a, b = c.semi_axes
    # A periodic and analytic integrand; its poles come near for slender ellipses.
    phi = np.arange(4000) * np.pi / 4000
    u, v = np.cos(phi), np.sin(phi)
    # 1 - (x + l u)^2/a^2 - (y + l v)^2/b^2 = A - B (l - l0)^2.
    square = u**2 / a**2 + v**2 / b**2
    slope = x * u / a**2 + y * v / b**2
    peak = 1 - x**2 / a**2 - y**2 / b**2 + slope**2 / square
    return c.max_pressure / (np.pi * c.modulus) * np.mean(np.pi**2 * peak / (2 * np.sqrt(square)))


class TestElliptic:
    def test_reference(self):
        c = hertz.elliptic(1.0, radii=(1.0, 2.0), force=1.0)
        assert c.semi_axes == pytest.approx((0.804527111136, 1.275820798198), rel=1e-12)
        assert c.max_pressure == pytest.approx(0.465169279009, rel=1e-12)
        assert c.depth == pytest.approx(0.730561613556, rel=1e-12)

    @pytest.mark.parametrize("ratio", [1.0, 1 + 1e-13, 1.001, 30.0, 1e4, 1e8, 1e12])
    def test_surface_takes_the_shape_of_the_body(self, ratio):
        c = hertz.elliptic(1.0, radii=(ratio, 1.0), force=1.0)
        a, b = c.semi_axes
        x, y = np.array([0.0, 0.5, 0.9, 0.0]) * a, np.array([0.0, 0.3, 0.1, 0.999]) * b
        shape = c.depth - x**2 / (2 * ratio) - y**2 / 2
        # Twenty steps with the chord take the error of the aspect below 7^-22.
        np.testing.assert_allclose(c.displacement(x, y), shape, rtol=0, atol=3e-15 * c.depth)
        assert c.force == pytest.approx(2 / 3 * np.pi * a * b * c.max_pressure, rel=1e-14)

    @pytest.mark.parametrize("ratio", [1.0, 3.0, 200.0])
    def test_displacement_follows_from_the_pressure(self, ratio):
        c = hertz.elliptic(1.0, radii=(ratio, 1.0), force=1.0)
        a, b = c.semi_axes
        for x, y in ((0.0, 0.0), (0.5 * a, 0.2 * b), (-0.3 * a, 0.8 * b)):
            assert c.displacement(x, y) == pytest.approx(potential(c, x, y), rel=1e-12)

    def test_displacement_outside(self):
        c = hertz.elliptic(1.0, radii=(1.0, 3.0), force=1.0)
        a, b = c.semi_axes
        # The pressure over s = sqrt(1 - rho^2) and the angle is s^2 ds: Gauss and the trapezoid are exact to rounding.
        s, weight = np.polynomial.legendre.leggauss(60)
        s, weight = (s + 1) / 2, weight / 2
        phi = np.arange(400) * np.pi / 200
        rho = np.sqrt(1 - s**2)[:, None]
        for x, y in ((2 * a, 0.0), (0.5 * a, 1.5 * b), (3.0, 4.0)):
            distance = np.hypot(x - a * rho * np.cos(phi), y - b * rho * np.sin(phi))
            u = (
                c.max_pressure
                * a
                * b
                / np.pi
                * np.sum(weight[:, None] * s[:, None] ** 2 / distance)
                * np.pi
                / 200
            )
            assert c.displacement(x, y) == pytest.approx(u, rel=1e-10)
        for far in (1e6, 1e12):
            assert c.displacement(far, far) == pytest.approx(1 / (np.pi * np.sqrt(2) * far), rel=1e-11)

    def test_a_circle_is_the_point_contact(self):
        point, c = hertz.point(3.0, radius=2.0, force=5.0), hertz.elliptic(3.0, radii=(2.0, 2.0), force=5.0)
        for name in ("depth", "max_pressure", "stiffness", "contact_area", "elastic_energy"):
            assert getattr(c, name) == pytest.approx(getattr(point, name), rel=1e-14)
        r = np.array([0.1, 1.0, 1.5, 30.0])
        np.testing.assert_allclose(c.pressure(r, 0.0), point.pressure(r), rtol=1e-12)
        np.testing.assert_allclose(c.displacement(0.0, r), point.displacement(r), rtol=1e-13)

    def test_a_slender_ellipse_is_a_line_contact(self):
        c = hertz.elliptic(1.0, radii=(1e10, 1.0), force=1.0)
        line = hertz.line(1.0, radius=1.0, half_width=c.semi_axes[1])
        # The difference goes as (b/a)^2 ln(a/b); here a/b is 4e5.
        assert c.max_pressure == pytest.approx(line.max_pressure, rel=1e-9)

    def test_exchange_of_the_radii(self):
        one, other = (hertz.elliptic(1.0, radii=r, depth=0.1) for r in ((1.0, 7.0), (7.0, 1.0)))
        assert one.semi_axes == pytest.approx(other.semi_axes[::-1], rel=1e-14)
        assert one.pressure(0.1, 0.2) == pytest.approx(other.pressure(0.2, 0.1), rel=1e-13)

    def test_any_two_quantities(self):
        names = ("modulus", "force", "depth", "max_pressure", "stiffness")
        c = hertz.elliptic(110e9, radii=(0.01, 0.05), force=20.0)
        values = {name: getattr(c, name) for name in names}
        # p0 and k are both E* times a length over a given one, and F = (2/3) k d needs a third.
        dependent = {"max_pressure", "stiffness"}
        for known in itertools.combinations(names, 2):
            given = {name: values[name] for name in known}
            if set(known) == dependent:
                with pytest.raises(ValueError, match="depend on each other"):
                    hertz.elliptic(radii=(0.01, 0.05), **given)
            else:
                again = hertz.elliptic(radii=(0.01, 0.05), **given)
                assert {name: getattr(again, name) for name in names} == pytest.approx(values, rel=1e-12)

    def test_stiffness_is_the_slope_of_the_force(self):
        d, h = 0.1, 1e-6
        f = [hertz.elliptic(1.0, radii=(1.0, 5.0), depth=x).force for x in (d - h, d + h)]
        c = hertz.elliptic(1.0, radii=(1.0, 5.0), depth=d)
        assert (f[1] - f[0]) / (2 * h) == pytest.approx(c.stiffness, rel=1e-8)

    def test_arrays_and_refusals(self):
        c = hertz.elliptic(1.0, radii=(np.array([1.0, 2.0, 4.0]), 1.0), force=np.array([[1.0], [2.0]]))
        assert c.depth.shape == c.semi_axes[0].shape == (2, 3)
        with pytest.raises(ValueError, match=r"radii \[m\] must be positive"):
            hertz.elliptic(1.0, radii=(1.0, 0.0), force=1.0)
        with pytest.raises(ValueError, match="determine the rest"):
            hertz.elliptic(1.0, radii=(1.0, 1.0))


def flamant(x, y, apex, side):
    """Stresses (xx, yy, xy) of a unit line load at (0, apex) along y, into the half-plane on one side."""
    depth = side * (y - apex)
    r2 = x**2 + depth**2
    radial = -2 / np.pi * depth / r2**2
    return radial * x**2, radial * depth**2, side * radial * x * depth


def test_the_axes_of_two_cylinders_approach_by_the_depth_with_this_reference_length():
    """A disc under two opposite loads: line loads and a uniform tension leave its rim free; Hertz near the contact."""
    radius, nu, a = 1.0, 0.3, 1e-3
    angle = np.radians([3.0, 40.0, 75.0])
    x, y = radius * np.cos(angle), radius * np.sin(angle)
    one, other = flamant(x, y, radius, -1), flamant(x, y, -radius, 1)
    xx, yy, xy = (p + q for p, q in zip(one, other, strict=True))
    xx, yy = xx + 1 / (np.pi * radius), yy + 1 / (np.pi * radius)
    assert np.abs([xx * x + xy * y, xy * x + yy * y]).max() < 1e-14 / radius

    def strain(s):
        """Plane strain towards the axis at a depth s, times E/(1 - nu^2): of half an ellipse of pressure nearby."""
        root = np.hypot(a, s)
        along = -2 / (np.pi * root) - 2 / (np.pi * (2 * radius - s)) + 1 / (np.pi * radius)
        across = -2 / (np.pi * a) * (root / a + s * (s / root) / a - 2 * s / a) + 1 / (np.pi * radius)
        return along - nu / (1 - nu) * across

    ends = [0.0, *10.0 ** np.arange(-6, 1)]
    parts = (quad(strain, *pair, epsabs=0, epsrel=1e-11)[0] for pair in itertools.pairwise(ends))
    shortening = -sum(parts)
    assert shortening == pytest.approx((2 * np.log(4 * radius / a) - 1) / np.pi, rel=3 * a)
    # Two of one material: 1/E* = 2 (1 - nu^2)/E, here 2, and each is of half of it.
    modulus, radii = 0.5, (radius, 4 * radius)
    force = np.pi * modulus * a**2 / (4 * (radii[0] * radii[1] / sum(radii)))
    both = force * (shortening + shortening + 2 * np.log(radii[1] / radii[0]) / np.pi)
    reduced = radii[0] * radii[1] / sum(radii)
    contact = hertz.line(
        modulus, radius=reduced, force=force, reference_length=2 * np.sqrt(radii[0] * radii[1]) / np.e
    )
    assert contact.half_width == pytest.approx(a, rel=1e-12)
    assert contact.depth == pytest.approx(both, rel=3 * a)
    # And as it is computed: a cell is 1/100 of the half width.
    grid = rc.Grid(400, a / 100)
    pressed = rc.press(
        rc.shapes.paraboloid(grid, reduced),
        modulus,
        force=float(force),
        operator=rc.line(grid, modulus, reference_length=contact.reference_length),
    )
    assert pressed.depth == pytest.approx(both, rel=3e-3)
