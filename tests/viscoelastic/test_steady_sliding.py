"""Steady sliding over a viscoelastic plane: closed forms, limits, a march in time, and the method."""

import dataclasses

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.solver.control import Status
from roughcontact.viscoelastic import friction_curve, sliding_solver
from roughcontact.viscoelastic.wave_operator import WaveOperator, passing

SOLID = rc.viscoelastic.standard_solid(1.0, 3.0, 1.0)
GRID = rc.Grid((32, 32), 1 / 32, periodic=True)
ROUGH = rc.self_affine(GRID, hurst=0.8, rms=0.01, rng=3, rolloff=0.5, short_cutoff=0.125)


def waves(pressure, grid=GRID):
    """Return the squares of all waves of a pressure, and their qy and qx: by full transforms."""
    qy, qx = (2 * np.pi * np.fft.fftfreq(n, d) for n, d in zip(grid.shape, grid.spacing, strict=True))
    return np.abs(np.fft.fft2(pressure) / pressure.size) ** 2, qy[:, None], qx[None]


@pytest.mark.parametrize(
    ("speed", "traction"),
    [(0.01, 1.235374006121e-4), (0.1, 8.892064367479e-4), (1.0, 3.063981105522e-4)],
)
def test_in_full_contact_a_cosine_has_the_friction_of_its_closed_form(speed, traction):
    cosine = rc.shapes.wave(rc.Grid((4, 32), 1 / 32, periodic=True), 0.01, 1.0)
    found = rc.steady_sliding(cosine, SOLID, speed=speed, pressure=0.2, tolerance=1e-12)
    assert found.contact_fraction == 1
    assert found.friction == pytest.approx([traction, 0], rel=1e-10, abs=1e-14)
    assert found.dissipation == pytest.approx(traction * speed, rel=1e-10)
    assert found.friction_error < 1e-10
    assert found.notes == () if speed < 0.3 else len(found.notes) == 1  # retardation time 3, period 1


@pytest.mark.parametrize("direction", [(1, 0), (0, -2), (3, 3)])
def test_an_oblique_wave_drags_along_its_own_normal(direction):
    y, x = GRID.coordinates
    surface = rc.Surface(0.002 * np.cos(2 * np.pi * (2 * x[None] + y[:, None])), GRID)
    q, unit = 2 * np.pi * np.array([2.0, 1.0]), np.array(direction) / np.hypot(*direction)
    found = rc.steady_sliding(surface, SOLID, speed=0.05, direction=direction, pressure=0.2)
    loss = 0.05 * (q @ unit)
    expected = 0.002**2 / 4 * np.hypot(*q) * q * 2 * loss / (1 + loss**2)
    assert found.friction == pytest.approx(expected, rel=1e-6)  # residual 1e-8 of the amplitude


def test_slow_and_fast_friction_follow_from_the_elastic_pressures():
    slow, fast = (rc.steady_sliding(ROUGH, SOLID, speed=v, pressure=0.02) for v in (1e-5, 100.0))
    squares, qy, qx = waves(rc.press(ROUGH, 1.0, pressure=0.02).pressure)
    q = np.where(np.hypot(qy, qx) > 0, np.hypot(qy, qx), np.inf)
    inside = np.abs(qx) < np.pi * 32 * 0.999
    assert slow.friction_coefficient / 1e-5 == pytest.approx(
        (inside * squares * 2 / q * qx**2).sum() * 2 / 0.02, rel=1e-4
    )
    # Waves along the track keep the relaxed modulus.
    half = WaveOperator(
        GRID, lambda grid: passing(rc.Viscoelastic(1.0, [2.0], [1e9]), (1.0, 0.0))(grid).real + 0j
    )
    glassy = rc.press(ROUGH, 1.0, pressure=0.02, operator=half)
    squares, *_ = waves(glassy.pressure)
    expected = (inside * (qx != 0) * squares * 2 / q).sum() * 2 / 9 / 0.02
    assert fast.friction_coefficient * 100 == pytest.approx(expected, rel=1e-4)
    assert fast.contact_fraction == glassy.contact_fraction
    assert fast.contact_fraction > rc.press(ROUGH, 3.0, pressure=0.02).contact_fraction


def test_without_speed_it_is_the_relaxed_contact():
    rest = rc.steady_sliding(ROUGH, SOLID, speed=0.0, pressure=0.02, tolerance=1e-10)
    pressed = rc.press(ROUGH, 1.0, pressure=0.02, tolerance=1e-10)
    assert np.abs(rest.pressure - pressed.pressure).max() < 1e-8 * pressed.max_pressure
    assert rest.depth == pytest.approx(pressed.depth, rel=1e-8)
    assert rest.gap == pytest.approx(pressed.gap, abs=1e-8 * pressed.gap.max())
    assert np.abs(rest.friction).max() < 1e-15


def marched(surface, speed):
    """Return the friction coefficient after a march in time: the plane moves by one cell a step, u linear in each."""
    grid, separation = surface.grid, surface.heights.max() - surface.heights
    step = grid.spacing[1] / speed
    decay = np.exp(-step)
    ramp = (1 - decay) / step
    effective, unit = 1 + 2 * ramp, rc.half_space(grid, 1.0)
    u = v = np.zeros(grid.shape)
    for _ in range(round(21 / step)):  # seven retardation times: what is left is exp(-7) = 0.1 % of the start
        u, v = (np.roll(each, -1, axis=1) for each in (u, v))
        known = decay * v - 2 * ramp * u
        pressed = rc.press(rc.Surface(known / effective - separation, grid), effective, pressure=0.02)
        new = (unit.apply(pressed.pressure) - known) / effective
        u, v = new, decay * v + 2 * ramp * (new - u)
    qx = 2 * np.pi * np.fft.fftfreq(grid.shape[1], grid.spacing[1])
    qx[grid.shape[1] // 2] = 0
    slope = np.fft.ifft(1j * qx * np.fft.fft(u, axis=1), axis=1).real
    return -np.mean(pressed.pressure * slope) / 0.02


def test_a_march_in_time_settles_at_the_steady_state():
    # Smooth on both grids, so that the error is that of the time step: 3 % and 0.8 %, of second order.
    surfaces = [
        rc.self_affine(
            rc.Grid((n, n), 1 / n, periodic=True), hurst=0.8, rms=0.01, rng=3, rolloff=0.5, short_cutoff=0.25
        )
        for n in (32, 64)
    ]
    coarse, fine = (marched(surface, 0.1) for surface in surfaces)
    found = rc.steady_sliding(surfaces[1], SOLID, speed=0.1, pressure=0.02).friction_coefficient
    assert abs(fine / found - 1) < abs(coarse / found - 1) / 3
    assert (4 * fine - coarse) / 3 == pytest.approx(found, rel=2e-3)


def test_a_saw_that_turns_round_is_its_mirror_image_that_does_not():
    x = np.arange(64) / 64
    heights = 0.02 * np.interp(x, [0, 0.8, 1], [0, 1, 0])
    smooth = np.fft.irfft(np.fft.rfft(heights) * np.exp(-((np.arange(33) / 6) ** 2)))
    grid = rc.Grid((4, 64), 1 / 64, periodic=True)
    saw, mirrored = (rc.Surface(np.tile(z, (4, 1)), grid) for z in (smooth, smooth[::-1]))
    forth, back, mirror = (
        rc.steady_sliding(surface, SOLID, speed=0.1, direction=(way, 0), pressure=0.01)
        for surface, way in ((saw, 1), (saw, -1), (mirrored, 1))
    )
    assert forth.friction[0] > 0 > back.friction[0]
    assert back.friction[0] == pytest.approx(-mirror.friction[0], rel=1e-6)
    assert abs(forth.friction[0] + back.friction[0]) > 0.05 * forth.friction[0]
    # The flank in front carries more: there the heights fall along the direction.
    for found in (forth, back):
        slope = np.gradient(smooth, 1 / 64)
        assert np.mean(found.pressure * slope) * found.direction[0] < 0


@pytest.mark.parametrize("ratio", [3.0, 1000.0])
def test_both_methods_give_the_same_contact(ratio, monkeypatch):
    solid = rc.viscoelastic.standard_solid(1.0, ratio, 1.0)
    given = {"speed": 3e-3, "pressure": 0.02}
    found = rc.steady_sliding(ROUGH, solid, **given)
    # The residual is that of the moving plane itself, by full transforms.
    _, qy, qx = waves(found.pressure)
    q = np.hypot(qy, qx)
    q[0, 0] = np.inf
    modulus = solid.complex_modulus(np.abs(-qx * 3e-3))
    answer = 1 / np.where(-qx < 0, modulus.conj(), modulus)
    answer[:, 16] = answer[:, 16].real  # of both signs
    u = np.fft.ifft2(2 / q * answer * np.fft.fft2(found.pressure)).real
    gap = u + ROUGH.heights.max() - ROUGH.heights - found.depth
    assert max(-gap.min(), np.abs(gap[found.contact]).max()) < 1.01e-8 * np.abs(u).max()
    monkeypatch.setattr(sliding_solver, "DENSE", 0)
    products = rc.steady_sliding(ROUGH, solid, **given)
    assert products.pressure == pytest.approx(found.pressure, abs=1e-6 * found.max_pressure)
    if ratio == 3:
        assert found.solves <= 6
        monkeypatch.setattr(sliding_solver, "IDLE", 0)  # sweeps only
        swept = rc.steady_sliding(ROUGH, solid, **given)
        assert 6 < swept.solves < 30  # a factor sin(delta) = 0.5 each: 27 without acceleration
        assert swept.pressure == pytest.approx(found.pressure, abs=1e-6 * found.max_pressure)


def test_a_term_without_weight_changes_nothing():
    more = rc.Viscoelastic(1.0, [2.0, 0.0], [1.0, 30.0])
    plain, other = (rc.steady_sliding(ROUGH, each, speed=0.1, pressure=0.02) for each in (SOLID, more))
    assert np.array_equal(other.pressure, plain.pressure)
    assert other.friction == pytest.approx(plain.friction, rel=1e-12, abs=1e-16)


def test_a_start_saves_solves_and_the_operator_is_one_of_the_protocol():
    first = rc.steady_sliding(ROUGH, SOLID, speed=0.01, pressure=0.02)
    again = rc.steady_sliding(ROUGH, SOLID, speed=0.01, force=0.02, start=first)
    assert again.solves == 0
    operator = first.problem.operator
    assert operator.as_matrix() @ first.pressure.ravel() == pytest.approx(
        first.displacement.ravel(), abs=1e-15
    )
    part = operator.restrict((slice(3, 9), slice(0, 32)))
    inside = np.zeros(GRID.shape)
    inside[3:9] = 1.0
    assert part.apply(np.ones((6, 32))) == pytest.approx(operator.apply(inside)[3:9], abs=1e-15)
    assert operator.restrict((slice(0, 32), slice(0, 32))) is operator


def test_a_missed_tolerance_is_stated(monkeypatch):
    monkeypatch.setattr(sliding_solver, "MAX_SOLVES", 1)
    monkeypatch.setattr(sliding_solver, "IDLE", 0)
    monkeypatch.setattr(sliding_solver, "SWEEPS", 1)
    with pytest.raises(rc.ConvergenceError, match=r"tolerance 1\.0e-08") as error:
        rc.steady_sliding(ROUGH, SOLID, speed=0.1, pressure=0.02)
    assert "where 1e-08 was asked for" in error.value.solution.notes[0]
    curve = rc.friction_curve(ROUGH, SOLID, speeds=[0.1], pressure=0.02)
    assert not curve.status[0].converged
    assert "0 of 1 speeds converged" in repr(curve)
    assert curve.plot().lines[-1].get_markerfacecolor() == "none"


def test_eight_decades_of_speed_on_a_material_of_ten_take_few_solves():
    gel = dataclasses.replace(
        rc.viscoelastic.power_law(1.0, 1.0, 0.3, band=(1e-9, 1e2)), equilibrium=1.0, band=None
    )
    curve = rc.friction_curve(ROUGH, gel, speeds=np.geomspace(1e-6, 1e2, 17), pressure=0.02)
    assert all(status.converged for status in curve.status)
    assert curve.solves.max() <= 20
    assert curve.solves.sum() <= 120
    assert curve.friction_coefficient.argmax() not in (0, 16)


def test_a_speed_that_does_not_converge_is_stated(monkeypatch):
    moving, starts = friction_curve.moving, []

    def no_fast_speeds(rest, material, speed, along, start):
        starts.append(start and start.speed)
        state = moving(rest, material, speed, along, start)
        return state if speed < 1e-2 else dataclasses.replace(state, status=Status.STAGNATED)

    monkeypatch.setattr(friction_curve, "moving", no_fast_speeds)
    curve = rc.friction_curve(ROUGH, SOLID, speeds=[5e-3, 50.0, 100.0], pressure=0.02)
    assert [status.converged for status in curve.status] == [True, False, False]
    assert starts == [None, 5e-3, 5e-3]  # a state that has not converged is no start
    assert curve.notes[0].startswith("At 2 of 3 speeds, first at 50 m/s: The residual is")


def test_what_limits_a_number_is_noted():
    fast = rc.steady_sliding(ROUGH, SOLID, speed=10.0, pressure=0.02)
    assert any("before it has recovered" in note for note in fast.notes)
    assert any("use smaller cells" in note for note in fast.notes)
    measured = rc.Viscoelastic(1.0, (2.0,), (1.0,), band=(0.1, 10.0))
    found = rc.steady_sliding(ROUGH, measured, speed=0.01, pressure=0.02)
    assert any("outside the band" in note for note in found.notes)
    assert not any("band" in note for note in fast.notes)


def test_a_curve_rises_and_falls_and_is_stored():
    curve = rc.friction_curve(ROUGH, SOLID, speeds=[1.0, 0.0, 0.03], pressure=0.02, direction=(0, 1))
    assert curve.speed.tolist() == [0.0, 0.03, 1.0]
    assert curve.friction_coefficient[0] == pytest.approx(0, abs=1e-15)
    assert curve.friction_coefficient[1] > curve.friction_coefficient[2]
    assert (np.diff(curve.contact_fraction) < 0).all()
    one = rc.steady_sliding(ROUGH, SOLID, speed=0.03, pressure=0.02, direction=(0, 1))
    assert curve.friction[1] == pytest.approx(one.friction, rel=1e-5, abs=1e-9)
    dataset = curve.to_dataset()
    assert dataset["friction_traction"].dims == ("sliding_speed", "component")
    assert dataset["dissipation"].attrs["units"] == "W m-2"
    assert curve.plot().get_xscale() == "linear"
    assert one.to_dataset()["gap"].shape == GRID.shape
    assert "friction coefficient" in repr(one)


FREE = rc.Surface(ROUGH.heights, rc.Grid((32, 32), 1 / 32))
HOLES = rc.Surface(np.where(ROUGH.heights > 0.02, np.nan, ROUGH.heights), GRID)


@pytest.mark.parametrize(
    ("surface", "material", "changed", "words"),
    [
        (FREE, SOLID, {}, "periodic along both axes"),
        (HOLES, SOLID, {}, "needs all heights"),
        (ROUGH, rc.viscoelastic.maxwell(1.0, 1.0), {}, "no relaxed modulus"),
        (ROUGH, 1e6, {}, "viscoelastic material"),
        (ROUGH, SOLID, {"speed": -1.0}, "0 or more"),
        (ROUGH, SOLID, {"direction": (0, 0)}, "not zero"),
        (ROUGH, SOLID, {"direction": (1, 0, 0)}, "not zero"),
        (ROUGH, SOLID, {"pressure": -1.0}, "positive"),
        (ROUGH, SOLID, {"force": 1.0}, "exactly one"),
        (ROUGH, SOLID, {"start": rc.press(rc.shapes.wave(rc.Grid((8, 8), 1.0, periodic=True), 1.0, 8.0), 1.0,
                                          pressure=0.1)}, "on the grid"),
    ],
)  # fmt: skip
def test_what_cannot_slide_is_refused(surface, material, changed, words):
    with pytest.raises(rc.InputError, match=words):
        rc.steady_sliding(surface, material, **({"speed": 0.1, "pressure": 0.02} | changed))


def test_a_curve_needs_a_speed():
    with pytest.raises(rc.InputError, match="at least one speed"):
        rc.friction_curve(ROUGH, SOLID, speeds=[], pressure=0.02)
