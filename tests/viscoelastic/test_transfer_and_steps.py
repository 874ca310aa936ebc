"""A rough periodic surface under one rise and one fall: steps in time beside the transfer of its elastic curve."""

import functools

import numpy as np
import pytest

import roughcontact as rc

SOLID = rc.Viscoelastic(1.0, [1.0, 1.0], [0.3, 2.0])
GRID = rc.Grid((48, 48), 1 / 48, periodic=True)
ROUGH = rc.self_affine(GRID, hurst=0.8, rms=0.01, rng=5, rolloff=0.5, short_cutoff=1 / 6)
DEEPEST = 0.6 * float(ROUGH.heights.max())
TIMES = (0.0, 1.0, 1.2, 1.4)
CUT = (0.0, 0.35, 0.7, 1.0, 1.05, 1.2, 1.33, 1.4)
SHARES = [0.0, 1.0, 0.8, 0.6]  # of the largest load
KINDS = ("depths", "forces")


@functools.cache
def curve():
    return rc.loading_curve(ROUGH, 1.0, depths=np.linspace(0, DEEPEST, 61)[1:], tolerance=1e-10)


def largest(kind):
    return DEEPEST if kind == "depths" else 1.5 * float(curve().force[-1])


def load_at(times, kind):
    return largest(kind) * np.interp(times, TIMES, SHARES)


@functools.cache
def stepped(times, kind, tolerance):
    """Return the curve and its points at TIMES."""
    loads = {kind: load_at(times, kind)}
    found = rc.viscoelastic_curve(
        ROUGH, SOLID, times=times, **loads, time_tolerance=tolerance, tolerance=1e-10
    )
    return found, np.searchsorted(found.time, TIMES)


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3])
@pytest.mark.parametrize("kind", KINDS)
def test_steps_and_transfer_agree_within_their_stated_errors(kind, tolerance):
    found = rc.viscoelastic.transfer(curve(), SOLID, TIMES, **{kind: load_at(TIMES, kind)})
    steps, at = stepped(TIMES, kind, tolerance)
    assert 0 < found.interpolation_error < 0.03
    assert 0 < steps.time_error[-1] <= tolerance
    answer = {"depths": "force", "forces": "depth"}[kind]
    by_steps, by_curve = getattr(steps, answer)[at], getattr(found, answer)
    # The interpolation error is that of the area, which grows by whole cells: the error of time is enough here.
    assert np.abs(by_steps - by_curve).max() <= steps.time_error[-1] * by_curve.max()
    area = np.abs(steps.contact_area[at] - found.contact_area).max()
    bound = found.interpolation_error + steps.time_error[-1]
    assert area <= bound * found.contact_area.max() + GRID.cell_area
    assert found.growth_time[-1] < 1 == found.growth_time[1]  # the contact grew, and receded


@pytest.mark.parametrize("kind", KINDS)
def test_how_the_history_is_cut_matters_less_than_the_stated_error(kind):
    """Further given times move the steps; the transfer does not depend on them."""
    (whole, at), (cut, among) = (stepped(times, kind, 1e-2) for times in (TIMES, CUT))
    bound = whole.time_error[-1] + cut.time_error[-1]
    for name in ("force", "depth", "work"):
        a, b = getattr(whole, name)[at], getattr(cut, name)[among]
        assert np.abs(a - b).max() <= bound * np.abs(a).max()
    assert len(cut) != len(whole)
    transferred = [
        rc.viscoelastic.transfer(curve(), SOLID, times, **{kind: load_at(times, kind)})
        for times in (TIMES, CUT)
    ]
    again = np.searchsorted(CUT, TIMES)
    for name in ("force", "depth", "contact_area"):
        a, b = (getattr(each, name) for each in transferred)
        # The growth is integrated in small steps of each interval, with an error of about 1e-6.
        assert b[again] == pytest.approx(a, abs=1e-5 * a.max())


def test_a_viscous_body_under_a_sudden_force_is_the_elastic_one_with_four_eta_over_t():
    """The impulse of the pressure is the elastic pressure under the impulse of the force, at each step."""
    force, times = 0.3 * largest("forces"), [0.0, 0.0, 0.25, 1.0]
    body = rc.viscoelastic.viscous(0.25)
    states = list(rc.viscoelastic_path(ROUGH, body, times=times, forces=[0.0, *[force] * 3], steps=2))
    assert [each.time for each in states] == [0.0, 0.125, 0.25, 0.625, 1.0]
    assert states[0].depth == 0
    for each in states[1:]:
        elastic = rc.press(ROUGH, 1 / each.time, force=force)  # 4 eta = 1
        # Two solutions with residuals of 1e-8 of the largest displacement, which is less than ten depths.
        assert each.depth == pytest.approx(elastic.depth, rel=1e-6)
        np.testing.assert_array_equal(each.contact, elastic.contact)
