"""The discrete asperity model: closed forms, a slow solver, the boundary element method, derivatives, refusals."""

import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.theory.asperity_models import asperities as theory, greenwood_williamson as gw

MODULUS, RADIUS = 2e11, 1e-3


def summits(x, y, height, radius=RADIUS, modulus=MODULUS):
    x = np.asarray(x, dtype=float)
    return theory.Asperities(x, y, height, np.broadcast_to(radius, x.shape), modulus)


def random_summits(count=25, seed=3, offset=0.0):
    """Heights scatter by 1 um, over a square of 1 mm: spots of 30 um push each other down by half their depth."""
    rng = np.random.default_rng(seed)
    x, y = 1e-3 * rng.random((2, count))
    return summits(x, y, offset + 1e-6 * rng.normal(size=count), RADIUS * rng.uniform(0.3, 2, count))


def ring(count, circle):
    angle = 2 * np.pi * np.arange(count) / count
    return summits(circle * np.cos(angle), circle * np.sin(angle), np.zeros(count))


def gauss_seidel(asperities, depth):
    """Forces of the interacting summits: each set to its own balance in turn, until nothing moves."""
    x, y, z, radius = asperities.x, asperities.y, asperities.height, asperities.radius
    force = np.zeros(x.size)
    for _ in range(2000):
        before = force.copy()
        for i in range(x.size):
            r = np.hypot(x - x[i], y - y[i])
            r[i] = np.inf
            left = z[i] - z.max() + depth - (force / (np.pi * MODULUS * r)).sum()
            force[i] = 4 / 3 * MODULUS * math.sqrt(radius[i]) * max(left, 0.0) ** 1.5
        if np.abs(force - before).max() <= 1e-14 * force.max():
            return force
    raise AssertionError("the slow solver did not settle")


class TestClosedForms:
    def test_one_summit_is_hertz(self):
        contact = theory.press(summits([1.0], [2.0], [3.0]), depth=1e-6)
        assert contact.force == pytest.approx(4 / 3 * MODULUS * math.sqrt(RADIUS) * 1e-9, rel=1e-14)
        assert contact.stiffness == pytest.approx(2 * MODULUS * math.sqrt(RADIUS * 1e-6), rel=1e-14)
        assert contact.contact_area == pytest.approx(math.pi * RADIUS * 1e-6, rel=1e-14)
        assert contact.elastic_energy == pytest.approx(0.4 * contact.force * 1e-6, rel=1e-14)

    @pytest.mark.parametrize("count", [2, 3, 8])
    def test_a_ring_of_equal_summits(self, count):
        asperities = ring(count, 3e-4)
        contact = theory.press(asperities, force=2.0)
        one = 2.0 / count
        # Chords of the ring; by symmetry each carries the same.
        inverse = sum(1 / (6e-4 * math.sin(math.pi * j / count)) for j in range(1, count)) / (
            math.pi * MODULUS
        )
        compression = (one / asperities.coefficient[0]) ** (2 / 3)
        assert contact.depth == pytest.approx(compression + one * inverse, rel=1e-12)
        own = 1 / (2 * MODULUS * math.sqrt(RADIUS * compression))
        assert contact.stiffness == pytest.approx(count / (own + inverse), rel=1e-11)

    def test_far_apart_they_add_up(self):
        asperities = summits([0.0, 1e3, 0.0], [0.0, 0.0, 1e3], [0.0, -2e-7, -5e-7])
        near, far = (theory.press(asperities, depth=1e-6, interaction=way) for way in (False, True))
        # A force of 10 N at 1 km moves the surface by 1e-14 m, 1e-8 of the depth.
        assert far.forces == pytest.approx(near.forces, rel=1e-7)
        assert near.force == pytest.approx(
            4 / 3 * MODULUS * math.sqrt(RADIUS) * (1e-9 + 8e-7**1.5 + 5e-7**1.5)
        )

    def test_a_higher_summit_keeps_a_lower_one_away(self):
        # 1 um of depth at 50 um: the deflection of 0.27 um keeps away what lies 0.8 um lower.
        asperities = summits([0.0, 5e-5], [0.0, 0.0], [0.0, -8e-7])
        assert theory.press(asperities, depth=1e-6, interaction=False).count == 2
        contact = theory.press(asperities, depth=1e-6)
        assert contact.count == 1
        assert contact.forces[1] == 0


class TestBalance:
    @pytest.mark.parametrize("depth", [1e-7, 1e-6, 3e-6])
    def test_slow_solver(self, depth):
        asperities = random_summits()
        contact = theory.press(asperities, depth=depth)
        expected = gauss_seidel(asperities, depth)
        # Both to 1e-12 and better of the depth, amplified by the condition of the influences, below a hundred.
        assert contact.forces == pytest.approx(expected, rel=1e-9, abs=1e-10 * expected.max())
        assert contact.merged == 0

    @pytest.mark.parametrize("interaction", [False, True])
    @pytest.mark.parametrize("force", [1e-12, 1.0, 40.0])
    def test_force_and_depth_agree(self, interaction, force):
        # Heights near 1 m: differences of a micrometre are lost in their last digits, the balance must not be.
        asperities = random_summits(offset=1.0)
        by_force = theory.press(asperities, force=force, interaction=interaction)
        assert by_force.force == pytest.approx(force, rel=1e-12)
        by_depth = theory.press(asperities, depth=by_force.depth, interaction=interaction)
        assert by_depth.force == pytest.approx(force, rel=1e-10)
        assert by_depth.stiffness == pytest.approx(by_force.stiffness, rel=1e-10)

    def test_scales(self):
        one = random_summits()
        # Lengths times 5, modulus times 3.
        other = summits(5 * one.x, 5 * one.y, 5 * one.height, 5 * one.radius, 3 * MODULUS)
        contact, larger = theory.press(one, depth=1e-6), theory.press(other, depth=5e-6)
        assert larger.forces == pytest.approx(75 * contact.forces, rel=1e-9)
        assert larger.stiffness == pytest.approx(15 * contact.stiffness, rel=1e-9)

    def test_order_and_place_do_not_matter(self):
        one = random_summits()
        order = np.random.default_rng(1).permutation(one.x.size)
        turned = summits(0.1 - one.y[order], one.x[order], one.height[order] - 2.0, one.radius[order])
        a, b = theory.press(one, force=3.0), theory.press(turned, force=3.0)
        # Heights near 2 m have their last digit at 4e-16 m, of a depth of 2e-6 m.
        assert b.forces == pytest.approx(a.forces[order], rel=1e-7, abs=1e-8)

    @pytest.mark.parametrize("interaction", [False, True])
    def test_stiffness_and_force_are_derivatives(self, interaction):
        asperities = random_summits()
        step = 1e-5
        below, at, above = (
            theory.press(asperities, depth=1.7e-6 * (1 + step * i), interaction=interaction)
            for i in (-1, 0, 1)
        )
        # Central differences of d^(3/2) and of d^(5/2), also of summits at a tenth of the depth: step^2 times 100.
        assert at.stiffness == pytest.approx((above.force - below.force) / (2 * step * 1.7e-6), rel=1e-8)
        energy = above.elastic_energy - below.elastic_energy
        assert at.force == pytest.approx(energy / (2 * step * 1.7e-6), rel=1e-8)

    def test_many_summits_of_a_rough_surface_up_to_merged_spots(self):
        surface = rc.self_affine(
            rc.Grid((128, 128), 1 / 128, periodic=False), hurst=0.95, rms=0.01, rng=np.random.default_rng(2)
        )
        found = rc.find_summits(surface)
        asperities = theory.Asperities(found.columns / 128, found.rows / 128, found.height, found.radius, 1.0)
        merged, depth = [], []
        for force in np.geomspace(1e-7, 0.03, 9):
            contact = theory.press(asperities, force=force)
            plain = theory.press(asperities, force=force, interaction=False)
            assert contact.force == pytest.approx(force, rel=1e-11)
            assert contact.stiffness <= plain.stiffness * (1 + 1e-12)
            assert contact.depth >= plain.depth * (1 - 1e-12)
            merged.append(contact.merged)
            depth.append(contact.depth)
        assert (np.diff(depth) > 0).all()
        assert merged[0] == 0
        assert contact.count > 100
        assert merged[-1] > contact.count / 2


class TestAgainstTheBoundaryElements:
    """Two paraboloids on a fine free grid, over one of them on the same cells."""

    def forces(self, distance, fall, spacing=1 / 12):
        # Radius 100, depth 0.01: a spot of radius 1, 12 cells.
        rows, columns = 33, 33 + round(distance / spacing)
        y, x = (np.arange(n) * spacing for n in (rows, columns))
        y, x = (y - y[16])[:, None], x - x[16]
        first = -(y**2 + x**2) / 200
        second = -(y**2 + (x - distance) ** 2) / 200 - fall
        pair = rc.Surface(np.maximum(first, second), rc.Grid((rows, columns), spacing, periodic=False))
        alone = rc.Surface(first[:, :rows], rc.Grid((rows, rows), spacing, periodic=False))
        return (rc.press(surface, 1.0, depth=0.01) for surface in (pair, alone))

    @pytest.mark.parametrize("distance", [2.5, 4.0])
    @pytest.mark.parametrize("fall", [0.0, 0.003])
    def test_two_spheres(self, distance, fall):
        pair, alone = self.forces(distance, fall)
        both = summits([0.0, distance], [0.0, 0.0], [0.0, -fall], 100.0, 1.0)
        model = theory.press(both, depth=0.01)
        hertz = 4 / 3 * 0.01
        # (a/r)^3 of the depth with a factor of a tenth or less: the deflection is not uniform under a spot, 4 % of
        # a^2/r^2 of itself each way.
        ratio = pair.force / alone.force
        assert model.force / hertz == pytest.approx(ratio, rel=2e-3)
        # Without interaction it is 14 % and more too much.
        assert theory.press(both, depth=0.01, interaction=False).force / hertz > 1.13 * ratio
        # The stiffness of a spot of 12 cells is that of its pixels, good to 1 %.
        assert model.stiffness / 2 == pytest.approx(pair.stiffness / alone.stiffness, rel=0.01)


class TestAgainstGreenwoodAndWilliamson:
    def test_many_independent_summits_are_the_population(self):
        count, std, area = 40_000, 1e-6, 1e-2
        rng = np.random.default_rng(7)
        x, y = rng.random((2, count)) * math.sqrt(area)
        law = theory.law(summits(x, y, std * rng.normal(size=count)), interaction=False)
        population = gw.Population(gw.Asperity.hertz(RADIUS, MODULUS), count / area, std)
        separation = np.array([0.5, 1.5]) * std
        force = area * population.pressure(separation)
        spots = area * population.spot_density(separation)
        # Four standard errors of the number of summits above the flat, some 12,000 and 2,700; both quantities are at
        # the same force, which can only make them scatter less.
        scatter = 4 / np.sqrt(spots)
        assert (np.abs(law.predict("spots", force) / spots - 1) < scatter).all()
        stiffness = area * population.stiffness(separation)
        assert (np.abs(law.predict("interfacial_stiffness", force) / stiffness - 1) < scatter).all()


class TestMerged:
    def test_counts_spots_that_overlap(self):
        # Spots of 32 um radius at 50 um and at 500 um.
        asperities = summits([0.0, 5e-5, 5e-4], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0])
        contact = theory.press(asperities, depth=1e-6, interaction=False)
        assert contact.spot_radius == pytest.approx([math.sqrt(1e-9)] * 3)
        assert contact.merged == 2

    def test_two_summits_of_one_spot_still_have_an_answer(self):
        contact = theory.press(summits([0.0, 1e-9], [0.0, 0.0], [0.0, 0.0]), force=1.0)
        assert contact.merged == 2
        assert contact.forces == pytest.approx([0.5, 0.5], rel=1e-12)


class TestLaw:
    @pytest.mark.parametrize("interaction", [False, True])
    def test_says_what_it_can(self, interaction):
        asperities, force = random_summits(), np.array([0.1, 2.0])
        law = theory.law(asperities, interaction=interaction)
        contacts = [theory.press(asperities, force=one, interaction=interaction) for one in force]
        name = "stiffness" if interaction else "interfacial_stiffness"
        assert law.predict(name, force) == pytest.approx([contact.stiffness for contact in contacts])
        assert law.predict("spots", force) == pytest.approx([contact.count for contact in contacts])
        assert ("depth" in law.quantities) is ("stiffness" in law.quantities) is interaction
        assert np.isnan(law.predict(name, 0.0))


class TestRefusals:
    @pytest.mark.parametrize("loads", [{}, {"force": 1.0, "depth": 1e-6}])
    def test_one_load(self, loads):
        with pytest.raises(ValueError, match="either a force"):
            theory.press(random_summits(), **loads)

    @pytest.mark.parametrize("loads", [{"force": 0.0}, {"depth": -1e-6}, {"force": math.nan}, {"depth": 0.0}])
    def test_positive_loads(self, loads):
        with pytest.raises(ValueError, match=r"must be positive|force must be a number, not nan"):
            theory.press(random_summits(), **loads)

    def test_arrays(self):
        with pytest.raises(ValueError, match="one length"):
            summits([0.0, 1.0], [0.0], [0.0, 0.0])
        with pytest.raises(ValueError, match="height must be finite"):
            summits([0.0], [0.0], [math.nan])
        with pytest.raises(ValueError, match="radius"):
            summits([0.0], [0.0], [0.0], 0.0)

    def test_two_summits_in_one_place(self):
        with pytest.raises(ValueError, match="same place"):
            summits([0.0, 1.0, 1.0], [0.0, 2.0, 2.0], [0.0, 0.0, 1.0])

    def test_too_many_summits(self):
        count = 8000
        asperities = summits(np.arange(count), np.zeros(count), np.zeros(count))
        with pytest.raises(ValueError, match="8000 of 8000 summits"):
            theory.press(asperities, force=1.0)
