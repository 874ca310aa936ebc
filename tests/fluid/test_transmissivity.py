"""The flow through the gap at each load of a curve."""

import dataclasses

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.plot.facts import curve_facts
from roughcontact.theory import leakage

SIZE = (32, 48)
PERIODIC, FREE = (
    rc.Surface(
        rc.self_affine(
            rc.Grid(SIZE, (1e-6, 1.5e-6), periodic=True),
            hurst=0.8,
            rms=1e-7,
            rng=2,
            rolloff=24e-6,
            short_cutoff=8e-6,
        ).heights,
        rc.Grid(SIZE, (1e-6, 1.5e-6), periodic=periodic),
    )
    for periodic in (True, False)
)
PRESSURES = (1e6, 3e6, 3e7)
WATER = rc.Liquid(1e-3)


def curve_of(surface=PERIODIC, pressures=PRESSURES, hardness=None, **given):
    measures = [rc.Transmissivity(**(given if given.keys() & {"axis", "between"} else given | {"axis": 0}))]
    return rc.loading_curve(surface, 1e9, pressures=pressures, hardness=hardness, measures=measures)


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("hardness", [None, 1e8])
@pytest.mark.parametrize("surface", [PERIODIC, FREE], ids=["periodic", "free"])
def test_each_state_has_the_numbers_of_its_flow(surface, axis, hardness):
    curve = curve_of(surface, axis=axis, hardness=hardness)
    periodic = surface is PERIODIC
    along = axis if periodic else 0
    path = rc.loading_path(surface, 1e9, pressures=PRESSURES, hardness=hardness)
    for k, solution in enumerate(path):
        flow = rc.gap_flow(solution, axis=None if periodic else axis)
        found = {name: values[k] for name, values in curve.measured.items()}
        kappa = flow.transmissivity[along, along]
        assert found["transmissivity"] == kappa
        assert found["hydraulic_gap"] == pytest.approx(np.cbrt(kappa), rel=1e-12)
        assert found["percolates"] == flow.percolates
        assert found["transmissivity_bruggeman"] == leakage.bruggeman(flow.gap**3)
        if flow.percolates:
            place = flow.constriction_along(along)
            assert found["flow_factor"] == pytest.approx(kappa / curve.mean_gap[k] ** 3, rel=1e-12)
            assert (found["constriction_cells"], found["constriction_share"]) == (place.cells, place.share)
            assert found["flow_residual"] == flow.residual < 1e-6
    # The first load leaves a path open, the last closes it.
    assert curve.measured["percolates"][[0, -1]].tolist() == [1.0, 0.0]
    assert curve.measured["flow_factor"][-1] == curve.measured["constriction_cells"][-1] == 0
    assert np.isnan(curve.measured["constriction_share"][-1])


def test_flow_factors_fall_with_the_load_and_are_infinite_without_a_mean_gap():
    factor = curve_of().measured["flow_factor"]
    assert 0 < factor[1] < factor[0] < 1
    soft = curve_of(FREE, [2e6], hardness=4e6)  # most cells in contact have flowed
    assert soft.mean_gap[0] < 0 < soft.measured["transmissivity"][0]
    assert soft.measured["flow_factor"][0] == np.inf


def test_a_channel_conducts_along_its_direction_only():
    """Along x the channel's cubed gap times its part of the width; along y nothing."""
    heights = np.zeros((16, 8))
    heights[4:8] = -1e-5
    channel = rc.Surface(heights, rc.Grid((16, 8), 1e-6, periodic=True))
    along, across = (curve_of(channel, [1e3], axis=axis).measured for axis in (1, 0))
    gap = rc.press(channel, 1e9, pressure=1e3).gap[4:8]
    assert along["transmissivity"][0] == pytest.approx(np.sum(gap[:, 0] ** 3) / 16, rel=1e-9)
    assert (along["percolates"][0], across["percolates"][0], across["transmissivity"][0]) == (1, 0, 0)


def test_missing_cells_and_regions():
    heights = FREE.heights.copy()
    heights[:, 20:24] = np.nan  # a ditch across x
    torn = rc.Surface(heights, FREE.grid)
    closed, opened = (curve_of(torn, [1e6], axis=1, missing=each).measured for each in ("closed", "open"))
    assert closed["percolates"] == 0
    assert opened["transmissivity"] > 0
    ends = np.zeros(SIZE, bool), np.zeros(SIZE, bool)
    ends[0][:2], ends[1][-2:] = True, True
    curve = curve_of(FREE, [1e6], between=ends)
    flow = rc.gap_flow(rc.press(FREE, 1e9, pressure=1e6), between=ends)
    assert curve.measured["transmissivity"][0] == flow.transmissivity[0, 0]
    assert all(np.isnan(curve.measured[name][0]) for name in ("hydraulic_gap", "flow_factor"))
    with pytest.raises(ValueError, match="no transmissivity along an axis"):
        rc.leak_rates(curve, WATER, drop=1e5, seal_width=1e-3, circumference=0.1)


@pytest.mark.parametrize("axis", [2, "x"])
def test_an_unknown_axis_is_refused(axis):
    with pytest.raises(ValueError, match="the axis must be 0 or 1"):
        rc.Transmissivity(axis=axis)
    with pytest.raises(ValueError, match="exactly one of axis and between: none is given"):
        rc.Transmissivity()


def test_leak_rates_are_those_of_each_load():
    seal = {"drop": 2e6, "seal_width": 1e-3, "circumference": 0.1}
    rates = rc.leak_rates(curve_of(axis=1), WATER, **seal)
    assert np.isnan(rates[0])  # the drop exceeds 1 MPa
    for rate, solution in zip(
        rates[1:], rc.loading_path(PERIODIC, 1e9, pressures=PRESSURES[1:]), strict=True
    ):
        assert rate == pytest.approx(rc.leak(solution, WATER, axis=1, **seal).volume, rel=1e-5)
    assert rates[1] > rates[2] == 0
    with pytest.raises(ValueError, match="that of a liquid"):
        rc.leak_rates(curve_of(pressures=[1e6]), rc.Gas("air"), **seal)
    with pytest.raises(ValueError, match="no transmissivity along an axis"):
        rc.leak_rates(rc.loading_curve(PERIODIC, 1e9, pressures=[1e6]), WATER, **seal)


def test_leak_rates_of_a_history_follow_its_gaps_and_end_with_its_pressure():
    """At a held squeeze the pressure relaxes to a third, and falls below the drop of 0.6 of the first pressure."""
    rubber = rc.viscoelastic.standard_solid(1e9, 3e9, 1.0)
    depth = rc.press(PERIODIC, 3e9, pressure=3e6).depth
    seal = {"drop": 1.8e6, "seal_width": 1e-3, "circumference": 0.1}
    history = {"times": [0, 0, 20], "steps": 10, "measures": [rc.Transmissivity(axis=0)]}
    squeeze = rc.viscoelastic_curve(PERIODIC, rubber, depths=[0, depth, depth], **history)
    rates = rc.leak_rates(squeeze, WATER, **seal)
    sealed = squeeze.nominal_pressure >= seal["drop"]
    assert np.array_equal(np.isnan(rates), ~sealed)
    assert np.isnan(rates[0])  # before the jump
    assert np.isnan(rates[-1])
    assert sealed.sum() >= 1
    elastic = rc.leak(rc.press(PERIODIC, 3e9, pressure=3e6), WATER, axis=0, **seal).volume
    assert rates[sealed] == pytest.approx(elastic, rel=1e-5)
    force = rc.viscoelastic_curve(PERIODIC, rubber, pressures=[0, 3e6, 3e6], **history)
    falling = rc.leak_rates(force, WATER, **seal)[1:]
    assert falling[0] == pytest.approx(elastic, rel=1e-5)
    assert np.all(np.diff(falling) < 0)
    relaxed = rc.leak(rc.press(PERIODIC, 1e9, pressure=3e6), WATER, axis=0, **seal).volume
    assert falling[-1] == pytest.approx(relaxed, rel=1e-2)  # ten steps of two relaxation times


def test_a_flow_beyond_its_tolerance_and_a_narrow_constriction_are_noted():
    curve = curve_of()
    assert not any("bounds of the flow" in note or "critical constriction" in note for note in curve.notes)
    worse = curve.measured | {
        "flow_residual": np.array([1e-9, 2e-3, 0.0]),
        "constriction_cells": np.array([9.0, 3.0, 0.0]),
        "constriction_share": np.array([0.1, 0.4, np.nan]),
    }
    first, *others = dataclasses.replace(curve, measured=worse).notes
    assert first == "At 1 of 3 loads the bounds of the flow differ by more than 1e-06, by up to 2.0e-03."
    assert any(
        note.startswith(
            "At 3 MPa, the last load with an open path, the critical constriction is 3 cells wide"
        )
        for note in others
    )


@pytest.mark.parametrize(
    ("pressures", "words"),
    [
        ((3e7, 1e8), "at no load, not even at 30 MPa (A/A0 "),
        ((1e6, 2e6), "up to the largest load, 2 MPa (A/A0 "),
        ((1e6, 3e7, 1e8), "closes between 1 MPa (A/A0 "),
    ],
)
def test_the_load_that_closes_the_gap_is_stated(pressures, words):
    facts = dict(curve_facts(curve_of(pressures=pressures), None))
    assert facts["open path"].startswith(words)
    assert "open path" not in dict(curve_facts(rc.loading_curve(PERIODIC, 1e9, pressures=[1e6]), None))


def test_tables_of_the_interface_hold_the_flow():
    curve = curve_of(pressures=(1e6, 2e6, 3e6))
    table = rc.interface_table(curve)
    data = table.to_dataset()
    np.testing.assert_array_equal(data["flow_factor"], curve.measured["flow_factor"])
    np.testing.assert_array_equal(table.flow["hydraulic_gap"], curve.measured["hydraulic_gap"])
    assert (data["hydraulic_gap"].attrs["units"], data["flow_factor"].attrs["units"]) == ("m", "1")
    assert not rc.interface_table(rc.loading_curve(PERIODIC, 1e9, pressures=[1e6, 3e6])).flow
