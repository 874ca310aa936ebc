"""Shear under a varying pressure: levels beside the law, the energy, and a slow program that shares nothing with it."""

import functools
import math
from itertools import pairwise

import numpy as np
import pint
import pytest

import roughcontact as rc
from made_laws import exponential, hertz, power
from roughcontact.errors import InputError

MU = 0.3
FEW = np.geomspace(1e-3, 1, 31)  # loads: the levels are exact for any law
LAW = power(0.9, pressure=FEW)
PHASES = [0.0, math.pi / 4, math.pi / 2, 2.0]


def cycles(phase, steps, count=2, pressure=0.5, swing=0.3, share=0.45):
    """Return pressures and tractions of equal period; the traction begins at zero."""
    angle = 2 * np.pi * np.linspace(0, count, steps * count + 1)
    return pressure * (1 + swing * np.sin(angle + phase)), share * MU * pressure * np.sin(angle)


@pytest.mark.parametrize("law", [hertz(pressure=FEW), exponential(pressure=FEW), LAW])
@pytest.mark.parametrize("part", [0.2, 0.5, 0.95])
def test_constant_pressure_is_the_backbone_and_masings_rule(law, part):
    """The same differences of the same gaps: rounding only. The energy is a difference of terms 50/part^2 larger."""
    p, tau = 0.8, part * MU * 0.8
    history = law.history(np.full(5, p), tau * np.array([0, 1, -1, 1, 0.3]))
    s = law.displacement(tau, p)
    np.testing.assert_allclose(history.displacement[:4], [0, s, -s, s], rtol=1e-12, atol=1e-14 * s)
    down = s - 2 * law.displacement(0.35 * tau, p)
    assert history.displacement[4] == pytest.approx(down, rel=1e-12)
    loss = law.loss(p, traction=tau)
    np.testing.assert_allclose(history.dissipated[:4], loss * np.array([0, 0.25, 0.5, 0.5]), rtol=1e-9)
    np.testing.assert_allclose(history.slipping, part * np.array([0, 1, 1, 1, 0.35]), rtol=1e-12)
    assert history.levels.traction == pytest.approx(0.3 * tau, rel=1e-12)


def test_a_small_loop_closes_and_leaves_the_large_one_as_it_was():
    history = LAW.history(np.full(7, 0.8), MU * 0.8 * np.array([0.0, 0.5, 0.1, 0.3, 0.1, 0.5, 0.9]))
    assert history.displacement[2] == pytest.approx(history.displacement[4], rel=1e-12)
    assert history.displacement[1] == pytest.approx(history.displacement[5], rel=1e-12)
    assert history.displacement[6] == pytest.approx(float(LAW.displacement(0.9 * MU * 0.8, 0.8)), rel=1e-12)


def test_loads_in_proportion_slip_nowhere():
    """Up to mu p and back: each level has its share of the traction, and falls with the pressure."""
    p = np.array([0.2, 0.6, 0.3, 0.8, 0.1])
    history = LAW.history(p, 0.9 * MU * p)
    assert (history.slipping == 0).all()
    assert (history.dissipated == 0).all()
    closure = LAW.normal.gap_at(0) - LAW.normal.gap_at(p)
    np.testing.assert_allclose(history.displacement, 0.9 * MU * closure, rtol=1e-12)


def test_a_falling_pressure_slips_under_a_constant_traction():
    """Until the whole contact is about to slide, at tau = mu p."""
    tau = 0.2 * MU
    history = LAW.history([1.0, 1.0, 0.6, 0.2], [0.0, tau, tau, tau])
    assert (np.diff(history.slipping[1:]) > 0).all()
    assert history.slipping[-1] == pytest.approx(1, rel=1e-9)
    assert (history.dissipated[1:] > 0).all()
    assert history.displacement[-1] == pytest.approx(float(LAW.gross_slip(0.2)), rel=1e-9)


@pytest.mark.parametrize("phase", PHASES)
def test_a_straight_step_is_the_sum_of_its_parts(phase):
    p, tau = cycles(phase, 8)
    at = np.linspace(0, len(p) - 1, 7 * (len(p) - 1) + 1)
    fine = LAW.history(np.interp(at, range(len(p)), p), np.interp(at, range(len(p)), tau))
    coarse = LAW.history(p, tau)
    np.testing.assert_allclose(fine.displacement[::7], coarse.displacement, rtol=0, atol=1e-11)
    parts = fine.dissipated[1:].reshape(-1, 7).sum(axis=1)
    np.testing.assert_allclose(parts, coarse.dissipated[1:], rtol=0, atol=1e-9 * coarse.dissipated.max())


@pytest.mark.parametrize("phase", PHASES)
def test_the_area_of_a_cycle_is_the_dissipated_energy(phase):
    """Trapezoids are good to the square of the step."""
    errors = []
    for steps in (50, 200):
        history = LAW.history(*cycles(phase, steps))
        s, q = history.displacement[steps:], history.traction[steps:]
        assert s[0] == pytest.approx(s[-1], rel=0, abs=1e-12)
        lost = history.dissipated[steps + 1 :].sum()
        assert lost > 0
        errors.append(abs(((q[1:] + q[:-1]) / 2 @ np.diff(s)) - lost) / lost)
    assert errors[0] < 0.02
    assert errors[0] / errors[1] == pytest.approx(16, rel=0.2)
    assert (history.dissipated >= 0).all()


@pytest.mark.parametrize("phase", PHASES[:3])
def test_both_amplitudes_together_lose_with_their_cube(phase):
    losses = []
    for size in (1.0, 0.5, 0.25, 0.125):
        history = LAW.history(*cycles(phase, 100, swing=0.3 * size, share=0.45 * size))
        losses.append(history.dissipated[101:].sum())
    slopes = -np.diff(np.log2(losses))
    assert ((slopes > 3) & (slopes < 3.6)).all()
    assert (np.diff(slopes) < 0).all()


class TestSlowly:
    """Coulomb's law in every cell, in steps, with matrices: the levels are its limit at the first order of the step."""

    surface = rc.self_affine(
        rc.Grid((24, 24), 1e-6, periodic=True), hurst=0.8, rms=1e-7, rng=3, rolloff=2e-5, short_cutoff=6e-6
    )
    bodies = (rc.Solid(2e9, 0.0), rc.Solid(2e9, 0.0))
    mean = 3e6

    @staticmethod
    @functools.cache
    def limit(pressure):
        """Return the largest traction of each cell, for a pressure that recurs in each period and number of steps."""
        return MU * rc.press(TestSlowly.surface, TestSlowly.bodies, pressure=pressure).pressure.ravel()

    def law(self, p):
        loads = np.unique(np.concatenate([np.geomspace(self.mean / 300, 1.5 * self.mean, 200), p]))
        curve = rc.loading_curve(
            self.surface, self.bodies, pressures=loads[np.append(True, np.diff(loads) > 1.0)]
        )
        return rc.shear_law(curve, self.bodies, friction=MU, exact=True)

    def slowly(self, p, tau):
        """Return displacements and dissipated energies: each step minimises the energy under the limits of friction."""
        matrix = rc.half_space(self.surface.grid, 1e9).as_matrix()
        moved, lost, slip, q = [], [], np.zeros(len(matrix)), np.zeros(len(matrix))
        for pressure, traction in zip(p, tau, strict=True):
            q, s = coulomb(matrix, self.limit(round(pressure, 3)), slip, q, traction * len(matrix))
            now = matrix @ q - s
            lost.append(-(q @ (now - slip)) / len(matrix))
            moved.append(s)
            slip = now
        return np.array(moved), np.array(lost)

    @pytest.mark.parametrize("phase", [math.pi / 4, math.pi / 2])
    def test_out_of_phase(self, phase):
        loads = {"pressure": self.mean, "swing": 0.4, "share": 0.41}
        law = self.law(cycles(phase, 48, **loads)[0])  # the coarser steps have some of its pressures
        errors = []
        for steps in (12, 24, 48):
            p, tau = cycles(phase, steps, **loads)
            levels, (moved, lost) = law.history(p, tau), self.slowly(p, tau)
            largest = abs(levels.displacement).max()
            part = slice(steps + 1, None)
            errors.append(
                [
                    abs(moved - levels.displacement).max() / largest,
                    lost[part].sum() / levels.dissipated[part].sum() - 1,
                ]
            )
            assert 0.3 < levels.slipping.max() < 0.9
        displacement, energy = abs(np.array(errors)).T
        assert displacement[0] < 0.02
        for values in (displacement, energy):
            assert all(1.5 < coarse / fine < 3.0 for coarse, fine in pairwise(values))

    def test_in_phase(self):
        """Only the law between its loads differs, by what single cells change there."""
        p, tau = cycles(0.0, 24, pressure=self.mean, swing=0.4, share=0.41)
        levels, (moved, _) = self.law(p).history(p, tau), self.slowly(p, tau)
        np.testing.assert_allclose(moved, levels.displacement, rtol=0, atol=1e-3 * abs(moved).max())

    def test_constant_pressure(self):
        """Nothing is between: certificates of 1e-8 in the loads of the curve."""
        tau = MU * self.mean * np.array([0.0, 0.5, -0.5, 0.2])
        p = np.full(4, self.mean)
        moved, _ = self.slowly(p, tau)
        needed = self.mean * np.array([0.5, 0.65, 1.0])
        curve = rc.loading_curve(self.surface, self.bodies, pressures=needed)
        levels = rc.shear_law(curve, self.bodies, friction=MU).history(p, tau)
        touch = MU * (curve.mean_gap[0] + curve.depth[0])
        np.testing.assert_allclose(moved, levels.displacement, rtol=0, atol=6e-8 * touch)


def coulomb(matrix, limit, slip, start, total):
    """Return tractions of the cells and the displacement of the bodies: a quadratic program by a primal active set.

    The energy ``q.A q/2 - q.slip`` is minimised for ``abs(q) <= limit`` and the given sum of q. One cell at a time is
    held at its limit, when a step would exceed it, or freed, when it would slip against its traction.
    """
    cells = np.flatnonzero(limit > 0)
    matrix, limit, slip = matrix[np.ix_(cells, cells)], limit[cells], slip[cells]
    q = start[cells].clip(-limit, limit)
    missing = total - q.sum()
    room = math.copysign(1, missing) * limit - q
    q = q + missing / room.sum() * room
    side = np.where(abs(q) >= limit, np.sign(q), 0.0)
    for _ in range(5000):
        free = np.flatnonzero(side == 0)
        size = len(free)
        system = np.ones((size + 1, size + 1))
        system[:size, :size], system[size, size] = matrix[np.ix_(free, free)] / matrix[0, 0], 0
        held = side * limit
        *target, s = np.linalg.solve(
            system, [*(slip - matrix @ held)[free] / matrix[0, 0], total - held.sum()]
        )
        step = target - q[free]
        reach = np.where(step > 0, limit[free] - q[free], -limit[free] - q[free])
        ratio = np.divide(reach, step, out=np.full(size, np.inf), where=step != 0)
        first = int(np.argmin(ratio))
        q[free] += min(1.0, ratio[first]) * step
        if ratio[first] < 1:
            side[free[first]] = np.sign(step[first])
            q[free[first]] = side[free[first]] * limit[free[first]]
            continue
        against = side * (matrix @ q - slip + s * matrix[0, 0])
        if against.max() <= 1e-12 * abs(slip).max(initial=abs(s * matrix[0, 0])):
            whole = np.zeros(len(start))
            whole[cells] = q
            return whole, -s * matrix[0, 0]
        side[np.argmax(against)] = 0
    raise AssertionError("the sets of slipping cells do not end")


def test_numbers_with_units_and_the_answer():
    U = pint.get_application_registry()
    history = LAW.history([0.5, 0.5] * U.Pa, [0.0, 50.0] * U.mPa)
    assert history.displacement[1] == LAW.displacement(0.05, 0.5)
    assert len(history) == 2
    assert repr(history).startswith("ShearHistory(2 steps, p 0.5 to 0.5 Pa, ")
    np.testing.assert_allclose(history.levels.tops[-2:], [0.5 - 0.05 / MU, 0.5])
    np.testing.assert_array_equal(history.levels.bottoms[1:], history.levels.tops[:-1])
    with pytest.raises(InputError, match="Pa"):
        LAW.history([0.5] * U.m, [0.0])


def test_what_is_no_history():
    ends = exponential(pressure=FEW)
    for wrong, message in (
        (lambda: LAW.history([0.5, 0.2], [0.0, -0.1]), r"at step 1 the traction -0\.1 Pa exceeds mu p = 0\.06 Pa"),
        (lambda: LAW.history([0.5, 0.5], [0.0]), "a traction for each pressure"),
        (lambda: LAW.history([], []), "a traction for each pressure"),
        (lambda: LAW.history([[0.5]], [[0.0]]), "give two rows of the same length"),
        (lambda: LAW.history(0.5, 0.1), "give two rows of the same length"),
        (lambda: LAW.history([0.5, 0.0], [0.0, 0.0]), "pressures must be positive and finite"),
        (lambda: LAW.history([0.5, math.nan], [0.0, 0.0]), "pressures"),
        (lambda: LAW.history([0.5], [math.inf]), "tractions must be finite"),
        (lambda: LAW.history([0.5, 2.0], [0.0, 0.1]), "the law holds from 0 to 1 Pa"),
        (lambda: ends.history([0.5, 0.5], [0.1, 0.1]), "at step 0, p - tau/mu lies below the lowest load"),
        (lambda: ends.history([0.5, 0.5], [0.0, 0.15]), "at step 1, p - tau/mu lies below the lowest load"),
    ):  # fmt: skip
        with pytest.raises(InputError, match=message):
            wrong()
